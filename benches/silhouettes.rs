//! Finding silhouettes on the processor: on the grids of table 1, all edges against the trees.

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use glam::Vec4;
use rayon::prelude::*;
use std::hint::black_box;
use std::time::{Duration, Instant};
use svbench::geometry::occluded::left_out;
use svbench::geometry::silhouette::{
    BruteForce, HEXTREE_DEPTH, Hextree, PlaneTree, SilhouetteEdge,
};
use svbench::geometry::{EdgeTriangles, Topology};
use svbench::scene::Mesh;
use svbench::scene::sphere_grid::SphereGrid;

const LIGHT: Vec4 = Vec4::new(8.0, 45.0, 12.0, 1.0);

/// The grid of table 1 with so many slices a sphere.
fn grid(slices: u32) -> Option<Mesh> {
    let grid = SphereGrid {
        rows: 10,
        columns: 10,
        slices,
        shells: 1,
    };
    grid.mesh().ok()
}

fn extraction(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("silhouette");
    group.sample_size(10);
    for slices in [18, 60, 104] {
        let Some(mesh) = grid(slices) else { continue };
        let topology = Topology::build(&mesh);
        let triangles = mesh.triangles.len();
        let mut brute_force = BruteForce::build(&mesh, &topology);
        let plane_tree = PlaneTree::build(&mesh, &topology);
        let hextree = Hextree::build(&mesh, &topology, HEXTREE_DEPTH);
        let mut found = Vec::new();
        let named = |what| BenchmarkId::new(what, triangles);
        group.bench_function(named("brute force"), |bencher| {
            bencher.iter(|| brute_force.silhouette(&mesh, &topology, black_box(LIGHT), &mut found));
        });
        group.bench_function(named("plane tree"), |bencher| {
            bencher.iter(|| plane_tree.silhouette(&mesh, &topology, black_box(LIGHT), &mut found));
        });
        group.bench_function(named("hextree"), |bencher| {
            bencher.iter(|| hextree.silhouette(&mesh, &topology, black_box(LIGHT), &mut found));
        });
        group.bench_function(named("plane tree, built"), |bencher| {
            bencher.iter(|| PlaneTree::build(black_box(&mesh), &topology));
        });
        group.bench_function(named("hextree, built"), |bencher| {
            bencher.iter(|| Hextree::build(black_box(&mesh), &topology, HEXTREE_DEPTH));
        });
    }
    group.finish();
}

/// What of a scene a light that stands still does not reach, found when a method is made ready.
fn occluded_casters(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("occluded casters");
    group.sample_size(10);
    for slices in [18, 104] {
        let Some(mesh) = grid(slices) else { continue };
        let topology = Topology::build(&mesh);
        let triangles = EdgeTriangles::build(&mesh, &topology);
        let are_closed = triangles.closed_casters(&mesh, &topology);
        group.bench_function(BenchmarkId::new("found", mesh.triangles.len()), |bencher| {
            let of = (&mesh, &topology, &triangles);
            bencher.iter(|| left_out(black_box(LIGHT), of, &are_closed));
        });
    }
    group.finish();
}

/// As a frame has it: the light has moved, the caches are full of other things, and the cores sleep.
fn extraction_in_a_frame(criterion: &mut Criterion) {
    let Some(mesh) = grid(104) else { return };
    let topology = Topology::build(&mesh);
    let mut group = criterion.benchmark_group("silhouette in a frame");
    group.sample_size(10);
    let mut brute_force = BruteForce::build(&mesh, &topology);
    let plane_tree = PlaneTree::build(&mesh, &topology);
    let hextree = Hextree::build(&mesh, &topology, HEXTREE_DEPTH);
    group.bench_function("brute force", |bencher| {
        bencher.iter_custom(|frames| {
            in_frames(frames, |light, found| {
                brute_force.silhouette(&mesh, &topology, light, found);
            })
        });
    });
    group.bench_function("plane tree", |bencher| {
        bencher.iter_custom(|frames| {
            in_frames(frames, |light, found| {
                plane_tree.silhouette(&mesh, &topology, light, found);
            })
        });
    });
    group.bench_function("hextree", |bencher| {
        bencher.iter_custom(|frames| {
            in_frames(frames, |light, found| {
                hextree.silhouette(&mesh, &topology, light, found);
            })
        });
    });
    group.finish();
}

/// The time of some frames' extractions.
fn in_frames(frames: u64, mut extract: impl FnMut(Vec4, &mut Vec<SilhouetteEdge>)) -> Duration {
    let mut found = Vec::new();
    let mut drawn = vec![0u64; 1 << 23];
    let frame = |frame: u64| {
        drawn.par_iter_mut().for_each(|word| *word += frame);
        std::thread::sleep(Duration::from_millis(5));
        let turn = frame as f32 / 64.0;
        let light = LIGHT + 8.0 * Vec4::new(turn.cos(), 0.0, turn.sin(), 0.0);
        let start = Instant::now();
        extract(black_box(light), &mut found);
        start.elapsed()
    };
    (0..frames).map(frame).sum()
}

criterion_group!(benches, extraction, occluded_casters, extraction_in_a_frame);
criterion_main!(benches);
