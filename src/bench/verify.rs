//! Checking a method's mask against the ray-traced truth, in frames that nobody times.

use crate::frame::{FrameView, Stage};
use crate::gpu::{FrameRecorder, Gpu, readback};
use crate::methods::PreparedMethod;
use crate::metrics::{MaskComparison, MaskError};
use crate::reference::{
    BoundaryProbe, CacheKey, Reference, ReferenceCache, ReferenceMask, ReferenceView,
};
use crate::scene::{Scene, View};
use anyhow::Context;
use glam::Vec4;

/// Draws single frames of one scene and judges their masks.
pub struct Verifier<'a> {
    gpu: &'a Gpu,
    scene: &'a Scene,
    stage: &'a Stage,
    reference: Reference,
    cache: &'a ReferenceCache,
    /// The light of the pictures; at first the scene's.
    pub light: Vec4,
}

/// What is true at one view.
pub struct Truth {
    view: ReferenceView,
    /// The verdict of each pixel.
    pub mask: ReferenceMask,
}

/// How a method did at one view.
pub struct Judgement {
    /// Counts of wrong pixels.
    pub error: MaskError,
    /// RGB, rows from the top: where they are.
    pub error_map: Vec<u8>,
}

impl<'a> Verifier<'a> {
    /// Prepares the reference of `scene`.
    ///
    /// # Errors
    /// When the scene has a triangle that cannot be traced.
    pub fn new(
        gpu: &'a Gpu,
        scene: &'a Scene,
        stage: &'a Stage,
        cache: &'a ReferenceCache,
    ) -> anyhow::Result<Self> {
        let mesh = &scene.mesh;
        let mut casts = vec![false; mesh.triangles.len()];
        for object in mesh.casters() {
            casts[object.triangle_range()].fill(true);
        }
        let reference = Reference::new(&mesh.positions, &mesh.triangles, |triangle| {
            casts[triangle as usize]
        })
        .with_context(|| format!("scene `{}` cannot be traced", scene.name))?;
        Ok(Self {
            gpu,
            scene,
            stage,
            reference,
            cache,
            light: scene.light,
        })
    }

    /// The truth at `view`, from the cache or traced; it stays the view of the frames drawn next.
    ///
    /// # Errors
    /// When the device is lost, or the view is no perspective.
    pub fn truth(&self, view: &View) -> anyhow::Result<Truth> {
        let FrameView {
            view_projection, ..
        } = self.stage.set_view(self.gpu, view, self.light);
        let mut frame = FrameRecorder::untimed(self.gpu);
        self.stage.record_gbuffer(&mut frame);
        frame.submit();
        let ids = readback::read_texture(self.gpu, &self.stage.targets.triangle_ids)?;
        let ids: Vec<u32> = bytemuck::pod_collect_to_vec(&ids);
        let view = ReferenceView {
            width: self.stage.targets.width,
            height: self.stage.targets.height,
            view_projection,
        };
        let light = self.light;
        let key = CacheKey::new(&self.scene.mesh_hash, light, &view, &ids);
        let mask = self
            .cache
            .get_or_trace(&key, &view, || self.reference.trace(light, &view, &ids))?;
        Ok(Truth { view, mask })
    }

    /// Draws the frame with `method` at the view set last, and returns the mask: 0 or 255 a pixel.
    ///
    /// # Errors
    /// When the device is lost.
    pub fn draw_mask(&self, method: &dyn PreparedMethod) -> anyhow::Result<Vec<u8>> {
        let mut frame = FrameRecorder::untimed(self.gpu);
        self.stage.record(&mut frame, method);
        frame.submit();
        readback::read_texture(self.gpu, &self.stage.targets.mask)
    }

    /// RGBA of the frame drawn last.
    ///
    /// # Errors
    /// When the device is lost.
    pub fn read_picture(&self) -> anyhow::Result<Vec<u8>> {
        readback::read_texture(self.gpu, &self.stage.targets.colour)
    }

    /// Compares a mask with the truth of the same view.
    ///
    /// # Errors
    /// When mask and truth differ in size.
    pub fn judge(&self, mask: &[u8], truth: &Truth) -> anyhow::Result<Judgement> {
        let light = self.light;
        let probe = BoundaryProbe::new(&self.reference, light, &truth.view, &truth.mask)?;
        let comparison = MaskComparison::new(mask, &truth.mask, |x, y| probe.near_boundary(x, y))?;
        Ok(Judgement {
            error: comparison.error(),
            error_map: comparison.error_map(),
        })
    }
}
