//! Axes for plotters' charts, which lack what these have: ticks at 1, 2 and 5 on logarithmic scales, and a band for
//! zero below them.

use std::ops::Range;

use plotters::coord::CoordTranslate as _;
use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};
use plotters::prelude::Cartesian2d;

use super::canvas::{Px, Rect};

/// How much of a logarithmic axis, from its lower end, is kept for zero where there is any.
const ZERO_BAND: f64 = 0.12;
const LOG_SCALE: &str = " (log scale)";

/// An axis over a range of values.
#[derive(Debug, Clone, Default)]
pub(super) struct Axis {
    pub(super) title: String,
    pub(super) high: f64,
    low: f64,
    log: bool,
    ticks: Vec<f64>,
    has_zero_band: bool,
}

impl Axis {
    /// Linear, over exactly the range of `values`.
    pub(super) fn exact(title: &str, values: &[f64]) -> Self {
        let low = values.iter().copied().fold(f64::INFINITY, f64::min);
        let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let (low, high) = if low < high { (low, high) } else { (0.0, 1.0) };
        Self::linear(title, low, high, round_step((high - low) / 8.0))
    }

    fn linear(title: &str, low: f64, high: f64, step: f64) -> Self {
        let first = (low / step).ceil() as i64;
        let last = (high / step + 1e-9).floor() as i64;
        Self {
            title: title.to_owned(),
            high,
            low,
            ticks: (first..=last).map(|n| n as f64 * step).collect(),
            ..Self::default()
        }
    }

    /// Logarithmic over the positive `values`, from tick to tick. Zero is shown as zero: where `values`
    /// have any, in a band of its own.
    pub(super) fn log(title: &str, values: &[f64]) -> Self {
        let (min, max) = positive_range(values);
        let mantissas: &[f64] = match (max / min).log10() {
            decades if decades > 4.0 => &[1.0],
            decades if decades > 0.7 => &[1.0, 2.0, 5.0],
            _ => &[1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0],
        };
        let exponents = min.log10().floor() as i32..=max.log10().floor() as i32 + 1;
        let of = |exponent| mantissas.iter().map(move |m| m * 10_f64.powi(exponent));
        let mut ticks: Vec<f64> = exponents.flat_map(of).collect();
        let low = ticks.iter().copied().rfind(|tick| *tick <= min * 1.0001);
        let high = ticks.iter().copied().find(|tick| *tick >= max * 1.0001);
        let (low, high) = (low.unwrap_or(min), high.unwrap_or(max * 10.0));
        ticks.retain(|tick| (low..=high).contains(tick));
        let has_zero_band = values.iter().any(|value| *value <= 0.0);
        if has_zero_band {
            ticks.insert(0, 0.0);
        }
        Self {
            title: format!("{title}{LOG_SCALE}"),
            high,
            low,
            log: true,
            ticks,
            has_zero_band,
        }
    }

    /// From zero to a round number where that shows every value; logarithmic where the largest value
    /// would press the smallest onto the axis.
    pub(super) fn fit(title: &str, values: &[f64]) -> Self {
        let (min, max) = positive_range(values);
        if max / min > 30.0 {
            return Self::log(title, values);
        }
        let step = round_step(max / 6.0);
        Self::linear(title, 0.0, (max / step).ceil() * step, step)
    }

    /// Logarithmic where `values` are far apart; linear over their range where some are below zero.
    pub(super) fn spread(title: &str, values: &[f64]) -> Self {
        let (min, max) = positive_range(values);
        if values.iter().any(|value| *value < 0.0) || max / min < 4.0 {
            Self::exact(title, values)
        } else {
            Self::log(title, values)
        }
    }

    /// An axis of so many groups, which are named otherwise.
    pub(super) fn of_groups(groups: usize) -> Self {
        Self {
            high: groups as f64,
            ..Self::default()
        }
    }

    /// Where the axis, drawn between these pixels, breaks off before zero, if it does.
    pub(super) fn break_px(&self, from: i32, to: i32) -> Option<i32> {
        let at = from + (f64::from(to - from) * ZERO_BAND * 0.92).round() as i32;
        self.has_zero_band.then_some(at)
    }

    /// Where `value` lies between the axis's ends, 0 to 1. Zero has no place on a logarithmic axis
    /// and is put into the middle of its band.
    fn fraction(&self, value: f64) -> f64 {
        if self.has_zero_band && value <= 0.0 {
            return ZERO_BAND / 2.0;
        }
        let fraction = if self.log {
            (value.max(self.low) / self.low).log10() / (self.high / self.low).log10()
        } else {
            (value - self.low) / (self.high - self.low)
        };
        let band = if self.has_zero_band { ZERO_BAND } else { 0.0 };
        band + (1.0 - band) * fraction.clamp(0.0, 1.0)
    }
}

