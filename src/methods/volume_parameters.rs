//! The parameters that all volume methods have.

use super::counter::{Counter, PortableCounter};
use super::{MethodError, PrepareContext};
use crate::frame::{DepthFormat, DepthSetup, Visibility};
use crate::geometry::{Casting, Determinism};
use crate::gpu::DepthDirection;
use crate::gpu::native::Raster;
use crate::parameters;
use crate::scene::LightPath;
use serde::{Deserialize, Serialize};
use std::ops::Deref;

/// Says that a parameter was set that [`Plan::Auto`] decides.
///
/// # Errors
/// If `is_set`.
pub(super) fn refuse_both(name: &str, is_set: bool) -> Result<(), MethodError> {
    if is_set {
        let message = format!("plan=auto decides `{name}`: leave one of the two out");
        return Err(MethodError::Parameter(message));
    }
    Ok(())
}

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
    /// Z-pass that begins with the number of volumes around the near rectangle, for each object for which there is such
    /// a number, else z-fail (see [`crate::geometry::near_count`]).
    ZPassCounted,
}

/// How far volumes reach.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Reach {
    /// To a plane just beyond the scene, where there is one (see [`crate::geometry::end_plane`]), else
    /// to infinity.
    #[default]
    Scene,
    /// The volume of each object to the one of the planes beside the scene that is best for it.
    Object,
    /// To infinity, as in the literature.
    Infinity,
}

/// Which objects' volumes are not drawn.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Culling {
    /// All are drawn.
    #[default]
    None,
    /// Those that cannot meet the view frustum.
    Frustum,
    /// These, and those whose boxes, extruded from the light, are found to be hidden (see [`crate::frame::occlusion`]).
    Occlusion,
    /// The same without an answer to the processor: the device draws them or not.
    OcclusionGpu,
}

/// What becomes of triangles that are occluded from the light (see [`crate::geometry::occluded`]).
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Occluded {
    /// They cast shadows as all others do, within those of others.
    #[default]
    Cast,
    /// They do not.
    LeftOut,
}

/// Who decides what of the volumes is drawn.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Plan {
    /// Each parameter for itself.
    #[default]
    AsSet,
    /// The program: no more than each object needs in the view of the frame.
    Auto,
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
        pub plan: Plan = Plan::AsSet,
            "auto: counting, reach, culling, casting (and more, method by method) as draws least, object by object; \
             as_set: as these say";
        pub counting: Counting = Counting::ZFail,
            "how volumes are counted; auto: z_pass for objects that cannot shadow the eye, else z_fail; \
             z_pass_counted: z_pass that begins with the number of volumes around the eye, else z_fail";
        pub reach: Reach = Reach::Scene,
            "scene: volumes end just beyond the scene where all may; object: where each may; infinity: nowhere";
        pub culling: Culling = Culling::None,
            "whose volumes are not drawn: none, frustum (of objects that cannot shadow anything in view), occlusion (nor of \
             those found to be hidden), occlusion_gpu (the same, and only the device knows; not of all methods)";
        pub visibility: Visibility = Visibility::Frustum,
            "which objects the G-buffer draws: frustum (those in view), occlusion (but for those found to be hidden)";
        pub occluded: Occluded = Occluded::Cast,
            "triangles that are proven to be behind others, seen from a light that stands still: cast, left_out";
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

/// What `casting` means.
pub(super) const CASTING_WORDS: &str = "light_facing: of closed objects with eye and light outside, only triangles that \
     face the light; each_side: of others first these, then the rest by their open edges; all";

parameters! {
    /// The parameters of volume methods in whose stages each edge finds the facings of its triangles.
    #[derive(Copy)]
    pub(super) struct StageVolumeParameters {
        pub determinism: Determinism = Determinism::ReferenceEdge,
            "how the edges of a triangle agree on its facing";
        pub casting: Casting = Casting::All,
            CASTING_WORDS;
        pub counter: Counter = Counter::Stencil8,
            "where volumes are counted: stencil8 (0 again at 256), stencil_export (the same by fragment shaders, twice: 0 \
             again at 65,280), blend16, blend32 (floats, by blending)";
        ..volume: VolumeParameters;
    }
}

parameters! {
    /// The parameters of volume methods that wgpu's pipelines draw: these can write no stencil values.
    #[derive(Copy)]
    pub(super) struct PortableVolumeParameters {
        pub counter: PortableCounter = PortableCounter::Stencil8,
            "where volumes are counted: stencil8 (0 again at 256), blend16, blend32 (floats, by blending)";
        ..volume: VolumeParameters;
    }
}

impl PortableVolumeParameters {
    /// As [`VolumeParameters::planned`].
    ///
    /// # Errors
    /// As there.
    pub(super) fn planned(mut self, light: &LightPath) -> Result<Self, MethodError> {
        self.volume = self.volume.planned(light)?;
        self.volume.refuse_draws_by_object()?;
        Ok(self)
    }
}

impl Deref for PortableVolumeParameters {
    type Target = VolumeParameters;

    fn deref(&self) -> &VolumeParameters {
        &self.volume
    }
}

impl StageVolumeParameters {
    /// For a method that has parameters of its own for the rest.
    pub(super) fn new(volume: VolumeParameters, casting: Casting, counter: Counter) -> Self {
        Self {
            determinism: Determinism::ReferenceEdge,
            casting,
            counter,
            volume,
        }
    }

