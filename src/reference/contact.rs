//! How the segment from a surface point to the light meets one triangle: the deciding test, in f64.
//!
//! Each test is the sign of a volume (a scalar triple product) and comes with a margin: if moving
//! the point or the triangle by the tolerance could turn the sign, it counts as zero, and what
//! follows from it as undecided.

use glam::{DVec3, Vec3};

use super::segment::{Plane, Segment, sign};

/// What one triangle does to a segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Contact {
    /// Not met, by more than the tolerance, or degenerate: a triangle without area never blocks.
    Miss,
    /// Met, by more than the tolerance.
    Block,
    /// Met or missed by less than the tolerance at one edge; all else is certain.
    Edge(EdgeContact),
    /// The start lies in the triangle's plane, and the line does not clearly miss the triangle.
    Touch,
    /// Met or missed by less than the tolerance, in any other way.
    Unsure,
}

/// A line that passes an edge within the tolerance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct EdgeContact {
    /// The ends, in the order of [`ordered`].
    pub(super) edge: [Vec3; 2],
    /// Side of the edge, seen along the segment, that the triangle covers: +1 or -1.
    pub(super) side: i8,
}

impl EdgeContact {
    /// Whether two triangles meet at this edge and cover both of its sides: whichever way the line
    /// really passes, one of the two blocks it.
    pub(super) fn closes(&self, other: &Self) -> bool {
        self.edge == other.edge && self.side != other.side
    }
}

/// Tests a segment against a triangle other than its own. Both sides of a triangle block.
pub(super) fn contact(segment: &Segment, corners: &[Vec3; 3]) -> Contact {
    let [a, b, c] = *corners;
    let edges = [[a, b], [b, c], [c, a]];
    // The sign of each says on which side of an edge the line passes, so that a line through the
    // triangle has three of one sign. The margin is the distance between line and edge.
    let passes = edges.map(|edge| {
        let (volume, length_squared) = edge_volume(segment.start, segment.to_light, edge);
        let margin = segment.tolerance * segment.length;
        if volume * volume <= margin * margin * length_squared {
            0
        } else {
            sign(volume)
        }
    });
    if passes.contains(&1) && passes.contains(&-1) {
        return Contact::Miss;
    }
    let Some(plane) = Plane::new(corners) else {
        return Contact::Miss;
    };
    match (segment.start_side(&plane), segment.light_side(&plane)) {
        (start, light) if start != 0 && start == light => return Contact::Miss,
        (0, _) => return Contact::Touch,
        (_, 0) => return Contact::Unsure,
        _ => {}
    }
    let mut undecided = (0..3).filter(|&i| passes[i] == 0);
    match (undecided.next(), undecided.next()) {
        (None, _) => Contact::Block,
        (Some(edge), None) => {
            let inside = passes[(edge + 1) % 3];
            let along = if is_ordered(edges[edge]) { 1 } else { -1 };
            Contact::Edge(EdgeContact {
                edge: ordered(edges[edge]),
                side: inside * along,
            })
        }
        _ => Contact::Unsure,
    }
}

/// Whether two triangles lie in one plane, within a tolerance (a length).
///
/// Asked from both, since a small triangle's plane strays far from it.
pub(super) fn coplanar(one: &[Vec3; 3], other: &[Vec3; 3], tolerance: f64) -> bool {
    let holds = |plane: &[Vec3; 3], corners: &[Vec3; 3]| {
        Plane::new(plane).is_some_and(|plane| plane.contains(corners, tolerance))
    };
    holds(one, other) || holds(other, one)
}

/// The signed volume spanned by a line and an edge, and the edge's length squared: positive where
/// the edge turns counter-clockwise around the line, seen from where the line points to.
///
/// Watertight: computed from the ordered ends, so that the two triangles of an edge get the same
/// value with opposite sign, and a line between them hits at least one.
pub(super) fn edge_volume(origin: DVec3, direction: DVec3, edge: [Vec3; 2]) -> (f64, f64) {
    let [from, to] = ordered(edge).map(Vec3::as_dvec3);
    let along = to - from;
    let volume = direction.dot((from - origin).cross(along));
    (
        if is_ordered(edge) { volume } else { -volume },
        along.length_squared(),
    )
}

/// The ends of an edge in an order that does not depend on the triangle it came from.
fn ordered([from, to]: [Vec3; 2]) -> [Vec3; 2] {
    if is_ordered([from, to]) {
        [from, to]
    } else {
        [to, from]
    }
}

fn is_ordered([from, to]: [Vec3; 2]) -> bool {
    (from.x, from.y, from.z) <= (to.x, to.y, to.z)
}

