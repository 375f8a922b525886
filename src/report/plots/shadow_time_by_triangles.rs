//! Shadow time against the number of casting triangles, over scenes that differ in nothing else.

use super::axis::Axis;
use super::chosen::Chosen;
use super::lines::{Line, LineChart};
use super::{Chart, Figure};
use crate::file_name::file_name;
use crate::report::load::Run;

/// A figure per family of scenes that has at least two points.
pub(super) fn figures(run: &Run) -> Vec<Figure> {
    let mut families: Vec<String> = Vec::new();
    for family in run.scenes().into_iter().filter_map(family) {
        if !families.contains(&family) {
            families.push(family);
        }
    }
    let mut figures: Vec<Figure> = families
        .iter()
        .filter_map(|family| figure(run, family))
        .collect();
    if let [only] = figures.as_mut_slice() {
        only.name = "shadow_time_by_triangles".to_owned();
    }
    figures
}

/// What a scene's name says besides its size: the name without its last `_n<digits>`. `None` where
/// it has none.
fn family(scene: &str) -> Option<String> {
    scene.rmatch_indices("_n").find_map(|(at, mark)| {
        let rest = &scene[at + mark.len()..];
        let after = rest.trim_start_matches(|c: char| c.is_ascii_digit());
        (after.len() < rest.len()).then(|| format!("{}{after}", &scene[..at]))
    })
}

fn figure(run: &Run, family_name: &str) -> Option<Figure> {
    let mut lines = Vec::new();
    let Chosen { keys, remark } = Chosen::of(run);
    for (key, contender) in keys {
        let rows = run.summaries.iter().filter(|row| {
            family(&row.scene).as_deref() == Some(family_name) && run.contender(row) == contender
        });
        let mut points: Vec<(f64, f64)> = rows
            .filter_map(|row| Some((row.triangles? as f64, row.shadow_ms_median?)))
            .filter(|(triangles, shadow_ms)| *triangles > 0.0 && *shadow_ms > 0.0)
            .collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        if !points.is_empty() {
            lines.push(Line {
                key,
                contender,
                points,
            });
        }
    }
    let points = || lines.iter().flat_map(|line| line.points.iter().copied());
    let first = points().next()?;
    if points().all(|point| point.0 == first.0) {
        return None;
    }
    let x = Axis::log(
        "Casting triangles (log scale)",
        points().map(|point| point.0),
    );
    let y = Axis::log(
        "Shadow time, median, ms (log scale)",
        points().map(|point| point.1),
    );
    Some(Figure {
        name: format!("shadow_time_by_triangles_{}", file_name(family_name)),
        title: format!("Shadow time by casting triangles, {family_name}{remark}"),
        chart: Chart::Lines(LineChart {
            x,
            y,
            lines,
            keys: Vec::new(),
        }),
    })
}

#[cfg(test)]
mod tests {
    use super::family;

    #[test]
    fn a_family_is_the_name_without_its_last_size() {
        assert_eq!(
            family("spheres_10x10_n140").as_deref(),
            Some("spheres_10x10")
        );
        assert_eq!(family("a_n2_b_n3").as_deref(), Some("a_n2_b"));
        assert_eq!(family("spheres_n18_high").as_deref(), Some("spheres_high"));
        assert_eq!(family("town_night"), None);
        assert_eq!(family("sponza"), None);
    }
}
