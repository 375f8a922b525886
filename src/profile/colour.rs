//! Colours for amounts and for times.
//!
//! Both maps are perceptually even, and grow lighter all the way, so that they also read in grey and for colour-blind
//! eyes: those called *viridis* and *plasma* (N. Smith, S. van der Walt, 2015), by nine of their points each.

/// Dark violet over green to yellow.
const VIRIDIS: [[u8; 3]; 9] = [
    [68, 1, 84],
    [71, 44, 122],
    [59, 81, 139],
    [44, 113, 142],
    [33, 144, 141],
    [39, 173, 129],
    [92, 200, 99],
    [170, 220, 50],
    [253, 231, 37],
];

/// Dark blue over red to yellow.
const PLASMA: [[u8; 3]; 9] = [
    [13, 8, 135],
    [76, 2, 161],
    [126, 3, 168],
    [170, 35, 149],
    [204, 71, 120],
    [230, 108, 92],
    [248, 149, 64],
    [253, 197, 39],
    [240, 249, 33],
];

/// The colour of an amount, from 0, none, to 1, all.
#[must_use]
pub fn of_amount(part: f64) -> [u8; 3] {
    at(&VIRIDIS, part)
}

/// The colour of a time, from 0, the first, to 1, the last.
#[must_use]
pub fn of_time(part: f64) -> [u8; 3] {
    at(&PLASMA, part)
}

fn at(map: &[[u8; 3]; 9], part: f64) -> [u8; 3] {
    // Of no number, the first.
    let part = if part.is_nan() { 0.0 } else { part };
    let place = part.clamp(0.0, 1.0) * (map.len() - 1) as f64;
    let below = (place as usize).min(map.len() - 2);
    mix(map[below], map[below + 1], place - below as f64)
}

/// Between two colours, from 0, the first, to 1, the second.
#[must_use]
pub fn mix(a: [u8; 3], b: [u8; 3], part: f64) -> [u8; 3] {
    let channel = |k: usize| f64::from(a[k]) + (f64::from(b[k]) - f64::from(a[k])) * part;
    [0, 1, 2].map(|k| channel(k).round() as u8)
}

/// As SVG writes it.
#[must_use]
pub fn hex([r, g, b]: [u8; 3]) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ends_are_the_ends_and_lightness_grows() {
        assert_eq!((of_amount(0.0), of_amount(1.0)), (VIRIDIS[0], VIRIDIS[8]));
        assert_eq!((of_time(-1.0), of_time(2.0)), (PLASMA[0], PLASMA[8]));
        assert_eq!(of_amount(f64::NAN), VIRIDIS[0]);
        let lightness = |[r, g, b]: [u8; 3]| {
            0.2126 * f64::from(r) + 0.7152 * f64::from(g) + 0.0722 * f64::from(b)
        };
        for of in [of_amount, of_time] {
            let steps: Vec<_> = (0..=50)
                .map(|i| lightness(of(f64::from(i) / 50.0)))
                .collect();
            assert!(steps.is_sorted(), "{steps:?}");
        }
        assert_eq!(hex([1, 160, 255]), "#01a0ff");
    }
}
