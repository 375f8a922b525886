// Which side of a triangle the light is on: the twin of geometry/facing.rs and shared/facing.glsl, which
// say why it is done this way. WGSL has no `precise`, so here a compiler may fuse operations: on such a
// device the last bit may differ, in triangles that the light sees edge-on.

// The vertex order: by x, then y, then z.
fn vertex_less(a: vec3<f32>, b: vec3<f32>) -> bool {
    return a.x < b.x || (a.x == b.x && (a.y < b.y || (a.y == b.y && a.z < b.z)));
}

// A triangle with its corners in the vertex order.
struct Sorted {
    a: vec3<f32>,
    b: vec3<f32>,
    c: vec3<f32>,
    // Whether they wind the other way round.
    is_swapped: bool,
}

fn sort_corners(a: vec3<f32>, b: vec3<f32>, c: vec3<f32>) -> Sorted {
    // By comparing neighbours; without branches, both sides of which many devices run.
    let first = vertex_less(b, a);
    let a_1 = select(a, b, first);
    let b_1 = select(b, a, first);
    let second = vertex_less(c, b_1);
    let b_2 = select(b_1, c, second);
    let c_2 = select(c, b_1, second);
    let third = vertex_less(b_2, a_1);
    let a_3 = select(a_1, b_2, third);
    let b_3 = select(b_2, a_1, third);
    return Sorted(a_3, b_3, c_2, (first != second) != third);
}

// The facing of a triangle, see below.
fn sorted_facing(t: Sorted, light: vec4<f32>) -> i32 {
    let x = t.c - t.a;
    let y = light.xyz - t.a * light.w;
    let e = t.b - t.a;
    let n = x.yzx * y.zxy - x.zxy * y.yzx;
    let terms = n * e;
    let d = terms.x + terms.y + terms.z;
    let side = select(0, 1, d > 0.0) - select(0, 1, d < 0.0);
    let is_degenerate = all(t.a == t.b) || all(t.b == t.c);
    return select(select(side, -side, t.is_swapped), 0, is_degenerate);
}

// The same of three corners of which a is before b.
fn sort_third(a: vec3<f32>, b: vec3<f32>, c: vec3<f32>) -> Sorted {
    let before_b = vertex_less(c, b);
    let before_a = vertex_less(c, a);
    return Sorted(
        select(a, c, before_a),
        select(select(b, c, before_b), a, before_a),
        select(c, b, before_b),
        before_a != before_b,
    );
}

// +1 if the light lies on the side from which a, b, c look counter-clockwise, -1 on the other side,
// 0 in the plane of the triangle. light.w: 1 position, 0 direction towards the light.
fn facing(a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, light: vec4<f32>) -> i32 {
    return sorted_facing(sort_corners(a, b, c), light);
}
