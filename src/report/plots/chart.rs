//! A chart as a value, and how it is drawn: axes by plotters, then lines, named dots or grouped bars, and a
//! legend.

use anyhow::Result;
use plotters::prelude::{ChartBuilder, Color as _};
use plotters::style::text_anchor::HPos;

use super::axis::{Axis, Frame};
use super::bars::{Group, GroupNames};
use super::canvas::{
    Canvas, FADED, GRID, INK, MUTED, PAPER, Px, Rect, Style, font, shortened, text_width_px,
};
use super::labels::{self, Anchor, Placed};
use super::legend::Legend;
use crate::report::curve::Contender;

/// Size of a plot in pixels; those with long legends are higher.
const SIZE_PX: (u32, u32) = (930, 560);
/// Dozens of names need room.
const SIZE_WITH_NAMES_PX: (u32, u32) = (1400, 800);
/// Room for tick labels and the title of the vertical axis.
const LEFT_PX: i32 = 84;
const TOP_PX: i32 = 52;
const BOTTOM_PX: i32 = 62;
/// From the edge of the plot to the titles of its axes.
const EDGE_PX: i32 = 10;
const NAME_PX: i32 = 13;
/// Markers on a line with more points than this are thinned out to about this number.
const MAX_MARKERS: usize = 10;

#[derive(Debug, Default)]
pub(super) struct Chart {
    pub(super) x: Axis,
    pub(super) y: Axis,
    pub(super) lines: Vec<Line>,
    /// Those that matter most first.
    pub(super) dots: Vec<Dot>,
    /// Groups of bars, a bar for each entry of the legend.
    pub(super) groups: Vec<Group>,
    pub(super) legend: Vec<(Style, Contender)>,
}

/// Points by ascending x, and what the line through them looks like.
#[derive(Debug)]
pub(super) struct Line {
    pub(super) style: Style,
    pub(super) points: Vec<(f64, f64)>,
}

/// A point with a name beside it.
#[derive(Debug)]
pub(super) struct Dot {
    pub(super) at: (f64, f64),
    pub(super) style: Style,
    pub(super) name: String,
    /// Whether it is larger than the others, and its name darker.
    pub(super) is_strong: bool,
}

/// The title of an axis, and what makes the axis over its values.
pub(super) type AxisOf<'a> = (&'a str, fn(&str, &[f64]) -> Axis);

impl Chart {
    /// A chart of lines.
    pub(super) fn of_lines(
        (x_title, x): AxisOf<'_>,
        (y_title, y): AxisOf<'_>,
        lines: Vec<Line>,
        legend: Vec<(Style, Contender)>,
    ) -> Self {
        let points = lines.iter().flat_map(|line| line.points.iter().copied());
        let (xs, ys): (Vec<f64>, Vec<f64>) = points.unzip();
        Self {
            x: x(x_title, &xs),
            y: y(y_title, &ys),
            lines,
            legend,
            ..Self::default()
        }
    }

    /// A chart of bars.
    pub(super) fn of_bars(
        (title, axis): AxisOf<'_>,
        groups: Vec<Group>,
        legend: Vec<(Style, Contender)>,
    ) -> Self {
        let bars = groups.iter().flat_map(|group| group.bars.iter().flatten());
        let values: Vec<f64> = bars.flat_map(|(value, end)| [*value, *end]).collect();
        Self {
            x: Axis::of_groups(groups.len()),
            y: axis(title, &values),
            groups,
            legend,
            ..Self::default()
        }
    }

    pub(super) fn size_px(&self) -> (u32, u32) {
        let (width, height) = match self.dots[..] {
            [] => SIZE_PX,
            _ => SIZE_WITH_NAMES_PX,
        };
        let legend_px = Legend(&self.legend).height_px().unsigned_abs();
        (width, height.max(legend_px))
    }

    pub(super) fn paint(&self, canvas: &Canvas<'_, '_>, title: &str) -> Result<()> {
        let legend = Legend(&self.legend);
        let (width, _) = self.size_px();
        let right = width as i32 - legend.width_px();
        let title = shortened(title, (width / 10) as usize);
        canvas.text(&title, (16, 24), &font(18, INK, HPos::Left))?;
        let names = GroupNames::of(&self.groups, right - LEFT_PX);
        let bottom_px = names.as_ref().map_or(BOTTOM_PX, GroupNames::height_px);
        let frame = &self.paint_axes(canvas, legend.width_px(), bottom_px)?;
        let breaks = self.paint_breaks(canvas, frame)?;
        let mut paths = Vec::new();
        for line in &self.lines {
            let path: Vec<Px> = line.points.iter().map(|at| frame.place(*at)).collect();
            paint_line(canvas, &path, line.style)?;
            paths.push(path);
        }
        paths.extend(breaks);
        self.paint_dots(canvas, frame, &paths)?;
        if let Some(names) = names {
            names.paint(canvas, frame)?;
            for (index, group) in self.groups.iter().enumerate() {
                group.paint(canvas, frame, index, &self.legend)?;
            }
        }
        legend.paint(canvas, (frame.area.right, frame.area.top - 10))
    }

