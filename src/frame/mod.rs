//! What all methods share: the scene on the device, the frame's targets, and the stages before and
//! after the method's own.
//!
//! A frame is `gbuffer` (depth, triangle ids, and a mask of what faces away from the light), the
//! method's stages (which add its shadows to the mask) and `shade` (the lit picture). The depth buffer is
//! reversed, 1 at the near plane and 0 at infinity, unless a [`DepthSetup`] has it otherwise for study.

mod blended_counts;
mod contract;
mod depth;
pub mod fullscreen;
mod gbuffer;
mod hidden_objects;
mod mask_pass;
mod numbered;
pub mod occlusion;
mod pixel_buffers;
mod pixel_compute;
mod resolve;
mod scene;
mod shade;
pub mod targets;
mod uniform;
mod view;
mod visible_triangles;

pub use blended_counts::BlendedCounts;
pub use contract::{DrawnVolumes, Frame, PreparedMethod, TexelOf, Texels};
pub use depth::{DepthFormat, DepthSetup, Visibility};
pub use gbuffer::GBuffer;
pub use mask_pass::{MaskPass, MaskShader};
pub use pixel_compute::{Input, PixelCompute, PixelKernel, read, write};
pub use resolve::{RESOLVE_STAGE, StencilResolve};
pub use scene::SceneBuffers;
pub use shade::Shade;
pub use targets::Targets;
pub use uniform::FrameUniform;
pub use view::{FrameView, SceneExtents};
pub use visible_triangles::VisibleTriangles;

use crate::gpu::{DeviceError, FrameRecorder, Gpu, readback};
use crate::scene::{Moment, Scene};
use occlusion::DepthBuffer;
use std::cell::Cell;
use std::rc::Rc;

/// Name of the first stage of every frame.
pub const GBUFFER_STAGE: &str = "gbuffer";
/// Name of the last stage of every frame.
pub const SHADE_STAGE: &str = "shade";

/// Everything that the frames of one scene at one size share, whatever the method.
pub struct FrameResources {
    /// The scene's meshes on the device.
    pub scene: Rc<SceneBuffers>,
    /// What the frame is drawn into.
    pub targets: Targets,
    /// View and light of the frame.
    pub uniform: FrameUniform,
    /// How far the scene reaches.
    pub extents: Rc<SceneExtents>,
    /// The depth buffer's setup.
    pub depth: DepthSetup,
    view: Cell<Option<FrameView>>,
    gbuffer: GBuffer,
    visible_triangles: VisibleTriangles,
    shade: Shade,
}

impl FrameResources {
    /// Uploads `scene` and makes targets of `width` × `height` pixels.
    ///
    /// # Errors
    /// When the device cannot hold them.
    pub fn new(gpu: &Gpu, scene: &Scene, width: u32, height: u32) -> Result<Self, DeviceError> {
        let buffers = Rc::new(SceneBuffers::new(gpu, &scene.mesh)?);
        let extents = Rc::new(SceneExtents::new(&scene.mesh));
        Self::of_buffers(
            gpu,
            buffers,
            extents,
            (width, height),
            DepthSetup::default(),
        )
    }

    /// The same scene and size with another depth buffer, which the device can draw with (see
    /// [`DepthSetup::check`]).
    ///
    /// # Errors
    /// When the device cannot hold it.
    pub fn with_depth(&self, gpu: &Gpu, depth: DepthSetup) -> Result<Self, DeviceError> {
        let size_px = (self.targets.width, self.targets.height);
        let (scene, extents) = (Rc::clone(&self.scene), Rc::clone(&self.extents));
        Self::of_buffers(gpu, scene, extents, size_px, depth)
    }

    fn of_buffers(
        gpu: &Gpu,
        scene: Rc<SceneBuffers>,
        extents: Rc<SceneExtents>,
        (width, height): (u32, u32),
        depth: DepthSetup,
    ) -> Result<Self, DeviceError> {
        gpu.attempt(|| {
            let targets = Targets::new(gpu, width, height, depth)?;
            let uniform = FrameUniform::new(gpu);
            let buffer = DepthBuffer {
                uniform: &uniform,
                targets: &targets,
                direction: depth.direction,
            };
            let gbuffer = GBuffer::new(gpu, &buffer, &scene, (depth, &extents));
            let visible_triangles = VisibleTriangles::new(gpu, &uniform, &scene, &targets);
            let shade = Shade::new(gpu, &targets);
            Ok(Self {
                scene,
                targets,
                uniform,
                extents,
                depth,
                view: Cell::new(None),
                gbuffer,
                visible_triangles,
                shade,
            })
        })
    }

