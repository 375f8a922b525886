//! The faces of volumes, as lists of corners.
//!
//! Every face is counter-clockwise seen from outside of its volume.

use crate::geometry::Casting;
use crate::methods::capping::{CappedPlan, Capping, Caps};
use crate::methods::corner::{Weights, far, near};
use crate::methods::side_quad::DirectedEdge;
use crate::methods::volume_parameters::FrontCap;

/// The corners of all faces, three a triangle, by how they are counted.
pub(super) struct Faces {
    weights: Weights,
    pub(super) depth_passes: Vec<u32>,
    pub(super) depth_fails: Vec<u32>,
    pub(super) everywhere: Vec<u32>,
    /// Of open edges, counted as those of `depth_passes` when these are in the mask.
    pub(super) of_open_edges: Vec<u32>,
}

impl Faces {
    pub(super) fn new(weights: Weights) -> Self {
        Self {
            weights,
            depth_passes: Vec::new(),
            depth_fails: Vec::new(),
            everywhere: Vec::new(),
            of_open_edges: Vec::new(),
        }
    }

    pub(super) fn clear(&mut self) {
        self.depth_passes.clear();
        self.depth_fails.clear();
        self.everywhere.clear();
        self.of_open_edges.clear();
    }

    /// The side quad of an edge, as often as its multiplicity says.
    pub(super) fn side(&mut self, edge: &DirectedEdge, plan: CappedPlan) {
        let faces = if plan.caster.z_pass {
            &mut self.depth_passes
        } else {
            &mut self.depth_fails
        };
        sides(faces, self.weights, edge, plan);
    }

    /// That of an open edge, counted down after the rest.
    pub(super) fn open_side(&mut self, edge: &DirectedEdge, plan: CappedPlan) {
        let counted_down = DirectedEdge {
            multiplicity: -edge.multiplicity,
            ..*edge
        };
        sides(&mut self.of_open_edges, self.weights, &counted_down, plan);
    }

    /// The triangle of a fan between an edge and a vertex of the same part of a mesh. With those of all silhouette edges
    /// there it covers what the triangles of a cap cover: each pixel as often, for both end at the silhouette.
    pub(super) fn fan_front(&mut self, edge: &DirectedEdge, apex: u32) {
        let &DirectedEdge { a, b, multiplicity } = edge;
        if apex != a && apex != b {
            let (a, b) = if multiplicity > 0 { (a, b) } else { (b, a) };
            for weight in self.weights.of_faces(multiplicity.unsigned_abs()) {
                self.everywhere
                    .extend([apex, a, b].map(|vertex| near(vertex) | weight));
            }
        }
    }

    /// The same for the back cap, which is flat and behind everything.
    pub(super) fn fan_back(&mut self, edge: &DirectedEdge, apex: u32, plan: CappedPlan) {
        let &DirectedEdge { a, b, multiplicity } = edge;
        if apex != a && apex != b && !plan.far_ends_meet {
            let (a, b) = if multiplicity > 0 { (b, a) } else { (a, b) };
            for weight in self.weights.of_faces(multiplicity.unsigned_abs()) {
                let far = |vertex| far(vertex, plan.caster.end) | weight;
                self.everywhere.extend([apex, a, b].map(far));
            }
        }
    }

    /// The front cap of a triangle that is counter-clockwise seen from the light.
    fn front_cap(&mut self, [a, b, c]: [u32; 3], everywhere: bool) {
        let faces = if everywhere {
            &mut self.everywhere
        } else {
            &mut self.depth_fails
        };
        faces.extend_from_slice(&[near(a), near(b), near(c)]);
    }

    /// The back cap of a triangle that is counter-clockwise seen from the light.
    fn back_cap(&mut self, [a, b, c]: [u32; 3], plan: CappedPlan) {
        if !plan.far_ends_meet {
            self.everywhere
                .extend_from_slice(&[a, c, b].map(|vertex| far(vertex, plan.caster.end)));
        }
    }

    /// The caps of one triangle, but for those that are fans.
    pub(super) fn caps(
        &mut self,
        capping: &Capping,
        plan: CappedPlan,
        [a, b, c]: [u32; 3],
        facing: i8,
    ) {
        let casting = plan.caster.casting;
        let casts = facing == 1 || facing == -1 && casting == Casting::All;
        // Counter-clockwise seen from the light.
        let triangle = if facing == 1 { [a, b, c] } else { [a, c, b] };
        if casts && !plan.fan_in_front {
            self.front_cap(triangle, capping.front_cap == FrontCap::Far);
        }
        let are_others_behind =
            capping.caps == Caps::FarTriangles && casting == Casting::LightFacing;
        if casts != are_others_behind && !plan.fan_behind {
            self.back_cap(triangle, plan);
        }
    }
}

/// Adds the side quads of an edge; where far ends meet, triangles.
fn sides(faces: &mut Vec<u32>, weights: Weights, edge: &DirectedEdge, plan: CappedPlan) {
    let far_of = |vertex| far(if plan.far_ends_meet { 0 } else { vertex }, plan.caster.end);
    let quad = edge.quad(near, far_of);
    let corners = if plan.far_ends_meet {
        &quad[..3]
    } else {
        &quad[..]
    };
    for weight in weights.of_faces(edge.multiplicity.unsigned_abs()) {
        faces.extend(corners.iter().map(|corner| corner | weight));
    }
}
