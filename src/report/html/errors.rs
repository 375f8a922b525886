//! What is wrong with masks: sign, place, distance, kind, stability. And the biases that were searched for.

use std::cmp::Reverse;

use maud::{Markup, html};

use super::shell::{Section, details};
use crate::metrics::MetricValues;
use crate::record::{RegionRow, Summary};
use crate::report::format::{count, px_per_frame};
use crate::report::load::Run;
use crate::report::table::{Cell, Column, Row, Table};

/// Upper ends of the distance classes shown, in pixels; what is farther is the last class.
const CLASSES_PX: [f64; 3] = [1.0, 4.0, 16.0];
/// So many regions of a scene are listed.
const MAX_REGIONS: usize = 8;

/// The section; none where no cell was verified.
pub(super) fn section(run: &Run, has_pictures: bool) -> Option<Section> {
    let is_verified = |scene: &&str| !verified(run, scene).is_empty();
    let scenes: Vec<&str> = run.scenes().into_iter().filter(is_verified).collect();
    let content = html! {
        p.note {
            "Wrong pixels per verified frame: by sign (" em { "false lit" } ", " em { "false shadowed" }
            "), and the same ones by place (at the true shadow " em { "boundary" } ", within one pixel; "
            "farther, an " em { "artifact" } "). Distances are to the true boundary; the bar shows "
            span.key.near {} " up to 1 px, " span.key.middle {} " up to 4, " span.key.far {}
            " up to 16, " span.key.beyond {} " farther. Flicker: surface points per million followed "
            "that turn from right to wrong, or back, although their truth stays. FLIP is the difference "
            "that an eye sees, from 0 to 1. A dash: not measured. "
            @if has_pictures {
                "The maps under " a href="#pictures" { "Pictures" }
                " show sign and place by colour."
            }
        }
        @for scene in &scenes {
            h3 { (run.scene_title(scene)) }
            (table(run, scene).html())
            (regions(run, scene))
        }
    };
    (!scenes.is_empty()).then(|| Section::new("errors", "Errors", content))
}

fn verified<'a>(run: &'a Run, scene: &str) -> Vec<&'a Summary> {
    let rows = run.rows(scene).into_iter();
    rows.filter(|row| row.verified_frames > 0).collect()
}

fn table(run: &Run, scene: &str) -> Table {
    let distance = |head: String| Column::number(head).over("Distance");
    let within = CLASSES_PX.map(|class| distance(format!("≤ {class}")).unit("px"));
    let mut columns = vec![
        Column::heads("Method", "method"),
        Column::number("Wrong").unit("px"),
        Column::number("false\nlit").over("Sign"),
        Column::number("false\nshadowed").over("Sign"),
        Column::number("boundary").over("Place"),
        Column::number("artifact").over("Place"),
        distance(String::new()),
    ];
    columns.extend(within);
    columns.extend([
        distance("most".to_owned()).unit("px"),
        Column::text("Kinds").unit("px per frame"),
        Column::number("Flicker").unit("per million"),
        Column::number("FLIP").unit("mean"),
    ]);
    let rows = verified(run, scene)
        .into_iter()
        .map(|summary| row(run, summary));
    Table::new("Errors by method", columns)
        .class("errors")
        .extend(rows)
}

fn row(run: &Run, row: &Summary) -> Row {
    let contender = run.contender(row);
    let px = |sum: Option<u64>| sum.map(|sum| px_per_frame(sum, row.verified_frames)).into();
    let wrong = row.false_lit.zip(row.false_shadowed);
    let metrics = &row.metrics;
    let shares = shares(metrics);
    let flicker = metrics.px("flicker_px").zip(metrics.px("followed_px"));
    let flicker = flicker.filter(|(_, followed)| *followed > 0);
    let mut cells = vec![
        Cell::method(&contender.method, &contender.variant),
        px(wrong.map(|(lit, shadowed)| lit + shadowed)),
        px(row.false_lit),
        px(row.false_shadowed),
        px(row.boundary_px),
        px(row.artifact_px),
        Cell::drawn(bar(shares)),
    ];
    // Rounded down: 100 % must mean all.
    let percent = |index: usize| shares.map(|s| format!("{:.0} %", (s[index] * 100.0).floor()));
    cells.extend((0..CLASSES_PX.len()).map(|index| percent(index).into()));
    cells.extend([
        metrics
            .get("distance_px_max")
            .map(|far| format!("{far:.1}"))
            .into(),
        kinds(row).into(),
        flicker
            .map(|(flicker, followed)| px_per_million(flicker, followed))
            .into(),
        metrics.get("flip").map(|flip| format!("{flip:.4}")).into(),
    ]);
    cells.into()
}

