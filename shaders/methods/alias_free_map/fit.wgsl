// Finds what samples each face of the light's map holds.
#include "shared/frame.wgsl"
#include "shared/pixels.wgsl"
#include "shared/view_sample.wgsl"
#include "methods/alias_free_map/light_map.wgsl"

@group(2) @binding(0) var<storage, read> corners: array<SampleCorner>;
@group(2) @binding(1) var<storage, read> ways: array<SampleWay>;
@group(2) @binding(2) var<storage, read_write> ranges: array<atomic<u32>>;

// Of an invocation.
const PIXELS: u32 = 64u;

fn add_to(face: u32, least: vec2<f32>, most: vec2<f32>) {
    atomicMax(&ranges[4u * face], ordered(-least.x));
    atomicMax(&ranges[4u * face + 1u], ordered(-least.y));
    atomicMax(&ranges[4u * face + 2u], ordered(most.x));
    atomicMax(&ranges[4u * face + 3u], ordered(most.y));
}

@compute @workgroup_size(64)
fn fit(@builtin(global_invocation_id) at: vec3<u32>, @builtin(num_workgroups) workgroups: vec3<u32>) {
    let first = PIXELS * invocation(at, workgroups);
    let end = min(first + PIXELS, arrayLength(&ways));
    // Neighbours are mostly on one face.
    var face = 6u;
    var least = vec2<f32>(0.0);
    var most = vec2<f32>(0.0);
    for (var pixel = first; pixel < end; pixel++) {
        let from_corner = ways[pixel];
        if from_corner.place == 0u {
            continue;
        }
        let way = (corners[pixel].corner - origin()) + from_corner.way;
        let its = face_of(way);
        let at = place_on_face(on_face(way, its));
        if its != face {
            if face < 6u {
                add_to(face, least, most);
            }
            face = its;
            least = at;
            most = at;
        }
        least = min(least, at);
        most = max(most, at);
    }
    if face < 6u {
        add_to(face, least, most);
    }
}
