//! Grouped bars: a bar per entry of the legend in each group, with a whisker where there is a spread.

use anyhow::Result;
use plotters::style::text_anchor::HPos;

use super::axis::Frame;
use super::canvas::{
    Canvas, INK, MUTED, PAPER, Px, Rect, Style, font, shortened, text_width_px, upright,
};
use crate::report::curve::Contender;

const NAME_PX: i32 = 13;
const LINE_PX: usize = 17;
/// Group names that cannot be broken to fit are turned upright and get at most this much room.
const UPRIGHT_PX: i32 = 220;
const MAX_BAR_PX: i32 = 56;

/// Bars side by side: those of a scene or of a device.
#[derive(Debug, Clone, Default)]
pub(super) struct Group {
    pub(super) name: String,
    /// What it has in common with groups beside it; may be empty.
    pub(super) band: String,
    /// Whether these are not results but others' numbers: drawn hollow, gaps without a word.
    pub(super) is_hollow: bool,
    /// Value and end of the whisker, for each entry of the legend; `None` where nothing was measured.
    pub(super) bars: Vec<Option<(f64, f64)>>,
}

impl Group {
    /// Draws the bars of the group at `index`.
    pub(super) fn paint(
        &self,
        canvas: &Canvas<'_, '_>,
        frame: &Frame,
        index: usize,
        legend: &[(Style, Contender)],
    ) -> Result<()> {
        let (left, right) = span(frame, index, 1);
        let bars = self.bars.len().max(1) as i32;
        let pitch = ((right - left) * 5 / 6 / bars).clamp(2, MAX_BAR_PX);
        let mut left = (left + right - pitch * bars) / 2;
        // All values or none: one alone would look as if it were special.
        let fits = |(value, _): &(f64, f64)| text_width_px(&three_digits(*value), 12) <= pitch + 6;
        let has_values = self.bars.iter().flatten().all(fits);
        for (bar, (style, _)) in self.bars.iter().zip(legend) {
            if let Some(bar) = bar {
                let end = self.paint_bar(canvas, frame, *bar, (left, pitch), *style)?;
                if has_values {
                    let value = three_digits(bar.0);
                    canvas.text(&value, (end.0, end.1 - 9), &font(12, INK, HPos::Center))?;
                }
            } else if pitch >= 12 && !self.is_hollow {
                let at = (left + pitch / 2, frame.area.bottom - 6);
                canvas.text("not measured", at, &upright(12, MUTED, HPos::Left))?;
            }
            left += pitch;
        }
        Ok(())
    }

    /// Gives the top of the bar and its whisker.
    fn paint_bar(
        &self,
        canvas: &Canvas<'_, '_>,
        frame: &Frame,
        (value, end): (f64, f64),
        (left, pitch): Px,
        style: Style,
    ) -> Result<Px> {
        let right = left + (pitch - (pitch / 8).max(1)).max(1);
        let middle = (left + right) / 2;
        let (top, end) = (frame.place((0.0, value)).1, frame.place((0.0, end)).1);
        let bottom = frame.area.bottom;
        canvas.rect([(left, top), (right, bottom)], style.color)?;
        if self.is_hollow {
            let inside = [(left + 2, (top + 2).min(bottom)), (right - 2, bottom)];
            canvas.rect(inside, PAPER)?;
        } else if pitch >= 12 && bottom - top >= 20 {
            let color = PAPER;
            canvas.marker(Style { color, ..style }, (middle, bottom - 10), 3)?;
        }
        if end < top {
            let cap_px = (pitch / 6).clamp(1, 5);
            let whisker = Style {
                cap_px,
                ..Style::line(INK, 1)
            };
            canvas.line(&[(middle, top), (middle, end)], whisker)?;
        }
        Ok((middle, end))
    }
}

/// From the left edge of the group at `index` to the right edge of the last of so many.
fn span(frame: &Frame, index: usize, groups: usize) -> Px {
    let edge = |index| frame.place((index as f64, 0.0)).0;
    (edge(index), edge(index + groups))
}

