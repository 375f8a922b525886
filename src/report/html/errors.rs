//! What is wrong with masks: sign, place, distance, kind, stability. And the biases that were searched for.

use std::cmp::Reverse;

use maud::{Markup, html};

use super::shell::{Section, details, note, prose};
use crate::metrics::MetricValues;
use crate::record::{RegionRow, Summary};
use crate::report::format::{count, px_per_frame};
use crate::report::load::Run;
use crate::report::table::{Cell, Column, Table};

/// Upper ends of the distance classes shown, in pixels; what is farther is the last class.
const CLASSES_PX: [f64; 3] = [1.0, 4.0, 16.0];
/// So many regions of a scene are listed.
const MAX_REGIONS: usize = 8;

/// The section; none where no cell was verified.
pub(super) fn section(run: &Run, has_pictures: bool) -> Option<Section> {
    let mut scenes = run.scenes();
    scenes.retain(|scene| run.rows(scene).iter().any(|row| row.verified_frames > 0));
    let content = html! {
        p.note {
            (prose(include_str!("notes/errors.html"))) " "
            @if has_pictures { "The maps under " a href="#pictures" { "Pictures" } " show sign and place by colour." }
        }
        @for scene in &scenes {
            h3 { (run.scene_title(scene)) }
            (table(run, scene))
            (regions(run, scene))
        }
    };
    (!scenes.is_empty()).then(|| Section::new("errors", "Errors", content))
}

fn table(run: &Run, scene: &str) -> Markup {
    let mut rows = run.rows(scene);
    rows.retain(|row| row.verified_frames > 0);
    let px = |row: &Summary, sum: Option<u64>| sum.map(|px| px_per_frame(px, row.verified_frames));
    let wrong = |row: &Summary| Some(row.false_lit? + row.false_shadowed?);
    // Rounded down: 100 % must mean all.
    let percent = |share: f64| format!("{:.0} %", (share * 100.0).floor());
    let within = |row: &Summary, class: usize| shares(&row.metrics).map(|s| percent(s[class]));
    let method = Column::heads("Method", "method");
    Table::of("Errors by method", rows)
        .class("errors")
        .column(method, |row| {
            let contender = run.contender(row);
            Cell::method(&contender.method, &contender.variant)
        })
        .number(("Wrong", "px"), |row| px(row, wrong(row)))
        .number("false\nlit", |row| px(row, row.false_lit))
        .number("false\nshadowed", |row| px(row, row.false_shadowed))
        .over("Sign", 2)
        .number("boundary", |row| px(row, row.boundary_px))
        .number("artifact", |row| px(row, row.artifact_px))
        .over("Place", 2)
        .number("", |row| Cell::drawn(bar(&row.metrics)))
        .number(("≤ 1", "px"), |row| within(row, 0))
        .number(("≤ 4", "px"), |row| within(row, 1))
        .number(("≤ 16", "px"), |row| within(row, 2))
        .number(("most", "px"), |row| {
            let farthest = row.metrics.get("distance_px_max");
            farthest.map(|far| format!("{far:.1}"))
        })
        .over("Distance", 5)
        .text(("Kinds", "px per frame"), |row| {
            let px = |px| px_per_frame(px, row.verified_frames);
            kinds(row.metrics.classes("label"), px)
        })
        .number(("Flicker", "per million"), |row| flicker(&row.metrics))
        .number(("FLIP", "mean"), |row| {
            row.metrics.get("flip").map(|flip| format!("{flip:.4}"))
        })
        .html()
}

/// Pixels that flicker of a million followed, never nothing where there is something.
fn flicker(metrics: &MetricValues) -> Option<String> {
    let (px, of_px) = (metrics.px("flicker_px")?, metrics.px("followed_px")?);
    let tenths = px as f64 * 1e7 / of_px as f64;
    (of_px > 0).then(|| match (px, tenths.round() as u64) {
        (0, _) => "0".to_owned(),
        (_, 0) => "<0.1".to_owned(),
        (_, tenths) => format!("{}.{}", count(tenths / 10), tenths % 10),
    })
}

/// The share of wrong pixels within each of [`CLASSES_PX`]; `None` where none has a distance.
fn shares(metrics: &MetricValues) -> Option<[f64; CLASSES_PX.len()]> {
    let classes: Vec<(&str, u64)> = metrics.classes("distance").collect();
    let all: u64 = classes.iter().map(|(_, px)| px).sum();
    // The class `more` has no upper end, and so is within none.
    let within = |limit: f64| {
        let is_near = |upper: &str| upper.parse::<f64>().is_ok_and(|upper| upper <= limit);
        let near = classes.iter().filter(|(upper, _)| is_near(upper));
        near.map(|(_, px)| px).sum::<u64>() as f64 / all as f64
    };
    (all > 0).then(|| CLASSES_PX.map(within))
}