/// As [`px_per_frame`], never nothing where there is something.
fn px_per_million(px: u64, of_px: u64) -> String {
    let tenths = px as f64 * 1e7 / of_px as f64;
    match (px, tenths.round() as u64) {
        (0, _) => "0".to_owned(),
        (_, 0) => "<0.1".to_owned(),
        (_, tenths) => format!("{}.{}", count(tenths / 10), tenths % 10),
    }
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

fn bar(shares: Option<[f64; CLASSES_PX.len()]>) -> Markup {
    let Some([near, middle, far]) = shares else {
        return html! {};
    };
    let shares = [near, middle - near, far - middle, 1.0 - far];
    html! {
        span.bar aria-hidden="true" {
            @for (class, share) in ["near", "middle", "far", "beyond"].iter().zip(shares) {
                span class=(class) style={ "width:" (format!("{:.2}", share * 100.0)) "%" } {}
            }
        }
    }
}

/// The kinds of error by their pixels, the most first; `None` where nothing was labelled.
fn kinds(row: &Summary) -> Option<String> {
    let mut kinds: Vec<(&str, u64)> = row.metrics.classes("label").collect();
    kinds.retain(|(_, px)| *px > 0);
    kinds.sort_by_key(|(_, px)| Reverse(*px));
    let text = |(name, px)| format!("{name} {}", px_per_frame(px, row.verified_frames));
    let texts: Vec<String> = kinds.into_iter().map(text).collect();
    (!texts.is_empty()).then(|| texts.join(", "))
}

fn regions(run: &Run, scene: &str) -> Markup {
    let mut regions: Vec<&RegionRow> = run.regions.iter().filter(|r| r.scene == scene).collect();
    regions.sort_by_key(|region| Reverse(region.size_px));
    regions.truncate(MAX_REGIONS);
    if regions.is_empty() {
        return html! {};
    }
    let frames = run.frames.iter().filter(|frame| frame.scene == scene);
    let all: u64 = frames.map(|frame| frame.px("regions")).sum();
    let shown = regions.len();
    let columns = [
        Column::heads("Method", "method"),
        Column::number("Frame"),
        Column::number("Size").unit("px"),
        Column::text("Sign"),
        Column::text("Kind"),
        Column::text("Columns"),
        Column::text("Rows"),
    ];
    let row = |region: &RegionRow| {
        [
            Cell::method(&region.method, region.variant.as_str()),
            region.frame.to_string().into(),
            count(region.size_px).into(),
            region.sign.replace('_', " ").into(),
            region.label.as_str().into(),
            format!("{}–{}", region.left, region.right).into(),
            format!("{}–{}", region.top, region.bottom).into(),
        ]
    };
    let table = Table::new("Largest regions of artifacts", columns);
    let summary = format!("Largest regions of artifacts ({shown} of {})", count(all));
    details(&summary, &table.extend(regions.into_iter().map(row)).html())
}

/// What ends acne, and what it costs; none where no bias was searched for.
pub(super) fn biases(run: &Run) -> Option<Section> {
    let columns = [
        Column::text("Scene"),
        Column::heads("Method", "method"),
        Column::number("Resolution").unit("texels"),
        Column::number("Slope bias"),
        Column::number("before").over("Acne"),
        Column::number("after").over("Acne"),
        Column::number("before").over("Detached shadow"),
        Column::number("after").over("Detached shadow"),
        Column::number("Tried"),
    ];
    let rows = run.biases.iter().map(|bias| {
        [
            run.scene_title(&bias.scene).into(),
            Cell::method(&bias.method, bias.variant.as_str()),
            bias.resolution.to_string().into(),
            bias.slope_bias.to_string().into(),
            px(bias.acne_px_unbiased),
            px(bias.acne_px),
            px(bias.detached_px_unbiased),
            px(bias.detached_px),
            bias.tried.to_string().into(),
        ]
    });
    let content = html! {
        p.note {
            "The smallest slope bias that leaves no more acne than the largest one does, for each shadow "
            "map whose bias was searched for, and the shadow that it detaches from its caster: in pixels "
            "per frame, before (without slope bias) and after. Biases are tried in other frames than the "
            "verified ones."
        }
        (Table::new("Biases found", columns).extend(rows).html())
    };
    (!run.biases.is_empty()).then(|| Section::new("bias", "Bias", content))
}

/// A tenth of a pixel, but never nothing where there is something.
fn px(per_frame: f64) -> Cell {
    if per_frame > 0.0 && per_frame < 0.05 {
        "<0.1".into()
    } else {
        format!("{per_frame:.1}").into()
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
