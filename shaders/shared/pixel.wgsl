// What a pixel is in the buffers of src/frame/pixel_buffers.rs.
//
// A word of `surfaces` has two numbers from -1 to 1, packed: how far the normal points up, and the cosine of the light's
// angle. The last bit of the first, which nobody would see, says that the surface's depth is to be moved.

// Where there is no surface: what no two numbers are packed to.
const NO_SURFACE: u32 = 0x80008000u;

const IS_MOVED: u32 = 1u;

// Pixels from one row to the next.
override row_px: u32;

// Given its centre.
fn pixel_index(at: vec4<f32>) -> u32 {
    return u32(at.y) * row_px + u32(at.x);
}
