//! Where the sun stands in the sky of a place on earth, and when it rises and sets.
//!
//! By NREL's SPA (I. Reda, A. Andreas: *Solar Position Algorithm for Solar Radiation Applications*,
//! NREL/TP-560-34302, 2003), good to 0.0003°. The elevation is the apparent one, raised by refraction in a standard
//! atmosphere: that is the direction from which light comes to the ground. Heights above the sea and the size of the
//! sun's disc are left out; "above the horizon" is said of its centre.

use std::ops::Range;

use jiff::Timestamp;
use jiff::tz::TimeZone;
use solar_positioning::time::JulianDate;
use solar_positioning::{ElevationTarget, Location, RefractionCorrection, SolarPositions, delta_t};

use super::clock::local_time;

/// The Julian date at the start of Unix time.
const UNIX_EPOCH_JD: f64 = 2_440_587.5;
const DAY_S: f64 = 86_400.0;
/// More rises or sets than a day may have, wherever.
const MAX_CROSSINGS: usize = 4;

/// A place on earth, at the height of the sea.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Site {
    latitude_deg: f64,
    longitude_deg: f64,
}

/// Why there is no such place.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum SiteError {
    /// Beyond a pole.
    #[error("a latitude is from -90 to 90 degrees, north positive; {0} is not")]
    Latitude(f64),
    /// More than half around the earth.
    #[error("a longitude is from -180 to 180 degrees, east positive; {0} is not")]
    Longitude(f64),
}

/// Why the sun's place is not known.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("the sun's place is known for the years -499 to 2999")]
pub struct SkyError;

/// Where the sun stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SunPosition {
    /// Clockwise from north: 90 is east.
    pub azimuth_deg: f64,
    /// Of the sun's centre above the horizon, with refraction.
    pub elevation_deg: f64,
}

/// When the sun's centre is above the horizon.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Daylight {
    /// All the time.
    Always,
    /// At no time.
    Never,
    /// From each rise to the next set.
    Crossings {
        /// When it rises.
        rises: Vec<Timestamp>,
        /// When it sets.
        sets: Vec<Timestamp>,
    },
}

impl Site {
    /// A place by its degrees.
    ///
    /// # Errors
    /// When they are out of range.
    pub fn new(latitude_deg: f64, longitude_deg: f64) -> Result<Self, SiteError> {
        if !(-90.0..=90.0).contains(&latitude_deg) {
            return Err(SiteError::Latitude(latitude_deg));
        }
        if !(-180.0..=180.0).contains(&longitude_deg) {
            return Err(SiteError::Longitude(longitude_deg));
        }
        Ok(Self {
            latitude_deg,
            longitude_deg,
        })
    }

    /// Degrees north of the equator.
    #[must_use]
    pub fn latitude_deg(&self) -> f64 {
        self.latitude_deg
    }

    /// Degrees east of Greenwich.
    #[must_use]
    pub fn longitude_deg(&self) -> f64 {
        self.longitude_deg
    }

    fn location(&self) -> Location {
        Location {
            latitude: self.latitude_deg,
            longitude: self.longitude_deg,
        }
    }

    /// Where the sun stands at a time.
    ///
    /// # Errors
    /// When the year is too far away.
    pub fn sun_at(&self, time: Timestamp) -> Result<SunPosition, SkyError> {
        let date = JulianDate::new(julian_date(time), delta_t_s(time)?).map_err(|_| SkyError)?;
        let refraction = Some(RefractionCorrection::standard());
        let position = SolarPositions::new().at_from_julian(date, self.location(), 0.0, refraction);
        let position = position.map_err(|_| SkyError)?;
        Ok(SunPosition {
            azimuth_deg: position.azimuth(),
            elevation_deg: position.elevation_angle(),
        })
    }

    /// The first set after the start and not after the end.
    ///
    /// # Errors
    /// When the year is too far away.
    pub(super) fn next_set(&self, span: Range<Timestamp>) -> Result<Option<Timestamp>, SkyError> {
        Ok(self.crossings(span, false)?.into_iter().next())
    }

    /// When the sun is above the horizon between two times of about a day.
    ///
    /// # Errors
    /// When the year is too far away.
    pub fn daylight(&self, span: Range<Timestamp>) -> Result<Daylight, SkyError> {
        let rises = self.crossings(span.clone(), true)?;
        let sets = self.crossings(span.clone(), false)?;
        Ok(match rises.is_empty() && sets.is_empty() {
            false => Daylight::Crossings { rises, sets },
            true if self.sun_at(span.start)?.elevation_deg > 0.0 => Daylight::Always,
            true => Daylight::Never,
        })
    }

    fn crossings(&self, span: Range<Timestamp>, rises: bool) -> Result<Vec<Timestamp>, SkyError> {
        let target = ElevationTarget {
            angle: 0.0,
            height: 0.0,
            refraction: Some(RefractionCorrection::standard()),
        };
        let (sun, delta_t_s) = (SolarPositions::new(), delta_t_s(span.start)?);
        let (mut from, to) = (julian_date(span.start), julian_date(span.end));
        let mut found = Vec::new();
        while found.len() < MAX_CROSSINGS {
            let place = self.location();
            let next = match rises {
                true => sun.next_elevation_rise_from_julian(from, to, place, delta_t_s, target),
                false => sun.next_elevation_set_from_julian(from, to, place, delta_t_s, target),
            };
            let Some(next) = next.map_err(|_| SkyError)? else {
                break;
            };
            found.push(timestamp(next)?);
            from = next;
        }
        Ok(found)
    }
}

impl Daylight {
    /// When the sun rises and sets, in a sentence.
    #[must_use]
    pub fn in_words(&self, zone: &TimeZone) -> String {
        let (rises, sets) = match self {
            Self::Always => return "that day it does not set".to_owned(),
            Self::Never => return "that day it does not rise".to_owned(),
            Self::Crossings { rises, sets } => (rises, sets),
        };
        let list = |verb: &str, times: &[Timestamp]| {
            let times: Vec<_> = times.iter().map(|time| local_time(*time, zone)).collect();
            (!times.is_empty()).then(|| format!("{verb} at {}", times.join(" and ")))
        };
        let parts: Vec<_> = [list("rises", rises), list("sets", sets)]
            .into_iter()
            .flatten()
            .collect();
        format!("that day it {}", parts.join(" and "))
    }
}

fn julian_date(time: Timestamp) -> f64 {
    UNIX_EPOCH_JD + time.as_duration().as_secs_f64() / DAY_S
}

fn timestamp(julian_date: f64) -> Result<Timestamp, SkyError> {
    let seconds = ((julian_date - UNIX_EPOCH_JD) * DAY_S).round();
    Timestamp::from_second(seconds as i64).map_err(|_| SkyError)
}

/// Terrestrial less universal time, as estimated for the month.
fn delta_t_s(time: Timestamp) -> Result<f64, SkyError> {
    let date = TimeZone::UTC.to_datetime(time);
    delta_t::estimate_from_date(
        i32::from(date.year()),
        u32::from(date.month().unsigned_abs()),
    )
    .map_err(|_| SkyError)
}
