//! Stencil counts to shadow mask, the last stage of every stencil method.

use super::fullscreen::{self, bind_group, bind_group_layout, texture_binding};
use super::targets::MASK_FORMAT;
use super::{Stage, Targets};
use crate::gpu::{FrameRecorder, Gpu, shader};

/// Name of this stage.
pub const RESOLVE_STAGE: &str = "resolve";

/// Pipelines of the resolve stage.
pub struct StencilResolve {
    counted: wgpu::RenderPipeline,
    uncounted: wgpu::RenderPipeline,
    inputs: wgpu::BindGroup,
}

impl StencilResolve {
    /// Builds the pipelines. The device must have a stencil buffer.
    pub fn new(gpu: &Gpu, stage: &Stage) -> Self {
        let device = &gpu.device;
        let module = shader::wgsl(device, "frame/resolve.wgsl");
        let inputs_layout = bind_group_layout(
            device,
            "resolve inputs",
            &[texture_binding(wgpu::TextureSampleType::Uint)],
        );
        let ids = wgpu::BindingResource::TextureView(&stage.targets.triangle_ids_view);
        let inputs = bind_group(device, &inputs_layout, &[ids]);
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("resolve"),
            bind_group_layouts: &[
                Some(&stage.uniform.layout),
                Some(&stage.scene.layout),
                Some(&inputs_layout),
            ],
            ..Default::default()
        });
        let pipeline = |fragment, compare| {
            let depth_stencil = depth_stencil(gpu.depth_format(), compare);
            let depth_stencil = Some(depth_stencil);
            fullscreen::pipeline(
                device,
                &module,
                fragment,
                &layout,
                MASK_FORMAT,
                depth_stencil,
            )
        };
        Self {
            counted: pipeline("counted", wgpu::CompareFunction::NotEqual),
            uncounted: pipeline("uncounted", wgpu::CompareFunction::Equal),
            inputs,
        }
    }

    /// Records the stage.
    pub fn record(&self, frame: &mut FrameRecorder<'_>, stage: &Stage) {
        let Targets {
            mask_view,
            depth_view,
            ..
        } = &stage.targets;
        frame.stage(RESOLVE_STAGE, |encoder| {
            let mut pass = fullscreen::pass(encoder, "resolve", mask_view, Some(depth_view));
            pass.set_bind_group(0, &stage.uniform.bind_group, &[]);
            pass.set_bind_group(1, &stage.scene.bind_group, &[]);
            pass.set_bind_group(2, &self.inputs, &[]);
            pass.set_stencil_reference(0);
            for pipeline in [&self.counted, &self.uncounted] {
                pass.set_pipeline(pipeline);
                pass.draw(0..3, 0..1);
            }
        });
    }
}

/// Passes where there is a surface and its count compares so with 0.
fn depth_stencil(
    format: wgpu::TextureFormat,
    count: wgpu::CompareFunction,
) -> wgpu::DepthStencilState {
    let face = wgpu::StencilFaceState {
        compare: count,
        ..wgpu::StencilFaceState::IGNORE
    };
    wgpu::DepthStencilState {
        format,
        depth_write_enabled: Some(false),
        // The triangle lies at depth 0: less than every surface, not less than the background, where
        // a count means nothing.
        depth_compare: Some(wgpu::CompareFunction::Less),
        stencil: wgpu::StencilState {
            front: face,
            back: face,
            read_mask: 0xff,
            write_mask: 0,
        },
        bias: wgpu::DepthBiasState::default(),
    }
}
