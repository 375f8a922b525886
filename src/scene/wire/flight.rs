//! The camera and the light of a scene file.

use glam::{DVec3, Vec3};
use serde::Deserialize;
use toml::Spanned;

use super::sun::SunWire;
use super::{Misplaced, misplaced};
use crate::scene::camera::{CameraKey, CameraPath};
use crate::scene::file::CameraUnit;
use crate::scene::light::{Light, LightError};
use crate::scene::light_keys::{LightKey, LightKeys};
use crate::scene::light_path::LightPath;
use crate::scene::view::{CameraError, radians};
use crate::toml_array::Exactly;

/// A light that stands still has a position, and one that moves has keys or is the sun.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct LightWire {
    position: Option<Spanned<Exactly<f64, 3>>>,
    keys: Option<Spanned<Vec<Spanned<LightKeyWire>>>>,
    w: Option<Spanned<f64>>,
    sun: Option<Spanned<SunWire>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct LightKeyWire {
    time_s: f64,
    position: Spanned<Exactly<f64, 3>>,
}

impl LightWire {
    /// `camera_s` is how long the camera flies.
    pub(super) fn check(light: &Spanned<Self>, camera_s: f64) -> Result<LightPath, Misplaced> {
        let wire = light.get_ref();
        if let Some(sun) = &wire.sun {
            wire.refuse_beside(sun)?;
            return Ok(LightPath::Sun(Box::new(SunWire::check(sun, camera_s)?)));
        }
        match (&wire.position, &wire.keys) {
            (Some(position), None) => Ok(LightPath::still(wire.light(position)?)),
            (None, Some(keys)) => wire.path(keys).map(LightPath::Keys),
            (Some(position), Some(_)) => Err(misplaced(
                position,
                &"a light stands still at its `position` or moves through its `keys`; remove one of them",
            )),
            (None, None) => Err(misplaced(
                light,
                &"a light needs a `position`, `keys` to move through, or a `sun`",
            )),
        }
    }

    fn refuse_beside(&self, sun: &Spanned<SunWire>) -> Result<(), Misplaced> {
        match self.position.is_some() || self.keys.is_some() || self.w.is_some() {
            true => Err(misplaced(
                sun,
                &"a sun says where the light is; remove `position`, `keys` and `w`",
            )),
            false => Ok(()),
        }
    }

    fn light(&self, position: &Spanned<Exactly<f64, 3>>) -> Result<Light, Misplaced> {
        let xyz = DVec3::from_array(position.get_ref().0);
        let w = self.w.as_ref().map_or(1.0, |w| *w.get_ref());
        Light::new(xyz, w).map_err(|error| match (error, &self.w) {
            (LightError::Weight(_), Some(w)) => misplaced(w, &error),
            _ => misplaced(position, &error),
        })
    }

    fn path(&self, keys: &Spanned<Vec<Spanned<LightKeyWire>>>) -> Result<LightKeys, Misplaced> {
        let wires = keys.get_ref();
        let mut path = LightKeys {
            keys: Vec::with_capacity(wires.len()),
            w: 1.0,
            radius: 0.0,
        };
        for key in wires {
            let LightKeyWire { time_s, position } = key.get_ref();
            let light = self.light(position)?;
            path.w = light.place.w;
            path.keys.push(LightKey {
                time_s: *time_s,
                place: light.place.truncate(),
            });
        }
        path.validate()
            .map_err(|error| match error.key.and_then(|key| wires.get(key)) {
                Some(key) => misplaced(key, &error),
                None => misplaced(keys, &error),
            })?;
        Ok(path)
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CameraWire {
    fov_deg: Spanned<f64>,
    near: Spanned<f32>,
    #[serde(default)]
    pub(super) unit: CameraUnit,
    #[serde(default)]
    up: Option<Spanned<Exactly<f32, 3>>>,
    keys: Spanned<Vec<Spanned<KeyWire>>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct KeyWire {
    time_s: f64,
    eye: Exactly<f32, 3>,
    target: Exactly<f32, 3>,
}

impl CameraWire {
    pub(super) fn check(self) -> Result<CameraPath, Misplaced> {
        let key = |key: &Spanned<KeyWire>| {
            let &KeyWire {
                time_s,
                eye,
                target,
            } = key.get_ref();
            CameraKey {
                time_s,
                eye: Vec3::from_array(eye.0),
                target: Vec3::from_array(target.0),
            }
        };
        let path = CameraPath {
            keys: self.keys.get_ref().iter().map(key).collect(),
            up: self
                .up
                .as_ref()
                .map_or(Vec3::Y, |up| Vec3::from_array(up.get_ref().0)),
            fov_y_rad: radians(*self.fov_deg.get_ref()),
            near: *self.near.get_ref(),
        };
        path.validate().map_err(|error| {
            let at_key = error.key.and_then(|key| self.keys.get_ref().get(key));
            let span = match (error.problem, at_key) {
                (CameraError::FieldOfView, _) => self.fov_deg.span(),
                (CameraError::Near, _) => self.near.span(),
                (_, Some(key)) => key.span(),
                (_, None) => self.keys.span(),
            };
            Misplaced {
                span,
                message: error.to_string(),
            }
        })?;
        Ok(path)
    }
}
