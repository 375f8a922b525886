// What a picture shows at the pixels whose light is in question, in two arrays, each no larger at 3840 × 2160 than the
// smallest limit of a buffer.
#include "shared/blocks.wgsl"
struct SampleCorner {
    corner: vec3<f32>,
    uncertainty: f32,
}

struct SampleWay {
    way: vec3<f32>,
    // 0 where there is nothing to ask, else what a method makes of it.
    place: u32,
}

fn sample_point(corner: SampleCorner, way: SampleWay) -> SurfacePoint {
    return SurfacePoint(corner.corner, way.way, corner.uncertainty);
}

// Its point again, to be read at a first look.
struct SamplePoint {
    at: vec3<f32>,
    // What a method makes of it.
    word: u32,
}
