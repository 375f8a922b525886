//! What methods cannot do that ask whether a triangle blocks the light of a point, however they find the triangles.

use super::{Bound, Limit};
use crate::metrics::Label;

/// What single precision leaves.
pub(super) const LIMITS: &[Limit] = &[
    Limit {
        text: "points of surfaces are found in 32-bit floats, as parts of the triangle: what is nearer to it than a \
               millionth of the size of both touches it and does not shadow it, and coordinates a million times as large as \
               what the picture shows are wrong",
        with: &[],
        unless: &[],
        fails: &[("large_triangles", 5.0), ("translation", 6.0)],
        kinds: &[],
        at_most: Bound::Share(0.1),
    },
    Limit {
        text: "a light nearer to an edge than ten millionths of its distance: single pixels on surfaces that it grazes",
        with: &[],
        unless: &[],
        fails: &[("light_near_edge", 7.0)],
        kinds: &[],
        at_most: Bound::Px(5),
    },
    Limit {
        text: "where a triangle is drawn just beside the line of sight, the point of its edge is asked, and what meets it \
               there touches it and does not shadow it: a pixel in one of some hundred pictures of random scenes",
        with: &[],
        unless: &[],
        fails: &[],
        kinds: &[Label::Unlabelled],
        at_most: Bound::Px(1),
    },
];