    /// Sets view and light of the frames recorded from now on.
    pub fn set_view(&self, gpu: &Gpu, moment: &Moment) -> FrameView {
        let size_px = (self.targets.width, self.targets.height);
        let view = self
            .uniform
            .write(gpu, moment, &self.extents, size_px, self.depth);
        self.view.set(Some(view));
        view
    }

    /// The view that was set last.
    ///
    /// # Panics
    /// When none was set: there is no frame to record then.
    pub fn view(&self) -> FrameView {
        let Some(view) = self.view.get() else {
            panic!("a frame is recorded before its view was set")
        };
        view
    }

    /// Copies the shadow mask to where [`PixelCompute`] finds and changes it.
    pub fn take_mask(&self, encoder: &mut wgpu::CommandEncoder) {
        self.targets.pixels.take_mask(encoder, &self.targets.mask);
    }

    /// Brings it back.
    pub fn give_mask(&self, encoder: &mut wgpu::CommandEncoder) {
        self.targets.pixels.give_mask(encoder, &self.targets.mask);
    }

    /// How many pixels a picture in a buffer has, with those between the end of a row and the next.
    pub fn buffer_px(&self) -> u32 {
        self.targets.pixels.row_px() * self.targets.height
    }

    /// Records a whole frame with `method`.
    ///
    /// # Errors
    /// The method's.
    pub fn record<'a>(
        &'a self,
        mut recorder: FrameRecorder<'a>,
        method: &mut dyn PreparedMethod,
    ) -> anyhow::Result<FrameRecorder<'a>> {
        self.record_gbuffer(&mut recorder)?;
        let mut frame = Frame::new(recorder, self);
        method.record(&mut frame)?;
        let mut recorder = frame.into_recorder();
        self.record_shade(&mut recorder);
        Ok(recorder)
    }

    /// The next frame, with `method`, follows no other.
    pub fn begin(&self, method: &mut dyn PreparedMethod) {
        self.gbuffer.begin();
        method.begin();
    }

    /// Draws a frame with `method` that follows no other, and reads the mask: 0 lit to 255 in shadow.
    ///
    /// # Errors
    /// When the device is lost, or the method's.
    pub fn draw_mask(&self, gpu: &Gpu, method: &mut dyn PreparedMethod) -> anyhow::Result<Vec<u8>> {
        self.begin(method);
        self.draw_next_mask(gpu, method)
    }

    /// The same for a frame that follows the one before.
    ///
    /// # Errors
    /// When the device is lost, or the method's.
    pub fn draw_next_mask(
        &self,
        gpu: &Gpu,
        method: &mut dyn PreparedMethod,
    ) -> anyhow::Result<Vec<u8>> {
        gpu.attempt(|| {
            self.draw(gpu, method)?;
            readback::read_texture(gpu, &self.targets.mask)
        })
    }

    /// Draws a frame that follows the one before and that nobody times, and does not wait for it.
    ///
    /// # Errors
    /// When the device is lost, or the method's.
    pub fn draw(&self, gpu: &Gpu, method: &mut dyn PreparedMethod) -> anyhow::Result<()> {
        gpu.attempt(|| {
            self.record(FrameRecorder::untimed(gpu), method)?.submit();
            Ok(())
        })
    }

    /// Records the last stage alone: shades with the mask as it is.
    pub fn record_shade(&self, frame: &mut FrameRecorder<'_>) {
        frame.stage(SHADE_STAGE, |stage| {
            self.shade.record(stage.encoder(), &self.targets);
            stage.count_draws(1);
        });
    }

    /// The depth of the frame under way, for what is drawn against it.
    pub fn depth_buffer(&self) -> DepthBuffer<'_> {
        DepthBuffer {
            uniform: &self.uniform,
            targets: &self.targets,
            direction: self.depth.direction,
        }
    }

    /// Records the first stage alone, for whoever reads the triangle ids.
    ///
    /// # Errors
    /// When the device is lost.
    pub fn record_gbuffer(&self, frame: &mut FrameRecorder<'_>) -> anyhow::Result<()> {
        let Self {
            uniform,
            scene,
            targets,
            gbuffer,
            visible_triangles,
            ..
        } = self;
        let view = (&self.view(), &*self.extents);
        frame.stage(GBUFFER_STAGE, |stage| {
            gbuffer.record(stage, &self.depth_buffer(), scene, view)?;
            let encoder = stage.encoder();
            let draw_calls = visible_triangles.record(encoder, uniform, scene, targets);
            stage.count_draws(draw_calls);
            Ok(())
        })
    }
}