/// A value as a bar's label: three significant digits are what one reads off a chart.
fn three_digits(value: f64) -> String {
    match value {
        v if v >= 100.0 => format!("{v:.0}"),
        v if v >= 10.0 => format!("{v:.1}"),
        v => format!("{v:.2}"),
    }
}

/// The names of groups, in lines below them; upright where one has no room for that.
pub(super) struct GroupNames<'a> {
    groups: &'a [Group],
    broken: Option<Vec<Vec<String>>>,
}

impl<'a> GroupNames<'a> {
    /// `None` where there are no groups.
    pub(super) fn of(groups: &'a [Group], width_px: i32) -> Option<Self> {
        let group_px = width_px.checked_div(groups.len() as i32)?;
        let names = groups.iter().map(|group| broken(&group.name, group_px - 6));
        let broken = names.collect();
        Some(Self { groups, broken })
    }

    pub(super) fn height_px(&self) -> i32 {
        if let Some(names) = &self.broken {
            let lines = names.iter().map(Vec::len).max().unwrap_or_default();
            return (26 + LINE_PX * lines) as i32;
        }
        let names = self.groups.iter();
        let longest = names.map(|group| text_width_px(&group.name, NAME_PX)).max();
        longest.unwrap_or_default().min(UPRIGHT_PX) + 12
    }

    /// Names the groups below the frame and the bands above it, with a line between bands.
    pub(super) fn paint(&self, canvas: &Canvas<'_, '_>, frame: &Frame) -> Result<()> {
        let Rect { top, bottom, .. } = frame.area;
        let name_font = font(NAME_PX, INK, HPos::Center);
        for (index, group) in self.groups.iter().enumerate() {
            let (left, right) = span(frame, index, 1);
            let at = |below_px| ((left + right) / 2, bottom + below_px);
            if let Some(names) = &self.broken {
                for (line, below_px) in names[index].iter().zip((16..).step_by(LINE_PX)) {
                    canvas.text(line, at(below_px), &name_font)?;
                }
            } else {
                let chars = UPRIGHT_PX / text_width_px("n", NAME_PX);
                let name = shortened(&group.name, chars as usize);
                canvas.text(&name, at(8), &upright(NAME_PX, INK, HPos::Right))?;
            }
        }
        let mut first = 0;
        for band in self.groups.chunk_by(|a, b| a.band == b.band) {
            let (left, right) = span(frame, first, band.len());
            let middle = ((left + right) / 2, top - 10);
            canvas.text(&band[0].band, middle, &name_font)?;
            if first > 0 {
                canvas.line(&[(left, top - 16), (left, bottom)], Style::line(MUTED, 1))?;
            }
            first += band.len();
        }
        Ok(())
    }
}

/// `name` broken after underscores and spaces into at most three lines of `width_px`, where it fits.
fn broken(name: &str, width_px: i32) -> Option<Vec<String>> {
    let fits = |line: &str| text_width_px(line.trim_end(), NAME_PX) <= width_px;
    let mut lines = vec![String::new()];
    for part in name.split_inclusive(['_', ' ']) {
        let last = lines.last_mut()?;
        if last.is_empty() || fits(&format!("{last}{part}")) {
            last.push_str(part);
        } else {
            lines.push(part.to_owned());
        }
    }
    (lines.len() <= 3 && lines.iter().all(|line| fits(line))).then_some(lines)
}

#[cfg(test)]
mod tests {
    use super::broken;

    #[test]
    fn names_break_where_words_end() {
        assert_eq!(broken("sponza", 60).unwrap(), ["sponza"]);
        assert_eq!(
            broken("sphere_grid_n140", 90).unwrap(),
            ["sphere_grid_", "n140"]
        );
        assert_eq!(broken("a_name_of_very_many_parts", 40), None);
        assert_eq!(broken("unbreakable", 40), None);
    }
}
