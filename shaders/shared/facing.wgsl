// Which side of a triangle the light is on: the twin of geometry/facing.rs and shared/facing.glsl, which
// say why it is done this way. WGSL has no `precise`, so here a compiler may fuse operations: on such a
// device the last bit may differ, in triangles that the light sees edge-on.

// The vertex order: by x, then y, then z.
fn vertex_less(a: vec3<f32>, b: vec3<f32>) -> bool {
    return a.x < b.x || (a.x == b.x && (a.y < b.y || (a.y == b.y && a.z < b.z)));
}

// +1 if the light lies on the side from which a, b, c look counter-clockwise, -1 on the other side,
// 0 in the plane of the triangle. light.w: 1 position, 0 direction towards the light.
fn facing(a_in: vec3<f32>, b_in: vec3<f32>, c_in: vec3<f32>, light: vec4<f32>) -> i32 {
    var a = a_in;
    var b = b_in;
    var c = c_in;
    var swapped = false;
    if vertex_less(b, a) { let t = a; a = b; b = t; swapped = !swapped; }
    if vertex_less(c, b) { let t = b; b = c; c = t; swapped = !swapped; }
    if vertex_less(b, a) { let t = a; a = b; b = t; swapped = !swapped; }
    if all(a == b) || all(b == c) { return 0; }

    let x = c - a;
    let y = light.xyz - a * light.w;
    let e = b - a;
    let n = x.yzx * y.zxy - x.zxy * y.yzx;
    let terms = n * e;
    let d = terms.x + terms.y + terms.z;
    let sorted = select(0, 1, d > 0.0) - select(0, 1, d < 0.0);
    return select(sorted, -sorted, swapped);
}
