//! Published papers as data: a file a paper in `src/report/published/`, its numbers in `results/published/`.
//!
//! A table has **series** (what is compared: methods, or one method's ways to be deterministic) and **points** (where:
//! numbers of triangles, numbers of objects, scenes). Which of the two are its rows is a matter of layout.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use anyhow::{Context as _, Result};
use include_dir::{Dir, include_dir};
use serde::Deserialize;

use super::claims::Claim;
use super::series::{At, Series};
use crate::record::Summary;

static PAPERS: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/src/report/published");
static NUMBERS: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/results/published");

/// A paper: its tables, figures and claims.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Publication {
    /// Authors and year in few words.
    pub short: String,
    /// The authors.
    pub authors: String,
    /// The title.
    pub title: String,
    /// Year of publication.
    pub year: u16,
    /// What its tables are of.
    pub quantity: Quantity,
    /// How the names of its files begin in a report.
    pub prefix: String,
    /// The device measured, where its numbers do not name one.
    #[serde(default)]
    pub device: String,
    /// Its tables.
    pub tables: Vec<Spec>,
    /// Its scenes, by id.
    #[serde(default)]
    pub places: BTreeMap<String, Place>,
    /// What it compares, by id.
    pub series: BTreeMap<String, Series>,
    /// What it claims.
    #[serde(default)]
    pub claims: Vec<Claim>,
}

/// What a table's values are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Quantity {
    /// Frames per second: more is better.
    Fps,
    /// Time of a frame.
    FrameMs,
    /// Time that shadows take of a frame.
    ShadowMs,
}

/// A table of the paper, and the figure that draws it.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Spec {
    /// The table's number in the paper.
    pub number: u8,
    /// The number of the figure with the same values.
    pub figure: u8,
    /// What the table shows.
    pub title: String,
    /// What its points are, as an axis is titled.
    pub points: String,
    /// The file of its numbers.
    pub numbers: String,
    /// The columns of the numbers that, joined by `_`, are the id of a series.
    pub series_columns: Vec<String>,
    /// The columns of the numbers that, joined by `_`, are the id of a place; or the one that is a number.
    pub point_columns: Vec<String>,
    /// What is compared, in the paper's order.
    pub series: Vec<String>,
    /// Whether the series are the rows; else the points are.
    #[serde(default)]
    pub series_are_rows: bool,
    /// Whether the table is about draw calls, so that they and the time of recording are shown.
    #[serde(default)]
    pub shows_recording: bool,
    /// Where it is measured here, but for what its points say.
    #[serde(default)]
    pub at: At,
}

/// A scene of the paper.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Place {
    /// Its name for people.
    pub name: String,
    /// Its name in a sentence; empty where that is the same.
    #[serde(default)]
    pub short: String,
    /// Where it is measured here.
    pub at: At,
}

/// The papers that come with the program.
///
/// # Errors
/// Where a file is damaged; the tests hold that none is.
pub fn papers() -> Result<&'static [Publication]> {
    static ALL: OnceLock<Vec<Publication>> = OnceLock::new();
    if let Some(papers) = ALL.get() {
        return Ok(papers);
    }
    let mut papers = Vec::new();
    for file in PAPERS.files() {
        let damaged = || format!("{} is damaged", file.path().display());
        let text = file.contents_utf8().with_context(damaged)?;
        papers.push(Publication::parse(text).with_context(damaged)?);
    }
    Ok(ALL.get_or_init(|| papers))
}

/// The text of a file in `results/published/`.
pub(super) fn numbers(file: &str) -> Result<&'static str> {
    let found = NUMBERS.get_file(file).and_then(|file| file.contents_utf8());
    found.with_context(|| format!("results/published/{file} is missing"))
}

impl Publication {
    /// A paper from the text of its file.
    pub(super) fn parse(text: &str) -> Result<Self> {
        let paper: Self = toml::from_str(text)?;
        for table in &paper.tables {
            for id in &table.series {
                let known = paper.series.contains_key(id);
                anyhow::ensure!(
                    known,
                    "table {} names the series {id}, which is none",
                    table.number
                );
            }
        }
        Ok(paper)
    }

    /// What a table compares.
    pub fn series_of<'a>(&'a self, spec: &'a Spec) -> impl Iterator<Item = &'a Series> {
        spec.series.iter().map(|id| &self.series[id])
    }

    /// The name of a table's files, without extension.
    pub fn table_name(&self, spec: &Spec) -> String {
        format!("{}table{}", self.prefix, spec.number)
    }

    /// The name of a figure's files, without extension.
    pub fn figure_name(&self, spec: &Spec) -> String {
        format!("{}figure{}", self.prefix, spec.figure)
    }
}

impl Quantity {
    /// The column of the published files and of `summary.csv` without its statistic.
    pub fn column(self) -> &'static str {
        match self {
            Self::Fps => "fps",
            Self::FrameMs => "frame_ms",
            Self::ShadowMs => "shadow_ms",
        }
    }

    /// Its name for people.
    pub fn title(self) -> &'static str {
        match self {
            Self::Fps => "Frames per second",
            Self::FrameMs => "Frame time, ms",
            Self::ShadowMs => "Shadow time, ms",
        }
    }

    /// Which end is better.
    pub fn best(self) -> &'static str {
        match self {
            Self::Fps => "highest",
            Self::FrameMs | Self::ShadowMs => "lowest",
        }
    }

    /// A value as a speed: of two, the faster one has the higher speed.
    pub fn speed(self, value: f64) -> f64 {
        match self {
            Self::Fps => value,
            Self::FrameMs | Self::ShadowMs => 1.0 / value,
        }
    }

    /// The value of a measured row.
    pub(super) fn of(self, row: &Summary) -> Option<f64> {
        match self {
            Self::Fps => row.fps,
            Self::FrameMs => row.frame_ms_median,
            Self::ShadowMs => row.shadow_ms_median,
        }
    }
}
