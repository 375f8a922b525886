// Brings samples into the lists of their cells: links them, or counts them for `sort_samples`.
#include "shared/frame.wgsl"
#include "shared/pixels.wgsl"
#include "shared/view_sample.wgsl"
#include "methods/alias_free_map/light_map.wgsl"

@group(2) @binding(0) var<storage, read> corners: array<SampleCorner>;
@group(2) @binding(4) var<storage, read_write> ways: array<SampleWay>;
@group(2) @binding(1) var<storage, read> ranges: array<Range>;
@group(2) @binding(2) var<storage, read_write> cells: array<atomic<u32>>;
// Each with the next pixel of the list plus 1, or how many came before.
@group(2) @binding(3) var<storage, read_write> points: array<SamplePoint>;

@compute @workgroup_size(8, 8)
fn place_samples(@builtin(global_invocation_id) at: vec3<u32>) {
    if any(at.xy >= vec2<u32>(frame.picture.xy)) {
        return;
    }
    let pixel = pixel_at(at.xy);
    let from_corner = ways[pixel];
    if from_corner.place == 0u {
        return;
    }
    let way = (corners[pixel].corner - origin()) + from_corner.way;
    let face_number = face_of(way);
    let place = on_face(way, face_number);
    let face = face_from(ranges[face_number]);
    let last = vec2<f32>(f32(resolution - 1u));
    let cell = vec2<u32>(clamp((place_on_face(place) - face.low) * face.cells, vec2<f32>(0.0), last));
    let index = cell_index(face_number, cell);
    let tile = tile_index(face_number, cell / TILE) * TILE_WORDS;
    let depth = ordered(depth_of(way, place));
    if is_sorted {
        ways[pixel].place = 1u + index;
        points[pixel].word = atomicAdd(&cells[index], 1u);
    } else {
        points[pixel].word = atomicExchange(&cells[index], pixel + 1u);
    }
    atomicMax(&cells[index + REACH], depth);
    // Mostly another has been there.
    if atomicLoad(&cells[tile + TILE_END + REACH]) < depth {
        atomicMax(&cells[tile + TILE_END + REACH], depth);
    }
}
