#include "methods/silhouette_cs/blocks.wgsl"
#include "methods/silhouette_cs/facing_bits.wgsl"

// See find_facings.wgsl.
@group(1) @binding(2) var<storage, read> facings: array<vec2<u32>>;

fn facing_of(triangle: u32) -> i32 {
    return facing_in(facings[triangle / 32u], triangle);
}

// Whether front caps are counted wherever they are, and whether back caps are made of the triangles that do not cast.
override front_everywhere: bool;
override far_triangles: bool;

// Which caps a triangle of this facing has, but for those that are fans.
struct TriangleCaps {
    front: bool,
    back: bool,
}

fn triangle_caps(plan: Plan, facing: i32) -> TriangleCaps {
    if !plan.is_drawn || plan.z_pass {
        return TriangleCaps(false, false);
    }
    let casts = facing == 1 || (facing == -1 && plan.casting == ALL);
    let others_behind = far_triangles && plan.casting == LIGHT_FACING;
    return TriangleCaps(
        casts && !plan.fan_in_front,
        casts != others_behind && !plan.fan_behind && !plan.far_ends_meet,
    );
}
