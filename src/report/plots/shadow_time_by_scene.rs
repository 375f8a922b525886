//! Shadow time of every method in every scene, side by side.

use super::axis::Axis;
use super::bars::{Bar, BarChart, Group};
use super::chosen::Chosen;
use super::{Chart, Figure};
use crate::report::load::Run;

/// The figure; `None` where nothing was measured.
pub(super) fn figure(run: &Run) -> Option<Figure> {
    let Chosen { keys, remark } = Chosen::of(run);
    let groups: Vec<Group> = run
        .scenes()
        .into_iter()
        .map(|scene| {
            let mut bars = vec![None; keys.len()];
            for row in run.rows(scene) {
                let contender = run.contender(row);
                let index = keys.iter().position(|(_, other)| *other == contender);
                let bar = row.shadow_ms_median.zip(row.shadow_ms_p95);
                if let (Some(index), Some((median, p95))) = (index, bar) {
                    bars[index] = Some(Bar {
                        value: median,
                        whisker: Some(p95),
                    });
                }
            }
            Group {
                name: scene.to_owned(),
                hollow: false,
                bars,
            }
        })
        .filter(|group| group.bars.iter().any(Option::is_some))
        .collect();
    if groups.is_empty() {
        return None;
    }
    let bars = groups.iter().flat_map(|group| group.bars.iter().flatten());
    let y = Axis::fit(
        "Shadow time, median and p95, ms",
        bars.flat_map(|bar| [Some(bar.value), bar.whisker])
            .flatten(),
    );
    Some(Figure {
        name: "shadow_time_by_scene".to_owned(),
        title: format!("Shadow time by scene{remark}"),
        chart: Chart::Bars(BarChart {
            y,
            keys,
            groups,
            bands: Vec::new(),
        }),
    })
}
