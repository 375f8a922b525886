//! Which of two numbers is simpler.

/// How much there is to read: 0 for 0, 1 for ±1, else what digits and point take, in characters.
pub(super) fn effort(x: f32) -> usize {
    if x == 0.0 {
        return 0;
    }
    let text = format!("{:?}", x.abs());
    match text.trim_end_matches(".0") {
        "1" => 1,
        digits => 1 + digits.len(),
    }
}

/// Simpler numbers near this one, the simplest first; each takes less [`effort`].
pub(super) fn simpler(x: f32) -> Vec<f32> {
    const MAX_DIGITS: usize = 5;
    let digits = |count: usize| format!("{x:.*e}", count - 1).parse().unwrap_or(x);
    let mut numbers = vec![0.0, 1f32.copysign(x), x.round(), (2.0 * x).round() / 2.0];
    numbers.extend((1..=MAX_DIGITS).map(digits));
    numbers.retain(|number| number.is_finite() && effort(*number) < effort(x));
    // Stable: of those alike, the ones above come first.
    numbers.sort_by_key(|number| effort(*number));
    numbers.dedup();
    numbers
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn round_numbers_come_first() {
        assert!(simpler(0.0).is_empty());
        assert_eq!(simpler(-1.0), [0.0]);
        assert_eq!(simpler(2.0), [0.0, 1.0]);
        assert_eq!(
            simpler(-2.671_283_8),
            [0.0, -1.0, -3.0, -2.5, -2.7, -2.67, -2.671, -2.6713]
        );
        assert_eq!(simpler(0.001), [0.0, 1.0]);
        assert_eq!(simpler(f32::MAX).last(), Some(&3.4028e38));
    }

    proptest! {
        #[test]
        fn every_simpler_number_takes_less_effort(bits in any::<u32>()) {
            let x = f32::from_bits(bits);
            prop_assume!(x.is_finite());
            for number in simpler(x) {
                prop_assert!(number.is_finite() && effort(number) < effort(x), "{x} {number}");
            }
        }
    }
}
