//! Edges eight at a time, with the planes of their triangles.

use super::lanes::{Doubts, DualLight, LANES, Points, lanes_of, mask};
use super::planes::{EdgeKind, EdgePlanes};
use super::{Question, SilhouetteEdge};

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
    /// Of at most [`LANES`] edges: their numbers and planes.
    pub(super) fn new<'a>(edges: impl Iterator<Item = (u32, &'a EdgePlanes)>) -> Self {
        let mut block = Self {
            first: Points::default(),
            second: Points::default(),
            doubt: Doubts::ALL,
            edges: [NO_EDGE; LANES],
        };
        for (lane, (number, planes)) in edges.enumerate() {
            block.edges[lane] = number;
            if matches!(planes.kind, EdgeKind::Pair | EdgeKind::Boundary) {
                block.first.set(lane, planes.points[0]);
                block.second.set(lane, planes.points[1]);
                block.doubt.set(lane, planes.doubt);
            }
        }
        block
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
