//! A scene's triangles in device memory.

use super::fullscreen::{bind_group, bind_group_layout};
use super::numbered::NumberedVertices;
use crate::gpu::native::VertexInput;
use crate::gpu::{DeviceError, Gpu};
use crate::scene::Mesh;
use glam::Vec4;
use std::ops::Range;

/// Vertex and element buffers of all objects, and which part belongs to which.
pub struct SceneBuffers {
    /// `vec4` a vertex: xyz, 1; and one more with zeros, for what has no vertex. Usable as vertex and as storage buffer.
    pub positions: wgpu::Buffer,
    /// Three `u32` a triangle. Usable as index and as storage buffer.
    pub indices: wgpu::Buffer,
    /// For the picture of triangle numbers.
    pub(super) numbered: NumberedVertices,
    /// Layout of `bind_group`.
    pub layout: wgpu::BindGroupLayout,
    /// Positions and indices as storage buffers, for shaders that fetch vertices or look up a triangle.
    pub bind_group: wgpu::BindGroup,
    /// Triangles of each object, in drawing order.
    pub objects: Vec<Range<u32>>,
    /// Triangles of each object that casts a shadow.
    pub casters: Vec<Range<u32>>,
}

/// Three indices.
const TRIANGLE_BYTES: u64 = 12;

fn indices_name(triangles: u64) -> String {
    format!("the indices of {triangles} triangles")
}

impl SceneBuffers {
    /// Bytes from one vertex to the next: xyz and a 1, so that storage buffers can read `vec4`.
    pub const VERTEX_STRIDE: u64 = 16;

    /// The positions as native pipelines take them.
    pub const NATIVE_INPUT: VertexInput = VertexInput::Positions {
        stride: Self::VERTEX_STRIDE as u32,
    };

    /// Uploads `mesh`.
    ///
    /// # Errors
    /// When it is larger than the device can hold, or bind for shaders.
    pub fn new(gpu: &Gpu, mesh: &Mesh) -> Result<Self, DeviceError> {
        let vertices = mesh.positions.len() as u64;
        let triangles = mesh.triangles.len() as u64;
        let vertices_name = format!("the positions of {vertices} vertices");
        // Both are looked at before anything is copied.
        let storage = wgpu::BufferUsages::STORAGE;
        Self::check(gpu, triangles)?;
        gpu.check_buffer(
            &vertices_name,
            Self::VERTEX_STRIDE * (vertices + 1),
            storage,
        )?;
        let positions = mesh.positions.iter().map(|p| p.extend(1.0));
        let positions: Vec<_> = positions.chain([Vec4::ZERO]).collect();
        let positions = gpu.buffer(
            &vertices_name,
            bytemuck::cast_slice(&positions),
            storage | wgpu::BufferUsages::VERTEX,
        )?;
        let indices = gpu.buffer(
            &indices_name(triangles),
            bytemuck::cast_slice(&mesh.triangles),
            storage | wgpu::BufferUsages::INDEX,
        )?;
        let read_only = wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Storage { read_only: true },
            has_dynamic_offset: false,
            min_binding_size: None,
        };
        let stages = wgpu::ShaderStages::VERTEX_FRAGMENT;
        let layout = bind_group_layout(&gpu.device, "geometry", stages, &[read_only; 2]);
        let resources = [positions.as_entire_binding(), indices.as_entire_binding()];
        let bind_group = bind_group(&gpu.device, &layout, &resources);
        Ok(Self {
            numbered: NumberedVertices::new(gpu, mesh)?,
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
        })
    }

    /// Whether the device can take so many triangles, for meshes that are not there yet.
    ///
    /// # Errors
    /// When it cannot.
    pub fn check(gpu: &Gpu, triangles: u64) -> Result<(), DeviceError> {
        let bytes = TRIANGLE_BYTES.saturating_mul(triangles);
        gpu.check_buffer(&indices_name(triangles), bytes, wgpu::BufferUsages::STORAGE)
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

    /// Draws `objects`, one call each. Gives the number of draw calls.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>, objects: &[Range<u32>]) -> u32 {
        pass.set_vertex_buffer(0, self.positions.slice(..));
        pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint32);
        let mut draw_calls = 0;
        for triangles in objects.iter().filter(|triangles| !triangles.is_empty()) {
            draw_calls += 1;
            pass.draw_indexed(3 * triangles.start..3 * triangles.end, 0, 0..1);
        }
        draw_calls
    }
}
