//! `volumes.csv`: how the shadow volumes of objects were drawn in each measured frame.

use super::Sample;
use crate::frame::DrawnVolumes;
use crate::variant::Variant;
use serde::{Deserialize, Serialize};
use std::collections::HashMap;

/// The volumes of a frame, in numbers of objects: a row of `volumes.csv`. See [`DrawnVolumes`].
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct VolumeRow {
    scene: String,
    method: String,
    variant: Variant,
    width: u32,
    height: u32,
    frame: u32,
    drawn: u32,
    culled: u32,
    hidden: u32,
    queries: u32,
    z_pass: u32,
    z_pass_counted: u32,
    z_fail: u32,
    light_facing: u32,
    each_side: u32,
    all: u32,
    at_infinity: u32,
}

/// The row of a sample of a method with volumes.
pub(super) fn volume_row(sample: &Sample) -> Option<VolumeRow> {
    let volumes = sample.volumes?;
    Some(VolumeRow {
        scene: sample.scene.clone(),
        method: sample.method.clone(),
        variant: sample.variant.clone(),
        width: sample.width,
        height: sample.height,
        frame: sample.frame,
        drawn: volumes.drawn(),
        culled: volumes.culled,
        hidden: volumes.hidden,
        queries: volumes.queries,
        z_pass: volumes.z_pass,
        z_pass_counted: volumes.z_pass_counted,
        z_fail: volumes.z_fail,
        light_facing: volumes.light_facing,
        each_side: volumes.each_side,
        all: volumes.all,
        at_infinity: volumes.at_infinity,
    })
}

/// Gives each sample its volumes; rows of no sample are left out.
pub(super) fn join_volumes(samples: &mut [Sample], rows: Vec<VolumeRow>) {
    let volumes = |row: VolumeRow| {
        let volumes = DrawnVolumes {
            culled: row.culled,
            hidden: row.hidden,
            queries: row.queries,
            z_pass: row.z_pass,
            z_pass_counted: row.z_pass_counted,
            z_fail: row.z_fail,
            light_facing: row.light_facing,
            each_side: row.each_side,
            all: row.all,
            at_infinity: row.at_infinity,
        };
        let size_px = (row.width, row.height);
        let key = (row.scene, row.method, row.variant, size_px, row.frame);
        (key, volumes)
    };
    let mut volumes: HashMap<_, _> = rows.into_iter().map(volumes).collect();
    for sample in samples {
        let size_px = (sample.width, sample.height);
        let (scene, method) = (sample.scene.clone(), sample.method.clone());
        let key = (scene, method, sample.variant.clone(), size_px, sample.frame);
        sample.volumes = volumes.remove(&key);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn volumes_come_back_to_their_samples() {
        let sample = |frame, volumes| Sample {
            scene: "city".to_owned(),
            method: "silhouette_gs".to_owned(),
            frame,
            volumes,
            ..Sample::default()
        };
        let volumes = DrawnVolumes {
            culled: 30,
            hidden: 20,
            queries: 7,
            z_pass: 4,
            z_fail: 6,
            all: 10,
            ..DrawnVolumes::default()
        };
        let samples = [sample(0, Some(volumes)), sample(1, None)];
        let rows: Vec<_> = samples.iter().filter_map(volume_row).collect();
        assert_eq!((rows.len(), rows[0].drawn), (1, 10));
        let mut bare = samples.clone();
        bare[0].volumes = None;
        join_volumes(&mut bare, rows);
        assert_eq!(bare, samples);
    }
}
