// Holds triangles against the samples of tiles that they cut: a workgroup a tile.
#include "shared/frame.wgsl"
#include "shared/pixels.wgsl"
#include "methods/triangle_frusta/frustum.wgsl"

@compute @workgroup_size(TILE_PIXELS)
fn cast_parts(
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(num_workgroups) workgroups: vec3<u32>,
    @builtin(local_invocation_index) lane: u32,
) {
    let number = workgroup.y * workgroups.x + workgroup.x;
    if number >= part_count() {
        return;
    }
    let part = part_at(number);
    let at = corner_of(part.place) + vec2<u32>(lane % TILE, lane / TILE);
    if all(at < vec2<u32>(frame.picture.xy)) {
        darken_if_behind(pixel_at(at), blocker(casters[part.triangle], frame.light));
    }
}
