// The triangle that the G-buffer shows at a pixel.

@group(1) @binding(0) var<storage, read> positions: array<vec4<f32>>;
@group(1) @binding(1) var<storage, read> indices: array<u32>;
@group(2) @binding(0) var triangle_ids: texture_2d<u32>;

struct Triangle {
    a: vec3<f32>,
    b: vec3<f32>,
    c: vec3<f32>,
}

// Its number plus 1, or 0 where nothing is.
fn visible_id(pixel: vec2<f32>) -> u32 {
    return textureLoad(triangle_ids, vec2<i32>(pixel), 0).x;
}

fn triangle_of(id: u32) -> Triangle {
    let first = 3u * (id - 1u);
    return Triangle(
        positions[indices[first]].xyz,
        positions[indices[first + 1u]].xyz,
        positions[indices[first + 2u]].xyz,
    );
}
