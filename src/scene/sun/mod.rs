//! The sun: a light at infinity whose direction is computed from a place on earth and a time.
//!
//! [`Site`] knows where the sun stands in the sky, [`Compass`] which way that is in a model, [`LocalDay`] when a
//! clock shows a time; [`Sun`] is all of it over a flight.

mod clock;
mod compass;
mod sky;

use glam::DVec3;
use jiff::Timestamp;

use super::light::{Light, direction};

pub use clock::{ClockError, LocalDay, local_time, parse_date, parse_time, parse_zone};
pub use compass::{Compass, CompassError};
pub use sky::{Daylight, Site, SiteError, SkyError, SunPosition};

/// The way of the sun over a flight, on one day and above the horizon all the while.
#[derive(Clone, Debug, PartialEq)]
pub struct Sun {
    site: Site,
    compass: Compass,
    course: SunCourse,
    start: Timestamp,
    end: Timestamp,
}

/// When the sun shines.
#[derive(Clone, Debug, PartialEq)]
pub struct SunCourse {
    /// The date and its zone.
    pub day: LocalDay,
    /// Local time at the start of the flight.
    pub from: jiff::civil::Time,
    /// Local time at the end; the same as `from` where the sun stands still.
    pub to: jiff::civil::Time,
    /// How long on the flight the way takes; 0 where the sun stands still.
    pub duration_s: f64,
}

/// Why there is no such sun.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SunError {
    /// The clock never shows `from`.
    #[error("{0}")]
    From(ClockError),
    /// The clock never shows `to`.
    #[error("{0}")]
    To(ClockError),
    /// The end is before the start.
    #[error("{to} is before {from}: the times of a sun go forward, within one day")]
    Backward {
        /// The start.
        from: jiff::civil::Time,
        /// The end.
        to: jiff::civil::Time,
    },
    /// The way takes no time, or a negative one.
    #[error("the sun needs a time on the flight for its way, above 0 s")]
    Duration,
    /// Where the sun is cannot be computed.
    #[error("{0}")]
    Sky(SkyError),
    /// It is night.
    #[error("{0}")]
    Night(String),
}

impl Sun {
    /// The sun over `site` in a model that lies as `compass` says.
    ///
    /// # Errors
    /// When a time does not exist, or the sun is not above the horizon from the start to the end.
    pub fn new(site: Site, compass: Compass, mut course: SunCourse) -> Result<Self, SunError> {
        let SunCourse { from, to, .. } = course;
        let start = course.day.instant(from).map_err(SunError::From)?;
        let end = course.day.instant(to).map_err(SunError::To)?;
        if end < start {
            return Err(SunError::Backward { from, to });
        }
        let takes_time = course.duration_s.is_finite() && course.duration_s > 0.0;
        if end > start && !takes_time {
            return Err(SunError::Duration);
        }
        if end == start {
            course.duration_s = 0.0;
        }
        let sun = Self {
            site,
            compass,
            course,
            start,
            end,
        };
        sun.check_daylight()?;
        Ok(sun)
    }

    fn check_daylight(&self) -> Result<(), SunError> {
        let day = &self.course.day;
        let at_start = self.site.sun_at(self.start).map_err(SunError::Sky)?;
        if at_start.elevation_deg <= 0.0 {
            let daylight = self.site.daylight(day.bounds()).map_err(SunError::Sky)?;
            return Err(SunError::Night(format!(
                "at {} on {} the sun is {:.1}° below the horizon; {}",
                local_time(self.start, day.zone()),
                day.date(),
                -at_start.elevation_deg,
                daylight.in_words(day.zone())
            )));
        }
        let set = self.site.next_set(self.start..self.end);
        match set.map_err(SunError::Sky)? {
            None => Ok(()),
            Some(set) => Err(SunError::Night(format!(
                "the sun sets at {}, before the end at {}; let it end earlier",
                local_time(set, day.zone()),
                local_time(self.end, day.zone())
            ))),
        }
    }

    /// Where on earth the scene is.
    #[must_use]
    pub fn site(&self) -> Site {
        self.site
    }

    /// How the scene lies there.
    #[must_use]
    pub fn compass(&self) -> Compass {
        self.compass
    }

    /// When the sun shines.
    #[must_use]
    pub fn course(&self) -> &SunCourse {
        &self.course
    }

    /// How long its way takes on the flight.
    pub(super) fn duration_s(&self) -> f64 {
        self.course.duration_s
    }

    /// The time of day at a time of the flight.
    #[must_use]
    pub fn time_at(&self, time_s: f64) -> Timestamp {
        let duration_s = self.duration_s();
        if duration_s == 0.0 {
            return self.start;
        }
        let part = (time_s / duration_s).clamp(0.0, 1.0);
        let day = self.end.duration_since(self.start);
        let passed = day.as_secs_f64() * part;
        let passed = jiff::SignedDuration::try_from_secs_f64(passed).unwrap_or(day);
        self.start.saturating_add(passed).unwrap_or(self.end)
    }

    /// The light at a time of the flight.
    pub(super) fn light_at(&self, time_s: f64) -> Light {
        match self.site.sun_at(self.time_at(time_s)) {
            Ok(position) => self.compass.light(position),
            // Never, between two times that have one; else `Light::validate` says that there is no direction.
            Err(_) => Light::at(DVec3::ZERO.as_vec3().extend(0.0)),
        }
    }
}

impl Compass {
    /// The sun as a light.
    #[must_use]
    pub fn light(&self, position: SunPosition) -> Light {
        let towards = direction(self.towards(position));
        Light::at(towards.unwrap_or_default().extend(0.0))
    }
}

#[cfg(test)]
#[path = "tests.rs"]
mod tests;
