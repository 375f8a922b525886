//! Every metric, an entry each. Rows of `metrics.csv`, columns of `summary.csv` and what reports say of it follow from
//! the entry; what takes more than a line to compute has a file of its own in this folder.

use super::metric::{Compute, Metric, OverFrames};

/// Pixels of a mask, counted by what [`MaskError`](super::MaskError) says of them.
macro_rules! mask_px {
    ($count:ident, $words:literal) => {
        Metric {
            name: stringify!($count),
            unit: "px",
            words: $words,
            over_frames: OverFrames::Sum,
            of: Compute::One(|f| Some(f.error.$count as f64)),
        }
    };
}

/// All metrics, in the order of the columns.
pub static METRICS: &[Metric] = &[
    mask_px!(false_lit, "lit, but in shadow by the reference"),
    mask_px!(
        false_shadowed,
        "in shadow, but lit or background by the reference"
    ),
    mask_px!(
        boundary_px,
        "wrong, within one pixel of the true shadow boundary"
    ),
    mask_px!(
        artifact_px,
        "wrong, farther than one pixel from the true shadow boundary"
    ),
    mask_px!(
        ambiguous_px,
        "left out of all other counts, because the reference cannot decide"
    ),
    mask_px!(compared_px, "all pixels but the ambiguous ones"),
    Metric {
        name: "distance",
        unit: "px",
        words: "wrong, by the distance from the true shadow boundary: each class is named by its largest distance in pixels",
        over_frames: OverFrames::Sum,
        of: Compute::Each(|f| as_numbers(f.distances.classes())),
    },
    Metric {
        name: "distance_px_max",
        unit: "px",
        words: "distance of the farthest wrong pixel; none where nothing is wrong or the picture has no boundary",
        over_frames: OverFrames::Max,
        of: Compute::One(|f| f.distances.max_px),
    },
    Metric {
        name: "regions",
        unit: "",
        words: "connected regions of artifacts of one sign",
        over_frames: OverFrames::Sum,
        of: Compute::One(|f| Some(f.analysis.regions.len() as f64)),
    },
    Metric {
        name: "largest_region_px",
        unit: "px",
        words: "size of the largest of them",
        over_frames: OverFrames::Max,
        of: Compute::One(|f| Some(f.analysis.regions.first().map_or(0.0, |r| r.size_px as f64))),
    },
    Metric {
        name: "label",
        unit: "px",
        words: "wrong, by the kind of error; boundary pixels without a kind are in none",
        over_frames: OverFrames::Sum,
        of: Compute::Each(|f| as_numbers(f.analysis.label_counts())),
    },
    Metric {
        name: "followed_px",
        unit: "px",
        words: "surface points that the next frame shows too, with the same truth",
        over_frames: OverFrames::Sum,
        of: Compute::One(|f| Some(f.flicker?.followed_px as f64)),
    },
    Metric {
        name: "flicker_px",
        unit: "px",
        words: "of these, the ones that turn from right to wrong or back",
        over_frames: OverFrames::Sum,
        of: Compute::One(|f| Some(f.flicker?.flicker_px as f64)),
    },
    Metric {
        name: "flip",
        unit: "",
        words: "mean FLIP of the shaded picture, 0 alike to 1",
        over_frames: OverFrames::Mean,
        of: Compute::One(|f| f.flip),
    },
];

fn as_numbers<'a>(classes: impl Iterator<Item = (&'a str, u64)>) -> Vec<(&'a str, f64)> {
    classes.map(|(class, px)| (class, px as f64)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_contract_lists_every_metric() {
        let contract = include_str!("../../FORMAT.md");
        for metric in METRICS {
            let over_frames = format!("{:?}", metric.over_frames).to_lowercase();
            let Metric {
                name, unit, words, ..
            } = metric;
            let row = format!("| `{name}` | {unit} | {over_frames} | {words} |");
            assert!(contract.contains(&row), "FORMAT.md has no line {row}");
        }
    }

    #[test]
    fn every_metric_has_a_name_of_its_own() {
        let names: Vec<_> = METRICS.iter().map(|m| m.name).collect();
        let apart: std::collections::BTreeSet<_> = names.iter().collect();
        assert_eq!(apart.len(), names.len());
        assert!(names.iter().all(|name| !name.contains('.')));
    }
}
