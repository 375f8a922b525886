//! Finding silhouettes on the processor: on the grids of table 1, all edges against the trees.

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use glam::Vec4;
use std::hint::black_box;
use svbench::geometry::Topology;
use svbench::geometry::silhouette::{BruteForce, HEXTREE_DEPTH, Hextree, PlaneTree};
use svbench::scene::sphere_grid::SphereGrid;

const LIGHT: Vec4 = Vec4::new(8.0, 45.0, 12.0, 1.0);

fn extraction(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("silhouette");
    group.sample_size(10);
    for slices in [18, 60, 104] {
        let grid = SphereGrid {
            rows: 10,
            columns: 10,
            slices,
        };
        let Ok(mesh) = grid.mesh() else { continue };
        let topology = Topology::build(&mesh);
        let triangles = mesh.triangles.len();
        let mut brute_force = BruteForce::build(&mesh, &topology);
        let plane_tree = PlaneTree::build(&mesh, &topology);
        let hextree = Hextree::build(&mesh, &topology, HEXTREE_DEPTH);
        let named = |what| BenchmarkId::new(what, triangles);
        group.bench_function(named("brute force"), |bencher| {
            bencher.iter(|| brute_force.silhouette(&mesh, &topology, black_box(LIGHT)));
        });
        group.bench_function(named("plane tree"), |bencher| {
            bencher.iter(|| plane_tree.silhouette(&mesh, &topology, black_box(LIGHT)));
        });
        group.bench_function(named("hextree"), |bencher| {
            bencher.iter(|| hextree.silhouette(&mesh, &topology, black_box(LIGHT)));
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

criterion_group!(benches, extraction);
criterion_main!(benches);
