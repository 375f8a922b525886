//! The rectangle that data is drawn in, with axes, grid and labels by plotters.

use anyhow::Result;
use plotters::prelude::{Cartesian2d, ChartBuilder, Color};

use super::axis::Axis;
use super::canvas::{Canvas, GRID, INK, MUTED, Px, font};

/// Room for tick labels and the title of the vertical axis.
const LEFT_PX: i32 = 84;
/// From the edge of the plot to the titles of its axes.
const EDGE_PX: i32 = 10;

/// What lies around the frame, in pixels.
#[derive(Debug, Clone, Copy)]
pub(super) struct Room {
    pub(super) top: i32,
    pub(super) right: i32,
    pub(super) bottom: i32,
}

/// The frame of a chart, in pixels, and its axes.
pub(super) struct Frame {
    pub(super) left: i32,
    pub(super) right: i32,
    pub(super) top: i32,
    pub(super) bottom: i32,
    axes: Cartesian2d<Axis, Axis>,
}

impl Frame {
    /// Draws axes and grid. An axis without ticks is a line.
    pub(super) fn paint(canvas: &Canvas<'_, '_>, x: &Axis, y: &Axis, room: Room) -> Result<Self> {
        let mut chart = ChartBuilder::on(canvas.0)
            .margin_top(room.top)
            .margin_right(room.right)
            .margin_left(EDGE_PX)
            .margin_bottom(EDGE_PX)
            .y_label_area_size(LEFT_PX - EDGE_PX)
            .x_label_area_size(room.bottom - EDGE_PX)
            .build_cartesian_2d(x.clone(), y.clone())?;
        chart
            .configure_mesh()
            .bold_line_style(GRID)
            .axis_style(MUTED.stroke_width(1))
            .label_style(font(14, MUTED))
            .axis_desc_style(font(15, INK))
            .set_all_tick_mark_size(4)
            .x_desc(&x.title)
            .y_desc(&y.title)
            .draw()?;
        let (across, down) = chart.plotting_area().get_pixel_range();
        Ok(Self {
            left: across.start,
            right: across.end,
            top: down.start,
            bottom: down.end,
            axes: chart.as_coord_spec().clone(),
        })
    }

    /// The place of a pair of values.
    pub(super) fn place(&self, (x, y): (f64, f64)) -> Px {
        use plotters::coord::CoordTranslate as _;
        self.axes.translate(&(x, y))
    }
}
