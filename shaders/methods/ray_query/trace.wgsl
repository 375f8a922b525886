// A shadow ray a pixel, through the device's own acceleration structure.
enable wgpu_ray_query;
#include "shared/trace.wgsl"

@group(2) @binding(2) var<storage, read> casters: array<Caster>;
@group(2) @binding(3) var structure: acceleration_structure;

// Every triangle that a ray meets is shown to the shader.
const NO_OPAQUE: u32 = 2u;

// See `SLACK` in src/methods/ray_query.rs.
override slack: f32;

fn is_blocked(point: SurfacePoint) -> bool {
    let light = frame.light;
    let place = point.corner + point.way;
    let end = select(1.0, 3e38, light.w == 0.0);
    var ray: ray_query;
    rayQueryInitialize(&ray, structure, RayDesc(NO_OPAQUE, 0xffu, 0.0, end, place, light.xyz - place * light.w));
    while rayQueryProceed(&ray) {
        let met = rayQueryGetCandidateIntersection(&ray).primitive_index;
        if blocks(casters[met], light, point, slack) {
            return true;
        }
    }
    return false;
}
