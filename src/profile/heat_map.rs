//! Hours of sun as colours.

use super::colour;
use super::day::Day;
use super::picture::{Picture, Scale};

/// What shows no surface.
const BACKGROUND: [u8; 3] = [255; 3];
/// More labels are not read.
const MAX_LABELS: usize = 9;
/// Colours of the bar.
const SHADES: usize = 128;

/// The heat map of a day's hours of sun per pixel, with its scale below it.
///
/// # Errors
/// When the scale cannot be drawn.
pub fn heat_map(
    size_px: (u32, u32),
    hours: impl Iterator<Item = Option<f32>>,
    day: &Day,
    of_whom: &str,
) -> anyhow::Result<Picture> {
    let all_h = day.hours();
    let colour = |hours: Option<f32>| hours.map_or(BACKGROUND, |hours| of_hours(hours, all_h));
    let picture = Picture {
        size_px,
        rgb: hours.flat_map(colour).collect(),
    };
    let request = &day.request;
    let (Some(first), Some(last)) = (day.steps.first(), day.steps.last()) else {
        return Ok(picture);
    };
    picture.over_scale(&Scale {
        title: format!(
            "Hours in sun on {} from {} to {} ({}), {of_whom}",
            request.day.date(),
            day.clock(first),
            day.clock(last),
            request.day.zone_name()
        ),
        colours: (0..SHADES)
            .map(|i| colour::of_amount(i as f64 / (SHADES - 1) as f64))
            .collect(),
        labels: ticks(all_h)
            .into_iter()
            .map(|hours| (hours / all_h, format!("{hours} h")))
            .collect(),
    })
}

/// The colour of hours out of all hours.
#[must_use]
pub fn of_hours(hours: f32, all_h: f64) -> [u8; 3] {
    colour::of_amount(f64::from(hours) / all_h)
}

/// Round numbers of hours from 0 to at most `all_h`.
fn ticks(all_h: f64) -> Vec<f64> {
    let steps_h = [0.05, 0.1, 0.25, 0.5, 1.0, 2.0, 3.0, 6.0];
    let fits = |step: &&f64| all_h / **step < MAX_LABELS as f64;
    let step_h = steps_h.iter().find(fits).copied().unwrap_or(12.0);
    let count = (all_h / step_h + 1e-9) as usize;
    (0..=count)
        .map(|i| ((i as f64 * step_h) * 100.0).round() / 100.0)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_not_too_many() {
        assert_eq!(ticks(4.0), [0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0]);
        assert_eq!(ticks(8.0), [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0]);
        assert_eq!(ticks(23.98).len(), 8);
        assert_eq!(ticks(0.2), [0.0, 0.05, 0.1, 0.15, 0.2]);
        assert_eq!(of_hours(4.0, 4.0), colour::of_amount(1.0));
    }
}
