//! Grouped bars: a bar per contender in each group, with a whisker where there is a spread.

use anyhow::Result;

use super::axis::Axis;
use super::canvas::{self, CENTER, Canvas, INK, LEFT, MUTED, PAPER, RIGHT, text_width_px};
use super::frame::{Frame, Room};
use super::legend::{Key, Legend};

use crate::report::curve::Contender;

const GROUP_NAME_PX: i32 = 13;
/// Group names that cannot be broken to fit are turned upright and get at most this much room.
const UPRIGHT_PX: i32 = 220;
const MAX_BAR_PX: i32 = 56;

/// A chart of grouped bars.
#[derive(Debug)]
pub(super) struct BarChart {
    pub(super) y: Axis,
    /// Whose bars they are, and what each looks like.
    pub(super) keys: Vec<(Key, Contender)>,
    pub(super) groups: Vec<Group>,
    /// What several groups side by side have in common, and how many those are; may be empty.
    pub(super) bands: Vec<(String, usize)>,
}

/// The bars of one scene.
#[derive(Debug)]
pub(super) struct Group {
    pub(super) name: String,
    /// Whether these are not results but others' numbers: drawn hollow, gaps without a word.
    pub(super) hollow: bool,
    /// A bar per contender, in their order; `None` where nothing was measured.
    pub(super) bars: Vec<Option<Bar>>,
}

/// A bar and its whisker.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bar {
    pub(super) value: f64,
    /// How far the whisker reaches, if there is one.
    pub(super) whisker: Option<f64>,
}

/// Where a group of bars stands.
#[derive(Debug, Clone, Copy)]
struct Slots {
    /// Left edge of the first bar.
    left: i32,
    /// From one bar to the next.
    pitch: i32,
}