fn bar(metrics: &MetricValues) -> Markup {
    html! {
        @if let Some([near, middle, far]) = shares(metrics) {
            @let shares = [near, middle - near, far - middle, 1.0 - far];
            span.bar aria-hidden="true" {
                @for (class, share) in ["near", "middle", "far", "beyond"].iter().zip(shares) {
                    span class=(class) style={ "width:" (format!("{:.2}", share * 100.0)) "%" } {}
                }
            }
        }
    }
}

/// The kinds of error by their pixels, the most first; `None` where nothing was labelled.
pub(super) fn kinds<'a>(
    kinds: impl IntoIterator<Item = (&'a str, u64)>,
    text: impl Fn(u64) -> String,
) -> Option<String> {
    let mut kinds: Vec<(&str, u64)> = kinds.into_iter().filter(|(_, px)| *px > 0).collect();
    kinds.sort_by_key(|(_, px)| Reverse(*px));
    let texts = kinds
        .iter()
        .map(|(name, px)| format!("{name} {}", text(*px)));
    (!kinds.is_empty()).then(|| texts.collect::<Vec<_>>().join(", "))
}

fn regions(run: &Run, scene: &str) -> Markup {
    let mut regions: Vec<&RegionRow> = run.regions.iter().filter(|r| r.scene == scene).collect();
    regions.sort_by_key(|region| Reverse(region.size_px));
    regions.truncate(MAX_REGIONS);
    let frames = run.frames.iter().filter(|frame| frame.scene == scene);
    let all = count(frames.map(|frame| frame.px("regions")).sum());
    let shown = regions.len();
    let method = Column::heads("Method", "method");
    let table = Table::of("Largest regions of artifacts", regions)
        .column(method, |r| Cell::method(&r.method, r.variant.as_str()))
        .number("Frame", |region| region.frame.to_string())
        .number(("Size", "px"), |region| region.size_px)
        .text("Sign", |region| region.sign.replace('_', " "))
        .text("Kind", |region| region.label.as_str())
        .text("Columns", |r| format!("{}–{}", r.left, r.right))
        .text("Rows", |r| format!("{}–{}", r.top, r.bottom));
    let summary = format!("Largest regions of artifacts ({shown} of {all})");
    html! { @if shown > 0 { (details(&summary, &table.html())) } }
}

/// What ends acne, and what it costs; none where no bias was searched for.
pub(super) fn biases(run: &Run) -> Option<Section> {
    let method = Column::heads("Method", "method");
    let table = Table::of("Biases found", &run.biases)
        .text("Scene", |bias| run.scene_title(&bias.scene))
        .column(method, |b| Cell::method(&b.method, b.variant.as_str()))
        .number(("Resolution", "texels"), |bias| bias.resolution.to_string())
        .number("Slope bias", |bias| bias.slope_bias.to_string())
        .number("before", |bias| tenths(bias.acne_px_unbiased))
        .number("after", |bias| tenths(bias.acne_px))
        .over("Acne", 2)
        .number("before", |bias| tenths(bias.detached_px_unbiased))
        .number("after", |bias| tenths(bias.detached_px))
        .over("Detached shadow", 2)
        .number("Tried", |bias| bias.tried.to_string());
    let content = html! { (note(include_str!("notes/bias.html"))) (table.html()) };
    (!run.biases.is_empty()).then(|| Section::new("bias", "Bias", content))
}

/// A tenth of a pixel, but never nothing where there is something.
fn tenths(px: f64) -> String {
    if px > 0.0 && px < 0.05 {
        "<0.1".to_owned()
    } else {
        format!("{px:.1}")
    }
}

#[cfg(test)]
mod tests {
    use super::shares;

    #[test]
    fn shares_add_up_and_what_is_beyond_is_within_none() {
        let classes = |px: &[(&str, f64)]| px.iter().copied().collect();
        let found = [
            ("distance.1", 5.0),
            ("distance.2", 2.0),
            ("distance.4", 1.0),
            ("distance.8", 1.0),
            ("distance.more", 1.0),
        ];
        assert_eq!(shares(&classes(&found)), Some([0.5, 0.8, 0.9]));
        let none = [("distance.1", 0.0), ("distance.more", 0.0)];
        assert_eq!(shares(&classes(&none)), None);
        assert_eq!(shares(&classes(&[])), None);
    }
}
