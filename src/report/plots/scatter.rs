//! Scatter charts: named points with intervals on both axes, lines through some of them, and a front.

use anyhow::Result;
use plotters::prelude::DrawingBackend;

use super::axis::Axis;
use super::canvas::{
    CENTER, Canvas, FADED, FRONT, INK, LEFT, MUTED, PAPER, Px, WHISKER, text_width_px,
};
use super::labels::{self, Anchor, Placed, Rect};
use super::legend::Key;
use super::lines::Frame;

/// How large it is drawn: dozens of names need room.
pub(super) const SIZE_PX: (u32, u32) = (1200, 800);
const NAME_PX: i32 = 13;
const KEY_PX: i32 = 14;
const KEY_LINE_PX: i32 = 24;
/// Half the width of a whisker's end.
const CAP_PX: i32 = 3;

/// A scatter chart; less is better on both axes.
#[derive(Debug)]
pub(super) struct ScatterChart {
    pub(super) x: Axis,
    pub(super) y: Axis,
    pub(super) dots: Vec<Dot>,
    /// Each a curve through these dots.
    pub(super) curves: Vec<CurveLine>,
    /// The dots of the front, by ascending x.
    pub(super) front: Vec<usize>,
    /// What the intervals are.
    pub(super) interval: &'static str,
}

/// A named point.
#[derive(Debug)]
pub(super) struct Dot {
    pub(super) at: (f64, f64),
    pub(super) x_range: Option<(f64, f64)>,
    pub(super) y_range: Option<(f64, f64)>,
    pub(super) key: Key,
    pub(super) name: String,
    pub(super) on_front: bool,
}

/// A line through dots, named in the key.
#[derive(Debug)]
pub(super) struct CurveLine {
    pub(super) key: Key,
    pub(super) name: String,
    pub(super) dots: Vec<usize>,
}

