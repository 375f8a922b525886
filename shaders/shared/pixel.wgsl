// Where a pixel is in the buffers of src/frame/pixel_buffers.rs.

// Pixels from one row to the next.
override row_px: u32;

// Given its centre.
fn pixel_index(at: vec4<f32>) -> u32 {
    return u32(at.y) * row_px + u32(at.x);
}
