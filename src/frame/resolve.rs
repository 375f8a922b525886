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
        let depth_stencil = where_something_is(gpu, depth, counted);
        let desc = FullscreenDesc {
            depth_stencil: Some(depth_stencil),
            ..FullscreenDesc::new(&module, "counted", &layout, MASK_FORMAT)
        };
        Self {
            pipeline: fullscreen::pipeline(device, &desc),
            far: depth.direction.far(),
        }
    }

    /// Sets all counts to 0.
    pub fn clear(&self, encoder: &mut wgpu::CommandEncoder, targets: &Targets) {
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("no counts"),
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &targets.depth_view,
                depth_ops: None,
                stencil_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(0),
                    store: wgpu::StoreOp::Store,
                }),
            }),
            ..Default::default()
        });
    }

    /// Records a stage, mostly [`RESOLVE_STAGE`]: adds to the mask the pixels with a count, where counting began with
    /// `begun_with` instead of 0 and `modulus` is 0 again: the stencil's own is 256.
    pub fn record(
        &self,
        frame: &mut Frame<'_>,
        stage: &'static str,
        begun_with: i32,
        modulus: u32,
    ) {
        let targets = frame.targets();
        frame.stage(stage, |stage| {
            let mut pass = add_to_mask(stage.encoder(), targets, &self.pipeline, self.far);
            // Counts wrap around, so they need not really begin there.
            let left = -i64::from(begun_with);
            pass.set_stencil_reference(left.rem_euclid(modulus.into()) as u32);
            pass.draw(0..3, 0..1);
            drop(pass);
            stage.count_draws(1);
        });
    }
}

/// Tests for a triangle at infinity: it is farther than every surface, and not farther than the background, where a count
/// means nothing.
pub(super) fn where_something_is(
    gpu: &Gpu,
    depth: DepthSetup,
    stencil: wgpu::StencilFaceState,
) -> wgpu::DepthStencilState {
    wgpu::DepthStencilState {
        format: depth.texture_format(gpu),
        depth_write_enabled: Some(false),
        depth_compare: Some(depth.direction.farther()),
        stencil: wgpu::StencilState {
            front: stencil,
            back: stencil,
            read_mask: 0xff,
            write_mask: 0,
        },
        bias: wgpu::DepthBiasState::default(),
    }
}

/// A pass over the picture, at infinity, that adds to the mask.
pub(super) fn add_to_mask<'a>(
    encoder: &'a mut wgpu::CommandEncoder,
    targets: &Targets,
    pipeline: &wgpu::RenderPipeline,
    far: f32,
) -> wgpu::RenderPass<'a> {
    let load = wgpu::LoadOp::Load;
    let depth = Some(&targets.depth_view);
    let mut pass = fullscreen::pass(encoder, "resolve", &targets.mask_view, load, depth);
    pass.set_pipeline(pipeline);
    let (width, height) = (targets.width as f32, targets.height as f32);
    pass.set_viewport(0.0, 0.0, width, height, far, far);
    pass
}
