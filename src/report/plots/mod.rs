//! Plots of a run: each is drawn as an SVG, and its PNG is that SVG in pixels.
//!
//! `pareto`, `errors_by_parameter`, `shadow_time` and `paper` choose the data and give it as a `chart`, which draws
//! it.

use std::path::Path;
use std::sync::{LazyLock, Once};

use anyhow::{Context as _, Result};
use plotters::prelude::{FontStyle, IntoDrawingArea, SVGBackend};
use plotters::style::register_font;
use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Options, Tree};

use super::load::Run;
use super::paper::{Paper, figure_names};
use super::pareto::Cloud;
use crate::output::{self, remove_stale, write_atomically};
use crate::record::Image;
use canvas::Canvas;
use chart::Chart;

mod axis;
mod bars;
mod canvas;
mod chart;
mod chosen;
mod errors_by_parameter;
mod labels;
mod legend;
mod paper;
mod pareto;
mod shadow_time;

/// Name of the folder of plots in a run directory.
pub(crate) const PLOTS_DIR: &str = "plots";
/// How the names of plots begin that depend on the scenes of a run.
const SCENE_PLOT_PREFIXES: [&str; 2] = [pareto::PREFIX, errors_by_parameter::PREFIX];

/// Pixels of a PNG for each of a plot: small text needs them.
const PNG_SCALE: u32 = 2;

#[derive(Debug)]
pub(crate) struct Plot {
    /// File name without extension.
    pub name: String,
    pub title: String,
    pub svg: String,
    pub is_pareto: bool,
}

/// A chart with its name and title, before it is drawn.
#[derive(Debug)]
struct Figure {
    name: String,
    title: String,
    chart: Chart,
}

/// Every plot that the run has data for.
pub(crate) fn draw(run: &Run) -> Result<Vec<Plot>> {
    let mut figures = shadow_time::by_growth(run);
    figures.extend(shadow_time::by_scene(run));
    figures.extend(shadow_time::along_flights(run));
    figures.into_iter().map(Plot::new).collect()
}

/// Accuracy against speed, a plot for each cloud; then wrong pixels by each swept parameter.
pub(crate) fn draw_pareto(run: &Run, clouds: &[Cloud]) -> Result<Vec<Plot>> {
    let figures = pareto::figures(run, clouds).into_iter();
    let by_parameter = errors_by_parameter::figures(run, clouds);
    figures.chain(by_parameter).map(Plot::new).collect()
}

/// The figures of papers: their curves and the measured ones in one picture.
pub(crate) fn draw_papers(papers: &[Paper]) -> Result<Vec<Plot>> {
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
        let end = path.extension().unwrap_or_default();
        let name = path.file_stem().unwrap_or_default().to_string_lossy();
        // Plots of accuracy depend on the scenes, so that only the folder knows what an earlier report wrote.
        let mut prefixes = SCENE_PLOT_PREFIXES.iter();
        let is_ours = prefixes.any(|prefix| name.starts_with(prefix))
            || figures.iter().any(|figure| **figure == *name);
        let is_new = plots.iter().any(|plot| *plot.name == *name);
        if is_ours && !is_new && (end == "svg" || end == "png") {
            remove_stale(&path)?;
        }
    }
    Ok(())
}

impl Plot {
    fn new(Figure { name, title, chart }: Figure) -> Result<Self> {
        install_font();
        let mut svg = String::new();
        let area = SVGBackend::with_string(&mut svg, chart.size_px()).into_drawing_area();
        area.fill(&canvas::PAPER)?;
        let painted = chart.paint(&Canvas(&area), &title);
        painted.with_context(|| format!("cannot draw the plot {name}"))?;
        area.present()?;
        drop(area);
        Ok(Self {
            is_pareto: name.starts_with(pareto::PREFIX),
            name,
            title,
            svg,
        })
    }

    /// Writes the plot as a PNG to `path`.
    pub(crate) fn write_png(&self, path: &Path) -> Result<()> {
        let unreadable = || format!("cannot draw {} as a PNG", self.name);
        let tree = Tree::from_str(&self.svg, png_options()).with_context(unreadable)?;
        let size = tree.size().to_int_size();
        let (width, height) = (size.width() * PNG_SCALE, size.height() * PNG_SCALE);
        let mut pixels = Pixmap::new(width, height).with_context(unreadable)?;
        let scale = Transform::from_scale(PNG_SCALE as f32, PNG_SCALE as f32);
        resvg::render(&tree, scale, &mut pixels.as_mut());
        // Plots are opaque, so that there is no alpha to undo.
        let pixels = pixels.pixels().iter();
        let rgb = pixels.flat_map(|c| [c.red(), c.green(), c.blue()]);
        Image::rgb((width, height), &rgb.collect::<Vec<u8>>()).write_png(path)
    }
}

/// With the program's own font alone: a PNG looks alike on every machine, also on one without fonts.
pub(crate) fn png_options() -> &'static Options<'static> {
    static OPTIONS: LazyLock<Options<'_>> = LazyLock::new(|| {
        let mut options = Options::default();
        let fonts = options.fontdb_mut();
        fonts.load_font_data(epaint_default_fonts::UBUNTU_LIGHT.to_vec());
        let family = fonts
            .faces()
            .find_map(|face| face.families.first().cloned());
        fonts.set_sans_serif_family(family.map_or_else(String::new, |(name, _)| name));
        options
    });
    &OPTIONS
}

/// Gives plotters the font by which it measures text.
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
