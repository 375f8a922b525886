// Whether a triangle blocks the light of a point: the twin of src/geometry/rays/blocks.rs, which says why it is done this
// way. WGSL has no `precise`, so here a compiler may fuse operations.

// Twin of `RayTriangle`: corners in the vertex order; the fourth numbers are its own number, what rounding may do to a
// distance from its plane, near it, times twice its area, and this.
struct Caster {
    a: vec4<f32>,
    b: vec4<f32>,
    c: vec4<f32>,
}

// A point of a triangle that is seen.
struct SurfacePoint {
    // A corner of the triangle.
    corner: vec3<f32>,
    // From there to the point.
    way: vec3<f32>,
    // What rounding may have moved it by.
    uncertainty: f32,
}

// What rounding may move a point by, as a part of the longer side of its own triangle.
const OF_POINT: f32 = 4.0 / 16777216.0;

fn surface_point(a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, weights: vec2<f32>) -> SurfacePoint {
    let way = weights.x * (b - a) + weights.y * (c - a);
    return SurfacePoint(a, way, OF_POINT * max(length(b - a), length(c - a)));
}

fn from_to(start: vec3<f32>, point: SurfacePoint) -> vec3<f32> {
    return (point.corner - start) + point.way;
}

fn spelled_cross(x: vec3<f32>, y: vec3<f32>) -> vec3<f32> {
    return x.yzx * y.zxy - x.zxy * y.yzx;
}

fn spelled_dot(x: vec3<f32>, y: vec3<f32>) -> f32 {
    let terms = x * y;
    return terms.x + terms.y + terms.z;
}

// How far beside a light plane a point lies, given the normal and the vector from the plane; `slack` is a part of that
// vector that does not count.
fn beside(normal: vec3<f32>, way: vec3<f32>, slack: f32) -> f32 {
    let distance = spelled_dot(normal, way);
    // The lengths of large vectors overflow.
    if slack == 0.0 {
        return distance;
    }
    return distance - slack * length(normal) * length(way);
}

// The normal of a triangle, times twice its area, from its two shorter sides.
fn shape_normal(a: vec3<f32>, b: vec3<f32>, c: vec3<f32>) -> vec3<f32> {
    let ab = b - a;
    let bc = c - b;
    let ca = a - c;
    let of_ab = dot(ab, ab);
    let of_bc = dot(bc, bc);
    let of_ca = dot(ca, ca);
    if of_ab >= max(of_bc, of_ca) {
        return spelled_cross(bc, ca);
    }
    if of_bc >= of_ca {
        return spelled_cross(ca, ab);
    }
    return spelled_cross(ab, bc);
}

// A triangle before the light, and its shadow volume: four planes with the shadow on their negative sides.
struct Blocker {
    // Points of the planes: the first of those of `ab`, `ac` and `own`, the second of that of `bc`.
    a: vec3<f32>,
    b: vec3<f32>,
    // The side on which the light is; 0 if it sees the triangle edge-on, and then it blocks nothing.
    side: f32,
    // Normals of the light planes, and of the triangle.
    ab: vec3<f32>,
    ac: vec3<f32>,
    bc: vec3<f32>,
    own: vec3<f32>,
    // What rounding may do to a distance from the triangle's plane, times twice its area; and that.
    contact: f32,
    double_area: f32,
}

fn blocker(caster: Caster, light: vec4<f32>) -> Blocker {
    let a = caster.a.xyz;
    let b = caster.b.xyz;
    let c = caster.c.xyz;
    let to_light = light.xyz - a * light.w;
    let of_ac = spelled_cross(c - a, to_light);
    let d = spelled_dot(of_ac, b - a);
    let sign = select(0.0, 1.0, d > 0.0) - select(0.0, 1.0, d < 0.0);
    let side = select(sign, 0.0, all(a == b) || all(b == c));
    let ab = side * spelled_cross(b - a, to_light);
    let bc = side * spelled_cross(c - b, light.xyz - b * light.w);
    let own = side * shape_normal(a, b, c);
    return Blocker(a, b, side, ab, -side * of_ac, bc, own, caster.b.w, caster.c.w);
}

// Points so far beside a triangle are taken to be within: `slack` is a part of their distance from it.
fn is_behind(point: SurfacePoint, blocker: Blocker, slack: f32) -> bool {
    let from_a = from_to(blocker.a, point);
    let from_b = from_to(blocker.b, point);
    let ab = beside(blocker.ab, from_a, slack);
    let ac = beside(blocker.ac, from_a, slack);
    let bc = beside(blocker.bc, from_b, slack);
    let contact = blocker.contact + blocker.double_area * point.uncertainty;
    let is_beyond = spelled_dot(blocker.own, from_a) < -contact;
    return blocker.side != 0.0 && max(ab, max(ac, bc)) <= 0.0 && is_beyond;
}

fn blocks(caster: Caster, light: vec4<f32>, point: SurfacePoint, slack: f32) -> bool {
    return is_behind(point, blocker(caster, light), slack);
}
