//! Edges eight at a time, with the planes of their triangles.

use super::lanes::{DualLight, LANES, OneBox, lanes_of};
use super::large_pages::{AT_A_TIME, fetch};
use super::planes::{EdgeKind, EdgePlanes};
use super::steps::{Sides, StepBox, StepPoints};
use super::{Question, SilhouetteEdge};
use bytemuck::{Pod, Zeroable};

/// Up to eight edges and the planes of two triangles on each. What their distances from a light leave open is decided by
/// the facings themselves.
///
/// Planes are kept in 16 bits along the sides of a box around them: most of what finding a silhouette costs is bringing
/// them from memory.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
pub(super) struct EdgeBlock {
    around: StepBox,
    /// The lanes that have an edge, and those whose edge has planes: a bit each.
    taken: u32,
    known: u32,
    /// Those of one triangle of each edge, and those of the other turned around.
    planes: [StepPoints; 2],
    edges: [u32; LANES],
}

impl EdgeBlock {
    /// Of at most [`LANES`] edges: their numbers and planes.
    pub(super) fn new<'a>(edges: impl Iterator<Item = (u32, &'a EdgePlanes)> + Clone) -> Self {
        let is_known =
            |planes: &EdgePlanes| matches!(planes.kind, EdgeKind::Pair | EdgeKind::Boundary);
        let known = edges.clone().filter(|(_, planes)| is_known(planes));
        let boxes = known.map(|(_, planes)| OneBox::from(planes));
        let mut block = Self {
            around: StepBox::of(boxes.reduce(OneBox::union).unwrap_or_default()),
            taken: 0,
            known: 0,
            planes: Default::default(),
            edges: [0; LANES],
        };
        for (lane, (number, planes)) in edges.enumerate() {
            block.edges[lane] = number;
            block.taken |= 1 << lane;
            if is_known(planes) {
                block.known |= 1 << lane;
                for (of_lanes, point) in block.planes.iter_mut().zip(planes.points) {
                    of_lanes.set(lane, point, &block.around);
                }
            }
        }
        block
    }

    /// The numbers of its edges.
    pub(super) fn edges(&self) -> impl Iterator<Item = u32> {
        lanes_of(self.taken).map(|lane| self.edges[lane])
    }

    /// Where the planes of its edges are for a light.
    fn sides(&self, light: &DualLight) -> [Sides; 2] {
        let steps = self.around.under(light);
        let [one, other] = &self.planes;
        [steps.sides(one, self.known), steps.sides(other, self.known)]
    }

    /// Adds the edges of some lanes, with the multiplicities `size` and `-size`, and those of `open` lanes with theirs.
    fn add(
        &self,
        [plus, minus, open]: [u32; 3],
        size: i32,
        question: Question<'_>,
        found: &mut Vec<SilhouetteEdge>,
    ) {
        for lane in lanes_of(plus | minus) {
            let is_minus = (minus >> lane & 1) as i32;
            found.push(SilhouetteEdge {
                edge: self.edges[lane],
                multiplicity: size - 2 * size * is_minus,
            });
        }
        if open != 0 {
            found.extend(lanes_of(open).filter_map(|lane| question.ask(self.edges[lane])));
        }
    }
}

/// Adds those edges of blocks that are on the silhouette.
pub(super) fn ask(
    blocks: &[&EdgeBlock],
    question: Question<'_>,
    light: &DualLight,
    found: &mut Vec<SilhouetteEdge>,
) {
    for blocks in blocks.chunks(AT_A_TIME) {
        fetch(blocks.iter().copied());
        let mut lanes = [[0; 3]; AT_A_TIME];
        for (lanes, block) in lanes.iter_mut().zip(blocks) {
            let [one, other] = block.sides(light);
            let (plus, minus) = (one.before & other.behind, one.behind & other.before);
            let cancels = one.before & other.before | one.behind & other.behind;
            *lanes = [plus, minus, block.taken & !(plus | minus | cancels)];
        }
        for (lanes, block) in lanes.into_iter().zip(blocks) {
            block.add(lanes, 2, question, found);
        }
    }
}

/// The same where each edge has one triangle.
pub(super) fn ask_boundary(
    blocks: &[EdgeBlock],
    question: Question<'_>,
    light: &DualLight,
    found: &mut Vec<SilhouetteEdge>,
) {
    for block in blocks {
        let [Sides { before, behind }, _] = block.sides(light);
        let open = block.taken & !(before | behind);
        block.add([before, behind, open], 1, question, found);
    }
}
