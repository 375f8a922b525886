//! Objects that the G-buffer need not draw, since others hide them.
//!
//! What was visible before is drawn first, and boxes around all else in view are held against its depth (Bittner et al.
//! 2004).

use super::occlusion::{Culler, DepthBuffer, Look, Sight, margin};
use super::{FrameView, SceneExtents};
use crate::geometry::{Bounds, VisibleFaces};
use crate::gpu::{Gpu, Stage};
use glam::DVec3;

/// Of boxes about which nothing is known, so many of the nearest are drawn before others are asked about.
const NEAREST: usize = 64;

/// What a frame asks by.
pub(super) struct ObjectLook<'a> {
    view: &'a FrameView,
    near: Bounds,
    margin: f64,
}

impl<'a> ObjectLook<'a> {
    pub(super) fn new(view: &'a FrameView, extents: &SceneExtents, height_px: u32) -> Self {
        Self {
            near: view.near_rectangle(),
            margin: margin(view, extents, height_px),
            view,
        }
    }
}

impl Look for ObjectLook<'_> {
    fn eye(&self) -> DVec3 {
        self.view.eye.as_dvec3()
    }

    fn sight(&self, bounds: Bounds) -> Sight {
        if !self.view.may_see(bounds) {
            return Sight::Out;
        }
        let eye = self.eye();
        let here = self.near.union(Bounds {
            low: eye,
            high: eye,
        });
        match bounds.larger_by(self.margin).may_meet(here) {
            true => Sight::Around,
            false => Sight::InView,
        }
    }

    fn push(&self, faces: &mut VisibleFaces, bounds: Bounds) {
        faces.push_box(bounds.larger_by(self.margin), self.eye());
    }
}

/// Finds out which objects are hidden.
pub(super) struct HiddenObjects(Culler);

impl HiddenObjects {
    pub(super) fn new(gpu: &Gpu, depth: &DepthBuffer<'_>, extents: &SceneExtents) -> Self {
        Self(Culler::new(gpu, depth, &extents.objects, NEAREST))
    }

    /// The next frame does not follow the one before.
    pub(super) fn forget(&mut self) {
        self.0.forget();
    }

    /// Draws what is visible, by `draw`, which is told whether it is the first time in the frame.
    ///
    /// # Errors
    /// When the device is lost.
    pub(super) fn draw(
        &mut self,
        stage: &mut Stage<'_, '_>,
        depth: &DepthBuffer<'_>,
        look: &ObjectLook<'_>,
        mut draw: impl FnMut(&mut Stage<'_, '_>, bool, Vec<u32>),
    ) -> anyhow::Result<()> {
        let culler = &mut self.0;
        let drawn = culler.begin(stage, look)?;
        draw(stage, true, drawn);
        culler.ask(stage, depth, look)?;
        while let Some(visible) = culler.go_on(stage, look)? {
            draw(stage, false, visible);
            culler.ask(stage, depth, look)?;
        }
        culler.end(stage, depth, look)
    }
}
