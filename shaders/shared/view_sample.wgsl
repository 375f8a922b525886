// What a picture shows at a pixel whose light is in question.
struct ViewSample {
    corner: vec3<f32>,
    uncertainty: f32,
    way: vec3<f32>,
    // 0 where there is nothing to ask, else what a method makes of it.
    place: u32,
}

fn point_of(sample: ViewSample) -> SurfacePoint {
    return SurfacePoint(sample.corner, sample.way, sample.uncertainty);
}

// Its point again, to be read at a first look.
struct SamplePoint {
    at: vec3<f32>,
    // What a method makes of it.
    word: u32,
}
