//! Values on the command line.

use crate::scene::Light;
use glam::{DVec3, Vec3};
use std::str::FromStr;

/// `640x480`.
pub(super) fn size(text: &str) -> Result<(u32, u32), String> {
    let error = || format!("`{text}` is not a size like 1024x768");
    let (width, height) = text.split_once(['x', 'X']).ok_or_else(error)?;
    let side = |text: &str| text.trim().parse::<u32>().map_err(|_| error());
    let size = (side(width)?, side(height)?);
    if size.0 == 0 || size.1 == 0 {
        return Err("both sides must be at least 1 pixel".to_owned());
    }
    Ok(size)
}

/// `1.5,2,-3`.
pub(super) fn vec3(text: &str) -> Result<Vec3, String> {
    let numbers = numbers::<f32>(text)?;
    <[f32; 3]>::try_from(numbers)
        .map(Vec3::from)
        .map_err(|_| format!("`{text}` is not three numbers X,Y,Z"))
}

/// The same with all digits.
pub(super) fn dvec3(text: &str) -> Result<DVec3, String> {
    let numbers = numbers::<f64>(text)?;
    <[f64; 3]>::try_from(numbers)
        .map(DVec3::from)
        .map_err(|_| format!("`{text}` is not three numbers X,Y,Z"))
}

/// `1.5,2,-3`, a point, or `1,2,3,0`, a direction.
pub(super) fn light(text: &str) -> Result<Light, String> {
    let (xyz, w) = match numbers(text)?[..] {
        [x, y, z] => (DVec3::new(x, y, z), 1.0),
        [x, y, z, w] => (DVec3::new(x, y, z), w),
        _ => return Err(format!("`{text}` is not X,Y,Z or X,Y,Z,W")),
    };
    Light::new(xyz, w).map_err(|error| error.to_string())
}

fn numbers<N: FromStr + Into<f64> + Copy>(text: &str) -> Result<Vec<N>, String> {
    let number = |part: &str| match part.trim().parse::<N>() {
        Ok(value) if value.into().is_finite() => Ok(value),
        _ => Err(format!("`{part}` is not a finite number")),
    };
    text.split(',').map(number).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec4;

    #[test]
    fn sizes() {
        assert_eq!(size("640x480"), Ok((640, 480)));
        for wrong in ["640", "0x480", "640x-1", "x", "1e3x4", "99999999999x1"] {
            assert!(size(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn vectors_and_lights() {
        assert_eq!(vec3("1,-2.5,3e2"), Ok(Vec3::new(1.0, -2.5, 300.0)));
        assert_eq!(light("1,2,3"), Ok(Light::at(Vec4::new(1.0, 2.0, 3.0, 1.0))));
        for direction in ["1,2,4,0", "1e-300,2e-300,4e-300,0", "2.5e299,5e299,1e300,0"] {
            assert_eq!(
                light(direction),
                Ok(Light::at(Vec4::new(0.25, 0.5, 1.0, 0.0)))
            );
        }
        for wrong in [
            "",
            "1,2",
            "1,2,nan",
            "1,2,3,0.5",
            "0,0,0,0",
            "1,2,3,1,1",
            "1,2,inf",
        ] {
            assert!(light(wrong).is_err(), "{wrong}");
        }
    }
}
