//! The parameters that all volume methods have.

use crate::frame::{DepthFormat, DepthSetup};
use crate::geometry::Determinism;
use crate::gpu::DepthDirection;
use crate::gpu::native::Raster;
use crate::parameters;
use serde::{Deserialize, Serialize};
use std::ops::Deref;

/// How volumes are counted.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Counting {
    /// Behind what is visible, to the end of the volumes, caps included: right wherever the eye is
    /// (Carmack's reverse; Everitt and Kilgard 2002).
    #[default]
    ZFail,
    /// Before what is visible, without caps: wrong where the eye is in a volume (Heidmann 1991).
    ZPass,
    /// Z-pass for each object whose volumes provably leave the near rectangle out, else z-fail.
    Auto,
}

/// How far volumes reach.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Reach {
    /// To a plane just beyond the scene, where there is one (see [`crate::geometry::end_plane`]), else
    /// to infinity.
    #[default]
    Scene,
    /// To infinity, as in the literature.
    Infinity,
}

/// Where the front caps of volumes are in z-fail.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum FrontCap {
    /// On the far plane. Every caster is in the depth buffer, so its front cap is never in front of what
    /// is visible: it counts everywhere (Milet et al. 2014, section 2.1).
    #[default]
    Far,
    /// On the triangle, where it competes with its own surface in the last bit of depth.
    InPlace,
}

/// A side quad is never in front of the surface that it starts from, but their depths may differ by less than the
/// rasteriser's arithmetic can tell, above all where the light grazes the surface, and for copies of a quad that a
/// tessellator cuts along different diagonals. Pushed back by so much, it is nearly always found behind. More would
/// move shadows: 1/256 pixel costs some ten wrong pixels at boundaries in a frame.
const PUSH_BACK_PX: f64 = 1.0 / 8192.0;

parameters! {
    /// The parameters that all volume methods have.
    #[derive(Copy)]
    pub(super) struct VolumeParameters {
        pub counting: Counting = Counting::ZFail,
            "how volumes are counted; auto: z_pass for objects that cannot shadow the eye, else z_fail";
        pub reach: Reach = Reach::Scene,
            "scene: volumes end just beyond the scene where they may; infinity: as in the literature";
        pub front_cap: FrontCap = FrontCap::Far,
            "where the front caps of z_fail are: far (on the far plane, counted everywhere), in_place";
        pub push_back_px: f64 = PUSH_BACK_PX, in -1.0..=1.0,
            "volumes that are tested against depth are pushed away by the change of their depth over so many pixels";
        pub depth: DepthDirection = DepthDirection::Reversed,
            "the frame's depth buffer: reversed (1 at the near plane, 0 at infinity), standard (0 to 1)";
        pub depth_format: DepthFormat = DepthFormat::Float32,
            "the frame's depth buffer";
        /// `None`: the camera's.
        pub near: Option<f64> = None, in 1e-9..=1e9,
            "distance of the frame's near plane, in the scene's units; none: the camera's";
    }
}

parameters! {
    /// The parameters of volume methods in whose stages each edge finds the facings of its triangles.
    #[derive(Copy)]
    pub(super) struct StageVolumeParameters {
        pub determinism: Determinism = Determinism::ReferenceEdge,
            "how the edges of a triangle agree on its facing";
        ..volume: VolumeParameters;
    }
}

impl Deref for StageVolumeParameters {
    type Target = VolumeParameters;

    fn deref(&self) -> &VolumeParameters {
        &self.volume
    }
}

impl StageVolumeParameters {
    /// The definitions that shaders take them by, and `more`.
    pub(super) fn defines<'a>(&self, more: &[(&'a str, u32)]) -> Vec<(&'a str, u32)> {
        let mut defines = vec![("DETERMINISM", self.determinism as u32)];
        if self.reach == Reach::Infinity {
            defines.push(("REACH_INFINITY", 1));
        }
        if self.depth == DepthDirection::Standard {
            defines.push(("STANDARD_DEPTH", 1));
        }
        defines.extend_from_slice(more);
        defines
    }
}

impl VolumeParameters {
    /// The depth buffer that the frame is to be drawn with.
    pub(super) fn depth_setup(&self) -> DepthSetup {
        DepthSetup {
            direction: self.depth,
            format: self.depth_format,
            near: self.near.map(|near| near as f32),
        }
    }

    /// How front caps that are drawn by themselves are counted in z-fail. On the far plane they fail
    /// every depth test; what the near plane cuts off is clipped and does not count.
    pub(super) fn front_cap_raster(&self) -> Raster {
        match self.front_cap {
            FrontCap::Far => Raster::CountAll,
            FrontCap::InPlace => Raster::CountDepthFails,
        }
    }
}