    /// Draws axes and grid. An axis without ticks is a line.
    fn paint_axes(&self, canvas: &Canvas<'_, '_>, right: i32, bottom: i32) -> Result<Frame> {
        let mut chart = ChartBuilder::on(canvas.0)
            .margin(EDGE_PX)
            .margin_top(TOP_PX)
            .margin_right(right)
            .y_label_area_size(LEFT_PX - EDGE_PX)
            .x_label_area_size(bottom - EDGE_PX)
            .build_cartesian_2d(self.x.clone(), self.y.clone())?;
        chart
            .configure_mesh()
            .bold_line_style(GRID)
            .axis_style(MUTED.stroke_width(1))
            .label_style(font(14, MUTED, HPos::Center))
            .axis_desc_style(font(15, INK, HPos::Center))
            .set_all_tick_mark_size(4)
            .x_desc(&self.x.title)
            .y_desc(&self.y.title)
            .draw()?;
        let (across, down) = chart.plotting_area().get_pixel_range();
        let area = Rect {
            left: across.start,
            top: down.start,
            right: across.end,
            bottom: down.end,
        };
        let axes = chart.as_coord_spec().clone();
        Ok(Frame { area, axes })
    }

    /// Shows where the axes break off before zero: by a dashed line, and by a gap in the vertical axis.
    fn paint_breaks(&self, canvas: &Canvas<'_, '_>, frame: &Frame) -> Result<Vec<Vec<Px>>> {
        let Rect {
            left,
            top,
            right,
            bottom,
        } = frame.area;
        let x = self.x.break_px(left, right);
        let y = self.y.break_px(bottom, top);
        let style = Style::line(MUTED, 1);
        if let Some(y) = y {
            canvas.rect([(left - 5, y - 3), (left + 5, y + 3)], PAPER)?;
            canvas.line(&[(left - 6, y), (left + 6, y - 6)], style)?;
            canvas.line(&[(left - 6, y + 6), (left + 6, y)], style)?;
        }
        let x = x.map(|x| vec![(x, top), (x, bottom)]);
        let y = y.map(|y| vec![(left, y), (right, y)]);
        let breaks: Vec<Vec<Px>> = x.into_iter().chain(y).collect();
        for line in &breaks {
            canvas.line(line, style.dashed(4))?;
        }
        Ok(breaks)
    }

    /// Draws the dots and their names, which keep off `lines`.
    fn paint_dots(&self, canvas: &Canvas<'_, '_>, frame: &Frame, lines: &[Vec<Px>]) -> Result<()> {
        let anchor = |dot: &Dot| Anchor {
            at: frame.place(dot.at),
            size: (text_width_px(&dot.name, NAME_PX) + 4, NAME_PX + 3),
        };
        let anchors: Vec<Anchor> = self.dots.iter().map(anchor).collect();
        let placed = labels::place(&anchors, frame.area, lines);
        for leader in placed.iter().filter_map(|placed| placed.leader) {
            canvas.line(&leader, Style::line(FADED, 1))?;
        }
        for (dot, anchor) in self.dots.iter().zip(&anchors).rev() {
            if dot.is_strong {
                let rim = Style {
                    color: PAPER,
                    ..dot.style
                };
                canvas.marker(rim, anchor.at, 6)?;
            }
            canvas.marker(dot.style, anchor.at, if dot.is_strong { 5 } else { 4 })?;
        }
        for ((dot, anchor), Placed { rect, .. }) in self.dots.iter().zip(&anchors).zip(&placed) {
            // Against the point: the room for a name is rather wider than the name.
            let (x, pos) = match anchor.at.0 {
                x if rect.left >= x => (rect.left + 2, HPos::Left),
                x if rect.right <= x => (rect.right - 2, HPos::Right),
                _ => ((rect.left + rect.right) / 2, HPos::Center),
            };
            let color = if dot.is_strong { INK } else { MUTED };
            let at = (x, (rect.top + rect.bottom) / 2);
            canvas.text(&dot.name, at, &font(NAME_PX, color, pos))?;
        }
        Ok(())
    }
}

fn paint_line(canvas: &Canvas<'_, '_>, path: &[Px], style: Style) -> Result<()> {
    canvas.line(path, style)?;
    let step = path.len().div_ceil(MAX_MARKERS).max(1);
    // Lines begin their markers at different points, so that near ones do not hide each other.
    let first = (style.marker.unwrap_or_default() * 3) % step;
    for at in path.iter().skip(first).step_by(step) {
        canvas.marker(style, *at, if style.dash_px > 0 { 3 } else { 4 })?;
    }
    Ok(())
}
