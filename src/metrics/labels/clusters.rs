//! Regions close to each other, which the same cause may have broken up.

use imageproc::distance_transform::Norm;
use imageproc::image::{GrayImage, Luma};
use imageproc::morphology::dilate;
use imageproc::region_labelling::{Connectivity, connected_components};

use super::frame::JudgedFrame;
use crate::metrics::regions::{Artifact, Sign};

/// Regions of one sign with small gaps between them.
#[derive(Default)]
pub(super) struct Cluster {
    /// Number of regions.
    pub(super) regions: usize,
    /// The pixels of all of them, in no order.
    pub(super) pixels: Vec<usize>,
}

/// All clusters of one sign.
pub(super) struct Clusters {
    pub(super) all: Vec<Cluster>,
    /// For each region of the picture, the index of its cluster.
    members: Vec<Option<usize>>,
}

impl Clusters {
    /// Regions of this sign belong together if the gap between them is at most `link_px` pixels.
    pub(super) fn find(
        frame: &JudgedFrame<'_>,
        artifacts: &[Artifact],
        sign: Sign,
        link_px: u8,
    ) -> Self {
        let of_sign = |artifact: &&Artifact| artifact.region.sign == sign;
        let mut clusters = Self {
            all: Vec::new(),
            members: vec![None; artifacts.len()],
        };
        if !artifacts.iter().any(|artifact| of_sign(&artifact)) {
            return clusters;
        }
        let (width, height) = (frame.comparison.width(), frame.comparison.height());
        let mut picture = GrayImage::new(width, height);
        for &pixel in artifacts.iter().filter(of_sign).flat_map(|a| &a.pixels) {
            let (x, y) = (pixel as u32 % width, pixel as u32 / width);
            picture.put_pixel(x, y, Luma([255]));
        }
        // Each side grows by half of the gap.
        let grown = dilate(&picture, Norm::LInf, link_px.div_ceil(2));
        let components = connected_components(&grown, Connectivity::Eight, Luma([0])).into_raw();
        for (member, artifact) in clusters.members.iter_mut().zip(artifacts) {
            if of_sign(&artifact) {
                let component = components[artifact.pixels[0]] as usize - 1;
                if clusters.all.len() <= component {
                    clusters.all.resize_with(component + 1, Cluster::default);
                }
                clusters.all[component].regions += 1;
                clusters.all[component].pixels.extend(&artifact.pixels);
                *member = Some(component);
            }
        }
        clusters
    }

    /// The index of a region's cluster; `None` for a region of the other sign.
    pub(super) fn of(&self, region: usize) -> Option<usize> {
        self.members[region]
    }
}
