//! Line charts: a line per contender, named at its end, or in a legend from the top.

use anyhow::Result;

use super::axis::Axis;
use super::canvas::{Canvas, Px};
use super::frame::{Frame, Room};
use super::legend::{self, Entry, Key};
use crate::report::curve::Contender;

/// Markers on a line with more points than this are thinned out to about this number.
const MAX_MARKERS: usize = 10;

/// A line chart.
#[derive(Debug)]
pub(super) struct LineChart {
    pub(super) x: Axis,
    pub(super) y: Axis,
    pub(super) lines: Vec<Line>,
    /// The legend's entries, where they are not the lines themselves: too many lines are told apart
    /// by two things, such as a colour and a marker, and each of those has entries of its own.
    pub(super) keys: Vec<(Key, Contender)>,
}

/// One contender's points, by ascending x.
#[derive(Debug)]
pub(super) struct Line {
    /// What it looks like.
    pub(super) key: Key,
    pub(super) contender: Contender,
    pub(super) points: Vec<(f64, f64)>,
}

impl LineChart {
    /// Whom the legend names.
    fn named(&self) -> Vec<&Contender> {
        if self.keys.is_empty() {
            self.lines.iter().map(|line| &line.contender).collect()
        } else {
            self.keys.iter().map(|(_, contender)| contender).collect()
        }
    }

    pub(super) fn legend_height_px(&self) -> i32 {
        legend::height_px(self.named().into_iter())
    }

    pub(super) fn paint(&self, canvas: &Canvas<'_, '_>) -> Result<()> {
        let (_, height) = canvas.size();
        let legend_px = legend::width_px(self.named().into_iter());
        let room = Room {
            top: 52,
            right: legend_px,
            bottom: 62,
        };
        let frame = &Frame::paint(canvas, &self.x, &self.y, room)?;
        for line in &self.lines {
            self.paint_line(canvas, frame, line)?;
        }
        let entries = if self.keys.is_empty() {
            self.entries_at_ends(frame)
        } else {
            legend::from_top(
                self.keys.iter().map(|(key, contender)| (*key, contender)),
                frame.top,
            )
        };
        legend::paint(canvas, entries, frame.right, (frame.top - 10, height - 10))
    }

    fn entries_at_ends(&self, frame: &Frame) -> Vec<Entry<'_>> {
        let entries = self.lines.iter().filter_map(|line| {
            let (_, end) = line.points.last()?;
            let wanted_y = frame.place((0.0, *end)).1;
            Some(Entry {
                key: line.key,
                contender: &line.contender,
                wanted_y,
            })
        });
        entries.collect()
    }

    fn paint_line(&self, canvas: &Canvas<'_, '_>, frame: &Frame, line: &Line) -> Result<()> {
        let points: Vec<Px> = line.points.iter().map(|at| frame.place(*at)).collect();
        line.key.line(canvas, points.clone())?;
        let step = points.len().div_ceil(MAX_MARKERS).max(1);
        // Lines begin their markers at different points, so that near ones do not hide each other.
        let first = (line.key.marker.unwrap_or_default() * 3) % step;
        for at in points.iter().skip(first).step_by(step) {
            line.key.marker(canvas, *at)?;
        }
        Ok(())
    }
}
