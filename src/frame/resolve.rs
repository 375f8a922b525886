//! Stencil counts to shadow mask, the last stage of every stencil method.

use super::{Targets, fullscreen};
use super::targets::MASK_FORMAT;
use crate::gpu::{FrameRecorder, Gpu, shader};

/// Name of this stage.
pub const RESOLVE_STAGE: &str = "resolve";

/// Pipeline of the resolve stage.
pub struct StencilResolve {
    pipeline: wgpu::RenderPipeline,
}

impl StencilResolve {
    /// Builds the pipeline. The device must have a stencil buffer.
    pub fn new(gpu: &Gpu) -> Self {
        let module = shader::wgsl(&gpu.device, "frame/resolve.wgsl");
        let not_zero = wgpu::StencilFaceState {
            compare: wgpu::CompareFunction::NotEqual,
            ..wgpu::StencilFaceState::IGNORE
        };
        let depth_stencil = wgpu::DepthStencilState {
            format: gpu.depth_format(),
            depth_write_enabled: Some(false),
            // The triangle lies at depth 0: less than every surface, not less than the background,
            // where a count means nothing.
            depth_compare: Some(wgpu::CompareFunction::Less),
            stencil: wgpu::StencilState {
                front: not_zero,
                back: not_zero,
                read_mask: 0xff,
                write_mask: 0,
            },
            bias: wgpu::DepthBiasState::default(),
        };
        let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor::default());
        let pipeline = fullscreen::pipeline(
            &gpu.device,
            &module,
            "shadowed",
            &layout,
            MASK_FORMAT,
            Some(depth_stencil),
        );
        Self { pipeline }
    }

    /// Records the stage.
    pub fn record(&self, frame: &mut FrameRecorder<'_>, targets: &Targets) {
        frame.stage(RESOLVE_STAGE, |encoder| {
            let depth = Some(&targets.depth_view);
            let mut pass = fullscreen::pass(encoder, "resolve", &targets.mask_view, depth);
            pass.set_pipeline(&self.pipeline);
            pass.set_stencil_reference(0);
            pass.draw(0..3, 0..1);
        });
    }
}
