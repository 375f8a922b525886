//! The G-buffer names the triangle that each pixel shows.
#![allow(clippy::unwrap_used, reason = "tests")]

use crate::common::device;
use svbench::frame::FrameResources;
use svbench::gpu::{Capability, FrameRecorder, Gpu, GpuOptions, readback};
use svbench::reference::{Reference, ReferenceView};
use svbench::scene::{Moment, Scene, SphereGrid};
use svbench::stress::random;

const SIZE_PX: (u32, u32) = (160, 120);

/// The numbers of the first view's pixels by the device and by rays.
fn ids(gpu: &Gpu, scene: &Scene, moment: &Moment) -> (Vec<u32>, Vec<u32>) {
    let stage = FrameResources::new(gpu, scene, SIZE_PX.0, SIZE_PX.1).unwrap();
    let frame_view = stage.set_view(gpu, moment);
    let mut frame = FrameRecorder::untimed(gpu);
    stage.record_gbuffer(&mut frame).unwrap();
    frame.submit();
    let bytes = readback::read_texture(gpu, &stage.targets.triangle_ids).unwrap();
    let view = ReferenceView {
        width: SIZE_PX.0,
        height: SIZE_PX.1,
        view_projection: frame_view.view_projection,
    };
    let mesh = &scene.mesh;
    let reference = Reference::new(&mesh.positions, &mesh.triangles, |_| true).unwrap();
    let by_rays = reference.visible_ids(&view).unwrap();
    (bytemuck::pod_collect_to_vec(&bytes), by_rays)
}

/// Few pixels have a centre on an edge, or surfaces at equal depth, where either may be shown. Gives how many
/// pixels show something.
fn assert_alike(gpu: &Gpu, scene: &Scene, moment: &Moment) -> usize {
    let (drawn, by_rays) = ids(gpu, scene, moment);
    let differing = drawn.iter().zip(&by_rays).filter(|(a, b)| a != b).count();
    assert!(
        differing * 200 < drawn.len(),
        "{}: {differing} differ",
        scene.name
    );
    drawn.iter().filter(|id| **id > 0).count()
}

#[test]
fn pixels_name_the_triangles_that_rays_meet() {
    let gpu = device();
    let grid = SphereGrid {
        rows: 10,
        columns: 10,
        slices: 8,
        shells: 1,
    };
    let (mesh, view) = (grid.mesh().unwrap(), crate::common::view());
    let light = glam::Vec4::new(3.0, 20.0, 5.0, 1.0);
    let template = crate::common::scene_over_ground(&[], 0.0, light, &view);
    let scene = Scene::new("grid".to_owned(), String::new(), mesh, template.flight);
    let of_grid_px = assert_alike(&gpu, &scene, &scene.flight.at(0.0));
    let soups = (0..20).map(random::case);
    let of_soups_px: usize = soups
        .map(|soup| assert_alike(&gpu, &soup, &soup.flight.at(0.0)))
        .sum();
    assert!(
        of_grid_px > 5000 && of_soups_px > 50_000,
        "{of_grid_px}, {of_soups_px}"
    );
}

#[test]
fn no_run_needs_what_few_devices_have() {
    let gpu = Gpu::open(&GpuOptions {
        adapter: std::env::var("SVBENCH_TEST_ADAPTER").ok(),
        hidden: Capability::ALL.to_vec(),
        ..GpuOptions::default()
    })
    .unwrap();
    let needed = wgpu::Features::TIMESTAMP_QUERY | wgpu::Features::TIMESTAMP_QUERY_INSIDE_ENCODERS;
    let more = gpu.device.features() - needed;
    assert!(more.is_empty(), "{more:?}");
}
