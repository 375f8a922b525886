//! The few statistics that a run reports: median, 95th percentile and mean.
//!
//! Frame times are skewed to the right (a late frame is far later than an early one is early), so
//! the tables lead with the median and show the 95th percentile beside it. The mean is kept because
//! frames per second, as the literature reports them, are its reciprocal.
//!
//! Every function gives `None` for no values, so that "nothing measured" cannot be read as zero.

/// The middle value; of an even number of values, the mean of the middle two.
pub fn median(values: &[f64]) -> Option<f64> {
    quantile(values, 0.5)
}

/// The 95th percentile, interpolated linearly between order statistics.
pub fn p95(values: &[f64]) -> Option<f64> {
    quantile(values, 0.95)
}

/// The 5th percentile, interpolated as [`p95`].
pub fn p05(values: &[f64]) -> Option<f64> {
    quantile(values, 0.05)
}

/// The arithmetic mean.
pub fn mean(values: &[f64]) -> Option<f64> {
    (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
}

/// The quantile at `fraction` (0 the smallest value, 1 the largest), interpolated linearly.
///
/// With the n values sorted, the quantile lies at rank `fraction · (n − 1)`, counted from zero; a
/// rank between two values is weighted between them. This is definition 7 of Hyndman and Fan
/// (1996), the default of R, NumPy and spreadsheets, so that anyone can check a reported figure
/// against `samples.csv` with the tool at hand.
fn quantile(values: &[f64], fraction: f64) -> Option<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let last = sorted.len().checked_sub(1)?;
    let rank = fraction * last as f64;
    let below = (rank.floor() as usize).min(last);
    let above = (below + 1).min(last);
    let weight = rank - below as f64;
    Some(sorted[below] + weight * (sorted[above] - sorted[below]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_has_no_statistics() {
        assert_eq!(median(&[]), None);
        assert_eq!(p95(&[]), None);
        assert_eq!(mean(&[]), None);
    }

    #[test]
    fn one_value_is_all_of_its_statistics() {
        assert_eq!(median(&[3.5]), Some(3.5));
        assert_eq!(p95(&[3.5]), Some(3.5));
        assert_eq!(mean(&[3.5]), Some(3.5));
    }

    #[test]
    fn median_does_not_depend_on_the_order() {
        assert_eq!(median(&[9.0, 1.0, 5.0]), Some(5.0));
        assert_eq!(median(&[9.0, 1.0, 5.0, 7.0]), Some(6.0));
    }

    #[test]
    fn p95_interpolates_between_order_statistics() {
        let hundred_and_one: Vec<f64> = (0..=100).map(f64::from).collect();
        assert_eq!(p95(&hundred_and_one), Some(95.0));
        // Rank 0.95 · 3 = 2.85: 85 % of the way from the third value to the fourth.
        let value = p95(&[4.0, 1.0, 2.0, 3.0]).unwrap();
        assert!((value - 3.85).abs() < 1e-12, "{value}");
    }

    #[test]
    fn p05_interpolates_as_p95_does() {
        // Rank 0.05 · 3 = 0.15: 15 % of the way from the first value to the second.
        let value = p05(&[4.0, 1.0, 2.0, 3.0]).unwrap();
        assert!((value - 1.15).abs() < 1e-12, "{value}");
    }

    #[test]
    fn mean_weighs_every_value_alike() {
        assert_eq!(mean(&[1.0, 2.0, 6.0]), Some(3.0));
    }
}
