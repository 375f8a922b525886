//! Plots of a run, each drawn by one function onto an SVG and onto a PNG.
//!
//! One plot a file: `pareto`, `errors_by_parameter`, `shadow_time_by_triangles`, `flight`, `shadow_time_by_scene`, `paper`.
//! These choose the data; `scatter`, `lines` and `bars` draw it.

use std::path::Path;
use std::sync::Once;

use anyhow::{Context as _, Result};
use plotters::prelude::{BitMapBackend, FontStyle, IntoDrawingArea, SVGBackend};
use plotters::style::register_font;

use super::load::Run;
use super::paper::{Paper, figure_names};
use super::pareto::Cloud;
use crate::output::{self, remove_stale, write_atomically};
use crate::record::Image;
use backend::{Backend, PNG_SCALE};

mod axis;
mod backend;
mod bars;
mod canvas;
mod chosen;
mod errors_by_parameter;
mod flight;
mod frame;
mod labels;
mod legend;
mod lines;
mod paper;
mod pareto;
mod sample_row;
mod scatter;
mod shadow_time_by_scene;
mod shadow_time_by_triangles;

/// Name of the folder of plots in a run directory.
pub const PLOTS_DIR: &str = "plots";
/// How the names of plots begin that depend on the scenes of a run.
const SCENE_PLOT_PREFIXES: [&str; 2] = [pareto::PREFIX, errors_by_parameter::PREFIX];

/// Size of a plot in pixels, in which everything on it is placed; but scatter charts are larger, and
/// those with more in their legends higher.
const SIZE_PX: (u32, u32) = (900, 560);

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

impl Chart {
    fn paint(&self, name: &str, title: &str, backend: Backend<'_>) -> Result<()> {
        install_font();
        let area = backend.into_drawing_area();
        area.fill(&canvas::PAPER)?;
        let canvas = &canvas::Canvas(&area);
        let painted = canvas.title(title).and_then(|()| match self {
            Self::Lines(chart) => chart.paint(canvas),
            Self::Bars(chart) => chart.paint(canvas),
            Self::Scatter(chart) => chart.paint(canvas),
        });
        painted.with_context(|| format!("cannot draw the plot {name}"))?;
        Ok(area.present()?)
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

/// The figures of papers: their curves and the measured ones in one picture.
pub fn draw_papers(papers: &[Paper]) -> Result<Vec<Plot>> {
    let figures = papers.iter().flat_map(paper::figures);
    figures.map(Plot::new).collect()
}

/// Writes the plots into the folder [`PLOTS_DIR`] of `dir`, and removes figures of papers and of accuracy
/// that an earlier report wrote and this one does not.
pub(super) fn write(dir: &Path, plots: &[Plot]) -> Result<()> {
    let dir = dir.join(PLOTS_DIR);
    output::create_dir_all(&dir)?;
    for plot in plots {
        write_atomically(&dir.join(format!("{}.svg", plot.name)), &plot.svg)?;
        plot.write_png(&dir.join(format!("{}.png", plot.name)))?;
    }
    let figures = figure_names()?;
    let unreadable = || format!("cannot read {}", dir.display());
    for entry in dir.read_dir().with_context(unreadable)? {
        let path = entry.with_context(unreadable)?.path();
        let is_plot = path
            .extension()
            .is_some_and(|end| end == "svg" || end == "png");
        let name = path.file_stem().unwrap_or_default().to_string_lossy();
        // Plots of accuracy depend on the scenes, so that only the folder knows what an earlier report wrote.
        let is_ours = SCENE_PLOT_PREFIXES
            .iter()
            .any(|prefix| name.starts_with(prefix))
            || figures.iter().any(|figure| **figure == *name);
        if is_plot && is_ours && plots.iter().all(|plot| *plot.name != *name) {
            remove_stale(&path)?;
        }
    }
    Ok(())
}

impl Plot {
    fn new(Figure { name, title, chart }: Figure) -> Result<Self> {
        let mut svg = String::new();
        let backend = Backend::Svg(SVGBackend::with_string(&mut svg, chart.size_px()));
        chart.paint(&name, &title, backend)?;
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
        let (width, height) = self.chart.size_px();
        let size_px = (width * PNG_SCALE, height * PNG_SCALE);
        let mut rgb = vec![0; 3 * size_px.0 as usize * size_px.1 as usize];
        let backend = Backend::Png(BitMapBackend::with_buffer(&mut rgb, size_px));
        self.chart.paint(&self.name, &self.title, backend)?;
        Image::rgb(size_px, &rgb).write_png(path)
    }
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