    /// With what [`Plan::Auto`] makes of them.
    ///
    /// # Errors
    /// When one that the plan decides is set as well.
    pub(super) fn planned(mut self, light: &LightPath) -> Result<Self, MethodError> {
        self.casting = self.planned_casting(self.casting, Self::default().casting)?;
        self.volume = self.volume.planned(light)?;
        Ok(self)
    }
}

impl Deref for StageVolumeParameters {
    type Target = VolumeParameters;

    fn deref(&self) -> &VolumeParameters {
        &self.volume
    }
}

impl StageVolumeParameters {
    /// The depth buffer that the frame is to be drawn with.
    pub(super) fn depth_setup(&self) -> DepthSetup {
        DepthSetup {
            stencil_in_shaders: self.counter == Counter::StencilExport,
            ..self.volume.depth_setup()
        }
    }

    /// The definitions that shaders take them by, and `more`.
    pub(super) fn defines<'a>(&self, more: &[(&'a str, u32)]) -> Vec<(&'a str, u32)> {
        self.defines_with(self.determinism as u32, more)
    }

    /// The same with another number for how edges agree.
    pub(super) fn defines_with<'a>(
        &self,
        determinism: u32,
        more: &[(&'a str, u32)],
    ) -> Vec<(&'a str, u32)> {
        let mut defines = vec![("DETERMINISM", determinism)];
        if self.depth == DepthDirection::Standard {
            defines.push(("STANDARD_DEPTH", 1));
        }
        defines.extend_from_slice(more);
        defines
    }

    /// The same for shaders that make the side quads of edges: where the counter takes weights, one for each edge.
    pub(super) fn defines_of_sides<'a>(&self, more: &[(&'a str, u32)]) -> Vec<(&'a str, u32)> {
        let mut defines = self.defines(more);
        if self.counter.takes_weights() {
            defines.push(("WEIGHTED", 1));
        }
        defines
    }
}

impl VolumeParameters {
    /// With what [`Plan::Auto`] makes of them.
    ///
    /// # Errors
    /// When one that the plan decides is set as well.
    pub(super) fn planned(mut self, light: &LightPath) -> Result<Self, MethodError> {
        if self.plan == Plan::Auto {
            let usual = Self::default();
            refuse_both("counting", self.counting != usual.counting)?;
            refuse_both("reach", self.reach != usual.reach)?;
            refuse_both("culling", self.culling != usual.culling)?;
            refuse_both("occluded", self.occluded != usual.occluded)?;
            self.counting = Counting::ZPassCounted;
            self.reach = Reach::Object;
            self.culling = Culling::Frustum;
            if light.standing_still().is_some() {
                self.occluded = Occluded::LeftOut;
            }
        }
        Ok(self)
    }

    /// For methods that draw many objects by one call.
    ///
    /// # Errors
    /// If the device is to decide about each.
    pub(super) fn refuse_draws_by_object(&self) -> Result<(), MethodError> {
        if self.culling == Culling::OcclusionGpu {
            let message = "culling=occlusion_gpu needs a draw call for each object, which this method does not have; \
                           use culling=occlusion";
            return Err(MethodError::Parameter(message.to_owned()));
        }
        Ok(())
    }

    /// What casts, if a method has `usual` where nothing is set: [`Plan::Auto`] decides it.
    ///
    /// # Errors
    /// When it is set as well.
    pub(super) fn planned_casting(
        &self,
        casting: Casting,
        usual: Casting,
    ) -> Result<Casting, MethodError> {
        if self.plan == Plan::Auto {
            refuse_both("casting", casting != usual)?;
            return Ok(Casting::EachSide);
        }
        Ok(casting)
    }

    /// The context of a method with these parameters, with the triangles that cast.
    ///
    /// # Errors
    /// When some are to be left out and the light does not stand still.
    pub(super) fn casters<'a>(
        &self,
        context: &PrepareContext<'a>,
    ) -> Result<PrepareContext<'a>, MethodError> {
        match self.occluded {
            Occluded::Cast => Ok(context.clone()),
            Occluded::LeftOut => context.without_occluded(),
        }
    }

    /// The depth buffer that the frame is to be drawn with.
    pub(super) fn depth_setup(&self) -> DepthSetup {
        DepthSetup {
            direction: self.depth,
            format: self.depth_format,
            near: self.near.map(|near| near as f32),
            stencil_in_shaders: false,
            visibility: self.visibility,
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Light;
    use glam::Vec4;

    #[test]
    fn a_plan_decides_alone() {
        let auto = StageVolumeParameters {
            volume: VolumeParameters {
                plan: Plan::Auto,
                ..VolumeParameters::default()
            },
            ..StageVolumeParameters::default()
        };
        let still = LightPath::still(Light::at(Vec4::W));
        let planned = auto.planned(&still).unwrap();
        assert_eq!(planned.counting, Counting::ZPassCounted);
        assert_eq!(planned.casting, Casting::EachSide);
        let mut both = auto;
        both.volume.counting = Counting::ZPass;
        let error = both.planned(&still).unwrap_err().to_string();
        assert!(error.contains("plan=auto decides `counting`"), "{error}");
        both.volume.plan = Plan::AsSet;
        assert_eq!(both.planned(&still).unwrap().counting, Counting::ZPass);
    }
}
