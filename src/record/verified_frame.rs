//! `metrics.csv`: what was found of each verified frame, a row for each metric.

use super::Cell;
use crate::metrics::{METRICS, MetricValues, find_metric};
use crate::variant::Variant;
use serde::{Deserialize, Serialize, Serializer};
use std::collections::HashMap;

/// A mask held against the reference.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct VerifiedFrame {
    /// Name of the scene.
    pub scene: String,
    /// Id of the method.
    pub method: String,
    /// Variant of the method.
    pub variant: Variant,
    /// Width of the picture in pixels.
    pub width: u32,
    /// Height of the picture in pixels.
    pub height: u32,
    /// Number of the frame among the verified ones, from zero.
    pub frame: u32,
    /// Where on the flight the frame lies, in seconds.
    pub time_s: f64,
    /// What was found.
    pub metrics: MetricValues,
}

impl VerifiedFrame {
    /// Of a cell, without findings.
    pub fn of(cell: &Cell, frame: u32, time_s: f64) -> Self {
        Self {
            scene: cell.scene.clone(),
            method: cell.method.clone(),
            variant: cell.variant.clone(),
            width: cell.width,
            height: cell.height,
            frame,
            time_s,
            metrics: MetricValues::default(),
        }
    }

    /// A metric that counts pixels; 0 where it was not computed.
    pub fn px(&self, metric: &str) -> u64 {
        self.metrics.px(metric).unwrap_or(0)
    }

    /// Pixels that are wrong in any way.
    pub fn wrong_px(&self) -> u64 {
        self.px("false_lit") + self.px("false_shadowed")
    }
}

/// A metric of a frame: a row of `metrics.csv`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MetricRow {
    scene: String,
    method: String,
    variant: Variant,
    width: u32,
    height: u32,
    frame: u32,
    time_s: f64,
    metric: String,
    #[serde(serialize_with = "plain")]
    value: f64,
    unit: String,
}

/// A whole number is written as one.
#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde passes references")]
fn plain<S: Serializer>(value: &f64, serializer: S) -> Result<S::Ok, S::Error> {
    const EXACT: f64 = 9_007_199_254_740_992.0;
    if value.fract() == 0.0 && value.abs() < EXACT {
        serializer.serialize_i64(*value as i64)
    } else {
        serializer.serialize_f64(*value)
    }
}

/// The rows of frames.
pub fn metric_rows<'a>(frames: impl IntoIterator<Item = &'a VerifiedFrame>) -> Vec<MetricRow> {
    let rows = |frame: &'a VerifiedFrame| {
        frame.metrics.iter().map(|(name, value)| MetricRow {
            scene: frame.scene.clone(),
            method: frame.method.clone(),
            variant: frame.variant.clone(),
            width: frame.width,
            height: frame.height,
            frame: frame.frame,
            time_s: frame.time_s,
            metric: name.to_owned(),
            value,
            unit: find_metric(METRICS, name).map_or_else(String::new, |m| m.unit.to_owned()),
        })
    };
    frames.into_iter().flat_map(rows).collect()
}

/// The frames that rows tell of, in the order in which they come.
pub(super) fn verified_frames(rows: Vec<MetricRow>) -> Vec<VerifiedFrame> {
    let mut places = HashMap::new();
    let mut frames: Vec<(VerifiedFrame, Vec<(String, f64)>)> = Vec::new();
    for row in rows {
        let frame = VerifiedFrame {
            scene: row.scene,
            method: row.method,
            variant: row.variant,
            width: row.width,
            height: row.height,
            frame: row.frame,
            time_s: row.time_s,
            metrics: MetricValues::default(),
        };
        let key = (
            frame.scene.clone(),
            frame.method.clone(),
            frame.variant.clone(),
            (frame.width, frame.height, frame.frame),
        );
        let place = *places.entry(key).or_insert(frames.len());
        if place == frames.len() {
            frames.push((frame, Vec::new()));
        }
        frames[place].1.push((row.metric, row.value));
    }
    let whole = |(frame, values): (VerifiedFrame, Vec<_>)| VerifiedFrame {
        metrics: values.into_iter().collect(),
        ..frame
    };
    frames.into_iter().map(whole).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(variant: &str, frame: u32, flip: f64) -> VerifiedFrame {
        VerifiedFrame {
            scene: "sponza".to_owned(),
            method: "shadow_map".to_owned(),
            variant: variant.parse().unwrap(),
            width: 8,
            height: 4,
            frame,
            time_s: 0.5,
            metrics: MetricValues::from_iter([
                ("false_lit", 3.0),
                ("label.acne", 2.0),
                ("flip", flip),
            ]),
        }
    }

    #[test]
    fn frames_survive_the_way_through_their_rows() {
        let frames = [
            frame("", 0, 0.1),
            frame("pcf=3", 0, 1.0 / 3.0),
            frame("", 1, 0.0),
        ];
        let text = crate::table::text(&metric_rows(&frames)).unwrap();
        let first: Vec<_> = std::str::from_utf8(&text)
            .unwrap()
            .lines()
            .take(4)
            .collect();
        assert_eq!(
            first,
            [
                "scene,method,variant,width,height,frame,time_s,metric,value,unit",
                "sponza,shadow_map,,8,4,0,0.5,false_lit,3,px",
                "sponza,shadow_map,,8,4,0,0.5,label.acne,2,px",
                "sponza,shadow_map,,8,4,0,0.5,flip,0.1,",
            ]
        );
        let rows = csv::Reader::from_reader(&*text).into_deserialize();
        let rows: Vec<MetricRow> = rows.map(Result::unwrap).collect();
        assert_eq!(verified_frames(rows), frames);
        assert_eq!(frames[0].wrong_px(), 3);
    }
}
