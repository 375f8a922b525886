//! The legend: what each line, marker or bar means, to the right of the data.

use anyhow::Result;
use plotters::style::text_anchor::HPos;

use super::canvas::{Canvas, INK, MUTED, Px, Style, font, shortened, text_width_px};
use crate::report::curve::Contender;

const NAME_PX: i32 = 14;
const VARIANT_PX: i32 = 12;
/// From the legend's left edge to its text: the sample of the line.
const KEY_PX: i32 = 44;
/// Longer names are cut.
const MAX_TEXT_PX: i32 = 260;

/// Its entries, from the top.
pub(super) struct Legend<'a>(pub(super) &'a [(Style, Contender)]);

impl Legend<'_> {
    pub(super) fn width_px(&self) -> i32 {
        let text_px = |(_, Contender { method, variant }): &_| {
            text_width_px(method, NAME_PX).max(text_width_px(variant, VARIANT_PX))
        };
        let text_px = self.0.iter().map(text_px).max().unwrap_or_default();
        KEY_PX + text_px.min(MAX_TEXT_PX) + 12
    }

    /// The height of a plot that has room for it.
    pub(super) fn height_px(&self) -> i32 {
        self.0.len() as i32 * self.pitch_px() + 60
    }

    /// From one entry to the next.
    fn pitch_px(&self) -> i32 {
        let has_two_lines = self.0.iter().any(|(_, name)| !name.variant.is_empty());
        if has_two_lines { 36 } else { 22 }
    }

    pub(super) fn paint(&self, canvas: &Canvas<'_, '_>, (left, top): Px) -> Result<()> {
        let (pitch_px, text_x) = (self.pitch_px(), left + KEY_PX);
        for (index, (style, Contender { method, variant })) in self.0.iter().enumerate() {
            let y = top + pitch_px / 2 + index as i32 * pitch_px;
            canvas.line(&[(left + 12, y), (text_x - 8, y)], *style)?;
            canvas.marker(*style, (left + KEY_PX / 2 + 2, y), 4)?;
            let name_y = if variant.is_empty() { y } else { y - 7 };
            for (text, y, size_px, color) in [
                (method, name_y, NAME_PX, INK),
                (variant, y + 9, VARIANT_PX, MUTED),
            ] {
                let chars = MAX_TEXT_PX / text_width_px("n", size_px);
                let text = shortened(text, chars as usize);
                canvas.text(&text, (text_x, y), &font(size_px, color, HPos::Left))?;
            }
        }
        Ok(())
    }
}
