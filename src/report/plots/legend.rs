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

/// What each line or bar looks like, and whose it is; from the top.
pub(super) struct Legend<'a>(pub(super) Vec<(Key, &'a Contender)>);

impl<'a> Legend<'a> {
    pub(super) fn of(keys: &'a [(Key, Contender)]) -> Self {
        Self(keys.iter().map(|(key, name)| (*key, name)).collect())
    }

    pub(super) fn width_px(&self) -> i32 {
        let texts = self
            .0
            .iter()
            .flat_map(|(_, Contender { method, variant })| {
                [(method, NAME_PX), (variant, VARIANT_PX)]
            });
        let text_px = texts
            .map(|(text, size_px)| text_width_px(text, size_px))
            .max();
        KEY_PX + text_px.unwrap_or_default().min(MAX_TEXT_PX) + 12
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
        for (index, (key, Contender { method, variant })) in self.0.iter().enumerate() {
            let y = top + pitch_px / 2 + index as i32 * pitch_px;
            key.line(canvas, vec![(left + 12, y), (text_x - 8, y)])?;
            key.marker(canvas, (left + KEY_PX / 2 + 2, y))?;
            let name_y = if variant.is_empty() { y } else { y - 7 };
            let method = fitted(method, NAME_PX);
            canvas.text(&method, (text_x, name_y), NAME_PX, INK, LEFT)?;
            if !variant.is_empty() {
                let variant = fitted(variant, VARIANT_PX);
                canvas.text(&variant, (text_x, y + 9), VARIANT_PX, MUTED, LEFT)?;
            }
        }
        Ok(())
    }
}

fn fitted(text: &str, size_px: i32) -> String {
    canvas::shortened(text, (MAX_TEXT_PX / text_width_px("n", size_px)) as usize)
}
