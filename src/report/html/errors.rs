//! What is wrong with masks: sign, place, distance, kind, stability.

use maud::{Markup, html};

use super::or_dash;
use super::results::breakable;
use crate::metrics::MetricValues;
use crate::record::{RegionRow, Summary};
use crate::report::format::{count, px_per_frame};
use crate::report::load::Run;

/// Upper ends of the distance classes shown, in pixels; what is farther is the last class.
const CLASSES_PX: [f64; 3] = [1.0, 4.0, 16.0];
/// So many regions of a scene are listed.
const MAX_REGIONS: usize = 8;

/// The section; nothing where no cell was verified.
pub(super) fn section(run: &Run, has_pictures: bool) -> Markup {
    let scenes: Vec<&str> = run
        .scenes()
        .into_iter()
        .filter(|scene| !verified(run, scene).is_empty())
        .collect();
    html! {
        @if !scenes.is_empty() {
            section #errors {
                h2 { "Errors" }
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
                @for scene in scenes {
                    h3 { (run.scene_title(scene)) }
                    (table(run, scene))
                    (regions(run, scene))
                }
            }
        }
    }
}

/// Whether the page has the section.
pub(super) fn has_any(run: &Run) -> bool {
    run.summaries.iter().any(|row| row.verified_frames > 0)
}

fn verified<'a>(run: &'a Run, scene: &str) -> Vec<&'a Summary> {
    let rows = run.rows(scene).into_iter();
    rows.filter(|row| row.verified_frames > 0).collect()
}

fn table(run: &Run, scene: &str) -> Markup {
    html! {
        div.scroll tabindex="0" role="region" aria-label="Errors by method" {
            table.errors {
                thead {
                    tr {
                        th.text scope="col" rowspan="2" { "Method" }
                        th scope="col" rowspan="2" { "Wrong" small { "px" } }
                        th.group scope="colgroup" colspan="2" { "Sign" }
                        th.group scope="colgroup" colspan="2" { "Place" }
                        th.group scope="colgroup" colspan="5" { "Distance" }
                        th.text scope="col" rowspan="2" { "Kinds" small { "px per frame" } }
                        th scope="col" rowspan="2" { "Flicker" small { "per million" } }
                        th scope="col" rowspan="2" { "FLIP" small { "mean" } }
                    }
                    tr {
                        th scope="col" { "false" br; "lit" }
                        th scope="col" { "false" br; "shadowed" }
                        th scope="col" { "boundary" }
                        th scope="col" { "artifact" }
                        th.text scope="col" {}
                        @for class in CLASSES_PX { th scope="col" { "≤ " (class) small { "px" } } }
                        th scope="col" { "most" small { "px" } }
                    }
                }
                tbody { @for summary in verified(run, scene) { (row(run, summary)) } }
            }
        }
    }
}

fn row(run: &Run, row: &Summary) -> Markup {
    let contender = run.contender(row);
    let px = |sum: Option<u64>| or_dash(sum.map(|sum| px_per_frame(sum, row.verified_frames)));
    let wrong = row
        .false_lit
        .zip(row.false_shadowed)
        .map(|(lit, shadowed)| lit + shadowed);
    let shares = shares(&row.metrics);
    let metrics = &row.metrics;
    let flicker = metrics
        .px("flicker_px")
        .zip(metrics.px("followed_px"))
        .filter(|(_, followed)| *followed > 0);
    let flicker = flicker.map(|(flicker, followed)| px_per_million(flicker, followed));
    html! {
        tr {
            th.method scope="row" {
                code { (contender.method) }
                @if !contender.variant.is_empty() { " " span.quiet { (breakable(&contender.variant)) } }
            }
            td { (px(wrong)) }
            td { (px(row.false_lit)) }
            td { (px(row.false_shadowed)) }
            td { (px(row.boundary_px)) }
            td { (px(row.artifact_px)) }
            td { (bar(shares)) }
            @for index in 0..CLASSES_PX.len() {
                td { (or_dash(shares.map(|shares| format!("{:.0} %", floor_percent(shares[index]))))) }
            }
            td { (or_dash(metrics.get("distance_px_max").map(|far| format!("{far:.1}")))) }
            td.text { (or_dash(kinds(row))) }
            td { (or_dash(flicker)) }
            td { (or_dash(metrics.get("flip").map(|flip| format!("{flip:.4}")))) }
        }
    }
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
        let near = classes
            .iter()
            .filter(|(upper, _)| upper.parse::<f64>().is_ok_and(|upper| upper <= limit));
        near.map(|(_, px)| px).sum::<u64>() as f64 / all as f64
    };
    (all > 0).then(|| CLASSES_PX.map(within))
}

/// Rounded down: 100 % must mean all.
fn floor_percent(share: f64) -> f64 {
    (share * 100.0).floor()
}

fn bar(shares: Option<[f64; CLASSES_PX.len()]>) -> Markup {
    let Some([near, middle, far]) = shares else {
        return html! {};
    };
    let parts = [
        ("near", near),
        ("middle", middle - near),
        ("far", far - middle),
        ("beyond", 1.0 - far),
    ];
    html! {
        span.bar aria-hidden="true" {
            @for (class, share) in parts {
                span class=(class) style={ "width:" (format!("{:.2}", share * 100.0)) "%" } {}
            }
        }
    }
}

/// The kinds of error by their pixels, the most first; `None` where nothing was labelled.
fn kinds(row: &Summary) -> Option<String> {
    let mut kinds: Vec<(&str, u64)> = row.metrics.classes("label").collect();
    kinds.retain(|(_, px)| *px > 0);
    kinds.sort_by_key(|(_, px)| std::cmp::Reverse(*px));
    let text =
        |(name, px): (&str, u64)| format!("{name} {}", px_per_frame(px, row.verified_frames));
    let texts: Vec<String> = kinds.into_iter().map(text).collect();
    (!texts.is_empty()).then(|| texts.join(", "))
}

fn regions(run: &Run, scene: &str) -> Markup {
    let mut regions: Vec<&RegionRow> = run.regions.iter().filter(|r| r.scene == scene).collect();
    regions.sort_by_key(|region| std::cmp::Reverse(region.size_px));
    let frames = run.frames.iter().filter(|frame| frame.scene == scene);
    let all: u64 = frames.map(|frame| frame.px("regions")).sum();
    regions.truncate(MAX_REGIONS);
    html! {
        @if !regions.is_empty() {
            details {
                summary { "Largest regions of artifacts (" (regions.len()) " of " (count(all)) ")" }
                div.scroll tabindex="0" role="region" aria-label="Largest regions of artifacts" {
                    table {
                        thead {
                            tr {
                                th.text scope="col" { "Method" }
                                th scope="col" { "Frame" }
                                th scope="col" { "Size" small { "px" } }
                                th.text scope="col" { "Sign" }
                                th.text scope="col" { "Kind" }
                                th.text scope="col" { "Columns" }
                                th.text scope="col" { "Rows" }
                            }
                        }
                        tbody { @for region in regions { (region_row(region)) } }
                    }
                }
            }
        }
    }
}

fn region_row(region: &RegionRow) -> Markup {
    html! {
        tr {
            th.method scope="row" {
                code { (region.method) } " " span.quiet { (breakable(region.variant.as_str())) }
            }
            td { (region.frame) }
            td { (count(region.size_px)) }
            td.text { (region.sign.replace('_', " ")) }
            td.text { (region.label) }
            td.text { (region.left) "–" (region.right) }
            td.text { (region.top) "–" (region.bottom) }
        }
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
