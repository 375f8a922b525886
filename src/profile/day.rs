//! The steps of a day, and how much of it each stands for.

use std::ops::Range;

use jiff::civil::Time;
use jiff::{SignedDuration, Timestamp};

use crate::scene::Light;
use crate::scene::sun::{ClockError, Compass, LocalDay, Site, SkyError, SunPosition, local_time};

/// More steps than anybody looks at: a minute each, all day long.
const MAX_STEPS: i128 = 24 * 60 + 1;

/// What day is looked at, and how closely.
#[derive(Clone, Debug)]
pub struct DayRequest {
    /// Where on earth.
    pub site: Site,
    /// How the scene lies there.
    pub compass: Compass,
    /// The date and its zone.
    pub day: LocalDay,
    /// From which local time.
    pub from: Time,
    /// To which.
    pub to: Time,
    /// From one picture to the next.
    pub step: SignedDuration,
}

/// One time of the day.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// When.
    pub time: Timestamp,
    /// Where the sun stands.
    pub position: SunPosition,
    /// The sun as a light; `None` at night.
    pub light: Option<Light>,
    /// How much of the day this time stands for: half the way to the step before, and half the way to the next.
    pub hours: f64,
}

/// A day in steps, in at least one of which the sun is up.
#[derive(Clone, Debug)]
pub struct Day {
    /// What was asked for.
    pub request: DayRequest,
    /// The times, first to last; the last step may be shorter.
    pub steps: Vec<Step>,
}

/// Why there is no such day.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum DayError {
    /// The clock never shows `from`.
    #[error("--from: {0}")]
    From(ClockError),
    /// The clock never shows `to`.
    #[error("--to: {0}")]
    To(ClockError),
    /// The end is not after the start.
    #[error("--to: {to} is not after {from}; a profile is of one day")]
    Backward {
        /// The start.
        from: Time,
        /// The end.
        to: Time,
    },
    /// Time would stand still or run back.
    #[error("--step: a step must be longer than 0, such as 30m")]
    Step,
    /// Only the ends would be looked at.
    #[error("--step: a step of {0:#} is longer than the time from --from to --to")]
    TooLong(SignedDuration),
    /// Too many pictures.
    #[error("--step: {0} steps are more than {MAX_STEPS}; give a longer step")]
    TooMany(i128),
    /// The sun's place cannot be computed.
    #[error("--date: {0}")]
    Sky(#[from] SkyError),
    /// There is no sun.
    #[error("the sun is not up at any step from {from} to {to} on {date}; {daylight}")]
    Dark {
        /// The start.
        from: String,
        /// The end.
        to: String,
        /// The date.
        date: String,
        /// When the sun rises and sets that day.
        daylight: String,
    },
}

impl Day {
    /// The steps of a day: `from`, and so on by `step`, and `to`.
    ///
    /// # Errors
    /// When there are none, or it is night at all of them.
    pub fn new(request: DayRequest) -> Result<Self, DayError> {
        let DayRequest {
            site, compass, day, ..
        } = &request;
        let start = day.instant(request.from).map_err(DayError::From)?;
        let end = day.instant(request.to).map_err(DayError::To)?;
        let times = times(start..end, &request)?;
        let steps = times.iter().enumerate().map(|(i, &time)| {
            let position = site.sun_at(time)?;
            let before = times[i.saturating_sub(1)];
            let after = times.get(i + 1).copied().unwrap_or(time);
            Ok(Step {
                time,
                position,
                light: (position.elevation_deg > 0.0).then(|| compass.light(position)),
                hours: after.duration_since(before).as_secs_f64() / 3600.0 / 2.0,
            })
        });
        let steps: Vec<Step> = steps.collect::<Result<_, SkyError>>()?;
        if steps.iter().all(|step| step.light.is_none()) {
            return Err(DayError::Dark {
                from: local_time(start, day.zone()),
                to: local_time(end, day.zone()),
                date: day.date().to_string(),
                daylight: site.daylight(day.bounds())?.in_words(day.zone()),
            });
        }
        Ok(Self { request, steps })
    }

    /// All the time from the first step to the last.
    #[must_use]
    pub fn hours(&self) -> f64 {
        self.steps.iter().map(|step| step.hours).sum()
    }

    /// From one step to the next.
    #[must_use]
    pub fn step_hours(&self) -> f64 {
        self.request.step.as_secs_f64() / 3600.0
    }

    /// What a clock shows at a step.
    #[must_use]
    pub fn clock(&self, step: &Step) -> String {
        local_time(step.time, self.request.day.zone())
    }

