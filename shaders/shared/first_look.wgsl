// Whether something may be behind a triangle, as far as rounded points and boxes tell: never no where `is_behind` says yes.
#include "shared/blocks.wgsl"

// What `is_behind` may round by where the triangle that a point is seen on is as large as the scene.
override scene_rounding: f32;

// What rounding does to a distance from a plane, as a part of its terms.
const OF_DISTANCE: f32 = 1.0 / 1048576.0;

// The middle of the distances of a box from a plane, and half their range: the box by its middle, seen from a point of the
// plane, and half its sides.
fn distances(normal: vec3<f32>, from_base: vec3<f32>, extent: vec3<f32>) -> vec2<f32> {
    return vec2<f32>(dot(normal, from_base), dot(abs(normal), extent));
}

// The half sides of a box that has room for what rounding may do to distances.
fn with_room(from_base: vec3<f32>, extent: vec3<f32>) -> vec3<f32> {
    return extent + OF_DISTANCE * (abs(from_base) + abs(extent)) + scene_rounding;
}

// Whether a point may be.
fn may_be_behind(point: vec3<f32>, of_caster: Blocker) -> bool {
    let from_a = point - of_caster.a;
    let from_b = point - of_caster.b;
    let about_a = OF_DISTANCE * (abs(point) + abs(from_a)) + scene_rounding;
    let about_b = OF_DISTANCE * (abs(point) + abs(from_b)) + scene_rounding;
    let ab = distances(of_caster.ab, from_a, about_a);
    let ac = distances(of_caster.ac, from_a, about_a);
    let bc = distances(of_caster.bc, from_b, about_b);
    let own = distances(of_caster.own, from_a, about_a);
    return max(max(ab.x - ab.y, ac.x - ac.y), max(bc.x - bc.y, own.x - own.y + of_caster.contact)) <= 0.0;
}
