//! What a metric is, and what it is computed from. All of them are in [`METRICS`](super::METRICS).

use super::{Analysis, Distances, Flicker, MaskError};
use crate::reference::ReferenceMask;

/// What a method's mask is judged by in one frame: what metrics are computed from.
#[derive(Clone, Copy)]
pub struct Findings<'a> {
    /// The mask, by rows from the top: 0 lit to 255 in shadow, which begins at [`SHADOWED_FROM`](super::SHADOWED_FROM).
    pub mask: &'a [u8],
    /// What it should be; its verdict is `Background` where a pixel shows no geometry.
    pub truth: &'a ReferenceMask,
    /// Counts of wrong pixels.
    pub error: MaskError,
    /// How far they are from the true edge.
    pub distances: &'a Distances,
    /// Where they are together, and of what kind.
    pub analysis: &'a Analysis,
    /// How they come and go, where that was looked for.
    pub flicker: Option<Flicker>,
    /// Mean FLIP of the picture, where that was looked for.
    pub flip: Option<f64>,
}

/// A number that is computed of every verified frame.
pub struct Metric {
    /// Its name in `metrics.csv`.
    pub name: &'static str,
    /// `px`, or empty for a pure number.
    pub unit: &'static str,
    /// What it is, in words.
    pub words: &'static str,
    /// What frames together have.
    pub over_frames: OverFrames,
    /// How it is computed.
    pub of: Compute,
}

/// How a metric is computed.
pub enum Compute {
    /// One number; `None` where it was not looked for or there is none.
    One(fn(&Findings<'_>) -> Option<f64>),
    /// A number for each class, such as a kind of error: `name.class` in `metrics.csv`.
    Each(fn(&Findings<'_>) -> Vec<(&'static str, f64)>),
}

/// What several frames together have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OverFrames {
    /// Their sum.
    Sum,
    /// Their mean.
    Mean,
    /// The largest.
    Max,
}

impl Metric {
    /// Its column in `summary.csv`; `None` for one with classes.
    pub fn column(&self) -> Option<String> {
        let suffix = match (&self.of, self.over_frames) {
            (Compute::Each(_), _) => return None,
            (Compute::One(_), OverFrames::Mean) => "_mean",
            (Compute::One(_), OverFrames::Sum | OverFrames::Max) => "",
        };
        Some(format!("{}{suffix}", self.name))
    }

    fn measure(&self, findings: &Findings<'_>, values: &mut MetricValues) {
        match self.of {
            Compute::One(of) => {
                let value = of(findings).map(|value| (self.name.to_owned(), value));
                values.0.extend(value);
            }
            Compute::Each(of) => {
                let named = |(class, value)| (format!("{}.{class}", self.name), value);
                values.0.extend(of(findings).into_iter().map(named));
            }
        }
    }
}

/// The metric that a value in `metrics.csv` is of.
pub fn find_metric<'a>(table: &'a [Metric], name: &str) -> Option<&'a Metric> {
    let name = name.split_once('.').map_or(name, |(name, _)| name);
    table.iter().find(|metric| metric.name == name)
}

/// Metrics by name, of a frame or of several together.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct MetricValues(Vec<(String, f64)>);

impl MetricValues {
    /// Computes the metrics of `table`, such as [`METRICS`](super::METRICS).
    pub fn measure(table: &[Metric], findings: &Findings<'_>) -> Self {
        let mut values = Self::default();
        for metric in table {
            metric.measure(findings, &mut values);
        }
        values
    }

