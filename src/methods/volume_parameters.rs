//! The parameters that all volume methods have.

use super::Parameter;
use super::parameters::in_range;
use crate::frame::{DepthFormat, DepthSetup};
use crate::geometry::Determinism;
use crate::gpu::DepthDirection;
use crate::gpu::native::Raster;
use serde::{Deserialize, Serialize};

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

/// See [`super::MethodInfo::parameters`].
pub(super) const PARAMETERS: &[Parameter] = &[
    (
        "determinism",
        "reference_edge",
        "how the edges of a triangle agree on its facing: reference_edge, consistent_triangle, none",
    ),
    (
        "counting",
        "z_fail",
        "z_fail; z_pass; auto: z_pass for objects that cannot shadow the eye, else z_fail",
    ),
    (
        "reach",
        "scene",
        "scene: volumes end just beyond the scene where they may; infinity: as in the literature",
    ),
    (
        "front_cap",
        "far",
        "where the front caps of z_fail are: far (on the far plane, counted everywhere), in_place",
    ),
    (
        "push_back_px",
        "0 (triangle_ts: 1/8192)",
        "what passes a depth test is pushed away by the change of its depth over so many pixels, -1 to 1",
    ),
    (
        "depth",
        "reversed",
        "the frame's depth buffer: reversed (1 at the near plane, 0 at infinity), standard (0 to 1)",
    ),
    (
        "depth_format",
        "float32",
        "the frame's depth buffer: float32, unorm24",
    ),
    (
        "near",
        "the camera's",
        "distance of the frame's near plane, in the scene's units",
    ),
];

/// The parameters that all volume methods have.
#[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
#[serde(default)]
pub(super) struct VolumeParameters {
    pub determinism: Determinism,
    pub counting: Counting,
    pub reach: Reach,
    pub front_cap: FrontCap,
    /// `None`: the method's own.
    pub push_back_px: Option<f64>,
    pub depth: DepthDirection,
    pub depth_format: DepthFormat,
    /// `None`: the camera's.
    pub near: Option<f64>,
}

impl VolumeParameters {
    /// See [`super::Parameters::validate`].
    pub(super) fn validate(&self) -> Result<(), String> {
        if let Some(px) = self.push_back_px {
            in_range("push_back_px", px, -1.0..=1.0)?;
        }
        match self.near {
            Some(near) => in_range("near", near, 1e-9..=1e9),
            None => Ok(()),
        }
    }

    /// The depth buffer that the frame is to be drawn with.
    pub(super) fn depth_setup(&self) -> DepthSetup {
        DepthSetup {
            direction: self.depth,
            format: self.depth_format,
            near: self.near.map(|near| near as f32),
        }
    }

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

    /// How front caps that are drawn by themselves are counted in z-fail. On the far plane they fail
    /// every depth test; what the near plane cuts off is clipped and does not count.
    pub(super) fn front_cap_raster(&self) -> Raster {
        match self.front_cap {
            FrontCap::Far => Raster::CountAll,
            FrontCap::InPlace => Raster::CountDepthFails,
        }
    }
}
