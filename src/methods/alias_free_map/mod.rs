//! A shadow map without aliasing: the samples of the picture are sorted into the cells of a map of the light, and each
//! triangle is held exactly against the samples of all cells that it may cover.

mod map;

use super::view_samples::ViewSamples;
use super::{MethodError, MethodInfo, PrepareContext, ShadowMethod, ray_limits};
use crate::frame::{Frame, PreparedMethod};
use map::LightMap;
use serde::{Deserialize, Serialize};

/// What the method is.
pub(super) static INFO: MethodInfo = MethodInfo {
    id: "alias_free_map",
    title: "an alias-free shadow map",
    source: "Sintorn, Eisemann and Assarsson 2008; Wyman, Hoetzlein and Lefohn 2015",
    needs: &[],
    limits: &[ray_limits::LIMITS],
    clashes: &[],
    tolerated_share: 0.0,
};

/// How the samples of a cell are kept.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Lists {
    /// Each knows the next.
    #[default]
    Linked,
    /// Next to each other.
    Sorted,
}

/// The finest map.
const MAX_RESOLUTION: u32 = 4096;

crate::parameters! {
    /// The method with its parameters.
    pub(super) struct AliasFreeMap {
        resolution: u32 = 512, in 32..=MAX_RESOLUTION, "cells along a side of each of the map's faces, in whole tiles of 32";
        lists: Lists = Lists::default(), "how the samples of a cell are kept: each with a link to the next, or sorted";
    }
}

impl ShadowMethod for AliasFreeMap {
    fn info(&self) -> &'static MethodInfo {
        &INFO
    }

    fn prepare(
        &self,
        context: &PrepareContext<'_>,
    ) -> Result<Box<dyn PreparedMethod>, MethodError> {
        let samples = ViewSamples::new(context)?;
        let map = LightMap::new(context, self, &samples)?;
        Ok(Box::new(Prepared { samples, map }))
    }
}

/// The map of one scene and picture.
struct Prepared {
    samples: ViewSamples,
    /// `None` where nothing casts.
    map: Option<LightMap>,
}

impl PreparedMethod for Prepared {
    fn record(&mut self, frame: &mut Frame<'_>) -> anyhow::Result<()> {
        let resources = frame.resources();
        let Some(map) = &self.map else { return Ok(()) };
        let pass = wgpu::ComputePassDescriptor::default();
        frame.stage("samples", |stage| {
            let encoder = stage.encoder();
            resources.take_mask(encoder);
            map.clear(encoder);
            let mut pass = encoder.begin_compute_pass(&pass);
            self.samples.record(&mut pass, resources);
        });
        frame.stage("lists", |stage| {
            let mut pass = stage.encoder().begin_compute_pass(&pass);
            map.list(&mut pass, resources);
        });
        frame.stage("triangles", |stage| {
            let encoder = stage.encoder();
            let mut pass = encoder.begin_compute_pass(&pass);
            map.cover(&mut pass, resources);
            drop(pass);
            resources.give_mask(encoder);
        });
        Ok(())
    }

    fn counters(&self) -> Vec<(&'static str, u64)> {
        self.map.as_ref().map_or_else(Vec::new, LightMap::counters)
    }
}
