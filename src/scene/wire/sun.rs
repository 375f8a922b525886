//! The sun of a scene file.

use glam::DVec3;
use serde::Deserialize;
use toml::Spanned;

use super::{Misplaced, misplaced};
use crate::scene::sun::{
    Compass, CompassError, LocalDay, Site, SiteError, Sun, SunCourse, SunError, parse_date,
    parse_time,
};
use crate::toml_array::Exactly;

/// A sun that stands still has a time, and one that moves goes from one time to another.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SunWire {
    latitude: Spanned<f64>,
    longitude: Spanned<f64>,
    date: Spanned<String>,
    zone: Spanned<String>,
    time: Option<Spanned<String>>,
    from: Option<Spanned<String>>,
    to: Option<Spanned<String>>,
    duration_s: Option<Spanned<f64>>,
    north: Option<Spanned<Exactly<f64, 3>>>,
    up: Option<Spanned<Exactly<f64, 3>>>,
}

impl SunWire {
    /// `camera_s` is how long the camera flies: so long the sun's way takes unless the file says otherwise.
    pub(super) fn check(sun: &Spanned<Self>, camera_s: f64) -> Result<Sun, Misplaced> {
        let wire = sun.get_ref();
        let (from, to) = wire.times(sun)?;
        let date =
            parse_date(wire.date.get_ref()).map_err(|error| misplaced(&wire.date, &error))?;
        let day = LocalDay::new(date, wire.zone.get_ref());
        let day = day.map_err(|error| misplaced(&wire.zone, &error))?;
        let time = |text: &Spanned<String>| {
            parse_time(text.get_ref()).map_err(|error| misplaced(text, &error))
        };
        let course = SunCourse {
            day,
            from: time(from)?,
            to: time(to)?,
            duration_s: wire.duration_s.as_ref().map_or(camera_s, |s| *s.get_ref()),
        };
        Sun::new(wire.site()?, wire.compass()?, course).map_err(|error| match error {
            SunError::From(_) | SunError::Night(_) => misplaced(from, &error),
            SunError::To(_) | SunError::Backward { .. } => misplaced(to, &error),
            SunError::Sky(_) => misplaced(&wire.date, &error),
            SunError::Duration => match &wire.duration_s {
                Some(duration_s) => misplaced(duration_s, &error),
                None => misplaced(
                    sun,
                    &"the camera stands still, so the sun needs `duration_s`, the length of its way on the flight",
                ),
            },
        })
    }

    fn times<'a>(
        &'a self,
        sun: &Spanned<Self>,
    ) -> Result<(&'a Spanned<String>, &'a Spanned<String>), Misplaced> {
        match (&self.time, &self.from, &self.to) {
            (Some(time), None, None) => match &self.duration_s {
                Some(duration_s) => Err(misplaced(
                    duration_s,
                    &"a sun with a `time` stands still and has no `duration_s`; remove it",
                )),
                None => Ok((time, time)),
            },
            (None, Some(from), Some(to)) => Ok((from, to)),
            _ => Err(misplaced(
                sun,
                &"a sun stands still at a `time`, or goes `from` one time `to` another",
            )),
        }
    }

    fn site(&self) -> Result<Site, Misplaced> {
        let site = Site::new(*self.latitude.get_ref(), *self.longitude.get_ref());
        site.map_err(|error| match error {
            SiteError::Latitude(_) => misplaced(&self.latitude, &error),
            SiteError::Longitude(_) => misplaced(&self.longitude, &error),
        })
    }

    fn compass(&self) -> Result<Compass, Misplaced> {
        let vector = |given: &Option<Spanned<Exactly<f64, 3>>>, usual: DVec3| {
            given
                .as_ref()
                .map_or(usual, |given| DVec3::from_array(given.get_ref().0))
        };
        let usual = Compass::default();
        let north = vector(&self.north, usual.north());
        let compass = Compass::new(north, vector(&self.up, usual.up()));
        compass.map_err(|error| {
            let spans = match error {
                CompassError::Up => [&self.up, &self.north],
                CompassError::North | CompassError::OneLine => [&self.north, &self.up],
            };
            let given = spans.into_iter().flatten().next();
            Misplaced {
                span: given.map_or(0..0, Spanned::span),
                message: error.to_string(),
            }
        })
    }
}

#[cfg(test)]
#[path = "sun_tests.rs"]
mod tests;
