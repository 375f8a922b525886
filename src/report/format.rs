//! Numbers as people read them, the same in every output.

/// A count with its thousands set apart: `262,267`.
pub fn count(value: u64) -> String {
    let digits = value.to_string();
    let mut text = String::with_capacity(digits.len() + digits.len() / 3);
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// A time in milliseconds, to the microsecond: no timer that we read is finer in practice.
pub fn ms(value: f64) -> String {
    format!("{value:.3}")
}

/// Frames per second.
pub fn fps(value: f64) -> String {
    format!("{value:.1}")
}

/// A change in percent, with its sign.
pub fn percent(value: f64) -> String {
    format!("{value:+.1} %")
}

/// How many times as much.
pub fn factor(value: f64) -> String {
    format!("×{value:.2}")
}

/// A value in a table of a paper: as papers have them, whole where it is large.
pub fn paper_value(value: f64) -> String {
    match value {
        v if v >= 100.0 => format!("{v:.0}"),
        v if v >= 10.0 => format!("{v:.1}"),
        v if v >= 0.1 => format!("{v:.2}"),
        v => format!("{v:.4}"),
    }
}

/// Pixels per verified frame. Only none at all is `0`: a pixel wrong in one frame of a thousand is
/// still wrong and must not round to nothing.
pub fn px_per_frame(sum_px: u64, frames: u32) -> String {
    if sum_px == 0 {
        return "0".to_owned();
    }
    let mean = sum_px as f64 / f64::from(frames.max(1));
    if mean < 0.001 {
        "<0.001".to_owned()
    } else if mean < 0.1 {
        format!("{mean:.3}")
    } else {
        let tenths = (mean * 10.0).round() as u64;
        format!("{}.{}", count(tenths / 10), tenths % 10)
    }
}

/// A number of any size in few characters: `257`, `0.35`, `1e-6`. Six digits tell values apart; a whole
/// number keeps all of its digits.
pub fn short(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let rounded = if value.fract() == 0.0 {
        value
    } else {
        format!("{value:.5e}").parse().unwrap_or(value)
    };
    let plain = format!("{rounded}");
    let scientific = format!("{rounded:e}");
    let is_usual = (0.001..100_000.0).contains(&rounded.abs());
    if is_usual || plain.len() <= scientific.len() {
        plain
    } else {
        scientific
    }
}

/// A number of things: `1 cell`, `2 cells`.
pub fn number_of(number: usize, what: &str) -> String {
    let plural = if number == 1 { "" } else { "s" };
    format!("{} {what}{plural}", count(number as u64))
}

/// An RFC 3339 time as people read it; as it is, where it is none.
pub fn date(rfc_3339: &str) -> String {
    rfc_3339.parse::<jiff::Timestamp>().map_or_else(
        |_| rfc_3339.to_owned(),
        |time| time.strftime("%-d %B %Y, %H:%M UTC").to_string(),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_are_for_people_and_nonsense_is_left_alone() {
        assert_eq!(date("2026-03-09T14:05:06+01:00"), "9 March 2026, 13:05 UTC");
        assert_eq!(date("yesterday"), "yesterday");
    }

    #[test]
    fn counts_are_grouped_by_thousands() {
        assert_eq!(count(0), "0");
        assert_eq!(count(999), "999");
        assert_eq!(count(32_400), "32,400");
        assert_eq!(count(1_960_000), "1,960,000");
    }

    #[test]
    fn numbers_of_any_size_are_short() {
        let text = [
            0.0,
            257.0,
            0.35,
            1e-6,
            0.1 + 0.2,
            1e7,
            16_777_217.0,
            -2.5e-7,
        ]
        .map(short);
        let expected = [
            "0", "257", "0.35", "1e-6", "0.3", "1e7", "16777217", "-2.5e-7",
        ];
        assert_eq!(text, expected);
    }

    #[test]
    fn a_wrong_pixel_never_rounds_to_none() {
        assert_eq!(px_per_frame(0, 8), "0");
        assert_eq!(px_per_frame(1, 8), "0.1");
        assert_eq!(px_per_frame(1, 64), "0.016");
        assert_eq!(px_per_frame(1, 5000), "<0.001");
        assert_eq!(px_per_frame(99_999, 8), "12,499.9");
    }
}
