//! Where a line of sight comes nearest to a triangle that it misses.

use glam::Vec3;

/// The point of a triangle's edges nearest to a line of sight, as weights of the second and the third corner: of the points
/// of each edge that are nearest to it in space, the one that is nearest as the eye sees it.
///
/// A rasteriser moves corners a little, so a pixel may show a triangle that its centre just misses. Where its *plane* meets
/// the line may be anywhere when it is seen nearly edge-on. `shaders/shared/point_seen.wgsl` has the twin.
pub(super) fn nearest_on_edges(corners: [Vec3; 3], eye: Vec3, sight: Vec3) -> [f32; 2] {
    let direction = sight.normalize();
    let [a, b, c] = corners.map(|corner| corner - eye);
    let (on_ab, ab) = nearest_on_edge(a, b, direction);
    let (on_bc, bc) = nearest_on_edge(b, c, direction);
    let (on_ac, ac) = nearest_on_edge(a, c, direction);
    if ab <= bc.min(ac) {
        [on_ab, 0.0]
    } else if bc <= ac {
        [1.0 - on_bc, on_bc]
    } else {
        [0.0, on_ac]
    }
}

/// How far along an edge it is nearest to a ray from the origin, and the tangent of the angle between the two.
fn nearest_on_edge(start: Vec3, end: Vec3, direction: Vec3) -> (f32, f32) {
    let across = |v: Vec3| v - v.dot(direction) * direction;
    let (offset, along) = (across(start), across(end - start));
    let share = -offset.dot(along) / along.length_squared().max(f32::MIN_POSITIVE);
    let share = share.clamp(0.0, 1.0);
    let point = start + share * (end - start);
    let distance = point.dot(direction);
    let tangent = across(point).length() / distance;
    // Behind the eye, nothing is near.
    (share, if distance > 0.0 { tangent } else { f32::MAX })
}
