//! The point of a triangle that is seen through a pixel.

use glam::{DVec2, DVec3, Vec3};

use super::contact::edge_volume;
use super::view::{EyeRay, Projection};

/// How far from its pixel's centre a triangle may be seen. The rasteriser snaps vertices to 1/256
/// of a pixel and transforms them in f32, so a small part of a pixel is expected; more means that
/// the ids were drawn from another view.
const MAX_OFFSET_PX: f64 = 0.5;

/// How far a clamped point is moved inwards, relative to the scale; less in a small triangle.
///
/// On the edge itself every neighbour touches it and nothing could be decided. This is a thousand
/// tolerances away from it, yet invisible: a thousandth of a pixel that shows a thousandth of the
/// scene.
const INWARD: f64 = 1e-6;

/// Where a ray meets a triangle, with the distance from the eye, or `None` beside or behind it.
///
/// The point is a convex combination of the corners: however edge-on the triangle is seen, it lies
/// in it. Watertight across shared edges.
pub(super) fn hit(ray: &EyeRay, corners: &[Vec3; 3]) -> Option<(DVec3, f64)> {
    let [a, b, c] = *corners;
    let volume = |edge| edge_volume(ray.eye, ray.direction, edge).0;
    let (u, v, w) = (volume([b, c]), volume([c, a]), volume([a, b]));
    if u.min(v).min(w) < 0.0 && u.max(v).max(w) > 0.0 {
        return None;
    }
    let (v, w) = (v / (u + v + w), w / (u + v + w));
    let [a, b, c] = [a, b, c].map(Vec3::as_dvec3);
    let point = a + v * (b - a) + w * (c - a);
    let distance = (point - ray.eye).dot(ray.direction);
    // Not a number where the triangle is seen exactly edge-on, and then not seen.
    (distance > 0.0).then_some((point, distance))
}

/// The point of a triangle seen through a pixel that the G-buffer says it covers.
///
/// Where the centre's ray passes just outside (the rasteriser snaps vertices), it is the
/// triangle's point nearest to the ray: where its *plane* meets the ray may be anywhere when the
/// plane is seen nearly edge-on. `None` if the triangle is not seen near this pixel.
pub(super) fn point_seen(
    projection: &Projection,
    centre_px: DVec2,
    corners: &[Vec3; 3],
    scale: f64,
) -> Option<DVec3> {
    let ray = projection.ray(centre_px);
    if let Some((point, _)) = hit(&ray, corners) {
        return Some(point);
    }
    let [a, b, c] = corners.map(Vec3::as_dvec3);
    let (nearest, _) = [[a, b], [b, c], [c, a]]
        .into_iter()
        .filter_map(|edge| nearest_on_edge(&ray, edge))
        .min_by(|(_, one), (_, other)| one.total_cmp(other))?;
    let seen_px = projection.place_px(nearest)?;
    if seen_px.distance(centre_px) > MAX_OFFSET_PX {
        return None;
    }
    let inwards = (a + b + c) / 3.0 - nearest;
    let share = (INWARD * scale / inwards.length()).min(0.5);
    Some(nearest + share * inwards)
}

/// Whether a ray meets a triangle, and so does every ray from the eye within a small angle (radians) of it.
pub(super) fn meets_well_inside(ray: &EyeRay, corners: &[Vec3; 3], angle: f64) -> bool {
    let [a, b, c] = corners.map(|corner| corner.as_dvec3() - ray.eye);
    // The sine of the angle between the ray and the plane through the eye and an edge.
    let sine = |from: DVec3, to: DVec3| {
        let normal = from.cross(to);
        ray.direction.dot(normal) / normal.length()
    };
    let sines = [sine(a, b), sine(b, c), sine(c, a)];
    // Not a number, which is beside, where the eye lies on an edge's line.
    sines.iter().all(|sine| *sine > angle) || sines.iter().all(|sine| *sine < -angle)
}

/// The point of an edge nearest to a ray, and the tangent of the angle between the two as seen from
/// the eye; `None` behind the eye.
fn nearest_on_edge(ray: &EyeRay, [from, to]: [DVec3; 2]) -> Option<(DVec3, f64)> {
    let across = |vector: DVec3| vector - vector.dot(ray.direction) * ray.direction;
    let (offset, along) = (across(from - ray.eye), across(to - from));
    let share = (-offset.dot(along) / along.length_squared()).clamp(0.0, 1.0);
    // Not a number for an edge that runs along the ray: all of it is equally near.
    let share = if share.is_nan() { 0.0 } else { share };
    let point = from + share * (to - from);
    let distance = (point - ray.eye).dot(ray.direction);
    (distance > 0.0).then(|| (point, across(point - ray.eye).length() / distance))
}

#[cfg(test)]
mod tests {
    use super::super::ReferenceView;
    use super::*;
    use glam::camera::rh::proj::directx::perspective_infinite_reverse;

    /// Looks down -z from the origin; a pixel is 0.02 wide at distance 1.
    fn projection() -> Projection {
        let view_projection = perspective_infinite_reverse(std::f32::consts::FRAC_PI_2, 1.0, 0.1);
        Projection::new(&ReferenceView {
            width: 100,
            height: 100,
            view_projection,
        })
        .unwrap()
    }

    const FACING: [Vec3; 3] = [
        Vec3::new(0.0, 0.0, -1.0),
        Vec3::new(0.5, 0.0, -1.0),
        Vec3::new(0.0, 0.5, -1.0),
    ];

    #[test]
    fn a_centre_inside_is_met_exactly() {
        let point = point_seen(&projection(), DVec2::new(60.5, 44.5), &FACING, 1.0).unwrap();
        assert!(
            point.distance(DVec3::new(0.21, 0.11, -1.0)) < 1e-7,
            "{point}"
        );
    }

    #[test]
    fn a_centre_just_outside_is_clamped_into_the_triangle() {
        let point = point_seen(&projection(), DVec2::new(60.5, 50.2), &FACING, 1.0).unwrap();
        assert!(
            point.distance(DVec3::new(0.21, 0.0, -1.0)) < 1e-5,
            "{point}"
        );
        assert!(point.y > 1e-8);
    }

    #[test]
    fn a_floor_seen_nearly_edge_on_does_not_throw_the_point_away() {
        // The plane meets the pixel's ray far behind the eye.
        let floor = [[-1.0, -1e-4, -3.0], [1.0, -1e-4, -3.0], [0.0, -1e-4, -2.0]].map(Vec3::from);
        let point = point_seen(&projection(), DVec2::new(50.0, 49.9), &floor, 3.0).unwrap();
        assert!((-3.0..=-2.0).contains(&point.z) && point.y < 0.0, "{point}");
    }

    #[test]
    fn a_triangle_elsewhere_is_not_seen() {
        assert!(point_seen(&projection(), DVec2::new(20.5, 20.5), &FACING, 1.0).is_none());
        let behind = FACING.map(|corner| -corner);
        assert!(point_seen(&projection(), DVec2::new(40.5, 55.5), &behind, 1.0).is_none());
    }
}
