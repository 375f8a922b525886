//! Structures of the device that rays are traced through.

use super::{DeviceError, Gpu};

/// Bytes from one corner of a triangle to the next.
const CORNER_BYTES: u64 = 16;

/// Bytes of a box: smallest and largest x, y, z.
const BOX_BYTES: u64 = 24;

/// Builds one over so many triangles, one at least: three corners each of x, y, z and a number that is not used. The buffer
/// has `BLAS_INPUT`.
///
/// # Errors
/// When the device cannot hold it.
pub fn of_triangles(
    gpu: &Gpu,
    corners: &wgpu::Buffer,
    count: u32,
) -> Result<wgpu::Tlas, DeviceError> {
    let size = wgpu::BlasTriangleGeometrySizeDescriptor {
        vertex_format: wgpu::VertexFormat::Float32x3,
        vertex_count: 3 * count,
        index_format: None,
        index_count: None,
        flags: wgpu::AccelerationStructureGeometryFlags::empty(),
    };
    let sizes = wgpu::BlasGeometrySizeDescriptors::Triangles {
        descriptors: vec![size.clone()],
    };
    let geometry = wgpu::BlasTriangleGeometry {
        size: &size,
        vertex_buffer: corners,
        first_vertex: 0,
        vertex_stride: CORNER_BYTES,
        index_buffer: None,
        first_index: None,
        transform_buffer: None,
        transform_buffer_offset: None,
    };
    let geometry = wgpu::BlasGeometries::TriangleGeometries(vec![geometry]);
    // wgpu holds the corners of triangles against the limit.
    build(gpu, 3 * u64::from(count), sizes, geometry)
}

/// Builds one over so many boxes, one at least: six numbers each. The buffer has `BLAS_INPUT`.
///
/// # Errors
/// When the device cannot hold it.
pub fn of_boxes(gpu: &Gpu, boxes: &wgpu::Buffer, count: u32) -> Result<wgpu::Tlas, DeviceError> {
    let size = wgpu::BlasAABBGeometrySizeDescriptor {
        primitive_count: count,
        flags: wgpu::AccelerationStructureGeometryFlags::empty(),
    };
    let sizes = wgpu::BlasGeometrySizeDescriptors::AABBs {
        descriptors: vec![size.clone()],
    };
    let geometry = wgpu::BlasAabbGeometry {
        size: &size,
        stride: BOX_BYTES,
        aabb_buffer: boxes,
        primitive_offset: 0,
    };
    let geometry = wgpu::BlasGeometries::AabbGeometries(vec![geometry]);
    build(gpu, u64::from(count), sizes, geometry)
}

/// Builds it, and waits until it is there.
fn build(
    gpu: &Gpu,
    elements: u64,
    sizes: wgpu::BlasGeometrySizeDescriptors,
    geometry: wgpu::BlasGeometries<'_>,
) -> Result<wgpu::Tlas, DeviceError> {
    const AS_IT_IS: [f32; 12] = [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    let most = gpu.device.limits().max_blas_primitive_count;
    if elements > u64::from(most) {
        return Err(DeviceError::TooLarge(format!(
            "{elements} corners or boxes are more than the {most} that this device traces rays through"
        )));
    }
    let flags = wgpu::AccelerationStructureFlags::PREFER_FAST_TRACE;
    let update_mode = wgpu::AccelerationStructureUpdateMode::Build;
    gpu.attempt(|| {
        let of_triangles = wgpu::CreateBlasDescriptor {
            label: Some("triangles"),
            flags,
            update_mode,
        };
        let blas = gpu.device.create_blas(&of_triangles, sizes);
        let mut tlas = gpu.device.create_tlas(&wgpu::CreateTlasDescriptor {
            label: Some("scene"),
            max_instances: 1,
            flags,
            update_mode,
        });
        if let Some(instance) = tlas.get_mut_single(0) {
            *instance = Some(wgpu::TlasInstance::new(&blas, AS_IT_IS, 0, 0xff));
        }
        let entry = wgpu::BlasBuildEntry {
            blas: &blas,
            geometry,
        };
        let nothing = wgpu::CommandEncoderDescriptor::default();
        let mut encoder = gpu.device.create_command_encoder(&nothing);
        encoder.build_acceleration_structures([&entry], [&tlas]);
        gpu.queue.submit([encoder.finish()]);
        gpu.wait_idle();
        Ok(tlas)
    })
}
