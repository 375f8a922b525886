//! View and light, as every stage of a frame sees them.

use super::DepthSetup;
use super::view::{FrameView, SceneExtents};
use crate::geometry::EndPlane;
use crate::gpu::Gpu;
use crate::scene::{Moment, View};
use bytemuck::{Pod, Zeroable};
use glam::{DMat4, Mat4, Vec3, Vec4};

/// Twin of `Frame` in `shaders/shared/frame.wgsl` and `frame.glsl`; see there.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct FrameData {
    view_projection: Mat4,
    clip_to_eye_ray: Mat4,
    light: Vec4,
    eye: Vec4,
    picture: Vec4,
    end_planes: [Vec4; EndPlane::COUNT],
}

/// The uniform buffer of a frame, bound as group 0 in wgpu's passes.
pub struct FrameUniform {
    /// The buffer itself, for native bindings.
    pub buffer: wgpu::Buffer,
    /// Layout of the bind group.
    pub layout: wgpu::BindGroupLayout,
    /// The bind group.
    pub bind_group: wgpu::BindGroup,
}

impl FrameUniform {
    /// An empty uniform.
    pub fn new(gpu: &Gpu) -> Self {
        let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("frame"),
            size: size_of::<FrameData>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let layout = gpu
            .device
            .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
                label: Some("frame"),
                entries: &[wgpu::BindGroupLayoutEntry {
                    binding: 0,
                    visibility: wgpu::ShaderStages::VERTEX_FRAGMENT | wgpu::ShaderStages::COMPUTE,
                    ty: wgpu::BindingType::Buffer {
                        ty: wgpu::BufferBindingType::Uniform,
                        has_dynamic_offset: false,
                        min_binding_size: None,
                    },
                    count: None,
                }],
            });
        let bind_group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("frame"),
            layout: &layout,
            entries: &[wgpu::BindGroupEntry {
                binding: 0,
                resource: buffer.as_entire_binding(),
            }],
        });
        Self {
            buffer,
            layout,
            bind_group,
        }
    }

    /// Writes view, light and picture size for what is submitted from now on, and returns what the
    /// processor needs to know of it.
    pub(super) fn write(
        &self,
        gpu: &Gpu,
        moment: &Moment,
        extents: &SceneExtents,
        size_px: (u32, u32),
        depth: DepthSetup,
    ) -> FrameView {
        let (width, height) = (size_px.0 as f32, size_px.1 as f32);
        let Moment { view, light } = moment;
        let view = &depth.near_plane_of(view);
        let reversed = view.view_projection(width / height);
        let clip_to_eye_ray = clip_to_eye_ray(reversed, view);
        let frame_view = FrameView::new(view, reversed, clip_to_eye_ray, *light, extents);
        let data = FrameData {
            view_projection: depth.device_projection(reversed),
            clip_to_eye_ray,
            light: light.place,
            eye: view.eye.extend(1.0),
            picture: Vec4::new(width, height, view.near, depth.direction.far()),
            end_planes: frame_view.end_planes.coefficients(),
        };
        gpu.queue
            .write_buffer(&self.buffer, 0, bytemuck::bytes_of(&data));
        frame_view
    }
}

/// Maps normalised x and y (with z = 0, w = 1) to the ray from the eye whose length along the
/// viewing direction is 1. With reversed infinite depth, w = near / depth is that length for the
/// surface, so the surface is at `eye + ray * near / depth`. The matrix is the one for reversed depth.
fn clip_to_eye_ray(view_projection: Mat4, view: &View) -> Mat4 {
    // About the eye: the columns of the product with a translation by the eye.
    let about_eye = view_projection.as_dmat4() * DMat4::from_translation(view.eye.as_dvec3());
    // clip = M (ray, 1) with rows x, y, w of M linear in the ray; the z row is (0, 0, 0, near).
    let rows = [about_eye.row(0), about_eye.row(1), about_eye.row(3)].map(|row| row.truncate());
    let inverse = glam::DMat3::from_cols(rows[0], rows[1], rows[2])
        .transpose()
        .inverse();
    let column = |i: usize| inverse.col(i).as_vec3().extend(0.0);
    Mat4::from_cols(column(0), column(1), Vec3::ZERO.extend(0.0), column(2))
}
