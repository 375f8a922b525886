//! Line charts: a line per contender.

use anyhow::Result;

use super::axis::Axis;
use super::canvas::{Canvas, Px};
use super::frame::{Frame, Room};
use super::legend::{Key, Legend};
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
    /// Without keys of its own, the lines from top to bottom as they end.
    pub(super) fn legend(&self) -> Legend<'_> {
        if !self.keys.is_empty() {
            return Legend::of(&self.keys);
        }
        let end = |line: &Line| line.points.last().map_or(0.0, |point| point.1);
        let mut lines: Vec<&Line> = self.lines.iter().collect();
        lines.sort_by(|a, b| end(b).total_cmp(&end(a)));
        Legend(
            lines
                .iter()
                .map(|line| (line.key, &line.contender))
                .collect(),
        )
    }

    pub(super) fn paint(&self, canvas: &Canvas<'_, '_>) -> Result<()> {
        let legend = self.legend();
        let room = Room {
            top: 52,
            right: legend.width_px(),
            bottom: 62,
        };
        let frame = &Frame::paint(canvas, &self.x, &self.y, room)?;
        for line in &self.lines {
            self.paint_line(canvas, frame, line)?;
        }
        legend.paint(canvas, (frame.right, frame.top - 10))
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
