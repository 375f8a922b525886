//! What is true at a view of a scene, and the frames that are held against it, which nobody times.

use super::ReadyMethod;
use crate::frame::{FrameResources, FrameView, PreparedMethod};
use crate::gpu::{FrameRecorder, Gpu, readback};
use crate::memory;
use crate::metrics::EdgeDistances;
use crate::reference::{
    CacheKey, Reference, ReferenceCache, ReferenceMask, ReferenceView, Verdict,
};
use crate::scene::{Moment, Scene};
use anyhow::Context;
use std::rc::Rc;

/// What the processor needs for a pixel of a picture that is compared with the truth: numbers of triangles,
/// verdicts, distances to the edge, masks and pictures.
const TRUTH_BYTES_PER_PIXEL: u64 = 64;

/// Knows what is true of one scene, and compares masks that are drawn with one set of frame resources with it.
pub struct Verifier<'a> {
    gpu: &'a Gpu,
    scene: &'a Scene,
    pub(super) resources: &'a FrameResources,
    pub(super) reference: Rc<Reference>,
    cache: &'a ReferenceCache,
}

/// What is true at one moment.
pub struct Truth {
    pub(super) moment: Moment,
    pub(super) view: ReferenceView,
    pub(super) triangle_ids: Vec<u32>,
    /// The verdict of each pixel.
    pub mask: ReferenceMask,
    pub(super) edges: EdgeDistances,
}

impl<'a> Verifier<'a> {
    /// Prepares the reference of `scene`.
    ///
    /// # Errors
    /// When the scene has a triangle that cannot be traced.
    pub fn new(
        gpu: &'a Gpu,
        scene: &'a Scene,
        resources: &'a FrameResources,
        cache: &'a ReferenceCache,
    ) -> anyhow::Result<Self> {
        Ok(Self::sharing(
            gpu,
            scene,
            resources,
            cache,
            &Self::reference_of(scene)?,
        ))
    }

    /// The reference of `scene`, for verifiers to [share](Self::sharing).
    ///
    /// # Errors
    /// When the scene has a triangle that cannot be traced.
    pub fn reference_of(scene: &Scene) -> anyhow::Result<Rc<Reference>> {
        let mesh = &scene.mesh;
        let mut casts = vec![false; mesh.triangles.len()];
        for object in mesh.casters() {
            casts[object.triangle_range()].fill(true);
        }
        let reference = Reference::new(&mesh.positions, &mesh.triangles, |triangle| {
            casts[triangle as usize]
        })
        .with_context(|| format!("scene `{}` cannot be traced", scene.name))?;
        Ok(Rc::new(reference))
    }

    /// The same with a reference that was prepared before.
    pub fn sharing(
        gpu: &'a Gpu,
        scene: &'a Scene,
        resources: &'a FrameResources,
        cache: &'a ReferenceCache,
        reference: &Rc<Reference>,
    ) -> Self {
        Self {
            gpu,
            scene,
            resources,
            reference: Rc::clone(reference),
            cache,
        }
    }

    /// The truth at `moment`, from the cache or traced.
    ///
    /// # Errors
    /// When the device is lost, memory is short, or there is no picture of that moment.
    pub fn truth(&self, moment: &Moment) -> anyhow::Result<Truth> {
        moment.validate()?;
        let (width, height) = (self.resources.targets.width, self.resources.targets.height);
        memory::check(TRUTH_BYTES_PER_PIXEL * u64::from(width) * u64::from(height))
            .with_context(|| format!("the truth of {width} × {height} pixels is too large"))?;
        let FrameView {
            view_projection, ..
        } = self.resources.set_view(self.gpu, moment);
        let ids = self.gpu.attempt(|| {
            let mut frame = FrameRecorder::untimed(self.gpu);
            self.resources.record_gbuffer(&mut frame)?;
            frame.submit();
            readback::read_texture(self.gpu, &self.resources.targets.triangle_ids)
        })?;
        let triangle_ids: Vec<u32> = bytemuck::pod_collect_to_vec(&ids);
        let view = ReferenceView {
            width,
            height,
            view_projection,
        };
        let light = moment.light;
        let key = CacheKey::new(&self.scene.mesh_hash, light, &view, &triangle_ids);
        let trace = || self.reference.trace(light, &view, &triangle_ids);
        let mask = self.cache.get_or_trace(&key, &view, trace)?;
        Ok(Truth {
            moment: *moment,
            edges: EdgeDistances::new(&mask),
            view,
            triangle_ids,
            mask,
        })
    }

    /// Draws the frame with `method` at the moment of `truth`, and returns the mask: 0 lit to 255 in shadow.
    ///
    /// # Errors
    /// When the device is lost.
    pub fn draw_mask(
        &self,
        method: &mut dyn PreparedMethod,
        truth: &Truth,
    ) -> anyhow::Result<Vec<u8>> {
        self.resources.set_view(self.gpu, &truth.moment);
        self.resources.draw_mask(self.gpu, method)
    }

    /// The same for a frame that follows those at `lead_in_s` of the flight.
    ///
    /// # Errors
    /// When the device is lost.
    pub fn draw_mask_after(
        &self,
        lead_in_s: &[f64],
        ready: &mut ReadyMethod,
        truth: &Truth,
    ) -> anyhow::Result<Vec<u8>> {
        let lead_in = lead_in_s.iter().map(|s| self.scene.flight.at(*s));
        ready.begin(self.gpu, &lead_in.collect::<Vec<_>>())?;
        self.resources.set_view(self.gpu, &truth.moment);
        ready.draw_mask(self.gpu)
    }

    /// RGBA of the frame drawn last.
    ///
    /// # Errors
    /// When the device is lost.
    pub fn read_picture(&self) -> anyhow::Result<Vec<u8>> {
        readback::read_texture(self.gpu, &self.resources.targets.colour)
    }

    /// RGBA of the frame as it is with the true shadows; ambiguous pixels are lit, see [`Self::flip`].
    ///
    /// # Errors
    /// When the device is lost.
    pub fn true_picture(&self, truth: &Truth) -> anyhow::Result<Vec<u8>> {
        let in_shadow = |verdict: Verdict| u8::from(verdict == Verdict::Shadowed) * u8::MAX;
        let mask: Vec<u8> = truth.mask.verdicts().map(in_shadow).collect();
        self.picture_under(&mask, &truth.moment)
    }

    /// RGBA of the frame without the light, under the sky alone.
    ///
    /// # Errors
    /// When the device is lost.
    pub fn dark_picture(&self, moment: &Moment) -> anyhow::Result<Vec<u8>> {
        let (width, height) = (self.resources.targets.width, self.resources.targets.height);
        let mask = vec![u8::MAX; width as usize * height as usize];
        self.picture_under(&mask, moment)
    }

    fn picture_under(&self, mask: &[u8], moment: &Moment) -> anyhow::Result<Vec<u8>> {
        let gpu = self.gpu;
        self.resources.set_view(gpu, moment);
        gpu.attempt(|| {
            let mut frame = FrameRecorder::untimed(gpu);
            self.resources.record_gbuffer(&mut frame)?;
            frame.submit();
            self.resources.targets.write_mask(gpu, mask);
            let mut frame = FrameRecorder::untimed(gpu);
            self.resources.record_shade(&mut frame);
            frame.submit();
            self.read_picture()
        })
    }
}
