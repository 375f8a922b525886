//! The faces of volumes, as lists of corners.
//!
//! Every face is counter-clockwise seen from outside of its volume.

use super::edges::DirectedEdge;
use crate::methods::portable_volumes::{far, near};

/// The corners of all faces, three a triangle, by how they are counted.
#[derive(Default)]
pub(super) struct Faces {
    pub(super) depth_passes: Vec<u32>,
    pub(super) depth_fails: Vec<u32>,
    pub(super) everywhere: Vec<u32>,
    /// All far ends are one point: volumes of a light at infinity that reach to infinity need no back caps.
    pub(super) far_ends_meet: bool,
}

impl Faces {
    pub(super) fn clear(&mut self) {
        self.depth_passes.clear();
        self.depth_fails.clear();
        self.everywhere.clear();
    }

    /// The side quad of an edge, as often as its multiplicity says.
    ///
    /// Its corners lie in one plane only but for rounding, so the diagonal matters to the last bit of depth: both windings
    /// are cut from `b` to the far end of `a`, so that opposite copies cancel to the pixel. Where far ends meet, it is
    /// a triangle.
    pub(super) fn side(&mut self, edge: &DirectedEdge, z_pass: bool) {
        let &DirectedEdge { a, b, multiplicity } = edge;
        let faces = if z_pass {
            &mut self.depth_passes
        } else {
            &mut self.depth_fails
        };
        let far_of = |vertex| {
            if self.far_ends_meet {
                far(0)
            } else {
                far(vertex)
            }
        };
        let quad = if multiplicity > 0 {
            [near(a), far_of(a), near(b), near(b), far_of(a), far_of(b)]
        } else {
            [near(a), near(b), far_of(a), near(b), far_of(b), far_of(a)]
        };
        let corners = if self.far_ends_meet {
            &quad[..3]
        } else {
            &quad[..]
        };
        for _ in 0..multiplicity.unsigned_abs() {
            faces.extend_from_slice(corners);
        }
    }

    /// The triangle of a fan between an edge and a vertex of the same part of a mesh. With those of all silhouette edges
    /// there it covers what the triangles of a cap cover: each pixel as often, for both end at the silhouette.
    pub(super) fn fan_front(&mut self, edge: &DirectedEdge, apex: u32) {
        let &DirectedEdge { a, b, multiplicity } = edge;
        if apex != a && apex != b {
            let (a, b) = if multiplicity > 0 { (a, b) } else { (b, a) };
            for _ in 0..multiplicity.unsigned_abs() {
                self.everywhere
                    .extend_from_slice(&[near(apex), near(a), near(b)]);
            }
        }
    }

    /// The same for the back cap, which is flat and behind everything.
    pub(super) fn fan_back(&mut self, edge: &DirectedEdge, apex: u32) {
        let &DirectedEdge { a, b, multiplicity } = edge;
        if apex != a && apex != b && !self.far_ends_meet {
            let (a, b) = if multiplicity > 0 { (b, a) } else { (a, b) };
            for _ in 0..multiplicity.unsigned_abs() {
                self.everywhere
                    .extend_from_slice(&[far(apex), far(a), far(b)]);
            }
        }
    }

    /// The front cap of a triangle that is counter-clockwise seen from the light.
    pub(super) fn front_cap(&mut self, [a, b, c]: [u32; 3], everywhere: bool) {
        let faces = if everywhere {
            &mut self.everywhere
        } else {
            &mut self.depth_fails
        };
        faces.extend_from_slice(&[near(a), near(b), near(c)]);
    }

    /// The back cap of a triangle that is counter-clockwise seen from the light.
    pub(super) fn back_cap(&mut self, [a, b, c]: [u32; 3]) {
        if !self.far_ends_meet {
            self.everywhere.extend_from_slice(&[far(a), far(c), far(b)]);
        }
    }
}