#[cfg(test)]
mod tests {
    use super::super::segment::ExactLight;
    use super::*;
    use crate::scene::Light;
    use glam::Vec4;
    use proptest::prelude::*;

    const TRIANGLE: [Vec3; 3] = [Vec3::ZERO, Vec3::X, Vec3::Y];

    fn segment(start: [f64; 3], end: [f64; 3]) -> Segment {
        Segment::new(DVec3::from(start), ExactLight::Point(DVec3::from(end)), 1.0)
    }

    #[test]
    fn both_sides_block() {
        for z in [1.0, -1.0] {
            let segment = segment([0.2, 0.2, z], [0.2, 0.2, -z]);
            assert_eq!(contact(&segment, &TRIANGLE), Contact::Block);
        }
    }

    #[test]
    fn a_segment_beside_before_or_behind_misses() {
        for (start, end) in [
            ([0.8, 0.8, 1.0], [0.8, 0.8, -1.0]),
            ([0.2, 0.2, 1.0], [0.2, 0.2, 0.1]),
            ([0.2, 0.2, 1.0], [0.2, 0.2, 3.0]),
        ] {
            assert_eq!(contact(&segment(start, end), &TRIANGLE), Contact::Miss);
        }
    }

    #[test]
    fn a_ray_has_no_end() {
        let away = ExactLight::new(Light::at(Vec4::new(0.0, 0.0, -5.0, 0.0))).unwrap();
        let far = Segment::new(DVec3::new(0.2, 0.2, 1e6), away, 1e6);
        assert_eq!(contact(&far, &TRIANGLE), Contact::Block);
    }

    #[test]
    fn the_margin_is_a_length() {
        let at = |x: f64| contact(&segment([x, 0.2, 1.0], [x, 0.2, -1.0]), &TRIANGLE);
        assert_eq!(at(3e-9), Contact::Block);
        assert!(matches!(at(5e-10), Contact::Edge(_)));
        assert!(matches!(at(-5e-10), Contact::Edge(_)));
        assert_eq!(at(-3e-9), Contact::Miss);
    }

    #[test]
    fn a_start_in_the_plane_touches_and_a_light_in_it_is_unsure() {
        let inside = [0.2, 0.2, 0.0];
        assert_eq!(
            contact(&segment(inside, [0.3, 0.3, 1.0]), &TRIANGLE),
            Contact::Touch
        );
        assert_eq!(
            contact(&segment([0.3, 0.3, 1.0], inside), &TRIANGLE),
            Contact::Unsure
        );
    }

    #[test]
    fn no_area_never_blocks() {
        let line = [Vec3::ZERO, Vec3::X, Vec3::X * 0.3];
        assert_eq!(
            contact(&segment([0.2, 0.0, 1.0], [0.2, 0.0, -1.0]), &line),
            Contact::Miss
        );
    }

    #[test]
    fn triangles_on_both_sides_of_an_edge_close_it() {
        let through = segment([0.5, 0.5, 1.0], [0.5, 0.5, -1.0]);
        let edge = |corners: [Vec3; 3]| match contact(&through, &corners) {
            Contact::Edge(edge) => edge,
            other => panic!("{other:?} instead of an edge"),
        };
        let near = edge(TRIANGLE);
        let beyond = edge([Vec3::X, Vec3::new(1.0, 1.0, 0.3), Vec3::Y]);
        let turned = edge([Vec3::Y, Vec3::new(1.0, 1.0, 0.3), Vec3::X]);
        let folded = edge([Vec3::X, Vec3::new(0.0, 0.0, 0.7), Vec3::Y]);
        assert!(near.closes(&beyond) && near.closes(&turned));
        assert!(!near.closes(&folded));
    }

    fn vector() -> impl Strategy<Value = Vec3> {
        prop::array::uniform3(-10.0f32..10.0).prop_map(Vec3::from)
    }

    proptest! {
        #[test]
        fn an_edge_has_one_volume(p in vector(), d in vector(), from in vector(), to in vector()) {
            let (p, d) = (p.as_dvec3(), d.as_dvec3());
            let forth = edge_volume(p, d, [from, to]);
            let back = edge_volume(p, d, [to, from]);
            prop_assert_eq!((forth.0, forth.1), (-back.0, back.1));
        }

        #[test]
        fn contact_does_not_depend_on_the_winding(
            start in vector(), end in vector(), a in vector(), b in vector(), c in vector()
        ) {
            let segment = Segment::new(start.as_dvec3(), ExactLight::Point(end.as_dvec3()), 10.0);
            let expected = contact(&segment, &[a, b, c]);
            for corners in [[b, c, a], [c, b, a], [a, c, b]] {
                prop_assert_eq!(contact(&segment, &corners), expected);
            }
        }
    }
}
