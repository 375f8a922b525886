//! Recording native draws.

use super::bindings::{Bindings, DRAW_CONSTANTS_BYTES};
use super::geometry::{IndexedGeometry, IndirectDraws};
use super::pipeline::Pipeline;
use super::target::Target;
use ash::vk;
use std::ops::Range;
use wgpu::hal::api::Vulkan;

/// A native render pass under way, over one target with one set of bindings.
pub struct NativePass<'a> {
    raw: ash::Device,
    commands: vk::CommandBuffer,
    draw_calls: u32,
    bound: &'a Bindings,
    /// Of the pipeline that is set.
    meshes: Option<ash::ext::mesh_shader::Device>,
}

impl NativePass<'_> {
    /// Records a whole pass into a command buffer of its own, to be submitted between wgpu's; gives
    /// also the number of its draw calls.
    ///
    /// `target`'s textures must be in wgpu's states `DEPTH_STENCIL_WRITE` and `COLOR_TARGET` when it runs, which
    /// [`crate::gpu::Stage::native`] takes care of. On a device that is lost or has no memory
    /// for commands nothing is recorded; [`crate::gpu::Gpu::attempt`] says so.
    pub fn record(
        device: &wgpu::Device,
        target: &Target,
        bindings: &Bindings,
        draw: impl FnOnce(&mut NativePass<'_>),
    ) -> (wgpu::CommandBuffer, u32) {
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor {
            label: Some("native"),
        });
        let mut draw_calls = 0;
        let Ok(raw) = super::raw_device(device) else {
            return (encoder.finish(), draw_calls);
        };
        // SAFETY: only native commands go into this encoder, and the pass is ended again. Target,
        // bindings and pipelines wait for the device before they destroy anything, so all handles
        // stay valid until the commands have run.
        unsafe {
            encoder.as_hal_mut::<Vulkan, _, _>(|hal| {
                let Some(hal) = hal else { return };
                let commands = hal.raw_handle();
                wait_for_all(&raw, commands);
                let begin = vk::RenderPassBeginInfo::default()
                    .render_pass(target.render_pass)
                    .framebuffer(target.framebuffer)
                    .render_area(vk::Rect2D {
                        offset: vk::Offset2D::default(),
                        extent: target.extent,
                    });
                raw.cmd_begin_render_pass(commands, &begin, vk::SubpassContents::INLINE);
                raw.cmd_bind_descriptor_sets(
                    commands,
                    vk::PipelineBindPoint::GRAPHICS,
                    bindings.layout,
                    0,
                    &[bindings.set],
                    &[],
                );
                let mut pass = NativePass {
                    raw,
                    commands,
                    draw_calls: 0,
                    bound: bindings,
                    meshes: None,
                };
                draw(&mut pass);
                pass.raw.cmd_end_render_pass(commands);
                draw_calls = pass.draw_calls;
                wait_for_all(&pass.raw, commands);
            });
        }
        (encoder.finish(), draw_calls)
    }

    /// Draws with `pipeline` from now on.
    pub fn set_pipeline(&mut self, pipeline: &Pipeline) {
        self.meshes.clone_from(&pipeline.meshes);
        // SAFETY: the pass is under way, and the pipeline waits for the device before it goes.
        unsafe {
            self.raw.cmd_bind_pipeline(
                self.commands,
                vk::PipelineBindPoint::GRAPHICS,
                pipeline.handle,
            );
        }
    }

    /// The `push_constant` block that all stages of the next draws see.
    pub fn set_constants(&mut self, constants: [u32; 4]) {
        self.push(0, &constants);
    }

    /// What fragment shaders that count in the stencil count to: so many are 0 again.
    pub fn set_modulus(&mut self, modulus: u32) {
        self.push(DRAW_CONSTANTS_BYTES, &[modulus]);
    }

    fn push(&mut self, offset: u32, constants: &[u32]) {
        // SAFETY: the pass is under way, and the layout of its bindings has room for what is set here.
        unsafe {
            self.raw.cmd_push_constants(
                self.commands,
                self.bound.layout,
                vk::ShaderStageFlags::ALL,
                offset,
                bytemuck::cast_slice(constants),
            );
        }
    }

    /// Takes the vertices of [`Self::draw_indexed`] from `geometry` from now on.
    pub fn set_geometry(&mut self, geometry: &IndexedGeometry) {
        // SAFETY: the pass is under way, and the geometry waits for the device before it goes.
        unsafe {
            self.raw
                .cmd_bind_vertex_buffers(self.commands, 0, &[geometry.vertices], &[0]);
            self.raw.cmd_bind_index_buffer(
                self.commands,
                geometry.indices,
                0,
                vk::IndexType::UINT32,
            );
        }
    }

    /// One draw call over a part of the element buffer.
    pub fn draw_indexed(&mut self, indices: Range<u32>) {
        if indices.is_empty() {
            return;
        }
        self.draw_calls += 1;
        // SAFETY: the pass is under way with a pipeline, its bindings and buffers bound.
        unsafe {
            self.raw.cmd_draw_indexed(
                self.commands,
                indices.end - indices.start,
                1,
                indices.start,
                0,
                0,
            );
        };
    }

    /// One draw call; `gl_VertexIndex` runs over `vertices`.
    pub fn draw(&mut self, vertices: Range<u32>) {
        if vertices.is_empty() {
            return;
        }
        self.draw_calls += 1;
        // SAFETY: the pass is under way with a pipeline and its bindings bound.
        unsafe {
            self.raw.cmd_draw(
                self.commands,
                vertices.end - vertices.start,
                1,
                vertices.start,
                0,
            );
        };
    }

    /// The most workgroups of a draw call that every device takes.
    pub const MOST_WORKGROUPS: u32 = 65_535;

    /// One draw call of so many workgroups of the first stage, with a pipeline of [`PrimitiveTopology::Meshes`].
    ///
    /// [`PrimitiveTopology::Meshes`]: super::PrimitiveTopology::Meshes
    pub fn draw_meshes(&mut self, workgroups: u32) {
        assert!(workgroups <= Self::MOST_WORKGROUPS);
        let Some(meshes) = &self.meshes else {
            panic!("the pipeline has no mesh shader")
        };
        self.draw_calls += 1;
        // SAFETY: the pass is under way with a pipeline that has mesh shaders, and its bindings bound.
        unsafe { meshes.cmd_draw_mesh_tasks(self.commands, workgroups, 1, 1) };
    }

    /// One draw call whose numbers are on the device, see [`IndirectDraws`].
    pub fn draw_indirect(&mut self, draws: &IndirectDraws, number: u32) {
        assert!(number < draws.count, "draw {number} of {}", draws.count);
        self.draw_calls += 1;
        let offset = u64::from(number) * draws.stride;
        // SAFETY: the pass is under way with a pipeline and its bindings bound, and the numbers lie in the buffer,
        // which waits for the device before it goes.
        unsafe {
            self.raw
                .cmd_draw_indirect(self.commands, draws.buffer, offset, 1, 0);
        }
    }

    /// The same over the element buffer; the draws are [indexed](IndirectDraws::indexed) ones.
    pub fn draw_indexed_indirect(&mut self, draws: &IndirectDraws, number: u32) {
        assert!(number < draws.count, "draw {number} of {}", draws.count);
        assert_eq!(draws.stride, IndirectDraws::INDEXED_STRIDE);
        self.draw_calls += 1;
        let offset = u64::from(number) * draws.stride;
        // SAFETY: the pass is under way with a pipeline, its bindings and an element buffer bound, and the numbers lie in
        // the buffer, which waits for the device before it goes.
        unsafe {
            self.raw
                .cmd_draw_indexed_indirect(self.commands, draws.buffer, offset, 1, 0);
        }
    }
}

/// wgpu does not see what native draws read and write, so it places no barrier between them and its own commands:
/// neither for what copies, compute passes and draws before have written for them, nor for commands after that
/// write over what they still read.
///
/// # Safety
/// `commands` must be recording, outside of a render pass.
unsafe fn wait_for_all(raw: &ash::Device, commands: vk::CommandBuffer) {
    let barrier = vk::MemoryBarrier::default()
        .src_access_mask(vk::AccessFlags::MEMORY_WRITE)
        .dst_access_mask(vk::AccessFlags::MEMORY_READ | vk::AccessFlags::MEMORY_WRITE);
    // SAFETY: the caller vouches for `commands`.
    unsafe {
        raw.cmd_pipeline_barrier(
            commands,
            vk::PipelineStageFlags::ALL_COMMANDS,
            vk::PipelineStageFlags::ALL_COMMANDS,
            vk::DependencyFlags::empty(),
            &[barrier],
            &[],
            &[],
        );
    }
}