impl BarChart {
    pub(super) fn legend(&self) -> Legend<'_> {
        Legend::of(&self.keys)
    }

    pub(super) fn paint(&self, canvas: &Canvas<'_, '_>) -> Result<()> {
        let legend = self.legend();
        let legend_px = legend.width_px();
        let (left, right) = (84, canvas.size().0 - legend_px);
        let group_px = (right - left) / i32::try_from(self.groups.len())?.max(1);
        let names: Option<Vec<Vec<String>>> = self
            .groups
            .iter()
            .map(|group| broken(&group.name, group_px - 6))
            .collect();
        let lines = names
            .iter()
            .flatten()
            .map(Vec::len)
            .max()
            .unwrap_or_default() as i32;
        let name_px = if names.is_some() {
            14 + 17 * lines
        } else {
            let names = self.groups.iter();
            let longest = names.map(|group| text_width_px(&group.name, GROUP_NAME_PX));
            longest.max().unwrap_or_default().min(UPRIGHT_PX)
        };
        let room = Room {
            top: 52,
            right: legend_px,
            bottom: name_px + 12,
        };
        let frame = &Frame::paint(canvas, &Axis::of_groups(self.groups.len()), &self.y, room)?;
        for (index, group) in self.groups.iter().enumerate() {
            let group_left = left + index as i32 * group_px;
            self.paint_group(canvas, frame, group, (group_left, group_px))?;
            let lines = names.as_ref().map(|names| names[index].as_slice());
            paint_name(
                canvas,
                &group.name,
                lines,
                (group_left + group_px / 2, frame.bottom),
            )?;
        }
        self.paint_bands(canvas, frame, group_px)?;

        legend.paint(canvas, (right, frame.top - 10))
    }

    /// Names the bands at the top of the frame, with a line between them.
    fn paint_bands(&self, canvas: &Canvas<'_, '_>, frame: &Frame, group_px: i32) -> Result<()> {
        let mut left = frame.left;
        for (name, groups) in &self.bands {
            let right = left + *groups as i32 * group_px;
            let at = ((left + right) / 2, frame.top - 10);
            canvas.text(name, at, GROUP_NAME_PX, INK, CENTER)?;
            if left > frame.left {
                canvas.line(vec![(left, frame.top - 16), (left, frame.bottom)], MUTED, 1)?;
            }
            left = right;
        }
        Ok(())
    }

    fn paint_group(
        &self,
        canvas: &Canvas<'_, '_>,
        frame: &Frame,
        group: &Group,
        (group_left, group_px): (i32, i32),
    ) -> Result<()> {
        let bars = group.bars.len().max(1) as i32;
        let pitch = (group_px * 5 / 6 / bars).clamp(2, MAX_BAR_PX);
        let slots = Slots {
            left: group_left + (group_px - pitch * bars) / 2,
            pitch,
        };
        for (index, bar) in group.bars.iter().enumerate() {
            match bar {
                Some(bar) => {
                    self.paint_bar(canvas, frame, *bar, (index, slots), group.hollow)?;
                }
                None if pitch >= 12 && !group.hollow => {
                    let at = (
                        slots.left + index as i32 * pitch + pitch / 2,
                        frame.bottom - 6,
                    );
                    canvas.text_upwards("not measured", at, 12, MUTED, LEFT)?;
                }
                None => {}
            }
        }
        Ok(())
    }

    fn paint_bar(
        &self,
        canvas: &Canvas<'_, '_>,
        frame: &Frame,
        bar: Bar,
        (index, slots): (usize, Slots),
        hollow: bool,
    ) -> Result<()> {
        let left = slots.left + index as i32 * slots.pitch;
        let right = left + (slots.pitch - (slots.pitch / 8).max(1)).max(1);
        let middle = (left + right) / 2;
        let top = frame.place((0.0, bar.value)).1;
        let key = self.keys[index].0;
        canvas.rect([(left, top), (right, frame.bottom)], key.color)?;
        if hollow {
            let inside = [
                (left + 2, (top + 2).min(frame.bottom)),
                (right - 2, frame.bottom),
            ];
            canvas.rect(inside, PAPER)?;
        } else if slots.pitch >= 12 && frame.bottom - top >= 20 {
            let marker = key.marker.unwrap_or(index);
            canvas.marker(marker, (middle, frame.bottom - 10), 3, PAPER)?;
        }
        let end = bar.whisker.map_or(top, |end| frame.place((0.0, end)).1);
        if bar.whisker.is_some() {
            canvas.line(vec![(middle, top), (middle, end)], INK, 1)?;
            let cap = (slots.pitch / 6).clamp(1, 5);
            canvas.line(vec![(middle - cap, end), (middle + cap, end)], INK, 1)?;
        }
        let value = three_digits(bar.value);
        if text_width_px(&value, 12) <= slots.pitch + 6 {
            canvas.text(&value, (middle, end - 9), 12, INK, CENTER)?;
        }
        Ok(())
    }
}

/// A value as a bar's label: three significant digits are what one reads off a chart.
fn three_digits(value: f64) -> String {
    match value {
        v if v >= 100.0 => format!("{v:.0}"),
        v if v >= 10.0 => format!("{v:.1}"),
        v => format!("{v:.2}"),
    }
}

fn paint_name(
    canvas: &Canvas<'_, '_>,
    name: &str,
    lines: Option<&[String]>,
    (middle, bottom): (i32, i32),
) -> Result<()> {
    let Some(lines) = lines else {
        let chars = UPRIGHT_PX / text_width_px("n", GROUP_NAME_PX);
        let name = canvas::shortened(name, chars as usize);
        return canvas.text_upwards(&name, (middle, bottom + 8), GROUP_NAME_PX, INK, RIGHT);
    };
    for (index, line) in lines.iter().enumerate() {
        let at = (middle, bottom + 16 + 17 * index as i32);
        canvas.text(line, at, GROUP_NAME_PX, INK, CENTER)?;
    }
    Ok(())
}

/// `name` broken after underscores and spaces into at most three lines of `width_px`, where it fits.
fn broken(name: &str, width_px: i32) -> Option<Vec<String>> {
    let mut lines = vec![String::new()];
    for part in name.split_inclusive(['_', ' ']) {
        let last = lines.last_mut()?;
        if !last.is_empty() && text_width_px(&format!("{last}{part}"), GROUP_NAME_PX) > width_px {
            lines.push(part.to_owned());
        } else {
            last.push_str(part);
        }
    }
    let fits = lines.len() <= 3
        && lines
            .iter()
            .all(|line| text_width_px(line.trim_end(), GROUP_NAME_PX) <= width_px);
    fits.then_some(lines)
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
