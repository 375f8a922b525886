//! What it costs to verify a frame of 1024 × 768 pixels on the processor: tracing the truth, and judging a mask
//! with few and one with many wrong pixels.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use glam::{Vec3, Vec4};
use svbench::metrics::{EdgeDistances, FrameContext, MaskComparison, analyse, mean_flip};
use svbench::reference::{BoundaryProbe, Reference, ReferenceView};
use svbench::scene::sphere_grid::SphereGrid;
use svbench::scene::{Light, View};

const LIGHT: Light = Light::at(Vec4::new(3.0, 20.0, 5.0, 1.0));
const SIZE: [u32; 2] = [1024, 768];

fn verification(criterion: &mut Criterion) {
    let grid = SphereGrid {
        rows: 10,
        columns: 10,
        slices: 60,
        shells: 1,
    };
    let view = View {
        eye: Vec3::new(18.0, 12.0, 18.0),
        target: Vec3::ZERO,
        up: Vec3::Y,
        fov_y_rad: 60f32.to_radians(),
        near: 0.1,
    };
    let view = ReferenceView {
        width: SIZE[0],
        height: SIZE[1],
        view_projection: view.view_projection(SIZE[0] as f32 / SIZE[1] as f32),
    };
    let Ok(mesh) = grid.mesh() else { return };
    let Ok(reference) = Reference::new(&mesh.positions, &mesh.triangles, |_| true) else {
        return;
    };
    let Ok(triangle_ids) = reference.visible_ids(&view) else {
        return;
    };
    let Ok(truth) = reference.trace(LIGHT, &view, &triangle_ids) else {
        return;
    };
    let mut group = criterion.benchmark_group("verification, 1024 × 768, 360K triangles");
    group.sample_size(10);
    group.bench_function("trace the truth", |bencher| {
        bencher.iter(|| reference.trace(black_box(LIGHT), &view, &triangle_ids));
    });
    group.bench_function("distances from the edge", |bencher| {
        bencher.iter(|| EdgeDistances::new(black_box(&truth)));
    });
    let edges = EdgeDistances::new(&truth);
    let mut few = truth.to_grey();
    few.iter_mut().step_by(5003).for_each(|value| *value ^= 255);
    // Stripes, as of acne.
    let mut many = truth.to_grey();
    many.iter_mut().step_by(4).for_each(|value| *value = 255);
    for (name, mask) in [("few wrong pixels", &few), ("many wrong pixels", &many)] {
        group.bench_function(format!("judge a mask of {name}"), |bencher| {
            bencher.iter(|| {
                let wrong_px = if mask == &many { 100_000 } else { 100 };
                let probe = BoundaryProbe::new(&reference, LIGHT, &view, &truth, wrong_px)?;
                let near = |x, y| probe.near_boundary(x, y);
                let Ok(comparison) = MaskComparison::new(black_box(mask), &truth, near) else {
                    return Ok(0);
                };
                let context = FrameContext {
                    reference: &reference,
                    light: LIGHT,
                    view: &view,
                    triangle_ids: &triangle_ids,
                    edges: &edges,
                    texel: None,
                    texel_reach: 0,
                };
                analyse(&comparison, &context).map(|analysis| analysis.regions.len())
            });
        });
    }
    let picture =
        |mask: &[u8]| -> Vec<u8> { mask.iter().flat_map(|v| [*v, *v, *v, 255]).collect() };
    let (one, other) = (picture(&few), picture(&many));
    group.bench_function("FLIP", |bencher| {
        bencher.iter(|| mean_flip(SIZE, black_box(&one), &other));
    });
    group.finish();
}

criterion_group!(benches, verification);
criterion_main!(benches);
