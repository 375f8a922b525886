//! The key of a scatter chart: what its lines and markers mean, in rows above it.

use anyhow::Result;

use super::canvas::{Canvas, FADED, FRONT, INK, LEFT, Px, WHISKER, text_width_px};
use super::legend::Key;

const KEY_PX: i32 = 14;
const KEY_LINE_PX: i32 = 24;
/// Half the width of a whisker's end.
pub(super) const CAP_PX: i32 = 3;

/// An entry of the key above the chart.
pub(super) enum Sample<'a> {
    Front,
    Dominated,
    /// What the intervals are.
    Interval(&'a str),
    /// A curve and its name.
    Curve(Key, &'a str),
}

/// Draws the key in rows from `at` and gives the height at which it ends.
pub(super) fn paint<'a>(
    samples: impl Iterator<Item = Sample<'a>>,
    canvas: &Canvas<'_, '_>,
    at: Px,
) -> Result<i32> {
    let (width, _) = canvas.size();
    let (mut x, mut y) = at;
    for sample in samples {
        let entry_px = KEY_LINE_PX + 8 + text_width_px(sample.name(), KEY_PX);
        if x > at.0 && x + entry_px > width - 16 {
            (x, y) = (at.0, y + 22);
        }
        sample.paint(canvas, (x, y))?;
        let text_at = (x + KEY_LINE_PX + 8, y);
        canvas.text(sample.name(), text_at, KEY_PX, INK, LEFT)?;
        x += entry_px + 20;
    }
    Ok(y + 16)
}

impl Sample<'_> {
    fn name(&self) -> &str {
        match self {
            Self::Front => "Pareto front",
            Self::Dominated => "dominated",
            Self::Interval(what) => what,
            Self::Curve(_, name) => name,
        }
    }

    fn paint(&self, canvas: &Canvas<'_, '_>, (x, y): Px) -> Result<()> {
        let (middle, right) = (x + KEY_LINE_PX / 2, x + KEY_LINE_PX);
        match self {
            Self::Front => canvas.line(
                vec![(x, y - 5), (middle, y - 5), (middle, y + 5), (right, y + 5)],
                FRONT,
                2,
            ),
            Self::Dominated => canvas.marker(0, (middle, y), 4, FADED),
            Self::Interval(_) => {
                canvas.line(vec![(x, y), (right, y)], WHISKER, 1)?;
                canvas.line(vec![(x, y - CAP_PX), (x, y + CAP_PX)], WHISKER, 1)?;
                canvas.line(vec![(right, y - CAP_PX), (right, y + CAP_PX)], WHISKER, 1)
            }
            Self::Curve(key, _) => {
                canvas.line(vec![(x, y), (right, y)], key.color, 1)?;
                key.marker(canvas, (middle, y))
            }
        }
    }
}