/// An entry of the key above the chart.
enum Sample<'a> {
    Front,
    Dominated,
    Interval(&'a str),
    Curve(&'a CurveLine),
}

impl ScatterChart {
    pub(super) fn paint<DB: DrawingBackend>(&self, canvas: &Canvas<'_, DB>) -> Result<()>
    where
        DB::ErrorType: 'static,
    {
        let (width, height) = canvas.size();
        let below_key = self.paint_key(canvas, (16, 54))?;
        let frame = Frame {
            left: 84,
            right: width - 24,
            top: below_key + 8,
            bottom: height - 62,
        };
        frame.paint_y_axis(canvas, &self.y)?;
        frame.paint_x_axis(canvas, &self.x)?;
        self.paint_breaks(canvas, frame)?;

        let placed = self.place_names(frame);
        self.paint_whiskers(canvas, frame)?;
        for curve in &self.curves {
            canvas.line(self.path(frame, &curve.dots), curve.key.color, 1)?;
        }
        canvas.line(self.front_path(frame), FRONT, 2)?;
        for leader in placed.iter().filter_map(|(_, placed)| placed.leader) {
            canvas.line(leader.to_vec(), FADED, 1)?;
        }
        // The front over the others, where they lie at one place.
        for on_front in [false, true] {
            for dot in self.dots.iter().filter(|dot| dot.on_front == on_front) {
                self.paint_dot(canvas, frame, dot)?;
            }
        }
        for (index, Placed { rect, .. }) in &placed {
            let dot = &self.dots[*index];
            let color = if dot.on_front { INK } else { MUTED };
            let at = ((rect.left + rect.right) / 2, (rect.top + rect.bottom) / 2);
            canvas.text(&dot.name, at, NAME_PX, color, CENTER)?;
        }
        Ok(())
    }

    fn place_of(&self, frame: Frame, (x, y): (f64, f64)) -> Px {
        (frame.x(&self.x, x), frame.y(&self.y, y))
    }

    fn path(&self, frame: Frame, dots: &[usize]) -> Vec<Px> {
        let at = |index: &usize| self.place_of(frame, self.dots[*index].at);
        dots.iter().map(at).collect()
    }

    /// The front as steps: at each time, the fewest wrong pixels that one can have by then.
    fn front_path(&self, frame: Frame) -> Vec<Px> {
        let mut path: Vec<Px> = Vec::new();
        for (x, y) in self.path(frame, &self.front) {
            path.push((x, path.last().map_or(frame.top, |last| last.1)));
            path.push((x, y));
        }
        path.extend(path.last().map(|last| (frame.right, last.1)));
        path
    }

    /// The names' places, those of the front first: they matter most.
    fn place_names(&self, frame: Frame) -> Vec<(usize, Placed)> {
        let mut order: Vec<usize> = (0..self.dots.len()).collect();
        order.sort_by_key(|index| !self.dots[*index].on_front);
        let anchors: Vec<Anchor> = order
            .iter()
            .map(|index| {
                let dot = &self.dots[*index];
                Anchor {
                    at: self.place_of(frame, dot.at),
                    size: (text_width_px(&dot.name, NAME_PX) + 4, NAME_PX + 3),
                }
            })
            .collect();
        let bounds = Rect {
            left: frame.left + 2,
            top: frame.top + 2,
            right: frame.right - 2,
            bottom: frame.bottom - 2,
        };
        let curves = self
            .curves
            .iter()
            .map(|curve| self.path(frame, &curve.dots));
        let paths: Vec<Vec<Px>> = curves.chain([self.front_path(frame)]).collect();
        let pieces = paths.iter().flat_map(|path| path.windows(2));
        let lines: Vec<[Px; 2]> = pieces.map(|ends| [ends[0], ends[1]]).collect();
        let placed = labels::place(&anchors, bounds, &lines);
        order.into_iter().zip(placed).collect()
    }

    fn paint_dot<DB: DrawingBackend>(
        &self,
        canvas: &Canvas<'_, DB>,
        frame: Frame,
        dot: &Dot,
    ) -> Result<()>
    where
        DB::ErrorType: 'static,
    {
        let at = self.place_of(frame, dot.at);
        let Some(marker) = dot.key.marker else {
            return Ok(());
        };
        if dot.on_front {
            canvas.marker(marker, at, 6, PAPER)?;
            canvas.marker(marker, at, 5, dot.key.color)
        } else {
            canvas.marker(marker, at, 4, FADED)
        }
    }

    fn paint_whiskers<DB: DrawingBackend>(
        &self,
        canvas: &Canvas<'_, DB>,
        frame: Frame,
    ) -> Result<()>
    where
        DB::ErrorType: 'static,
    {
        for dot in &self.dots {
            let (x, y) = self.place_of(frame, dot.at);
            if let Some((low, high)) = dot.x_range {
                let (low, high) = (frame.x(&self.x, low), frame.x(&self.x, high));
                canvas.line(vec![(low, y), (high, y)], WHISKER, 1)?;
                for end in [low, high] {
                    canvas.line(vec![(end, y - CAP_PX), (end, y + CAP_PX)], WHISKER, 1)?;
                }
            }
            if let Some((low, high)) = dot.y_range {
                let (low, high) = (frame.y(&self.y, low), frame.y(&self.y, high));
                canvas.line(vec![(x, low), (x, high)], WHISKER, 1)?;
                for end in [low, high] {
                    canvas.line(vec![(x - CAP_PX, end), (x + CAP_PX, end)], WHISKER, 1)?;
                }
            }
        }
        Ok(())
    }

    /// Shows where the axes break off before zero: a dashed line, and a gap in the axis.
    fn paint_breaks<DB: DrawingBackend>(&self, canvas: &Canvas<'_, DB>, frame: Frame) -> Result<()>
    where
        DB::ErrorType: 'static,
    {
        let part = |length: i32, fraction: f64| (f64::from(length) * fraction).round() as i32;
        let (mut left, mut bottom) = (frame.left, frame.bottom);
        if let Some(band) = self.x.zero_band() {
            left += part(frame.right - frame.left, band * 0.92);
            canvas.dashed_line(vec![(left, frame.top), (left, frame.bottom)], MUTED, 1, 4)?;
        }
        if let Some(band) = self.y.zero_band() {
            bottom -= part(frame.bottom - frame.top, band * 0.92);
            canvas.dashed_line(
                vec![(frame.left, bottom), (frame.right, bottom)],
                MUTED,
                1,
                4,
            )?;
        }
        canvas.line(
            vec![(frame.left, frame.top), (frame.left, bottom)],
            MUTED,
            1,
        )?;
        if bottom < frame.bottom {
            canvas.rect(
                [(frame.left - 5, bottom - 3), (frame.left + 5, bottom + 3)],
                PAPER,
            )?;
            for y in [bottom - 3, bottom + 3] {
                let slash = vec![(frame.left - 6, y + 3), (frame.left + 6, y - 3)];
                canvas.line(slash, MUTED, 1)?;
            }
        }
        Ok(())
    }

    /// Draws the key in rows from `at` and gives the height at which it ends.
    fn paint_key<DB: DrawingBackend>(&self, canvas: &Canvas<'_, DB>, at: Px) -> Result<i32>
    where
        DB::ErrorType: 'static,
    {
        let has = |found: bool, sample| found.then_some(sample);
        let dominated = self.dots.iter().any(|dot| !dot.on_front);
        let ranged = |dot: &Dot| dot.x_range.or(dot.y_range).is_some();
        let interval = self.dots.iter().any(ranged);
        let samples = [
            Some(Sample::Front),
            has(dominated, Sample::Dominated),
            has(interval, Sample::Interval(self.interval)),
        ];
        let curves = self.curves.iter().map(Sample::Curve);
        let (width, _) = canvas.size();
        let (mut x, mut y) = at;
        for sample in samples.into_iter().flatten().chain(curves) {
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
}

impl Sample<'_> {
    fn name(&self) -> &str {
        match self {
            Self::Front => "Pareto front",
            Self::Dominated => "dominated",
            Self::Interval(what) => what,
            Self::Curve(curve) => &curve.name,
        }
    }

    fn paint<DB: DrawingBackend>(&self, canvas: &Canvas<'_, DB>, (x, y): Px) -> Result<()>
    where
        DB::ErrorType: 'static,
    {
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
            Self::Curve(curve) => {
                canvas.line(vec![(x, y), (right, y)], curve.key.color, 1)?;
                curve.key.marker(canvas, (middle, y))
            }
        }
    }
}
