//! Line charts: a line per contender, named at its end, or in a legend from the top.

use anyhow::Result;
use plotters::prelude::DrawingBackend;

use super::axis::Axis;
use super::canvas::{CENTER, Canvas, GRID, INK, MUTED, Px, RIGHT};
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

/// The rectangle that data is drawn in, in pixels.
#[derive(Debug, Clone, Copy)]
pub(super) struct Frame {
    pub(super) left: i32,
    pub(super) right: i32,
    pub(super) top: i32,
    pub(super) bottom: i32,
}

impl Frame {
    pub(super) fn x(&self, axis: &Axis, value: f64) -> i32 {
        self.left + (f64::from(self.right - self.left) * axis.fraction(value)).round() as i32
    }

    pub(super) fn y(&self, axis: &Axis, value: f64) -> i32 {
        self.bottom - (f64::from(self.bottom - self.top) * axis.fraction(value)).round() as i32
    }

    /// Draws the vertical axis with its grid.
    pub(super) fn paint_y_axis<DB: DrawingBackend>(
        &self,
        canvas: &Canvas<'_, DB>,
        axis: &Axis,
    ) -> Result<()>
    where
        DB::ErrorType: 'static,
    {
        for (value, label) in axis.ticks() {
            let y = self.y(axis, value);
            canvas.line(vec![(self.left, y), (self.right, y)], GRID, 1)?;
            canvas.text(&label, (self.left - 8, y), 14, MUTED, RIGHT)?;
        }
        let middle = (self.top + self.bottom) / 2;
        canvas.text_upwards(&axis.title, (20, middle), 15, INK, CENTER)
    }

    /// Draws the horizontal axis with its grid.
    pub(super) fn paint_x_axis<DB: DrawingBackend>(
        &self,
        canvas: &Canvas<'_, DB>,
        axis: &Axis,
    ) -> Result<()>
    where
        DB::ErrorType: 'static,
    {
        for (value, label) in axis.ticks() {
            let x = self.x(axis, value);
            canvas.line(vec![(x, self.top), (x, self.bottom)], GRID, 1)?;
            canvas.text(&label, (x, self.bottom + 16), 14, MUTED, CENTER)?;
        }
        canvas.line(
            vec![(self.left, self.bottom), (self.right, self.bottom)],
            MUTED,
            1,
        )?;
        let middle = (self.left + self.right) / 2;
        canvas.text(&axis.title, (middle, self.bottom + 42), 15, INK, CENTER)
    }
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

    pub(super) fn paint<DB: DrawingBackend>(&self, canvas: &Canvas<'_, DB>) -> Result<()>
    where
        DB::ErrorType: 'static,
    {
        let (width, height) = canvas.size();
        let legend_px = legend::width_px(self.named().into_iter());
        let frame = Frame {
            left: 84,
            right: width - legend_px,
            top: 52,
            bottom: height - 62,
        };
        frame.paint_y_axis(canvas, &self.y)?;
        frame.paint_x_axis(canvas, &self.x)?;
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

    fn entries_at_ends(&self, frame: Frame) -> Vec<Entry<'_>> {
        let entries = self.lines.iter().filter_map(|line| {
            let (_, end) = line.points.last()?;
            let wanted_y = frame.y(&self.y, *end);
            Some(Entry {
                key: line.key,
                contender: &line.contender,
                wanted_y,
            })
        });
        entries.collect()
    }

    fn paint_line<DB: DrawingBackend>(
        &self,
        canvas: &Canvas<'_, DB>,
        frame: Frame,
        line: &Line,
    ) -> Result<()>
    where
        DB::ErrorType: 'static,
    {
        let place = |(x, y): &(f64, f64)| (frame.x(&self.x, *x), frame.y(&self.y, *y));
        let points: Vec<Px> = line.points.iter().map(place).collect();
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
