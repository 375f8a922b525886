//! The legend: every contender's marker, colour and name to the right of the data.

use anyhow::Result;
use plotters::prelude::RGBColor;

use super::canvas::{self, Canvas, INK, LEFT, MUTED, Px, text_width_px};
use crate::report::curve::Contender;

const NAME_PX: i32 = 14;
const VARIANT_PX: i32 = 12;
/// From the legend's left edge to its text: the sample of the line.
const KEY_PX: i32 = 44;
/// No legend takes more than this of a plot's width; longer names are cut.
const MAX_TEXT_PX: i32 = 230;

/// What a line looks like.
#[derive(Debug, Clone, Copy)]
pub(super) struct Key {
    pub(super) color: RGBColor,
    /// Number of the marker's shape.
    pub(super) marker: Option<usize>,
    /// Length of the dashes of a line that is context, not result: it is also thinner. `None` for a
    /// solid line.
    pub(super) dash_px: Option<i32>,
}

impl Key {
    /// The colour and marker of the curve at this place in the run's list.
    pub(super) fn of(index: usize) -> Self {
        Self {
            color: canvas::color(index),
            marker: Some(index),
            dash_px: None,
        }
    }

    pub(super) fn line(&self, canvas: &Canvas<'_, '_>, points: Vec<Px>) -> Result<()> {
        match self.dash_px {
            Some(dash_px) => canvas.dashed_line(points, self.color, dash_px),
            None => canvas.line(points, self.color, 2),
        }
    }

    pub(super) fn marker(&self, canvas: &Canvas<'_, '_>, at: Px) -> Result<()> {
        let radius_px = if self.dash_px.is_some() { 3 } else { 4 };
        self.marker.map_or(Ok(()), |marker| {
            canvas.marker(marker, at, radius_px, self.color)
        })
    }
}

/// One contender's place in the legend.
#[derive(Debug)]
pub(super) struct Entry<'a> {
    /// What it looks like.
    pub(super) key: Key,
    pub(super) contender: &'a Contender,
    /// The height at which its line ends, in pixels, to which the entry keeps as near as it can.
    pub(super) wanted_y: i32,
}

/// The width that a legend of `contenders` needs, in pixels.
pub(super) fn width_px<'a>(contenders: impl Iterator<Item = &'a Contender>) -> i32 {
    let text_px = contenders
        .map(|contender| {
            text_width_px(&contender.method, NAME_PX)
                .max(text_width_px(&contender.variant, VARIANT_PX))
        })
        .max()
        .unwrap_or_default();
    KEY_PX + text_px.min(MAX_TEXT_PX) + 12
}

/// The height of a plot whose legend has room for all of `contenders`, in pixels.
pub(super) fn height_px<'a>(contenders: impl Iterator<Item = &'a Contender>) -> i32 {
    let (mut entries, mut two_lines) = (0, false);
    for contender in contenders {
        entries += 1;
        two_lines |= !contender.variant.is_empty();
    }
    entries * gap_px(two_lines) + 60
}

/// From one entry to the next.
fn gap_px(two_lines: bool) -> i32 {
    if two_lines { 36 } else { 22 }
}

/// Entries one below the other from `top`, in their order.
pub(super) fn from_top<'a>(
    keys: impl Iterator<Item = (Key, &'a Contender)>,
    top: i32,
) -> Vec<Entry<'a>> {
    keys.enumerate()
        .map(|(index, (key, contender))| Entry {
            key,
            contender,
            wanted_y: top + index as i32,
        })
        .collect()
}

/// Draws the legend at `left`, between `top` and `bottom`.
pub(super) fn paint(
    canvas: &Canvas<'_, '_>,
    mut entries: Vec<Entry<'_>>,
    left: i32,
    (top, bottom): (i32, i32),
) -> Result<()> {
    entries.sort_by_key(|entry| entry.wanted_y);
    let two_lines = entries
        .iter()
        .any(|entry| !entry.contender.variant.is_empty());
    let wanted: Vec<i32> = entries.iter().map(|entry| entry.wanted_y).collect();
    let places = spread(&wanted, gap_px(two_lines), (top, bottom));
    for (entry, y) in entries.iter().zip(places) {
        let sample = vec![(left + 12, y), (left + KEY_PX - 8, y)];
        entry.key.line(canvas, sample)?;
        entry.key.marker(canvas, (left + KEY_PX / 2 + 2, y))?;
        let text_x = left + KEY_PX;
        let Contender { method, variant } = entry.contender;
        let name_y = if variant.is_empty() { y } else { y - 7 };
        canvas.text(
            &fitted(method, NAME_PX),
            (text_x, name_y),
            NAME_PX,
            INK,
            LEFT,
        )?;
        if !variant.is_empty() {
            let at = (text_x, y + 9);
            canvas.text(&fitted(variant, VARIANT_PX), at, VARIANT_PX, MUTED, LEFT)?;
        }
    }
    Ok(())
}

fn fitted(text: &str, size_px: i32) -> String {
    canvas::shortened(text, (MAX_TEXT_PX / text_width_px("n", size_px)) as usize)
}

/// Places near `wanted` (ascending) that keep `gap` apart and lie between `top` and `bottom`, as far
/// as they fit.
fn spread(wanted: &[i32], gap: i32, (top, bottom): (i32, i32)) -> Vec<i32> {
    let fitting = (bottom - top) / i32::try_from(wanted.len()).unwrap_or(i32::MAX).max(1);
    let gap = gap.min(fitting);
    let mut places = wanted.to_vec();
    let mut lowest = top + gap / 2;
    for place in &mut places {
        *place = (*place).max(lowest);
        lowest = *place + gap;
    }
    let mut highest = bottom - gap / 2;
    for place in places.iter_mut().rev() {
        *place = (*place).min(highest);
        highest = *place - gap;
    }
    places
}

#[cfg(test)]
mod tests {
    use super::spread;

    #[test]
    fn entries_keep_their_place_where_there_is_room() {
        assert_eq!(spread(&[100, 200, 300], 20, (0, 400)), [100, 200, 300]);
    }

    #[test]
    fn entries_that_would_overlap_are_moved_apart_within_the_bounds() {
        assert_eq!(spread(&[100, 101, 102], 20, (0, 400)), [100, 120, 140]);
        assert_eq!(spread(&[399, 400], 20, (0, 400)), [370, 390]);
        assert_eq!(spread(&[-5, 0], 20, (0, 400)), [10, 30]);
    }

    #[test]
    fn too_many_entries_share_the_room() {
        let places = spread(&[50; 10], 36, (0, 100));
        assert!(places.iter().all(|y| (0..=100).contains(y)), "{places:?}");
    }
}
