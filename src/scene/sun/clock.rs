//! Dates, times and zones as people write them, and the moments that they mean.

use std::ops::Range;

use jiff::Timestamp;
use jiff::civil::{Date, DateTime, Time};
use jiff::fmt::temporal::DateTimeParser;
use jiff::tz::{AmbiguousOffset, TimeZone};

use crate::toml_error::nearest;

/// Why a clock never shows something.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ClockError {
    /// Not written like a date.
    #[error("`{0}` is not a date like 2026-09-18")]
    NoDate(String),
    /// No such month, or day of a month.
    #[error("there is no {text}: {why}")]
    NotInCalendar {
        /// The date.
        text: String,
        /// What is wrong with it.
        why: String,
    },
    /// Not written like a time.
    #[error("`{0}` is not a time of day like 09:30")]
    NoTime(String),
    /// No such zone.
    #[error("unknown time zone `{name}`{}; give a name like `Europe/Vienna` or an offset like `+01:00`", hint(nearest.as_deref()))]
    NoZone {
        /// The zone.
        name: String,
        /// The one that was probably meant.
        nearest: Option<String>,
    },
    /// Clocks leave it out.
    #[error(
        "on {date} clocks in {zone} do not show {time}: they go from {before} to {after} over it"
    )]
    Skipped {
        /// The date.
        date: Date,
        /// The time.
        time: Time,
        /// The zone.
        zone: String,
        /// The offset before.
        before: String,
        /// The offset after.
        after: String,
    },
    /// Clocks show it twice.
    #[error(
        "on {date} clocks in {zone} show {time} twice; give zone = \"{before}\" or zone = \"{after}\""
    )]
    Twice {
        /// The date.
        date: Date,
        /// The time.
        time: Time,
        /// The zone.
        zone: String,
        /// The offset before.
        before: String,
        /// The offset after.
        after: String,
    },
}

fn hint(nearest: Option<&str>) -> String {
    nearest.map_or(String::new(), |nearest| {
        format!("; did you mean `{nearest}`?")
    })
}

/// Reads `2026-09-18`.
///
/// # Errors
/// When it is no date.
pub fn parse_date(text: &str) -> Result<Date, ClockError> {
    let no_date = || ClockError::NoDate(text.to_owned());
    let parts: Vec<&str> = text.splitn(3, '-').collect();
    let [year, month, day] = parts[..] else {
        return Err(no_date());
    };
    let number = |part: &str, digits: usize| {
        let is_number = part.len() == digits && part.bytes().all(|byte| byte.is_ascii_digit());
        is_number.then(|| part.parse::<i16>().ok()).flatten()
    };
    let (Some(year), Some(month), Some(day)) = (number(year, 4), number(month, 2), number(day, 2))
    else {
        return Err(no_date());
    };
    let (month, day) = (month as i8, day as i8);
    Date::new(year, month, day).map_err(|_| ClockError::NotInCalendar {
        text: text.to_owned(),
        why: match Date::new(year, month, 1) {
            Ok(first) => format!(
                "{} has {} days",
                first.strftime("%B %Y"),
                first.days_in_month()
            ),
            Err(_) => "a year has 12 months".to_owned(),
        },
    })
}

/// Reads `09:30` or `09:30:15`.
///
/// # Errors
/// When it is no time of day.
pub fn parse_time(text: &str) -> Result<Time, ClockError> {
    let no_time = |_| ClockError::NoTime(text.to_owned());
    let is_plain = text
        .bytes()
        .all(|b| b.is_ascii_digit() || matches!(b, b':' | b'.'));
    if !is_plain || !text.contains(':') {
        return Err(ClockError::NoTime(text.to_owned()));
    }
    text.parse().map_err(no_time)
}

/// Reads the name of a zone or an offset.
///
/// # Errors
/// When there is no such zone.
pub fn parse_zone(text: &str) -> Result<TimeZone, ClockError> {
    let is_offset = text.starts_with(['+', '-']);
    let known = if is_offset {
        DateTimeParser::new().parse_time_zone(text)
    } else {
        TimeZone::get(text)
    };
    known.map_err(|_| {
        let names: Vec<_> = jiff::tz::db()
            .available()
            .map(|name| name.as_str().to_owned())
            .collect();
        ClockError::NoZone {
            name: text.to_owned(),
            nearest: nearest(text, names.iter().map(String::as_str)).map(str::to_owned),
        }
    })
}

/// Hours and minutes that a clock in `zone` shows, to the nearest minute.
#[must_use]
pub fn local_time(time: Timestamp, zone: &TimeZone) -> String {
    let minute = time.round(jiff::Unit::Minute).unwrap_or(time);
    zone.to_datetime(minute).strftime("%H:%M").to_string()
}

/// A date by the clocks of a zone.
#[derive(Clone, Debug, PartialEq)]
pub struct LocalDay {
    date: Date,
    zone: TimeZone,
    zone_name: String,
}

impl LocalDay {
    /// A date in the zone of this name, see [`parse_zone`].
    ///
    /// # Errors
    /// When there is no such zone.
    pub fn new(date: Date, zone: &str) -> Result<Self, ClockError> {
        Ok(Self {
            date,
            zone: parse_zone(zone)?,
            zone_name: zone.to_owned(),
        })
    }

    /// The date.
    #[must_use]
    pub fn date(&self) -> Date {
        self.date
    }

    /// The zone.
    #[must_use]
    pub fn zone(&self) -> &TimeZone {
        &self.zone
    }

    /// The zone as it was written.
    #[must_use]
    pub fn zone_name(&self) -> &str {
        &self.zone_name
    }

    /// When clocks show this time.
    ///
    /// # Errors
    /// When they never do, or twice.
    pub fn instant(&self, time: Time) -> Result<Timestamp, ClockError> {
        let shown = self
            .zone
            .to_ambiguous_timestamp(self.date.to_datetime(time));
        let words = |offset: jiff::tz::Offset| offset.to_string();
        let (date, zone) = (self.date, self.zone_name.clone());
        match shown.offset() {
            AmbiguousOffset::Gap { before, after } => Err(ClockError::Skipped {
                date,
                time,
                zone,
                before: words(before),
                after: words(after),
            }),
            AmbiguousOffset::Fold { before, after } => Err(ClockError::Twice {
                date,
                time,
                zone,
                before: words(before),
                after: words(after),
            }),
            AmbiguousOffset::Unambiguous { .. } => {
                shown.compatible().map_err(|_| ClockError::NotInCalendar {
                    text: date.to_string(),
                    why: "it is at the end of time".to_owned(),
                })
            }
        }
    }

    /// From the first moment of the day to that of the next.
    #[must_use]
    pub fn bounds(&self) -> Range<Timestamp> {
        let start_of = |date: Date| {
            let midnight = self
                .zone
                .to_ambiguous_timestamp(DateTime::from_parts(date, Time::midnight()));
            midnight.compatible().unwrap_or(Timestamp::MAX)
        };
        start_of(self.date)..start_of(self.date.saturating_add(jiff::Span::new().days(1)))
    }
}
