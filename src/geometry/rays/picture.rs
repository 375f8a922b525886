//! A view and its light, as rays need them.

use glam::{Mat4, Vec3, Vec4};

/// A view and its light.
#[derive(Clone, Copy, Debug)]
pub struct Picture {
    /// Its size in pixels.
    pub size_px: [usize; 2],
    /// Where it is seen from.
    pub eye: Vec3,
    /// Maps normalised x and y, with z = 0 and w = 1, to a vector from the eye.
    pub clip_to_eye_ray: Mat4,
    /// Position (w = 1), or direction towards it (w = 0).
    pub light: Vec4,
}
