//! Stencil counts to shadow mask, the last stage of every stencil method.

use super::fullscreen::{self, FullscreenDesc};
use super::targets::MASK_FORMAT;
use super::{DepthSetup, Frame, Targets};
use crate::gpu::{Gpu, shader};

/// Name of this stage.
pub const RESOLVE_STAGE: &str = "resolve";

/// Pipeline of the resolve stage.
pub struct StencilResolve {
    pipeline: wgpu::RenderPipeline,
    far: f32,
}

impl StencilResolve {
    /// Builds the pipeline. The device must have a stencil buffer.
    pub fn new(gpu: &Gpu, depth: DepthSetup) -> Self {
        let device = &gpu.device;
        let module = shader::wgsl(device, "frame/resolve.wgsl");
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor::default());
        let counted = wgpu::StencilFaceState {
            compare: wgpu::CompareFunction::NotEqual,
            ..wgpu::StencilFaceState::IGNORE
        };
        let depth_stencil = wgpu::DepthStencilState {
            format: depth.texture_format(gpu),
            depth_write_enabled: Some(false),
            // The triangle lies at infinity: farther than every surface, not farther than the
            // background, where a count means nothing.
            depth_compare: Some(depth.direction.farther()),
            stencil: wgpu::StencilState {
                front: counted,
                back: counted,
                read_mask: 0xff,
                write_mask: 0,
            },
            bias: wgpu::DepthBiasState::default(),
        };
        let desc = FullscreenDesc {
            depth_stencil: Some(depth_stencil),
            ..FullscreenDesc::new(&module, "counted", &layout, MASK_FORMAT)
        };
        Self {
            pipeline: fullscreen::pipeline(device, &desc),
            far: depth.direction.far(),
        }
    }

    /// Records a stage, mostly [`RESOLVE_STAGE`]: adds to the mask the pixels with a count, where counting began with
    /// `begun_with` instead of 0.
    pub fn record(&self, frame: &mut Frame<'_>, stage: &'static str, begun_with: i32) {
        let Targets {
            mask_view,
            depth_view,
            width,
            height,
            ..
        } = frame.targets();
        frame.stage(stage, |stage| {
            let load = wgpu::LoadOp::Load;
            let mut pass = fullscreen::pass(
                stage.encoder(),
                "resolve",
                mask_view,
                load,
                Some(depth_view),
            );
            pass.set_pipeline(&self.pipeline);
            let far = self.far;
            pass.set_viewport(0.0, 0.0, *width as f32, *height as f32, far, far);
            // Counts wrap around, so they need not really begin there.
            pass.set_stencil_reference(begun_with.wrapping_neg() as u32 & 0xff);
            pass.draw(0..3, 0..1);
            drop(pass);
            stage.count_draws(1);
        });
    }
}
