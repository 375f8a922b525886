//! The depth buffer of a frame: what of it may be varied for study.

use crate::gpu::{Capability, DepthDirection, Gpu};
use crate::scene::View;
use glam::{Mat4, Vec4};
use serde::{Deserialize, Serialize};

/// How finely depth is stored.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum DepthFormat {
    /// 32 bits, floating point.
    #[default]
    Float32,
    /// 24 bits, evenly spaced from 0 to 1.
    Unorm24,
}

/// Which objects the G-buffer draws.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Visibility {
    /// Those whose boxes are in view.
    #[default]
    Frustum,
    /// Of these, those that others do not hide (see [`crate::frame::occlusion`]).
    Occlusion,
}

/// The depth buffer that a frame is drawn with.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct DepthSetup {
    /// Which way depth runs.
    pub direction: DepthDirection,
    /// How finely it is stored.
    pub format: DepthFormat,
    /// Distance of the near plane; by default the camera's.
    pub near: Option<f32>,
    /// Whether native fragment shaders read and write the stencil.
    pub stencil_in_shaders: bool,
    /// What is drawn into it.
    pub visibility: Visibility,
}

impl DepthSetup {
    /// Whether the device can draw with it.
    ///
    /// # Errors
    /// The reason why not, as a sentence for people.
    pub fn check(&self, gpu: &Gpu) -> Result<(), String> {
        match self.format {
            DepthFormat::Float32 => {}
            DepthFormat::Unorm24 => gpu.check(Capability::Depth24)?,
        }
        if self.stencil_in_shaders {
            gpu.check(Capability::StencilExport)?;
            gpu.check(Capability::StencilInput)?;
        }
        Ok(())
    }

    pub(super) fn texture_format(&self, gpu: &Gpu) -> wgpu::TextureFormat {
        match self.format {
            DepthFormat::Float32 => gpu.depth_format(),
            DepthFormat::Unorm24 => wgpu::TextureFormat::Depth24PlusStencil8,
        }
    }

    /// The view with the near plane of this setup.
    pub(super) fn near_plane_of(&self, view: &View) -> View {
        View {
            near: self.near.unwrap_or(view.near),
            ..*view
        }
    }

    /// World to clip space as the device uses it, from the matrix for reversed depth.
    ///
    /// Reversed, clip z is `near` for every point and clip w its distance before the eye; turned
    /// round, z is w - near. Each entry is exact but the last: a point at infinity gets the bits of
    /// its w as its z, and lies on the far plane.
    pub(super) fn device_projection(&self, reversed: Mat4) -> Mat4 {
        match self.direction {
            DepthDirection::Reversed => reversed,
            DepthDirection::Standard => {
                let rows = [0, 1, 2, 3].map(|row| reversed.row(row));
                let [x, y, z, w]: [Vec4; 4] = rows;
                Mat4::from_cols(x, y, w - z, w).transpose()
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    #[test]
    fn turned_round_depth_runs_from_0_to_1() {
        let view = View {
            eye: Vec3::new(3.0, 4.0, 5.0),
            target: Vec3::ZERO,
            up: Vec3::Y,
            fov_y_rad: 1.0,
            near: 0.25,
        };
        let setup = DepthSetup {
            direction: DepthDirection::Standard,
            near: Some(0.5),
            ..DepthSetup::default()
        };
        let view = setup.near_plane_of(&view);
        let reversed = view.view_projection(1.5);
        let standard = setup.device_projection(reversed);
        let forward = (view.target - view.eye).normalize();
        let depth = |matrix: Mat4, distance: f32| {
            let clip = matrix * (view.eye + distance * forward).extend(1.0);
            clip.z / clip.w
        };
        for (distance, expected) in [(0.5, 0.0), (1.0, 0.5), (50.0, 0.99)] {
            let found = depth(standard, distance);
            assert!((found - expected).abs() < 1e-5, "{distance}: {found}");
            assert!((depth(reversed, distance) - (1.0 - expected)).abs() < 1e-5);
        }
        for direction in [forward, Vec3::new(-0.3, -0.7, -0.9)] {
            let clip = standard * direction.extend(0.0);
            assert_eq!(clip.z, clip.w);
        }
    }
}
