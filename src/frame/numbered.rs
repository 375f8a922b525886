//! Vertices that say which triangle they belong to, most of them shared.

use crate::gpu::{DeviceError, Gpu};
use crate::scene::Mesh;
use std::ops::Range;

/// Vertices by which a picture of triangle numbers is drawn. A flat value of a triangle is that of its first vertex, so each
/// triangle has one of its own there, numbered as the triangle; its other vertices are those that neighbours have at
/// the same places. Corners keep their order, so that depth keeps its bits.
///
/// Asking for the number in the fragment shader takes longer, and few devices outside of Vulkan can; three vertices for
/// each triangle take three times the work.
pub(super) struct NumberedVertices {
    pub(super) vertices: wgpu::Buffer,
    pub(super) elements: wgpu::Buffer,
}

impl NumberedVertices {
    pub(super) fn new(gpu: &Gpu, mesh: &Mesh) -> Result<Self, DeviceError> {
        let (vertices, elements) = number(mesh);
        let count = mesh.triangles.len();
        let buffer = |what: &str, contents: &[u8], usage| {
            gpu.buffer(
                &format!("the {what} of {count} numbered triangles"),
                contents,
                usage,
            )
        };
        Ok(Self {
            vertices: buffer(
                "vertices",
                bytemuck::cast_slice(&vertices),
                wgpu::BufferUsages::VERTEX,
            )?,
            elements: buffer(
                "elements",
                bytemuck::cast_slice(&elements),
                wgpu::BufferUsages::INDEX,
            )?,
        })
    }

    /// The layout of a vertex, the number of one of the scene, at shader location 0.
    pub(super) fn layout() -> wgpu::VertexBufferLayout<'static> {
        wgpu::VertexBufferLayout {
            array_stride: size_of::<u32>() as u64,
            step_mode: wgpu::VertexStepMode::Vertex,
            attributes: &wgpu::vertex_attr_array![0 => Uint32],
        }
    }

    /// Draws these objects, a call each. Gives the number of draw calls.
    pub(super) fn draw<'a>(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        objects: impl Iterator<Item = &'a Range<u32>>,
    ) -> u32 {
        pass.set_vertex_buffer(0, self.vertices.slice(..));
        pass.set_index_buffer(self.elements.slice(..), wgpu::IndexFormat::Uint32);
        let mut draw_calls = 0;
        for triangles in objects.filter(|object| !object.is_empty()) {
            draw_calls += 1;
            pass.draw_indexed(3 * triangles.start..3 * triangles.end, 0, 0..1);
        }
        draw_calls
    }
}

/// The vertex of the scene at each numbered vertex, first those of the triangles, and the elements of all triangles.
fn number(mesh: &Mesh) -> (Vec<u32>, Vec<[u32; 3]>) {
    const NONE: u32 = u32::MAX;
    let mut vertices: Vec<_> = mesh.triangles.iter().map(|t| t[0]).collect();
    // Of each vertex of the scene the numbered vertex that was made last, or is made first, of those there.
    let mut nearest = vec![NONE; mesh.positions.len()];
    for (triangle, corners) in mesh.triangles.iter().enumerate().rev() {
        nearest[corners[0] as usize] = triangle as u32;
    }
    let mut elements = Vec::with_capacity(mesh.triangles.len());
    for (triangle, &[a, b, c]) in mesh.triangles.iter().enumerate() {
        nearest[a as usize] = triangle as u32;
        let mut at = |corner: u32| {
            let known = &mut nearest[corner as usize];
            if *known == NONE {
                *known = vertices.len() as u32;
                vertices.push(corner);
            }
            *known
        };
        elements.push([triangle as u32, at(b), at(c)]);
    }
    (vertices, elements)
}
