//! Shadow rays on the processor: a view of each grid of table 1, and the tree that they are followed through.

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use glam::camera::rh::view::look_at_mat4;
use glam::{Mat4, Vec3, Vec4};
use std::hint::black_box;
use svbench::geometry::rays::{Picture, RayTree};
use svbench::reference::{Reference, ReferenceView};
use svbench::scene::Mesh;
use svbench::scene::sphere_grid::SphereGrid;

const SIZE_PX: [usize; 2] = [1024, 768];
const NEAR: f32 = 0.1;

/// Half of what is seen to either side, at a distance of 1.
const HALF_HEIGHT: f32 = 0.5;

/// The middle of the grid seen from above its border.
fn picture() -> Picture {
    let aspect = SIZE_PX[0] as f32 / SIZE_PX[1] as f32;
    let (eye, middle) = (Vec3::new(4.0, 9.0, 16.0), Vec3::new(0.0, 0.5, 0.0));
    let to_world = look_at_mat4(eye, middle, Vec3::Y).inverse();
    let along = |v: Vec3| to_world.transform_vector3(v).extend(0.0);
    Picture {
        size_px: SIZE_PX,
        eye,
        clip_to_eye_ray: Mat4::from_cols(
            along(Vec3::X * HALF_HEIGHT * aspect),
            along(Vec3::Y * HALF_HEIGHT),
            Vec4::ZERO,
            along(-Vec3::Z),
        ),
        light: Vec4::new(3.0, 20.0, 5.0, 1.0),
    }
}

/// What the picture shows, as a G-buffer has it.
fn triangle_ids(picture: &Picture, mesh: &Mesh) -> Option<Vec<u32>> {
    let [width, height] = SIZE_PX.map(|px| px as u32);
    let aspect = width as f32 / height as f32;
    let clip = Mat4::from_cols(
        Vec4::X / (HALF_HEIGHT * aspect),
        Vec4::Y / HALF_HEIGHT,
        -Vec4::W,
        Vec4::Z * NEAR,
    );
    let view = look_at_mat4(picture.eye, Vec3::new(0.0, 0.5, 0.0), Vec3::Y);
    let view = ReferenceView {
        width,
        height,
        view_projection: clip * view,
    };
    let reference = Reference::new(&mesh.positions, &mesh.triangles, |_| true).ok()?;
    reference.visible_ids(&view).ok()
}

fn rays(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("rays");
    group.sample_size(20);
    for slices in [18, 60, 104] {
        let grid = SphereGrid {
            rows: 10,
            columns: 10,
            slices,
            shells: 1,
        };
        let Ok(mesh) = grid.mesh() else { continue };
        let named = |what| BenchmarkId::new(what, mesh.triangles.len());
        let (picture, tree) = (picture(), RayTree::new(&mesh));
        let Some(ids) = triangle_ids(&picture, &mesh) else {
            continue;
        };
        group.bench_function(named("picture"), |bencher| {
            bencher.iter(|| {
                let mut mask = vec![0; ids.len()];
                picture.add_shadows(black_box(&mesh), &tree, &ids, &mut mask);
                mask
            });
        });
        group.bench_function(named("tree, built"), |bencher| {
            bencher.iter(|| RayTree::new(black_box(&mesh)));
        });
    }
    group.finish();
}

criterion_group!(benches, rays);
criterion_main!(benches);
