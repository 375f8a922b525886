//! A ground for models that have none.

use glam::Vec3;

use super::mesh::Mesh;
use super::part::Part;

/// A level square under the middle of a model, which only receives shadows. Level is said of world space, y up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ground {
    /// Its y.
    pub height: f32,
    /// From its middle to each side.
    pub reach: f32,
}

impl Ground {
    /// What it is called among the objects.
    pub const NAME: &'static str = "ground";

    /// The square for this mesh.
    #[must_use]
    pub fn part(self, mesh: &Mesh) -> Part {
        let (low, high) = mesh.bounds();
        let middle = (low + high) / 2.0;
        let corner = |x: f32, z: f32| {
            Vec3::new(
                middle.x + x * self.reach,
                self.height,
                middle.z + z * self.reach,
            )
        };
        let [a, b, c, d] =
            [(-1.0, -1.0), (-1.0, 1.0), (1.0, 1.0), (1.0, -1.0)].map(|(x, z)| corner(x, z));
        Part::of_triangles(Self::NAME, &[[a, b, c], [a, c, d]]).receiver()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_lies_under_the_middle_and_faces_up() {
        let triangle = [
            Vec3::ZERO,
            Vec3::new(4.0, 1.0, 0.0),
            Vec3::new(0.0, 1.0, 2.0),
        ];
        let mut mesh: Mesh = [Part::of_triangles("one", &[triangle])]
            .into_iter()
            .collect();
        let ground = Ground {
            height: -1.0,
            reach: 10.0,
        };
        mesh.push(&ground.part(&mesh));
        assert_eq!(
            mesh.bounds(),
            (Vec3::new(-8.0, -1.0, -9.0), Vec3::new(12.0, 1.0, 11.0))
        );
        assert_eq!((mesh.objects.len(), mesh.caster_object_count()), (2, 1));
        for triangle in mesh.objects[1].triangle_range() {
            let [a, b, c] = mesh.corners(triangle);
            assert!((b - a).cross(c - a).y > 0.0);
        }
    }
}
