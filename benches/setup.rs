//! What happens once per scene, before the first frame: on the largest grid of table 1.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use glam::{DVec3, Vec4};
use svbench::geometry::{Bounds, NearVolume, Topology, facing};
use svbench::scene::sphere_grid::SphereGrid;

const LARGEST: SphereGrid = SphereGrid {
    rows: 10,
    columns: 10,
    slices: 140,
    shells: 1,
};
const SINGLE_MILLION: SphereGrid = SphereGrid {
    rows: 1,
    columns: 1,
    slices: 1000,
    shells: 1,
};
const MANY_OBJECTS: SphereGrid = SphereGrid {
    rows: 120,
    columns: 130,
    slices: 8,
    shells: 1,
};

fn generation(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("sphere_grid");
    group.sample_size(10);
    for (name, grid) in grids() {
        group.bench_function(name, |bencher| bencher.iter(|| black_box(grid).mesh()));
    }
    group.finish();
}

fn topology(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("topology");
    group.sample_size(10);
    for (name, grid) in grids() {
        let Ok(mesh) = grid.mesh() else { continue };
        group.bench_function(name, |bencher| {
            bencher.iter(|| Topology::build(black_box(&mesh)));
        });
    }
    group.finish();
}

fn facing_of_a_million(criterion: &mut Criterion) {
    let Ok(mesh) = SINGLE_MILLION.mesh() else {
        return;
    };
    let light = Vec4::new(8.0, 45.0, 12.0, 1.0);
    let mut group = criterion.benchmark_group("facing");
    group.sample_size(10);
    group.bench_function("1M triangles, one thread", |bencher| {
        bencher.iter(|| {
            let triangles = (0..mesh.triangles.len()).map(|t| mesh.corners(t));
            triangles
                .map(|[a, b, c]| facing(a, b, c, black_box(light)))
                .sum::<i32>()
        });
    });
    group.finish();
}

/// What `counting = "auto"` decides in every frame.
fn near_volume_of_many_objects(criterion: &mut Criterion) {
    let Ok(mesh) = MANY_OBJECTS.mesh() else {
        return;
    };
    let boxes = Bounds::of_objects(&mesh);
    let light = Vec4::new(8.0, 45.0, 12.0, 1.0);
    let corner = |x: f64, y: f64| DVec3::new(18.0 + 0.1 * x, 12.0 + 0.1 * y, 18.0);
    let corners = [
        corner(-1., -1.),
        corner(1., -1.),
        corner(1., 1.),
        corner(-1., 1.),
    ];
    criterion.bench_function("near volume/15600 objects", |bencher| {
        bencher.iter(|| {
            let volume = NearVolume::new(black_box(corners), light);
            boxes.iter().filter(|b| volume.may_meet(**b)).count()
        });
    });
}

fn grids() -> [(&'static str, SphereGrid); 3] {
    [
        ("100 objects, 1.96M triangles", LARGEST),
        ("1 object, 1M triangles", SINGLE_MILLION),
        ("15600 objects, 1M triangles", MANY_OBJECTS),
    ]
}

criterion_group!(
    benches,
    generation,
    topology,
    facing_of_a_million,
    near_volume_of_many_objects
);
criterion_main!(benches);