    /// What frames have together; metrics that are not in `table` are left out.
    pub fn over_frames<'a>(table: &[Metric], frames: impl IntoIterator<Item = &'a Self>) -> Self {
        let mut all: Vec<(&str, Vec<f64>)> = Vec::new();
        for (name, value) in frames.into_iter().flat_map(Self::iter) {
            match all.iter_mut().find(|(known, _)| *known == name) {
                Some((_, values)) => values.push(value),
                None => all.push((name, vec![value])),
            }
        }
        let together = |(name, values): (&str, Vec<f64>)| {
            let sum = values.iter().sum::<f64>();
            let value = match find_metric(table, name)?.over_frames {
                OverFrames::Sum => sum,
                OverFrames::Mean => sum / values.len() as f64,
                OverFrames::Max => values.into_iter().fold(f64::NEG_INFINITY, f64::max),
            };
            Some((name.to_owned(), value))
        };
        Self(all.into_iter().filter_map(together).collect())
    }

    /// Names and values.
    pub fn iter(&self) -> impl Iterator<Item = (&str, f64)> {
        self.0.iter().map(|(name, value)| (name.as_str(), *value))
    }

    /// The value of a metric; `None` where it was not computed.
    pub fn get(&self, name: &str) -> Option<f64> {
        self.iter()
            .find_map(|(known, value)| (known == name).then_some(value))
    }

    /// The value of a metric that counts pixels.
    pub fn px(&self, name: &str) -> Option<u64> {
        self.get(name).map(|value| value as u64)
    }

    /// Classes and counts of a metric that has them: the kinds of `label`, the distances of `distance`.
    pub fn classes(&self, name: &str) -> impl Iterator<Item = (&str, u64)> {
        self.iter().filter_map(move |(known, value)| {
            let class = known.strip_prefix(name)?.strip_prefix('.')?;
            Some((class, value as u64))
        })
    }
}

impl<N: Into<String>> FromIterator<(N, f64)> for MetricValues {
    fn from_iter<I: IntoIterator<Item = (N, f64)>>(values: I) -> Self {
        let values = values.into_iter();
        Self(values.map(|(name, value)| (name.into(), value)).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metrics::SHADOWED_FROM;
    use crate::reference::Visibility;

    /// All that a metric takes.
    const SHADOWED: Metric = Metric {
        name: "shadowed_px",
        unit: "px",
        words: "in shadow by the mask",
        over_frames: OverFrames::Max,
        of: Compute::One(|f| Some(f.mask.iter().filter(|v| **v >= SHADOWED_FROM).count() as f64)),
    };
    const FALSE_SHADOWED: Metric = Metric {
        name: "false_shadowed",
        unit: "px",
        words: "in shadow by the mask alone",
        over_frames: OverFrames::Sum,
        of: Compute::One(|f| Some(f.error.false_shadowed as f64)),
    };
    const FLIP: Metric = Metric {
        name: "flip",
        unit: "",
        words: "what an eye sees",
        over_frames: OverFrames::Mean,
        of: Compute::One(|f| f.flip),
    };
    const LABEL: Metric = Metric {
        name: "label",
        unit: "px",
        words: "by kind",
        over_frames: OverFrames::Sum,
        of: Compute::Each(|_| Vec::new()),
    };
    const TABLE: &[Metric] = &[SHADOWED, FALSE_SHADOWED, FLIP, LABEL];

    fn measured(mask: &[u8], flip: Option<f64>) -> MetricValues {
        let lit = vec![Some(Visibility::FULL); mask.len()];
        let truth = ReferenceMask::new(mask.len() as u32, 1, lit).unwrap();
        let findings = Findings {
            mask,
            truth: &truth,
            error: MaskError {
                false_shadowed: 2,
                ..MaskError::default()
            },
            distances: &Distances::default(),
            analysis: &Analysis::default(),
            flicker: None,
            flip,
        };
        MetricValues::measure(TABLE, &findings)
    }

    #[test]
    fn a_metric_is_computed_and_summed_up_by_its_entry_alone() {
        let frames = [
            measured(&[0, 255, 255], Some(0.5)),
            measured(&[0, 255, 0], Some(0.25)),
            measured(&[255, 255, 255], None),
        ];
        assert_eq!(frames[0].px("shadowed_px"), Some(2));
        assert_eq!(frames[2].get("flip"), None);
        let all = MetricValues::over_frames(TABLE, &frames);
        assert_eq!(all.px("shadowed_px"), Some(3));
        assert_eq!(all.px("false_shadowed"), Some(6));
        assert_eq!(all.get("flip"), Some(0.375));
        assert_eq!(SHADOWED.column().as_deref(), Some("shadowed_px"));
        assert_eq!(FLIP.column().as_deref(), Some("flip_mean"));
    }

    #[test]
    fn classes_are_summed_up_one_by_one() {
        let frames = [
            MetricValues::from_iter([("label.acne", 3.0), ("label.leak", 1.0)]),
            MetricValues::from_iter([("label.acne", 4.0), ("unheard_of", 1.0)]),
        ];
        let all = MetricValues::over_frames(TABLE, &frames);
        let labels: Vec<_> = all.classes("label").collect();
        assert_eq!(labels, [("acne", 7), ("leak", 1)]);
        assert_eq!(all.get("unheard_of"), None);
    }
}
