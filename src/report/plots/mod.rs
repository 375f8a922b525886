//! Plots of a run, each drawn by one function onto an SVG and onto a PNG.
//!
//! One plot a file: `shadow_time_by_triangles`, `flight`, `shadow_time_by_scene`, `paper`. These
//! choose the data; `lines` and `bars` draw it.

use std::path::Path;
use std::sync::Once;

use anyhow::{Context as _, Result};
use plotters::prelude::{
    BitMapBackend, DrawingArea, DrawingBackend, FontStyle, IntoDrawingArea, SVGBackend,
};
use plotters::style::register_font;

use super::load::Run;
use super::paper::Paper;

mod axis;
mod bars;
mod canvas;
mod flight;
mod legend;
mod lines;
mod paper;
mod shadow_time_by_scene;
mod shadow_time_by_triangles;

/// Size of every plot in pixels, in which everything on it is placed.
const SIZE_PX: (u32, u32) = (900, 560);
/// A PNG has this many pixels for each of them: text set at whole pixels is uneven at fewer.
const PNG_SCALE: u32 = 2;

/// One plot of a run.
#[derive(Debug)]
pub struct Plot {
    /// File name without extension.
    pub name: String,
    /// What it shows, in a line.
    pub title: String,
    /// The plot as an SVG document.
    pub svg: String,
    chart: Chart,
}

/// What is drawn, before it is drawn.
#[derive(Debug)]
enum Chart {
    Lines(lines::LineChart),
    Bars(bars::BarChart),
}

/// A chart with its name and title.
#[derive(Debug)]
struct Figure {
    name: String,
    title: String,
    chart: Chart,
}

/// Every plot that the run has data for.
pub fn draw(run: &Run) -> Result<Vec<Plot>> {
    let mut figures = shadow_time_by_triangles::figures(run);
    figures.extend(shadow_time_by_scene::figure(run));
    figures.extend(flight::figures(run));
    figures.into_iter().map(Plot::new).collect()
}

/// Figures 5 to 8 of the paper: its curves and the measured ones in one picture.
pub fn draw_paper(paper: &Paper) -> Result<Vec<Plot>> {
    paper::figures(paper).into_iter().map(Plot::new).collect()
}

impl Plot {
    fn new(Figure { name, title, chart }: Figure) -> Result<Self> {
        install_font();
        let mut svg = String::new();
        let backend = SVGBackend::with_string(&mut svg, SIZE_PX);
        paint(&chart, &title, &backend.into_drawing_area())
            .with_context(|| format!("cannot draw the plot {name}"))?;
        Ok(Self {
            name,
            title,
            svg,
            chart,
        })
    }

    /// Writes the plot as a PNG to `path`, whose extension must be `.png`.
    pub fn write_png(&self, path: &Path) -> Result<()> {
        install_font();
        let size_px = (SIZE_PX.0 * PNG_SCALE, SIZE_PX.1 * PNG_SCALE);
        let backend = BitMapBackend::new(path, size_px);
        paint(&self.chart, &self.title, &backend.into_drawing_area())
            .with_context(|| format!("cannot draw the plot {}", self.name))
    }
}

/// Draws a chart onto any backend; all that tells an SVG from a PNG has been decided before.
fn paint<DB: DrawingBackend>(
    chart: &Chart,
    title: &str,
    area: &DrawingArea<DB, plotters::coord::Shift>,
) -> Result<()>
where
    DB::ErrorType: 'static,
{
    let canvas = canvas::Canvas::new(area)?;
    canvas.title(title)?;
    match chart {
        Chart::Lines(chart) => chart.paint(&canvas)?,
        Chart::Bars(chart) => chart.paint(&canvas)?,
    }
    area.present().map_err(anyhow::Error::from)
}

/// Gives plotters the font that comes with the program: a PNG must look alike on every machine, also
/// on one without fonts.
fn install_font() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        let bytes = epaint_default_fonts::UBUNTU_LIGHT;
        let installed = register_font(canvas::FONT, FontStyle::Normal, bytes);
        debug_assert!(
            installed.is_ok(),
            "the font that comes with the program is valid"
        );
    });
}
