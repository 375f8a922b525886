//! Scatter charts: named points with intervals on both axes, lines through some of them, and a front.

use anyhow::Result;

use super::axis::Axis;
use super::canvas::{
    CENTER, Canvas, FADED, FRONT, INK, LEFT, MUTED, PAPER, Px, RIGHT, WHISKER, text_width_px,
};
use super::frame::{Frame, Room};
use super::labels::{self, Anchor, Placed, Rect};
use super::legend::Key;
use super::sample_row::{self, CAP_PX, Sample};

/// How large it is drawn: dozens of names need room.
pub(super) const SIZE_PX: (u32, u32) = (1200, 800);
const NAME_PX: i32 = 13;

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

impl ScatterChart {
    pub(super) fn paint(&self, canvas: &Canvas<'_, '_>) -> Result<()> {
        let below_key = sample_row::paint(self.samples(), canvas, (16, 54))?;
        let room = Room {
            top: below_key + 8,
            right: 24,
            bottom: 62,
        };
        let frame = &Frame::paint(canvas, &self.x, &self.y, room)?;
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
            let (x, _) = frame.place(dot.at);
            let y = (rect.top + rect.bottom) / 2;
            // Against the point: the room for a name is rather wider than the name.
            let (at, pos) = if rect.left >= x {
                ((rect.left + 2, y), LEFT)
            } else if rect.right <= x {
                ((rect.right - 2, y), RIGHT)
            } else {
                (((rect.left + rect.right) / 2, y), CENTER)
            };
            canvas.text(&dot.name, at, NAME_PX, color, pos)?;
        }
        Ok(())
    }

    /// What the key explains: what there is.
    fn samples(&self) -> impl Iterator<Item = Sample<'_>> {
        let dominated = self.dots.iter().any(|dot| !dot.on_front);
        let interval = self
            .dots
            .iter()
            .any(|dot| dot.x_range.or(dot.y_range).is_some());
        let samples = [
            Some(Sample::Front),
            dominated.then_some(Sample::Dominated),
            interval.then_some(Sample::Interval(self.interval)),
        ];
        let curves = self.curves.iter();
        let curves = curves.map(|curve| Sample::Curve(curve.key, &curve.name));
        samples.into_iter().flatten().chain(curves)
    }

    fn path(&self, frame: &Frame, dots: &[usize]) -> Vec<Px> {
        let at = |index: &usize| frame.place(self.dots[*index].at);
        dots.iter().map(at).collect()
    }

    /// The front as steps: at each time, the fewest wrong pixels that one can have by then.
    fn front_path(&self, frame: &Frame) -> Vec<Px> {
        let mut path: Vec<Px> = Vec::new();
        for (x, y) in self.path(frame, &self.front) {
            path.push((x, path.last().map_or(frame.top, |last| last.1)));
            path.push((x, y));
        }
        path.extend(path.last().map(|last| (frame.right, last.1)));
        path
    }

    /// The names' places, those of the front first: they matter most.
    fn place_names(&self, frame: &Frame) -> Vec<(usize, Placed)> {
        let mut order: Vec<usize> = (0..self.dots.len()).collect();
        order.sort_by_key(|index| !self.dots[*index].on_front);
        let anchors: Vec<Anchor> = order
            .iter()
            .map(|index| {
                let dot = &self.dots[*index];
                Anchor {
                    at: frame.place(dot.at),
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
        let placed = labels::place(&anchors, bounds, &self.lines(frame));
        order.into_iter().zip(placed).collect()
    }

    /// Every line that a name had better not lie over.
    fn lines(&self, frame: &Frame) -> Vec<[Px; 2]> {
        let curves = self.curves.iter();
        let paths = curves.map(|curve| self.path(frame, &curve.dots));
        let mut lines: Vec<[Px; 2]> = Vec::new();
        for path in paths.chain([self.front_path(frame)]) {
            lines.extend(path.windows(2).map(|ends| [ends[0], ends[1]]));
        }
        for dot in &self.dots {
            lines.extend(self.whiskers(frame, dot).into_iter().flatten());
        }
        let y = self.break_y(frame);
        lines.extend(y.map(|y| [(frame.left, y), (frame.right, y)]));
        lines
    }

    /// The height at which the vertical axis breaks off before zero, if it does.
    fn break_y(&self, frame: &Frame) -> Option<i32> {
        let band = self.y.zero_band()?;
        let band_px = f64::from(frame.bottom - frame.top) * band * 0.92;
        Some(frame.bottom - band_px.round() as i32)
    }

    /// A dot's intervals, the horizontal one first.
    fn whiskers(&self, frame: &Frame, dot: &Dot) -> [Option<[Px; 2]>; 2] {
        let (x, y) = dot.at;
        let across = |(low, high)| [low, high].map(|x| frame.place((x, y)));
        let along = |(low, high)| [low, high].map(|y| frame.place((x, y)));
        [dot.x_range.map(across), dot.y_range.map(along)]
    }

    fn paint_dot(&self, canvas: &Canvas<'_, '_>, frame: &Frame, dot: &Dot) -> Result<()> {
        let at = frame.place(dot.at);
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

    fn paint_whiskers(&self, canvas: &Canvas<'_, '_>, frame: &Frame) -> Result<()> {
        for dot in &self.dots {
            let [across, along] = self.whiskers(frame, dot);
            for (ends, cap) in [(across, (0, CAP_PX)), (along, (CAP_PX, 0))] {
                for end in ends.into_iter().flatten() {
                    let (from, to) = (
                        (end.0 - cap.0, end.1 - cap.1),
                        (end.0 + cap.0, end.1 + cap.1),
                    );
                    canvas.line(vec![from, to], WHISKER, 1)?;
                }
                if let Some(ends) = ends {
                    canvas.line(ends.to_vec(), WHISKER, 1)?;
                }
            }
        }
        Ok(())
    }

    /// Shows where the axes break off before zero: a dashed line, and a gap in the axis.
    fn paint_breaks(&self, canvas: &Canvas<'_, '_>, frame: &Frame) -> Result<()> {
        let left = frame.left;
        if let Some(band) = self.x.zero_band() {
            let band_px = f64::from(frame.right - left) * band * 0.92;
            let x = left + band_px.round() as i32;
            canvas.dashed_line(vec![(x, frame.top), (x, frame.bottom)], MUTED, 4)?;
        }
        let bottom = self.break_y(frame).unwrap_or(frame.bottom);
        if bottom < frame.bottom {
            canvas.dashed_line(vec![(left, bottom), (frame.right, bottom)], MUTED, 4)?;
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
}
