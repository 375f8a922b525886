//! `stages.csv`: how long each stage of a method took in each measured frame.

use super::{Sample, StageMs};
use crate::variant::Variant;
use serde::{Deserialize, Serialize};
use std::collections::HashMap;

/// A stage of a frame: a row of `stages.csv`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StageRow {
    scene: String,
    method: String,
    variant: Variant,
    width: u32,
    height: u32,
    frame: u32,
    stage: String,
    device_ms: f64,
    cpu_ms: f64,
}

/// The rows of samples.
pub fn stage_rows<'a>(samples: impl IntoIterator<Item = &'a Sample>) -> Vec<StageRow> {
    let rows = |sample: &'a Sample| {
        sample.stages.iter().map(|stage| StageRow {
            scene: sample.scene.clone(),
            method: sample.method.clone(),
            variant: sample.variant.clone(),
            width: sample.width,
            height: sample.height,
            frame: sample.frame,
            stage: stage.stage.clone(),
            device_ms: stage.device_ms,
            cpu_ms: stage.cpu_ms,
        })
    };
    samples.into_iter().flat_map(rows).collect()
}

/// Gives each sample its stages; rows of no sample are left out.
pub(super) fn join_stages(samples: &mut [Sample], rows: Vec<StageRow>) {
    let mut stages: HashMap<_, Vec<StageMs>> = HashMap::new();
    for row in rows {
        let size_px = (row.width, row.height);
        let key = (row.scene, row.method, row.variant, size_px, row.frame);
        stages.entry(key).or_default().push(StageMs {
            stage: row.stage,
            device_ms: row.device_ms,
            cpu_ms: row.cpu_ms,
        });
    }
    for sample in samples {
        let size_px = (sample.width, sample.height);
        let (scene, method) = (sample.scene.clone(), sample.method.clone());
        let key = (scene, method, sample.variant.clone(), size_px, sample.frame);
        sample.stages = stages.remove(&key).unwrap_or_default();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stages_come_back_to_their_samples() {
        let stage = |name: &str, device_ms, cpu_ms| StageMs {
            stage: name.to_owned(),
            device_ms,
            cpu_ms,
        };
        let sample = |frame, stages| Sample {
            scene: "sponza".to_owned(),
            method: "silhouette_ts".to_owned(),
            variant: "counting=z_pass".parse().unwrap(),
            frame,
            stages,
            ..Sample::default()
        };
        let samples = [
            sample(
                0,
                vec![stage("volumes", 1.5, 0.25), stage("resolve", 0.1, 0.0)],
            ),
            sample(1, vec![]),
            sample(2, vec![stage("volumes", 2.5, 0.0)]),
        ];
        let rows = stage_rows(&samples);
        assert_eq!(rows.len(), 3);
        let mut bare = samples.clone();
        bare.iter_mut().for_each(|sample| sample.stages.clear());
        join_stages(&mut bare, rows);
        assert_eq!(bare, samples);
    }
}
