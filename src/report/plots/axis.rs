//! Axes for plotters' charts, which lack what these have: ticks at 1, 2 and 5 on logarithmic scales, and a band for
//! zero below them.

use std::ops::Range;

use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};

/// An axis over a range of values.
#[derive(Debug, Clone, Default)]
pub(super) struct Axis {
    pub(super) title: String,
    log: bool,
    low: f64,
    high: f64,
    ticks: Vec<f64>,
    /// How much of the axis, from its lower end, is kept for zero; 0 where zero has no band.
    zero_band: f64,
}

impl Axis {
    /// A linear axis from zero to a round number above `values`.
    pub(super) fn from_zero(title: &str, values: impl Iterator<Item = f64>) -> Self {
        let max = positive(values.fold(0.0, f64::max));
        let step = round_step(max / 6.0);
        let steps = (max / step).ceil();
        Self::linear(title, 0.0, steps * step, step)
    }

    /// A linear axis over exactly the range of `values`.
    pub(super) fn exact(title: &str, values: impl Iterator<Item = f64> + Clone) -> Self {
        let low = values.clone().fold(f64::INFINITY, f64::min);
        let high = values.fold(f64::NEG_INFINITY, f64::max);
        let (low, high) = if low < high { (low, high) } else { (0.0, 1.0) };
        Self::linear(title, low, high, round_step((high - low) / 8.0))
    }

    fn linear(title: &str, low: f64, high: f64, step: f64) -> Self {
        let first = (low / step).ceil() as i64;
        let last = (high / step + 1e-9).floor() as i64;
        let ticks = (first..=last).map(|n| n as f64 * step).collect();
        Self {
            title: title.to_owned(),
            log: false,
            low,
            high,
            ticks,
            zero_band: 0.0,
        }
    }

    /// A logarithmic axis over the positive `values`, from tick to tick.
    pub(super) fn log(title: &str, values: impl Iterator<Item = f64>) -> Self {
        let (mut min, mut max) = (f64::INFINITY, 0.0_f64);
        for value in values.filter(|value| *value > 0.0) {
            min = min.min(value);
            max = max.max(value);
        }
        let min = if min.is_finite() { min } else { 1.0 };
        let max = max.max(min);
        let decades = (max / min).log10();
        let mantissas: &[f64] = if decades > 4.0 {
            &[1.0]
        } else if decades > 0.7 {
            &[1.0, 2.0, 5.0]
        } else {
            &[1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0]
        };
        let exponents = min.log10().floor() as i32..=max.log10().floor() as i32 + 1;
        let of = |exponent| mantissas.iter().map(move |m| m * 10_f64.powi(exponent));
        let mut ticks: Vec<f64> = exponents.flat_map(of).collect();
        let low = ticks.iter().copied().rfind(|tick| *tick <= min * 1.0001);
        let high = ticks.iter().copied().find(|tick| *tick >= max * 1.0001);
        let (low, high) = (low.unwrap_or(min), high.unwrap_or(max * 10.0));
        ticks.retain(|tick| (low..=high).contains(tick));
        Self {
            title: title.to_owned(),
            log: true,
            low,
            high,
            ticks,
            zero_band: 0.0,
        }
    }

    /// A logarithmic axis that shows zero as zero: where `values` have any, in a band of its own, which
    /// takes `zero_band` of the axis.
    pub(super) fn log_with_zero(
        title: &str,
        values: impl Iterator<Item = f64> + Clone,
        zero_band: f64,
    ) -> Self {
        let has_zero = values.clone().any(|value| value <= 0.0);
        let mut axis = Self::log(title, values);
        if has_zero {
            axis.zero_band = zero_band;
            axis.ticks.insert(0, 0.0);
        }
        axis
    }

    /// Where the band of zero ends, as a fraction of the axis, if it has one.
    pub(super) fn zero_band(&self) -> Option<f64> {
        (self.zero_band > 0.0).then_some(self.zero_band)
    }

    /// From zero where that shows every value; logarithmic, and called so, where the largest value
    /// would press the smallest onto the axis.
    pub(super) fn fit(title: &str, values: impl Iterator<Item = f64> + Clone) -> Self {
        let min = values
            .clone()
            .filter(|value| *value > 0.0)
            .fold(f64::INFINITY, f64::min);
        let max = values.clone().fold(0.0, f64::max);
        if max / min > 30.0 {
            Self::log(&format!("{title} (log scale)"), values)
        } else {
            Self::from_zero(title, values)
        }
    }

    /// Where `value` lies between the axis's ends, 0 to 1. Zero has no place on a logarithmic axis
    /// and is put into the middle of its band, or at the lower end where it has none.
    pub(super) fn fraction(&self, value: f64) -> f64 {
        if self.zero_band > 0.0 && value <= 0.0 {
            return self.zero_band / 2.0;
        }
        let fraction = if self.log {
            (value.max(self.low) / self.low).log10() / (self.high / self.low).log10()
        } else {
            (value - self.low) / (self.high - self.low)
        };
        self.zero_band + (1.0 - self.zero_band) * fraction.clamp(0.0, 1.0)
    }

    /// An axis of so many groups, which are named otherwise.
    pub(super) fn of_groups(groups: usize) -> Self {
        Self {
            high: groups.max(1) as f64,
            ..Self::default()
        }
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

fn positive(value: f64) -> f64 {
    if value > 0.0 { value } else { 1.0 }
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
        let axis = Axis::from_zero("", [3.0, 11.4].into_iter());
        assert_eq!(labels(&axis), ["0", "2", "4", "6", "8", "10", "12"]);
        assert_eq!(axis.fraction(6.0), 0.5);
    }

    #[test]
    fn a_log_axis_has_round_ticks_around_its_values() {
        let axis = Axis::log("", [32_400.0, 1_960_000.0].into_iter());
        assert_eq!(
            labels(&axis),
            ["20k", "50k", "100k", "200k", "500k", "1M", "2M"]
        );
        assert!(axis.fraction(32_400.0) > 0.0 && axis.fraction(1_960_000.0) < 1.0);
        let axis = Axis::log("", [0.04, 300.0].into_iter());
        assert_eq!(
            labels(&axis),
            [
                "0.02", "0.05", "0.1", "0.2", "0.5", "1", "2", "5", "10", "20", "50", "100", "200",
                "500"
            ]
        );
    }

    #[test]
    fn an_axis_is_logarithmic_only_where_it_must_be() {
        assert!(!Axis::fit("", [1.0, 20.0].into_iter()).log);
        assert!(Axis::fit("", [1.0, 50.0].into_iter()).log);
    }

    #[test]
    fn zero_has_a_band_below_every_other_value() {
        let axis = Axis::log_with_zero("", [0.0, 0.5, 1000.0].into_iter(), 0.2);
        assert_eq!(axis.fraction(0.0), 0.1);
        assert!(axis.fraction(0.5) >= 0.2 && axis.fraction(1000.0) < 1.0);
        assert_eq!(labels(&axis)[0], "0");
        let axis = Axis::log_with_zero("", [0.5, 1000.0].into_iter(), 0.2);
        assert_eq!(axis.zero_band(), None);
        assert_ne!(labels(&axis)[0], "0");
    }

    #[test]
    fn an_axis_over_nothing_still_has_places() {
        for axis in [
            Axis::log("", [].into_iter()),
            Axis::from_zero("", [].into_iter()),
        ] {
            assert!(axis.fraction(1.0).is_finite());
        }
        assert!(Axis::exact("", [2.0].into_iter()).fraction(2.0).is_finite());
    }
}
