//! Edges eight at a time, with the planes of their triangles.

use super::lanes::{Doubts, DualLight, LANES, OneBox, Points, lanes_of, mask};
use super::planes::{Origin, PlaneBox};
use super::{Question, SilhouetteEdge};
use crate::geometry::Topology;
use crate::scene::mesh::Mesh;
use glam::Vec2;

/// Where a lane has no edge.
const NO_EDGE: u32 = u32::MAX;

/// Up to eight edges and the planes of two triangles on each. What their distances from a light leave open is decided by
/// the facings themselves.
pub(super) struct EdgeBlock {
    first: Points,
    /// Turned around.
    second: Points,
    doubt: Doubts,
    edges: [u32; LANES],
}

impl EdgeBlock {
    /// Of at most [`LANES`] edges with [`Origin::planes`], and the box around these.
    pub(super) fn new(
        mesh: &Mesh,
        topology: &Topology,
        origin: Origin,
        edges: impl Iterator<Item = u32>,
    ) -> (Self, OneBox) {
        let mut block = Self::empty();
        let mut around = OneBox::EMPTY;
        for (lane, number) in edges.enumerate() {
            block.edges[lane] = number;
            let edge = topology.edges[number as usize];
            let planes = match origin.pair(mesh, topology, edge) {
                Some([first, second]) => {
                    block.set(lane, &first, &second);
                    Some(first.union(&second))
                }
                None => origin.planes(mesh, topology, edge),
            };
            around = planes.iter().map(OneBox::from).fold(around, OneBox::union);
        }
        (block, around)
    }

    /// Of at most [`LANES`] edges with one triangle each: their numbers and the planes of these, if they have any.
    pub(super) fn of_boundary(edges: impl Iterator<Item = (u32, Option<PlaneBox>)>) -> Self {
        let mut block = Self::empty();
        for (lane, (number, plane)) in edges.enumerate() {
            block.edges[lane] = number;
            if let Some(plane) = plane {
                block.set(lane, &plane, &plane);
            }
        }
        block
    }

    /// All is in doubt.
    fn empty() -> Self {
        let mut block = Self {
            first: Points::default(),
            second: Points::default(),
            doubt: Doubts::default(),
            edges: [NO_EDGE; LANES],
        };
        for lane in 0..LANES {
            block.doubt.set(lane, Vec2::INFINITY);
        }
        block
    }

    fn set(&mut self, lane: usize, first: &PlaneBox, second: &PlaneBox) {
        self.first.set(lane, first.low.as_vec4());
        self.second.set(lane, second.low.as_vec4());
        self.doubt.set(lane, first.doubt32().max(second.doubt32()));
    }

    /// The numbers of its edges.
    pub(super) fn edges(&self) -> impl Iterator<Item = u32> {
        let edges = self.edges.iter().copied();
        edges.take_while(|&edge| edge != NO_EDGE)
    }

    /// Adds those of its edges that are on the silhouette.
    pub(super) fn ask(
        &self,
        question: Question<'_>,
        light: &DualLight,
        found: &mut Vec<SilhouetteEdge>,
    ) {
        let (first, second) = (self.first.distances(light), self.second.distances(light));
        let doubt = self.doubt.under(light);
        let before = |one: &[f32; LANES], i: usize| one[i] > doubt[i];
        let behind = |one: &[f32; LANES], i: usize| one[i] < -doubt[i];
        let cancels = mask(|i| {
            (before(&first, i) & before(&second, i)) | (behind(&first, i) & behind(&second, i))
        });
        for i in lanes_of(!cancels) {
            let edge = self.edges[i];
            let multiplicity = if before(&first, i) && behind(&second, i) {
                2
            } else if behind(&first, i) && before(&second, i) {
                -2
            } else if edge == NO_EDGE {
                break;
            } else {
                question.multiplicity(edge)
            };
            if multiplicity != 0 {
                found.push(SilhouetteEdge { edge, multiplicity });
            }
        }
    }

    /// The same where each edge has one triangle.
    pub(super) fn ask_boundary(
        &self,
        question: Question<'_>,
        light: &DualLight,
        found: &mut Vec<SilhouetteEdge>,
    ) {
        let distances = self.first.distances(light);
        let doubt = self.doubt.under(light);
        for (i, edge) in self.edges().enumerate() {
            let multiplicity = if distances[i] > doubt[i] {
                1
            } else if distances[i] < -doubt[i] {
                -1
            } else {
                question.multiplicity(edge)
            };
            if multiplicity != 0 {
                found.push(SilhouetteEdge { edge, multiplicity });
            }
        }
    }
}
