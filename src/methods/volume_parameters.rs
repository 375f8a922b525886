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
        "1/8192",
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
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
#[serde(default)]
pub(super) struct VolumeParameters {
    pub determinism: Determinism,
    pub counting: Counting,
    pub reach: Reach,
    pub front_cap: FrontCap,
    pub push_back_px: f64,
    pub depth: DepthDirection,
    pub depth_format: DepthFormat,
    /// `None`: the camera's.
    pub near: Option<f64>,
}

/// A side quad is never in front of the surface that it starts from, but their depths may differ by less than the
/// rasteriser's arithmetic can tell, above all where the light grazes the surface, and for copies of a quad that a
/// tessellator cuts along different diagonals. Pushed back by so much, it is nearly always found behind. More would
/// move shadows: 1/256 pixel costs some ten wrong pixels at boundaries in a frame.
const PUSH_BACK_PX: f64 = 1.0 / 8192.0;

impl Default for VolumeParameters {
    fn default() -> Self {
        Self {
            determinism: Determinism::default(),
            counting: Counting::default(),
            reach: Reach::default(),
            front_cap: FrontCap::default(),
            push_back_px: PUSH_BACK_PX,
            depth: DepthDirection::default(),
            depth_format: DepthFormat::default(),
            near: None,
        }
    }
}

impl VolumeParameters {
    /// See [`super::Parameters::validate`].
    pub(super) fn validate(&self) -> Result<(), String> {
        in_range("push_back_px", self.push_back_px, -1.0..=1.0)?;
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
