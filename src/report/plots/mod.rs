//! Plots of a run, each drawn by one function onto an SVG and onto a PNG.
//!
//! One plot a file: `pareto`, `errors_by_parameter`, `shadow_time_by_triangles`, `flight`, `shadow_time_by_scene`, `paper`.
//! These choose the data; `scatter`, `lines` and `bars` draw it.

use std::path::Path;
use std::sync::Once;

use anyhow::{Context as _, Result};
use plotters::prelude::{
    BitMapBackend, DrawingArea, DrawingBackend, FontStyle, IntoDrawingArea, SVGBackend,
};
use plotters::style::register_font;

use super::load::Run;
use super::paper::Paper;
use super::pareto::Cloud;
use crate::record::Image;

mod axis;
mod bars;
mod canvas;
mod chosen;
mod errors_by_parameter;
mod flight;
mod labels;
mod legend;
mod lines;
mod paper;
mod pareto;
mod sample_row;
mod scatter;
mod shadow_time_by_scene;
mod shadow_time_by_triangles;

/// How the names of plots begin that depend on the scenes of a run.
pub(super) const SCENE_PLOT_PREFIXES: [&str; 2] = [pareto::PREFIX, errors_by_parameter::PREFIX];

/// Size of a plot in pixels, in which everything on it is placed; but scatter charts are larger, and
/// those with more in their legends higher.
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
    Scatter(scatter::ScatterChart),
}

impl Chart {
    fn size_px(&self) -> (u32, u32) {
        let legend_px = match self {
            Self::Lines(chart) => chart.legend_height_px(),
            Self::Bars(chart) => chart.legend_height_px(),
            Self::Scatter(_) => return scatter::SIZE_PX,
        };
        (SIZE_PX.0, SIZE_PX.1.max(legend_px.unsigned_abs()))
    }
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

/// Accuracy against speed, a plot for each cloud; then wrong pixels by each swept parameter.
pub fn draw_pareto(run: &Run, clouds: &[Cloud]) -> Result<Vec<Plot>> {
    let figures = pareto::figures(run, clouds).into_iter();
    let by_parameter = errors_by_parameter::figures(run, clouds);
    figures.chain(by_parameter).map(Plot::new).collect()
}

/// Figures 5 to 8 of the paper: its curves and the measured ones in one picture.
pub fn draw_paper(paper: &Paper) -> Result<Vec<Plot>> {
    paper::figures(paper).into_iter().map(Plot::new).collect()
}

impl Plot {
    fn new(Figure { name, title, chart }: Figure) -> Result<Self> {
        install_font();
        let mut svg = String::new();
        let backend = SVGBackend::with_string(&mut svg, chart.size_px());
        paint(&chart, &title, &backend.into_drawing_area())
            .with_context(|| format!("cannot draw the plot {name}"))?;
        Ok(Self {
            name,
            title,
            svg,
            chart,
        })
    }

    /// Whether it shows accuracy against speed.
    pub fn is_pareto(&self) -> bool {
        matches!(self.chart, Chart::Scatter(_))
    }

    /// Writes the plot as a PNG to `path`.
    pub fn write_png(&self, path: &Path) -> Result<()> {
        install_font();
        let (width, height) = self.chart.size_px();
        let size_px = (width * PNG_SCALE, height * PNG_SCALE);
        let mut rgb = vec![0; 3 * size_px.0 as usize * size_px.1 as usize];
        let backend = BitMapBackend::with_buffer(&mut rgb, size_px);
        paint(&self.chart, &self.title, &backend.into_drawing_area())
            .with_context(|| format!("cannot draw the plot {}", self.name))?;
        Image::rgb(size_px, &rgb).write_png(path)
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
    let canvas = canvas::Canvas::new(area, chart.size_px())?;
    canvas.title(title)?;
    match chart {
        Chart::Lines(chart) => chart.paint(&canvas)?,
        Chart::Bars(chart) => chart.paint(&canvas)?,
        Chart::Scatter(chart) => chart.paint(&canvas)?,
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
