//! What a shadow method gets of a frame and what it gives.
//!
//! A method that was prepared for a scene draws its part of every frame in [`PreparedMethod::record`]: a chain of
//! stages between G-buffer and shading that add its shadows to the mask. [`Frame`] has all that it may ask: view and
//! light, the scene on the device, targets, and stages. What depends on view or light is found there, in every frame
//! in which it may have changed, and timed: both move.
//!
//! A method may keep what it knows from frame to frame (what was visible, silhouettes of a light that stands still,
//! [tickets](crate::gpu::Ticket) of read-backs). [`PreparedMethod::begin`] tells it that the next frame does not
//! follow the last one: that a flight begins, or a picture far from the one before. What it keeps may then only cost
//! or save time, never change the mask.
//!
//! ```no_run
//! use svbench::frame::{Frame, PreparedMethod};
//!
//! /// All that faces the light is lit.
//! struct NoShadows;
//!
//! impl PreparedMethod for NoShadows {
//!     fn record(&mut self, frame: &mut Frame<'_>) -> anyhow::Result<()> {
//!         // The G-buffer stage has marked what faces away; there is nothing to add.
//!         frame.stage("nothing", |_stage| Ok(()))
//!     }
//! }
//! ```

use super::{FrameResources, FrameView, SceneBuffers, Targets};
use crate::gpu::{FrameRecorder, Gpu, Stage};
use glam::DVec3;
use std::ops::AddAssign;

/// A method ready to draw frames of one scene.
pub trait PreparedMethod {
    /// The next frame does not follow the one before: forget what was kept from frame to frame.
    fn begin(&mut self) {}

    /// Records its stages between G-buffer and shading; they add its shadows to the mask.
    ///
    /// # Errors
    /// Why there is no such frame; it ends the cell.
    fn record(&mut self, frame: &mut Frame<'_>) -> anyhow::Result<()>;

    /// What a reader of its results should know about this scene.
    fn warnings(&self) -> Vec<String> {
        Vec::new()
    }

    /// How its shadow map was looked up in the last frame; `None` for methods without one.
    fn texels(&self) -> Option<Texels<'_>> {
        None
    }

    /// How it drew the shadow volumes of the last frame; `None` for methods without volumes.
    fn drawn_volumes(&self) -> Option<DrawnVolumes> {
        None
    }

    /// What it counted while it was prepared, by name.
    fn counters(&self) -> Vec<(&'static str, u64)> {
        Vec::new()
    }
}

/// How the shadow volumes of objects were drawn, in numbers of objects.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct DrawnVolumes {
    /// Not at all: they cannot shadow anything in view.
    pub culled: u32,
    /// Nor these: hidden, as the device found.
    pub hidden: u32,
    /// Boxes that it was asked about.
    pub queries: u32,
    /// Of the others, counted z-pass.
    pub z_pass: u32,
    /// Of these, with the near rectangle in their volumes.
    pub z_pass_counted: u32,
    /// Counted z-fail.
    pub z_fail: u32,
    /// Only triangles that face the light cast.
    pub light_facing: u32,
    /// First these, then the rest by open edges.
    pub each_side: u32,
    /// All triangles cast.
    pub all: u32,
    /// Their volumes reach to infinity.
    pub at_infinity: u32,
}

impl DrawnVolumes {
    /// How many are drawn.
    pub fn drawn(&self) -> u32 {
        self.z_pass + self.z_fail
    }
}

impl AddAssign for DrawnVolumes {
    fn add_assign(&mut self, other: Self) {
        self.culled += other.culled;
        self.hidden += other.hidden;
        self.queries += other.queries;
        self.z_pass += other.z_pass;
        self.z_pass_counted += other.z_pass_counted;
        self.z_fail += other.z_fail;
        self.light_facing += other.light_facing;
        self.each_side += other.each_side;
        self.all += other.all;
        self.at_infinity += other.at_infinity;
    }
}

/// Gives the texel of a shadow map in which a point in world space is looked up: layer, column, row.
/// `None` outside of the map.
pub type TexelOf<'a> = Box<dyn Fn(DVec3) -> Option<[i64; 3]> + Sync + 'a>;

/// How a shadow map is looked up.
pub struct Texels<'a> {
    /// Where.
    pub of: TexelOf<'a>,
    /// How many texels to each side of that one have a say too.
    pub reach: u32,
}

/// A frame under way.
pub struct Frame<'a> {
    resources: &'a FrameResources,
    view: FrameView,
    recorder: FrameRecorder<'a>,
}

impl<'a> Frame<'a> {
    pub(super) fn new(recorder: FrameRecorder<'a>, resources: &'a FrameResources) -> Self {
        Self {
            resources,
            view: resources.view(),
            recorder,
        }
    }

    /// The device.
    pub fn gpu(&self) -> &'a Gpu {
        self.recorder.gpu()
    }

    /// View and light.
    pub fn view(&self) -> &FrameView {
        &self.view
    }

    /// What all frames of this scene and size share: targets, the scene's buffers, the uniform with view and light.
    pub fn resources(&self) -> &'a FrameResources {
        self.resources
    }

    /// What the frame is drawn into: depth and triangle ids to read, the mask to write.
    pub fn targets(&self) -> &'a Targets {
        &self.resources.targets
    }

    /// The scene on the device.
    pub fn scene(&self) -> &'a SceneBuffers {
        &self.resources.scene
    }

    /// A stage of the frame, called `name` in results; gives what `record` gives. Its commands for the device and
    /// its work on the processor are timed apart, see [`Stage`].
    pub fn stage<T>(
        &mut self,
        name: &'static str,
        record: impl FnOnce(&mut Stage<'_, 'a>) -> T,
    ) -> T {
        self.recorder.stage(name, record)
    }

    pub(super) fn into_recorder(self) -> FrameRecorder<'a> {
        self.recorder
    }
}