impl Ranged for Axis {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, (from, to): (i32, i32)) -> i32 {
        from + (f64::from(to - from) * self.fraction(*value)).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        // There are no lines between ticks.
        if hint.weight().allow_light_points() {
            Vec::new()
        } else {
            self.ticks.clone()
        }
    }

    fn range(&self) -> Range<f64> {
        self.low..self.high
    }
}

impl ValueFormatter<f64> for Axis {
    fn format_ext(&self, value: &f64) -> String {
        label(*value)
    }
}

/// The rectangle that data is drawn in.
pub(super) struct Frame {
    pub(super) area: Rect,
    pub(super) axes: Cartesian2d<Axis, Axis>,
}

impl Frame {
    pub(super) fn place(&self, at: (f64, f64)) -> Px {
        self.axes.translate(&at)
    }
}

/// The least and the greatest of the positive `values`; 1 and 1 where there are none.
fn positive_range(values: &[f64]) -> (f64, f64) {
    let positive = || values.iter().copied().filter(|value| *value > 0.0);
    let max = positive().reduce(f64::max).unwrap_or(1.0);
    (positive().fold(max, f64::min), max)
}

/// The smallest of 1, 2, 5 times a power of ten that is at least `rough`.
fn round_step(rough: f64) -> f64 {
    let power = 10_f64.powf(rough.log10().floor());
    let step = [1.0, 2.0, 5.0]
        .iter()
        .map(|m| m * power)
        .find(|step| *step >= rough * 0.9999);
    step.unwrap_or(10.0 * power)
}

/// A round number as people write it: `0.05`, `20`, `50k`, `2M`.
fn label(value: f64) -> String {
    let (scaled, suffix) = match value.abs() {
        v if v >= 1e6 => (value / 1e6, "M"),
        v if v >= 1e4 => (value / 1e3, "k"),
        _ => (value, ""),
    };
    // Six decimals carry any tick; shorter ones are printed without their zeros.
    let digits = format!("{scaled:.6}");
    format!(
        "{}{suffix}",
        digits.trim_end_matches('0').trim_end_matches('.')
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(axis: &Axis) -> Vec<String> {
        axis.ticks.iter().map(|tick| label(*tick)).collect()
    }

    #[test]
    fn a_linear_axis_begins_at_zero_and_ends_at_a_round_number() {
        let axis = Axis::fit("", &[3.0, 11.4]);
        assert_eq!(labels(&axis), ["0", "2", "4", "6", "8", "10", "12"]);
        assert_eq!(axis.fraction(6.0), 0.5);
    }

    #[test]
    fn a_log_axis_has_round_ticks_around_its_values() {
        let axis = Axis::log("", &[32_400.0, 1_960_000.0]);
        assert_eq!(
            labels(&axis),
            ["20k", "50k", "100k", "200k", "500k", "1M", "2M"]
        );
        assert!(axis.fraction(32_400.0) > 0.0 && axis.fraction(1_960_000.0) < 1.0);
        let axis = Axis::log("", &[0.04, 300.0]);
        let ends = (&*labels(&axis)[0], labels(&axis)[13].clone());
        assert_eq!(ends, ("0.02", "500".to_owned()));
    }

    #[test]
    fn an_axis_is_logarithmic_only_where_it_must_be() {
        assert!(!Axis::fit("", &[1.0, 20.0]).log && Axis::fit("", &[1.0, 50.0]).log);
        assert!(!Axis::spread("", &[-1.0, 1.0, 9.0]).log && Axis::spread("", &[1.0, 9.0]).log);
    }

    #[test]
    fn zero_has_a_band_below_every_other_value() {
        let axis = Axis::log("", &[0.0, 0.5, 1000.0]);
        assert_eq!(axis.fraction(0.0), ZERO_BAND / 2.0);
        assert!(axis.fraction(0.5) >= ZERO_BAND && axis.fraction(1000.0) < 1.0);
        assert_eq!(labels(&axis)[0], "0");
        let axis = Axis::log("", &[0.5, 1000.0]);
        assert_eq!(axis.break_px(0, 100), None);
        assert_ne!(labels(&axis)[0], "0");
    }

    #[test]
    fn an_axis_over_nothing_still_has_places() {
        for axis in [Axis::log("", &[]), Axis::fit("", &[])] {
            assert!(axis.fraction(1.0).is_finite());
        }
        assert!(Axis::exact("", &[2.0]).fraction(2.0).is_finite());
    }
}
