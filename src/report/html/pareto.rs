//! Accuracy against speed: the charts, how to read them, and the front in figures.

use maud::{Markup, html};

use super::shell::{Section, details, figures};
use crate::report::format::{count, ms, px_per_frame};
use crate::report::load::Run;
use crate::report::pareto::{Cloud, PARETO_FILE, Point};
use crate::report::plots::Plot;
use crate::report::table::{Cell, Column, Row, Table};

/// The section; none where there is no chart.
pub(super) fn section(run: &Run, clouds: &[Cloud], plots: &[&Plot]) -> Option<Section> {
    let title = |cloud: &Cloud| {
        let scene = cloud.scene.as_deref();
        let title = scene.map_or("over all scenes", |scene| run.scene_title(scene));
        format!("The front in figures, {title}")
    };
    let content = html! {
        (explanation(clouds.iter().any(|cloud| cloud.scene.is_none())))
        (figures(plots))
        @for cloud in clouds { (details(&title(cloud), &table(cloud).html())) }
    };
    (!clouds.is_empty()).then(|| Section::new("pareto", "Accuracy against speed", content))
}

fn explanation(over_all: bool) -> Markup {
    html! {
        p.note {
            "What each millisecond buys. Left is faster, down is more accurate. The stepped line is the "
            em { "Pareto front" } ": at each time, the fewest wrong pixels that one can have by then. A grey "
            "point is " em { "dominated" } ": another is no slower and no less accurate, and better in one of "
            "the two. Thin lines join the points of a sweep, which bear the value swept. Both axes are "
            "logarithmic; points without any wrong pixel stand at 0, in a band of their own below the break "
            "of the axis. Means and medians alone decide what is dominated: where intervals overlap, the "
            "order may be chance."
        }
        p.note {
            "Intervals reach from the 5th to the 95th percentile: of shadow time over the measured frames, "
            "of wrong pixels over the verified ones. "
            @if over_all {
                "Over all scenes stand the contenders that were measured and verified in each of them: at the "
                "geometric mean of their shadow times and the arithmetic mean of their wrong pixels, with "
                "intervals from the least to the greatest of the scenes. "
            }
            "All points are in " code { (PARETO_FILE) } "."
        }
    }
}

fn table(cloud: &Cloud) -> Table {
    let mut others: Vec<&Point> = cloud.points.iter().collect();
    others.retain(|point| point.dominated_by.is_some());
    others.sort_by(|a, b| a.shadow_ms.total_cmp(&b.shadow_ms));
    let front = cloud.front().into_iter().map(|index| &cloud.points[index]);
    let columns = [
        Column::heads("Method", "method"),
        Column::number("Shadow").unit("ms"),
        Column::number("Interval").unit("ms"),
        Column::number("Wrong").unit("px per frame"),
        Column::number("Interval").unit("px"),
        Column::text("Dominated by"),
    ];
    let rows = front.chain(others).map(|point| row(cloud, point));
    Table::new("The front in figures", columns).extend(rows)
}

fn row(cloud: &Cloud, point: &Point) -> Row {
    let by = point
        .dominated_by
        .map(|by| cloud.points[by].contender.label());
    let cells = [
        Cell::code(point.contender.label()),
        ms(point.shadow_ms).into(),
        range(point.shadow_ms_range, ms),
        wrong_px(cloud, point).into(),
        range(point.wrong_px_range, px),
        by.as_deref().unwrap_or("– on the front").into(),
    ];
    Row {
        is_faint: by.is_some(),
        ..cells.into()
    }
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
    digits
        .trim_end_matches('0')
        .trim_end_matches('.')
        .to_owned()
}

fn range(range: Option<(f64, f64)>, text: fn(f64) -> String) -> Cell {
    range
        .map(|(low, high)| format!("{} – {}", text(low), text(high)))
        .into()
}
