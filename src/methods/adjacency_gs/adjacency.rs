//! Triangles with the vertices beyond their edges.

use crate::geometry::open_edges::is_irregular;
use crate::geometry::{Determinism, Edge};
use crate::methods::Casters;
use glam::Vec4;

/// The triangles of a mesh as a geometry shader takes them with adjacency.
pub(super) struct Adjacency {
    /// Six vertices for each triangle of the mesh: its own at 0, 2 and 4, each followed by that of the neighbour beyond the
    /// edge to the next, or by the number of vertices where there is no neighbour.
    pub(super) vertices: Vec<[u32; 6]>,
    /// Edges that became edges of each of their triangles for itself.
    pub(super) cut: Vec<Edge>,
}

impl Adjacency {
    /// Of what casts. An edge of more than two triangles, or of two that go the same way along it, is cut: no triangle has
    /// a neighbour there (Stich et al. 2007, section 11.3.1, where all edges of such triangles are).
    pub(super) fn new(casters: &Casters) -> Self {
        let mesh = &casters.mesh;
        let (topology, triangles) = (casters.topology(), casters.edge_triangles());
        let nowhere = mesh.positions.len() as u32;
        let alone = |[a, b, c]: &[u32; 3]| [*a, nowhere, *b, nowhere, *c, nowhere];
        let mut vertices: Vec<_> = mesh.triangles.iter().map(alone).collect();
        let mut cut = Vec::new();
        for &edge in &topology.edges {
            let own = triangles.of(edge);
            if is_irregular(own) {
                cut.push(edge);
                continue;
            }
            let &[one, other] = own else { continue };
            let &[of_one, of_other] = topology.opposites_of(edge) else {
                continue;
            };
            for (triangle, beyond) in [(one, of_other), (other, of_one)] {
                let start = if triangle.is_along() { edge.a } else { edge.b };
                let corners = &mut vertices[triangle.triangle()];
                let at = [0, 2, 4].into_iter().find(|at| corners[*at] == start);
                // A triangle has its own corners.
                if let Some(at) = at {
                    corners[at + 1] = beyond;
                }
            }
        }
        Self { vertices, cut }
    }

    /// How many side quads more than by multiplicities the edges that were cut get under a light, if all triangles cast.
    pub(super) fn extra_side_quads(&self, casters: &Casters, light: Vec4) -> u64 {
        let at = |vertex: u32| casters.mesh.positions[vertex as usize];
        let extra = |edge: &Edge| {
            let opposites = casters.topology().opposites_of(*edge).iter();
            let facings = opposites.map(|opposite| {
                Determinism::ReferenceEdge.facing(at(edge.a), at(edge.b), at(*opposite), light)
            });
            let (quads, sum) = facings.fold((0, 0), |(quads, sum): (u64, i32), facing| {
                (quads + u64::from(facing != 0), sum + facing)
            });
            quads - u64::from(sum.unsigned_abs())
        };
        self.cut.iter().map(extra).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::camera::CameraPath;
    use crate::scene::{Flight, Light, Part, Scene};
    use glam::Vec3;

    fn casters(triangles: &[[Vec3; 3]]) -> Casters {
        let mesh = [Part::of_triangles("part", triangles)]
            .into_iter()
            .collect();
        let camera = CameraPath::framing(Vec3::ZERO, Vec3::ONE);
        let flight = Flight::under(Light::at(Vec4::new(0.0, 9.0, 0.0, 1.0)), camera);
        Casters::of(&Scene::new("s".to_owned(), "s".to_owned(), mesh, flight))
    }

    const CORNERS: [Vec3; 5] = [
        Vec3::ZERO,
        Vec3::X,
        Vec3::Y,
        Vec3::Z,
        Vec3::new(1.0, 1.0, 1.0),
    ];

    fn faces<const N: usize>(faces: [[usize; 3]; N]) -> Vec<[Vec3; 3]> {
        faces.map(|face| face.map(|i| CORNERS[i])).to_vec()
    }

    #[test]
    fn each_triangle_of_a_closed_mesh_has_three_neighbours() {
        let casters = casters(&faces([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]]));
        let found = Adjacency::new(&casters);
        assert!(found.cut.is_empty());
        for corners in &found.vertices {
            let own = [corners[0], corners[2], corners[4]];
            let fourth = (0..4).find(|vertex| !own.contains(vertex)).unwrap();
            assert_eq!([corners[1], corners[3], corners[5]], [fourth; 3]);
        }
    }

    #[test]
    fn an_edge_of_three_or_of_two_that_go_the_same_way_is_cut() {
        let fan = casters(&faces([[0, 1, 2], [1, 0, 3], [0, 1, 4]]));
        let found = Adjacency::new(&fan);
        let nowhere = fan.mesh.positions.len() as u32;
        assert_eq!(found.cut.len(), 1);
        let beyond = |corners: &[u32; 6]| [corners[1], corners[3], corners[5]];
        assert!(found.vertices.iter().all(|own| beyond(own) == [nowhere; 3]));

        let twisted = Adjacency::new(&casters(&faces([[0, 1, 2], [0, 1, 3]])));
        assert_eq!(twisted.cut.len(), 1);
        let joined = Adjacency::new(&casters(&faces([[0, 1, 2], [1, 0, 3]])));
        assert!(joined.cut.is_empty());
        let neighbours = joined.vertices.iter().flat_map(beyond);
        assert_eq!(neighbours.filter(|vertex| *vertex < 4).count(), 2);
    }

    #[test]
    fn what_cutting_costs_is_what_would_have_cancelled() {
        // Two triangles on one side of an edge and one on the other: three quads for a sum of one.
        let [a, b] = [Vec3::ZERO, Vec3::X];
        let fan = [Vec3::Z, 2.0 * Vec3::Z, -Vec3::Z].map(|c| [a, b, c]);
        let casters = casters(&fan);
        let light = Vec4::new(0.2, -9.0, 0.3, 1.0);
        let found = Adjacency::new(&casters);
        assert_eq!(found.cut.len(), 1);
        assert_eq!(found.extra_side_quads(&casters, light), 2);
    }
}
