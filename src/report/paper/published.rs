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
use crate::record::Summary;
use crate::variant::Variant;

static PAPERS: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/src/report/published");
static NUMBERS: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/results/published");

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Publication {
    pub short: String,
    pub authors: String,
    pub title: String,
    pub year: u16,
    pub quantity: Quantity,
    /// How the names of its files begin in a report.
    pub prefix: String,
    /// The device measured, where its numbers do not name one.
    #[serde(default)]
    pub device: String,
    pub tables: Vec<Spec>,
    /// Its scenes, by id.
    #[serde(default)]
    pub places: BTreeMap<String, Place>,
    pub series: BTreeMap<String, Series>,
    #[serde(default)]
    pub claims: Vec<Claim>,
}

/// What a table's values are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Quantity {
    /// Frames per second: more is better.
    Fps,
    /// Time of a frame.
    FrameMs,
    /// Time that shadows take of a frame.
    ShadowMs,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Spec {
    pub number: u8,
    pub figure: u8,
    pub title: String,
    /// What its points are, as an axis is titled.
    pub points: String,
    pub numbers: String,
    /// The columns of the numbers that, joined by `_`, are the id of a series.
    pub series_columns: Vec<String>,
    /// The columns of the numbers that, joined by `_`, are the id of a place; or the one that is a number.
    pub point_columns: Vec<String>,
    /// What is compared, in the paper's order.
    pub series: Vec<String>,
    /// Places that the paper lacks.
    #[serde(default)]
    pub also: Vec<String>,
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

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Place {
    pub name: String,
    /// Its name in a sentence; empty where that is the same.
    #[serde(default)]
    pub short: String,
    /// Where it is measured here.
    pub at: At,
}

/// Which cells of a run are measured where a paper measured.
#[derive(Debug, Clone, Default, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct At {
    /// The scene's name; any where empty.
    pub scene: String,
    /// How the scene's name begins.
    pub scene_prefix: String,
    pub triangles: Option<u64>,
    /// How far from that number they may be.
    pub tolerance: u64,
    pub objects: Option<u64>,
}

/// What a paper compares.
#[derive(Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Series {
    pub name: String,
    pub method: String,
    /// What that method's variant must say, if anything.
    pub needs: Option<Needed>,
    #[serde(default = "yes")]
    pub in_paper: bool,
}

#[derive(Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Needed {
    pub name: String,
    pub value: String,
    /// The value of a variant that does not name the parameter.
    pub default: String,
}

fn yes() -> bool {
    true
}

/// The papers that come with the program.
///
/// # Errors
/// Where a file is damaged; the tests hold that none is.
pub(crate) fn papers() -> Result<&'static [Publication]> {
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

pub(super) fn numbers(file: &str) -> Result<&'static str> {
    let found = NUMBERS.get_file(file).and_then(|file| file.contents_utf8());
    found.with_context(|| format!("results/published/{file} is missing"))
}

impl Publication {
    pub(super) fn parse(text: &str) -> Result<Self> {
        let paper: Self = toml::from_str(text)?;
        for Spec { number, series, .. } in &paper.tables {
            let unknown = series.iter().find(|id| !paper.series.contains_key(*id));
            if let Some(id) = unknown {
                anyhow::bail!("table {number} names the series {id}, which is none");
            }
        }
        Ok(paper)
    }

    pub(crate) fn series_of<'a>(&'a self, spec: &'a Spec) -> impl Iterator<Item = &'a Series> {
        spec.series.iter().map(|id| &self.series[id])
    }

    pub(crate) fn table_name(&self, spec: &Spec) -> String {
        format!("{}table{}", self.prefix, spec.number)
    }

    pub(crate) fn figure_name(&self, spec: &Spec) -> String {
        format!("{}figure{}", self.prefix, spec.figure)
    }
}

impl Quantity {
    /// The column of the published files and of `summary.csv` without its statistic.
    pub(crate) fn column(self) -> &'static str {
        match self {
            Self::Fps => "fps",
            Self::FrameMs => "frame_ms",
            Self::ShadowMs => "shadow_ms",
        }
    }

    /// Its name for people.
    pub(crate) fn title(self) -> &'static str {
        match self {
            Self::Fps => "Frames per second",
            Self::FrameMs => "Frame time, ms",
            Self::ShadowMs => "Shadow time, ms",
        }
    }

    /// A value as a speed: of two, the faster one has the higher speed.
    pub(crate) fn speed(self, value: f64) -> f64 {
        if self == Self::Fps {
            value
        } else {
            1.0 / value
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

impl At {
    pub(super) fn holds(&self, row: &Summary) -> bool {
        let is_near = |wanted: u64| {
            let away = row.triangles.map(|own| own.abs_diff(wanted));
            away.is_some_and(|away| away <= self.tolerance)
        };
        (self.scene.is_empty() || row.scene == self.scene)
            && row.scene.starts_with(&self.scene_prefix)
            && self.triangles.is_none_or(is_near)
            && (self.objects.is_none() || row.objects == self.objects)
    }
}

impl Series {
    /// Whether a method in this variant stands for the series.
    pub(super) fn is(&self, method: &str, variant: &Variant) -> bool {
        let has =
            |wanted: &Needed| variant.get(&wanted.name).unwrap_or(&wanted.default) == wanted.value;
        self.method == method && self.needs.as_ref().is_none_or(has)
    }

    /// What a variant says besides what makes it this series.
    pub(super) fn besides(&self, variant: &Variant) -> Variant {
        let needed = self.needs.as_ref();
        needed.map_or_else(|| variant.clone(), |needed| variant.without(&needed.name))
    }
}
