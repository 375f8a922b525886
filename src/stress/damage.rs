//! Meshes with holes, wrong windings and triangles that come twice, made from sound ones.

use super::rewrite::part_like;
use crate::scene::{Mesh, Scene};
use rand::{Rng, RngExt};

/// The scene with a share of its casting triangles damaged: a third of these is missing, a third is wound
/// the other way, and a third comes twice.
pub fn damage(scene: &Scene, share: f64, random: &mut impl Rng) -> Scene {
    let mesh = &scene.mesh;
    let parts = mesh.objects.iter().map(|object| {
        let mut triangles = Vec::with_capacity(object.triangles.len());
        for triangle in object.triangle_range() {
            let [a, b, c] = mesh.corners(triangle);
            if !object.casts_shadow || !random.random_bool(share) {
                triangles.push([a, b, c]);
                continue;
            }
            match random.random_range(0..3) {
                0 => {}
                1 => triangles.push([a, c, b]),
                _ => triangles.extend([[a, b, c]; 2]),
            }
        }
        part_like(object, &triangles)
    });
    let damaged: Mesh = parts.collect();
    Scene::new(
        format!("{}_damaged", scene.name),
        format!("{}, damaged", scene.title),
        damaged,
        scene.flight.clone(),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stress::fixtures::small_grid;
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;

    #[test]
    fn some_triangles_go_and_some_come_twice() {
        let scene = small_grid();
        let mut random = ChaCha8Rng::seed_from_u64(1);
        let damaged = damage(&scene, 0.3, &mut random);
        assert_ne!(damaged.mesh_hash, scene.mesh_hash);
        assert_eq!(damaged.mesh.objects.len(), scene.mesh.objects.len());
        let mut corners: Vec<_> = (0..damaged.mesh.triangles.len())
            .map(|t| {
                damaged
                    .mesh
                    .corners(t)
                    .map(|p| p.to_array().map(f32::to_bits))
            })
            .collect();
        let all = corners.len();
        corners.sort_unstable();
        corners.dedup();
        let missing = scene.mesh.triangles.len() - corners.len();
        assert!(all - corners.len() > 5 && missing > 5, "{all} {missing}");
        assert_eq!(damage(&scene, 0.0, &mut random).mesh_hash.len(), 64);
    }
}
