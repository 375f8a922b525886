//! Accuracy against speed: the charts, how to read them, and the front in figures.

use maud::html;

use super::shell::{Section, details, figures, note, prose};
use crate::report::format::{count, ms, px_per_frame};
use crate::report::load::Run;
use crate::report::pareto::{Cloud, PARETO_FILE, Point};
use crate::report::plots::Plot;
use crate::report::table::{Cell, Column, Table};

/// The section; none where there is no chart.
pub(super) fn section(run: &Run, clouds: &[Cloud], plots: &[&Plot]) -> Option<Section> {
    let title = |cloud: &Cloud| {
        let scene = cloud.scene.as_deref();
        let title = scene.map_or("over all scenes", |scene| run.scene_title(scene));
        format!("The front in figures, {title}")
    };
    let content = html! {
        (note(include_str!("notes/pareto.html")))
        p.note {
            (prose(include_str!("notes/intervals.html"))) " "
            @if clouds.iter().any(|cloud| cloud.scene.is_none()) { (prose(include_str!("notes/overall.html"))) " " }
            "All points are in " code { (PARETO_FILE) } "."
        }
        (figures(plots))
        @for cloud in clouds { (details(title(cloud), &table(cloud).html())) }
    };
    (!clouds.is_empty()).then(|| Section::new("pareto", "Accuracy against speed", content))
}

fn table(cloud: &Cloud) -> Table {
    let mut points: Vec<&Point> = cloud.points.iter().collect();
    points.sort_by(|a, b| a.shadow_ms.total_cmp(&b.shadow_ms));
    points.sort_by_key(|point| point.dominated_by.is_some());
    let by = |point: &Point| Some(cloud.points[point.dominated_by?].contender.label());
    let method = Column::heads("Method", "method");
    Table::of("The front in figures", points)
        .column(method, |point| Cell::code(point.contender.label()))
        .number(("Shadow", "ms"), |point| ms(point.shadow_ms))
        .number(("Interval", "ms"), |p| range(p.shadow_ms_range, ms))
        .number(("Wrong", "px per frame"), |point| wrong_px(cloud, point))
        .number(("Interval", "px"), |p| range(p.wrong_px_range, px))
        .text("Dominated by", |point| {
            by(point).unwrap_or("– on the front".to_owned())
        })
        .faint(|point| point.dominated_by.is_some())
        .table
}

fn wrong_px(cloud: &Cloud, point: &Point) -> String {
    // The sum over the scenes' frames is not the mean of the scenes.
    if cloud.scene.is_none() {
        return px(point.wrong_px);
    }
    let sum_px = point.counts.false_lit + point.counts.false_shadowed;
    px_per_frame(sum_px, point.counts.verified_frames)
}

/// Pixels that need not be whole; as [`px_per_frame`], never nothing where there is something.
fn px(value: f64) -> String {
    if value >= 100.0 {
        return count(value.round() as u64);
    }
    if value > 0.0 && value < 0.001 {
        return "<0.001".to_owned();
    }
    let digits = format!("{value:.3}");
    let digits = digits.trim_end_matches('0').trim_end_matches('.');
    digits.to_owned()
}

fn range(range: Option<(f64, f64)>, text: fn(f64) -> String) -> Option<String> {
    range.map(|(low, high)| format!("{} – {}", text(low), text(high)))
}
