//! Corners of faces by number.

use super::MethodError;
use super::counter::Counter;
use crate::geometry::EndPlane;
use crate::scene::Mesh;

/// Bits of a corner's number that are the vertex and, above it, the weight. Those above are 0 at the vertex itself, and at the
/// far end of its shadow 1 and more, the end plane.
const PLACE_SHIFT: u32 = 29;

/// The number of the corner at a vertex.
pub(super) const fn near(vertex: u32) -> u32 {
    vertex
}

/// The number of the corner at the far end of a vertex's shadow.
pub(super) fn far(vertex: u32, end: EndPlane) -> u32 {
    vertex | (end.index() as u32 + 1) << PLACE_SHIFT
}

/// How often faces count. Where a counter takes weights, the bits of corners' numbers that vertices leave hold that of their
/// face, less 1. Twins: weights.wgsl of `silhouette_cs`, and `shaders/methods/volumes/corner.wgsl`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Weights {
    pub(super) vertex_bits: u32,
}

impl Weights {
    /// For the vertices of a mesh.
    ///
    /// # Errors
    /// When there are more than numbers for them.
    pub(super) fn new(mesh: &Mesh, counter: Counter) -> Result<Self, MethodError> {
        let vertices = mesh.positions.len();
        if vertices > 1 << PLACE_SHIFT {
            let most = 1 << PLACE_SHIFT;
            let message =
                format!("{vertices} vertices are more than the {most} that it can number");
            return Err(MethodError::Unavailable(message));
        }
        Ok(Self {
            vertex_bits: if counter.takes_weights() {
                vertices.next_power_of_two().trailing_zeros()
            } else {
                PLACE_SHIFT
            },
        })
    }

    /// How often a face may count at most.
    pub(super) fn most(self) -> u32 {
        1 << (PLACE_SHIFT - self.vertex_bits)
    }

    /// For each face of those that count so often together, what its corners' numbers have beside the vertex.
    pub(super) fn of_faces(self, times: u32) -> impl Iterator<Item = u32> {
        let most = self.most();
        let of_face = move |face: u32| (times - face * most).min(most);
        (0..times.div_ceil(most)).map(move |face| (of_face(face) - 1) << self.vertex_bits)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    #[test]
    fn weights_add_up_and_leave_vertices_alone() {
        let mesh = Mesh {
            positions: vec![Vec3::ZERO; 5],
            ..Mesh::default()
        };
        let weights = Weights::new(&mesh, Counter::Blend32).unwrap();
        assert_eq!((weights.vertex_bits, weights.most()), (3, 1 << 26));
        let few = Weights { vertex_bits: 27 };
        assert!(few.of_faces(0).next().is_none());
        for times in 1..20 {
            let all: Vec<_> = few.of_faces(times).collect();
            assert!(all.iter().all(|bits| bits & ((1 << 27) - 1) == 0));
            let sum: u32 = all.iter().map(|bits| (bits >> 27) + 1).sum();
            assert_eq!((sum, all.len()), (times, times.div_ceil(4) as usize));
        }
        let stencil = Weights::new(&mesh, Counter::Stencil8).unwrap();
        assert!(stencil.of_faces(3).eq([0, 0, 0]));
    }
}
