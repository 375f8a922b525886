//! A scene's triangles in device memory.

use super::fullscreen::{bind_group, bind_group_layout};
use crate::gpu::Gpu;
use crate::scene::Mesh;
use std::ops::Range;
use wgpu::util::DeviceExt;

/// Vertex and element buffers of all objects, and which part belongs to which.
pub struct SceneBuffers {
    /// `vec4` a vertex: xyz, 1. Usable as vertex and as storage buffer.
    pub positions: wgpu::Buffer,
    /// Three `u32` a triangle. Usable as index and as storage buffer.
    pub indices: wgpu::Buffer,
    /// Layout of `bind_group`.
    pub layout: wgpu::BindGroupLayout,
    /// Positions and indices as storage buffers, for fragments that look up their triangle.
    pub bind_group: wgpu::BindGroup,
    /// Triangles of each object, in drawing order.
    pub objects: Vec<Range<u32>>,
    /// Triangles of each object that casts a shadow.
    pub casters: Vec<Range<u32>>,
}

impl SceneBuffers {
    /// Bytes from one vertex to the next: xyz and a 1, so that storage buffers can read `vec4`.
    pub const VERTEX_STRIDE: u64 = 16;

    /// Uploads `mesh`.
    pub fn new(gpu: &Gpu, mesh: &Mesh) -> Self {
        let positions: Vec<_> = mesh.positions.iter().map(|p| p.extend(1.0)).collect();
        let buffer = |label, contents: &[u8], usage| {
            gpu.device
                .create_buffer_init(&wgpu::util::BufferInitDescriptor {
                    label: Some(label),
                    contents,
                    usage: usage | wgpu::BufferUsages::STORAGE,
                })
        };
        let positions = buffer(
            "positions",
            bytemuck::cast_slice(&positions),
            wgpu::BufferUsages::VERTEX,
        );
        let indices = buffer(
            "indices",
            bytemuck::cast_slice(&mesh.triangles),
            wgpu::BufferUsages::INDEX,
        );
        let read_only = wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Storage { read_only: true },
            has_dynamic_offset: false,
            min_binding_size: None,
        };
        let layout = bind_group_layout(&gpu.device, "geometry", &[read_only; 2]);
        let resources = [positions.as_entire_binding(), indices.as_entire_binding()];
        let bind_group = bind_group(&gpu.device, &layout, &resources);
        Self {
            positions,
            indices,
            layout,
            bind_group,
            objects: mesh
                .objects
                .iter()
                .map(|object| object.triangles.clone())
                .collect(),
            casters: mesh
                .casters()
                .map(|object| object.triangles.clone())
                .collect(),
        }
    }

    /// Layout of the positions as a vertex buffer, at shader location 0.
    pub fn vertex_layout() -> wgpu::VertexBufferLayout<'static> {
        wgpu::VertexBufferLayout {
            array_stride: Self::VERTEX_STRIDE,
            step_mode: wgpu::VertexStepMode::Vertex,
            attributes: &[wgpu::VertexAttribute {
                format: wgpu::VertexFormat::Float32x3,
                offset: 0,
                shader_location: 0,
            }],
        }
    }

    /// Draws `objects`, one call each; the instance number is the object's first triangle. Gives the
    /// number of draw calls.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>, objects: &[Range<u32>]) -> u32 {
        pass.set_vertex_buffer(0, self.positions.slice(..));
        pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint32);
        let mut draw_calls = 0;
        for triangles in objects.iter().filter(|triangles| !triangles.is_empty()) {
            draw_calls += 1;
            let first = triangles.start;
            pass.draw_indexed(3 * first..3 * triangles.end, 0, first..first + 1);
        }
        draw_calls
    }
}
