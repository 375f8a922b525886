//! Stencil counts to shadow mask, the last stage of every stencil method.

use super::targets::MASK_FORMAT;
use super::{Targets, fullscreen};
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
        let device = &gpu.device;
        let module = shader::wgsl(device, "frame/resolve.wgsl");
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor::default());
        let counted = wgpu::StencilFaceState {
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
                front: counted,
                back: counted,
                read_mask: 0xff,
                write_mask: 0,
            },
            bias: wgpu::DepthBiasState::default(),
        };
        let depth_stencil = Some(depth_stencil);
        Self {
            pipeline: fullscreen::pipeline(
                device,
                &module,
                "counted",
                &layout,
                MASK_FORMAT,
                depth_stencil,
            ),
        }
    }

    /// Records the stage: adds the counted pixels to the mask.
    pub fn record(&self, frame: &mut FrameRecorder<'_>, targets: &Targets) {
        let Targets {
            mask_view,
            depth_view,
            ..
        } = targets;
        frame.stage(RESOLVE_STAGE, |encoder| {
            let load = wgpu::LoadOp::Load;
            let mut pass = fullscreen::pass(encoder, "resolve", mask_view, load, Some(depth_view));
            pass.set_pipeline(&self.pipeline);
            pass.set_stencil_reference(0);
            pass.draw(0..3, 0..1);
            1
        });
    }
}
