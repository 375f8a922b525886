//! Counts that blending adds up, where the stencil's eight bits are too few.

use super::fullscreen::{self, FullscreenDesc, bind_group, bind_group_layout, buffer_binding};
use super::pixel_buffers::{copy, row_px};
use super::resolve::{add_to_mask, where_something_is};
use super::targets::MASK_FORMAT;
use super::{Frame, FrameResources};
use crate::gpu::{DeviceError, Gpu, shader};

/// A count a pixel as a float, and the stage that brings it to the mask. Sums of whole numbers are exact as long as none on the
/// way is beyond 2048 with 16 bits, or 2²⁴ with 32.
pub struct BlendedCounts {
    counts: wgpu::Texture,
    view: wgpu::TextureView,
    /// A copy, which is read faster than the texture.
    copy: wgpu::Buffer,
    begun_with: wgpu::Buffer,
    bind_group: wgpu::BindGroup,
    resolve: wgpu::RenderPipeline,
    far: f32,
}

impl BlendedCounts {
    /// With 16 bits, or with 32 if the device can blend them.
    ///
    /// # Errors
    /// When the device cannot hold them.
    pub fn new(gpu: &Gpu, resources: &FrameResources, bits: u32) -> Result<Self, DeviceError> {
        let device = &gpu.device;
        let size = resources.targets.mask.size();
        let counts = gpu.texture(&wgpu::TextureDescriptor {
            label: Some("a picture of counts"),
            size,
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: if bits == 16 {
                wgpu::TextureFormat::R16Float
            } else {
                wgpu::TextureFormat::R32Float
            },
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        })?;
        let bytes = u64::from(bits / 8 * row_px(size.width) * size.height);
        let usage = wgpu::BufferUsages::COPY_DST;
        let storage = usage | wgpu::BufferUsages::STORAGE;
        let copy = gpu.empty_buffer("a copy of counts", bytes, storage)?;
        let uniform = usage | wgpu::BufferUsages::UNIFORM;
        let begun_with = gpu.empty_buffer("what counts begin with", 16, uniform)?;
        let types = [
            buffer_binding(wgpu::BufferBindingType::Storage { read_only: true }),
            buffer_binding(wgpu::BufferBindingType::Uniform),
        ];
        let stages = wgpu::ShaderStages::FRAGMENT;
        let group_layout = bind_group_layout(device, "counts", stages, &types);
        let bound = [copy.as_entire_binding(), begun_with.as_entire_binding()];
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("counts"),
            bind_group_layouts: &[Some(&group_layout)],
            ..Default::default()
        });
        let module = shader::wgsl(device, "frame/resolve_blended.wgsl");
        let depth_stencil =
            where_something_is(gpu, resources.depth, wgpu::StencilFaceState::IGNORE);
        let desc = FullscreenDesc {
            constants: &[
                ("row_px", f64::from(row_px(size.width))),
                ("bits", f64::from(bits)),
            ],
            depth_stencil: Some(depth_stencil),
            ..FullscreenDesc::new(&module, "counted", &layout, MASK_FORMAT)
        };
        Ok(Self {
            view: counts.create_view(&wgpu::TextureViewDescriptor::default()),
            bind_group: bind_group(device, &group_layout, &bound),
            resolve: fullscreen::pipeline(device, &desc),
            far: resources.depth.direction.far(),
            counts,
            copy,
            begun_with,
        })
    }

    /// Them.
    pub fn texture(&self) -> &wgpu::Texture {
        &self.counts
    }

    /// What a pipeline adds to them.
    pub fn target(&self) -> wgpu::ColorTargetState {
        let add = wgpu::BlendComponent {
            src_factor: wgpu::BlendFactor::One,
            dst_factor: wgpu::BlendFactor::One,
            operation: wgpu::BlendOperation::Add,
        };
        wgpu::ColorTargetState {
            blend: Some(wgpu::BlendState {
                color: add,
                alpha: add,
            }),
            ..self.counts.format().into()
        }
    }

    /// Them in a pass that goes on counting.
    pub fn attachment(&self) -> wgpu::RenderPassColorAttachment<'_> {
        self.attached(wgpu::LoadOp::Load)
    }

    fn attached(&self, load: wgpu::LoadOp<wgpu::Color>) -> wgpu::RenderPassColorAttachment<'_> {
        wgpu::RenderPassColorAttachment {
            view: &self.view,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations {
                load,
                store: wgpu::StoreOp::Store,
            },
        }
    }

    /// Sets all to 0.
    pub fn clear(&self, encoder: &mut wgpu::CommandEncoder) {
        let zero = self.attached(wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT));
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("no counts"),
            color_attachments: &[Some(zero)],
            ..Default::default()
        });
    }

    /// Records a stage that adds to the mask the pixels with a count, where counting began with `begun_with` instead of 0.
    ///
    /// # Errors
    /// When the device is lost.
    pub fn record(
        &self,
        frame: &mut Frame<'_>,
        stage: &'static str,
        begun_with: i32,
    ) -> anyhow::Result<()> {
        let targets = frame.targets();
        frame.stage(stage, |stage| {
            let word = [begun_with as f32, 0.0, 0.0, 0.0];
            stage.upload(&self.begun_with, 0, bytemuck::bytes_of(&word))?;
            let encoder = stage.encoder();
            let bytes_per_px = self.counts.format().block_copy_size(None).unwrap_or(4);
            copy(encoder, &self.counts, &self.copy, bytes_per_px);
            let mut pass = add_to_mask(encoder, targets, &self.resolve, self.far);
            pass.set_bind_group(0, &self.bind_group, &[]);
            pass.draw(0..3, 0..1);
            drop(pass);
            stage.count_draws(1);
            Ok(())
        })
    }
}