    /// The steps at which the sun is up, each with its number.
    pub fn daylight(&self) -> impl Iterator<Item = (usize, &Step, Light)> {
        let steps = self.steps.iter().enumerate();
        steps.filter_map(|(i, step)| Some((i, step, step.light?)))
    }
}

fn times(span: Range<Timestamp>, request: &DayRequest) -> Result<Vec<Timestamp>, DayError> {
    let DayRequest { from, to, step, .. } = *request;
    if span.start >= span.end {
        return Err(DayError::Backward { from, to });
    }
    if step <= SignedDuration::ZERO {
        return Err(DayError::Step);
    }
    let length = span.end.duration_since(span.start);
    if step > length {
        return Err(DayError::TooLong(step));
    }
    let count = length.as_nanos() / step.as_nanos() + 1;
    if count > MAX_STEPS {
        return Err(DayError::TooMany(count));
    }
    let steps = (0..count as i32).map_while(|i| span.start.checked_add(step.checked_mul(i)?).ok());
    let mut times: Vec<_> = steps.collect();
    if times.last() != Some(&span.end) {
        times.push(span.end);
    }
    Ok(times)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::sun::{parse_date, parse_time};

    pub(super) fn request(
        latitude: f64,
        date: &str,
        from: &str,
        to: &str,
        step: &str,
    ) -> DayRequest {
        DayRequest {
            site: Site::new(latitude, 16.37).unwrap(),
            compass: Compass::default(),
            day: LocalDay::new(parse_date(date).unwrap(), "Europe/Vienna").unwrap(),
            from: parse_time(from).unwrap(),
            to: parse_time(to).unwrap(),
            step: step.parse().unwrap(),
        }
    }

    fn day(from: &str, to: &str, step: &str) -> Result<Day, DayError> {
        Day::new(request(48.2, "2026-09-18", from, to, step))
    }

    #[test]
    fn steps_stand_for_all_of_the_time() {
        let hours = |day: &Day| day.steps.iter().map(|step| step.hours).collect::<Vec<_>>();
        let even = day("10:00", "12:00", "30m").unwrap();
        assert_eq!(hours(&even), [0.25, 0.5, 0.5, 0.5, 0.25]);
        let clocks: Vec<_> = even.steps.iter().map(|step| even.clock(step)).collect();
        assert_eq!(clocks, ["10:00", "10:30", "11:00", "11:30", "12:00"]);
        // The last step is shorter.
        let uneven = day("10:00", "12:00", "45m").unwrap();
        assert_eq!(hours(&uneven), [0.375, 0.75, 0.625, 0.25]);
        assert_eq!((even.hours(), uneven.hours()), (2.0, 2.0));
        assert_eq!(even.step_hours(), 0.5);
        let whole = day("10:00", "12:00", "2h").unwrap();
        assert_eq!(hours(&whole), [1.0, 1.0]);
    }

    #[test]
    fn a_day_may_begin_and_end_in_the_night() {
        let all = day("00:00", "23:59", "1h").unwrap();
        assert_eq!(all.steps.len(), 25);
        // Up from 06:37 to 18:59.
        let up: Vec<_> = all.daylight().map(|(i, ..)| i).collect();
        assert_eq!(up, (7..=18).collect::<Vec<_>>());
    }

    #[test]
    fn a_change_of_clocks_is_no_gap() {
        let spring = Day::new(request(48.2, "2026-03-29", "01:00", "08:00", "1h")).unwrap();
        assert_eq!(spring.hours(), 6.0);
        let clocks: Vec<_> = spring.steps.iter().map(|step| spring.clock(step)).collect();
        assert_eq!(clocks[..3], ["01:00", "03:00", "04:00"]);
    }

    #[test]
    fn impossible_days_say_why() {
        let error = |from, to, step| day(from, to, step).unwrap_err().to_string();
        assert!(error("10:00", "09:00", "30m").contains("09:00:00 is not after 10:00:00"));
        assert!(error("10:00", "10:00", "30m").contains("is not after"));
        assert!(error("10:00", "12:00", "0s").contains("longer than 0"));
        assert!(error("10:00", "12:00", "-5m").contains("longer than 0"));
        assert!(error("10:00", "12:00", "3h").contains("a step of 3h is longer"));
        assert!(error("10:00", "12:00", "1s").contains("7201 steps are more than 1441"));
        assert!(error("20:00", "23:00", "1h").contains("rises at 06:37 and sets at 18:59"));
        let polar = Day::new(request(69.65, "2026-12-21", "09:00", "15:00", "1h"));
        assert!(polar.unwrap_err().to_string().contains("it does not rise"));
    }
}
