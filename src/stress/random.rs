//! Random scenes, each made from one number.

use crate::scene::mesh::canonical;
use crate::scene::{CameraKey, CameraPath, Mesh, Object, Scene};
use glam::{Vec3, Vec4};
use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

fn in_cube(random: &mut impl Rng, half: f32) -> Vec3 {
    Vec3::from_array([(); 3].map(|()| random.random_range(-half..half)))
}

fn log_uniform(random: &mut impl Rng, low: f32, high: f32) -> f32 {
    random.random_range(low.ln()..high.ln()).exp()
}

/// exp
pub fn soup(random: &mut impl Rng, count: usize, size: f32) -> Vec<[Vec3; 3]> {
    (0..count)
        .map(|_| {
            let centre = in_cube(random, 1.0);
            [(); 3].map(|()| canonical(centre + in_cube(random, size)))
        })
        .collect()
}

/// exp
pub fn case(seed: u64) -> Scene {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let r = &mut random;
    let count = log_uniform(r, 1.0, 200.99) as usize;
    let kind = r.random_range(0..4);
    let mut positions: Vec<Vec3> = Vec::new();
    let mut triangles: Vec<[u32; 3]> = Vec::new();
    match kind {
        0 | 1 => {
            let size = log_uniform(r, 0.05, 2.0);
            let snap = kind == 1;
            for t in soup(r, count, size) {
                let first = positions.len() as u32;
                positions.extend(t.map(|p| if snap { (p * 4.0).round() / 4.0 } else { p }));
                triangles.push([first, first + 1, first + 2]);
            }
        }
        2 => {
            let n = r.random_range(3..count.max(4) + 3);
            positions = (0..n).map(|_| canonical(in_cube(r, 1.0))).collect();
            for _ in 0..count {
                triangles.push([(); 3].map(|()| r.random_range(0..n) as u32));
            }
        }
        _ => {
            let slices = 2 * r.random_range(2..7u32);
            let sphere = crate::scene::SphereGrid {
                rows: 1,
                columns: 1,
                slices,
            };
            let mesh = sphere.mesh().expect("valid");
            let o = &mesh.objects[if mesh.objects[0].casts_shadow { 0 } else { 1 }];
            let s = 0.08;
            positions = mesh.positions[o.vertex_range()]
                .iter()
                .map(|p| canonical(*p * s - Vec3::Y))
                .collect();
            triangles = mesh.triangles[o.triangle_range()]
                .iter()
                .map(|t| t.map(|i| i - o.vertices.start))
                .collect();
            let damage = r.random_range(0..4);
            for _ in 0..damage * 3 {
                let i = r.random_range(0..triangles.len());
                match r.random_range(0..4) {
                    0 => {
                        triangles.swap_remove(i);
                    }
                    1 => triangles[i].swap(0, 1),
                    2 => {
                        let t = triangles[i];
                        triangles.push(t);
                    }
                    _ => {
                        let v = triangles[i][0] as usize;
                        positions[v] += in_cube(r, 0.2);
                        positions[v] = canonical(positions[v]);
                    }
                }
            }
        }
    }
    let mut objects = vec![Object {
        name: "soup".into(),
        vertices: 0..positions.len() as u32,
        triangles: 0..triangles.len() as u32,
        casts_shadow: true,
    }];
    if r.random_bool(0.5) {
        let v = positions.len() as u32;
        let t = triangles.len() as u32;
        let y = r.random_range(-1.5..1.0f32);
        positions.extend(
            [(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)]
                .map(|(x, z)| canonical(Vec3::new(x * 4.0, y, z * 4.0))),
        );
        triangles.extend([[v, v + 1, v + 2], [v + 2, v + 1, v + 3]]);
        objects.push(Object {
            name: "ground".into(),
            vertices: v..v + 4,
            triangles: t..t + 2,
            casts_shadow: true,
        });
    }
    let light = match r.random_range(0..10) {
        0 => in_cube(r, 1.0).extend(0.0),
        1 => (in_cube(r, 1.0).normalize() * log_uniform(r, 3.0, 1000.0)).extend(1.0),
        2 => ((in_cube(r, 2.0) * 4.0).round() / 4.0).extend(1.0),
        _ => in_cube(r, 2.0).extend(1.0),
    };
    let eye = in_cube(r, 3.0);
    let target = in_cube(r, 0.5);
    let near = log_uniform(r, 0.001, 0.2);
    let camera = CameraPath {
        keys: vec![CameraKey {
            time_s: 0.0,
            eye,
            target,
        }],
        up: Vec3::Y,
        fov_y_rad: 1.0,
        near,
    };
    Scene::new(
        format!("fuzz_{seed}"),
        format!("Random scene {seed}"),
        Mesh {
            positions,
            triangles,
            objects,
        },
        Vec4::from(light),
        camera,
    )
}
