//! Which way the sky's directions are in a model.

use glam::DVec3;

use super::sky::SunPosition;

/// Closer than this, rounding decides where north is.
const SMALLEST_SINE: f64 = 1e-4;

/// North and up in world space. East is on the right of who looks north: worlds are right-handed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Compass {
    /// As given, of any length.
    north: DVec3,
    up: DVec3,
}

/// Why north and up are no compass.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CompassError {
    /// North is no direction.
    #[error("north must be a direction: finite numbers, not all 0")]
    North,
    /// Up is no direction.
    #[error("up must be a direction: finite numbers, not all 0")]
    Up,
    /// They are one line.
    #[error("north and up lie on one line; give another north")]
    OneLine,
}

impl Default for Compass {
    /// Up is y and north is −z, so that east is x: a map with x to the east and y to the north lies so once its z
    /// points up.
    fn default() -> Self {
        Self {
            north: DVec3::NEG_Z,
            up: DVec3::Y,
        }
    }
}

impl Compass {
    /// From north and up, whose lengths do not matter. North may slope; what counts is where it points over the
    /// ground.
    ///
    /// # Errors
    /// When they are no directions, or on one line.
    pub fn new(north: DVec3, up: DVec3) -> Result<Self, CompassError> {
        let unit_north = unit(north).ok_or(CompassError::North)?;
        let unit_up = unit(up).ok_or(CompassError::Up)?;
        if unit_north.cross(unit_up).length() < SMALLEST_SINE {
            return Err(CompassError::OneLine);
        }
        Ok(Self { north, up })
    }

    /// North as it was given.
    #[must_use]
    pub fn north(&self) -> DVec3 {
        self.north
    }

    /// Up as it was given.
    #[must_use]
    pub fn up(&self) -> DVec3 {
        self.up
    }

    /// The unit vector towards a place in the sky.
    #[must_use]
    pub fn towards(&self, position: SunPosition) -> DVec3 {
        let up = unit(self.up).unwrap_or(DVec3::Y);
        let east = unit(self.north)
            .unwrap_or(DVec3::NEG_Z)
            .cross(up)
            .normalize_or_zero();
        let north = up.cross(east);
        let (sin_azimuth, cos_azimuth) = position.azimuth_deg.to_radians().sin_cos();
        let (sin_elevation, cos_elevation) = position.elevation_deg.to_radians().sin_cos();
        cos_elevation * (sin_azimuth * east + cos_azimuth * north) + sin_elevation * up
    }
}

/// The direction with length 1, also of numbers whose squares overflow or vanish.
fn unit(direction: DVec3) -> Option<DVec3> {
    let largest = direction.abs().max_element();
    (largest.is_finite() && largest > 0.0).then(|| (direction / largest).normalize())
}
