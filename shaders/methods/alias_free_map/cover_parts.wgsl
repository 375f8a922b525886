// Shadows what large triangles cover in the light's map: a workgroup a part.
#include "shared/frame.wgsl"
#include "shared/pixels.wgsl"
#include "methods/alias_free_map/covered.wgsl"

const LANES: u32 = 64u;

@compute @workgroup_size(LANES)
fn cover_parts(
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(num_workgroups) workgroups: vec3<u32>,
    @builtin(local_invocation_index) lane: u32,
) {
    let number = number_of(workgroup, workgroups);
    if number >= part_count() {
        return;
    }
    let part = part_at(number);
    let caster = casters[part.item];
    let tile = part.place;
    let of_caster = blocker(caster, frame.light);
    if is_sorted {
        let end = cells[tile * TILE_WORDS + TILE_END];
        for (var sample = cells[tile * TILE_WORDS] + lane; sample < end; sample += LANES) {
            let point = points[sample];
            darken_if_behind(point.word, point.at, of_caster);
        }
        return;
    }
    let tiles = resolution / TILE;
    let face = tile / (tiles * tiles);
    let first = TILE * vec2<u32>(tile % tiles, tile / tiles % tiles);
    let covered = coverage(caster, face);
    let low = max(first, covered.first);
    let size = min(first + TILE, covered.last + 1u) - low;
    for (var number = lane; number < size.x * size.y; number += LANES) {
        let cell = low + vec2<u32>(number % size.x, number / size.x);
        darken_cell(face, cell, covered, of_caster);
    }
}
