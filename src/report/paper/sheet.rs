//! A table of a paper, filled in: published devices and measured ones side by side.

use super::published::{Publication, Spec};
use super::series::At;
use super::value::{Mask, Value};
use crate::report::format::{count, ms};
use crate::variant::Variant;

/// A table with a group of columns for each device.
#[derive(Debug, Clone)]
pub struct Sheet {
    /// Whose table it is.
    pub paper: &'static Publication,
    /// Which table it is.
    pub spec: &'static Spec,
    /// Where its series are measured.
    pub points: Vec<Point>,
    /// The devices: those of the paper first.
    pub columns: Vec<Column>,
}

/// Where series are measured.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Point {
    /// Its id in the published numbers.
    pub id: String,
    /// Its name for people.
    pub name: String,
    /// Its name in a sentence.
    pub short: String,
    /// The place on a figure's axis, where it is a number.
    pub number: Option<u64>,
    /// Which cells of a run are measured here.
    pub at: At,
}

/// What one device has in a table: its group of columns.
#[derive(Debug, Clone)]
pub struct Column {
    /// The device, and what tells it from another group of the same device.
    pub device: String,
    /// Who measured it.
    pub source: Source,
    /// By series, then by point; `None` where nothing was measured.
    pub values: Vec<Vec<Option<Value>>>,
    /// By series: the variant measured; empty where it is the default.
    pub variants: Vec<Variant>,
    /// The run directories that its values come from; none for the paper.
    pub runs: Vec<String>,
}

/// Who measured a device.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Source {
    /// The paper's authors.
    Paper,
    /// A run of this program; the place in the list of device groups.
    Measured(usize),
}

impl Column {
    /// A column in which nothing was measured yet.
    pub(super) fn empty(device: &str, source: Source, spec: &Spec, points: usize) -> Self {
        Self {
            device: device.to_owned(),
            source,
            values: vec![vec![None; points]; spec.series.len()],
            variants: vec![Variant::default(); spec.series.len()],
            runs: Vec::new(),
        }
    }

    /// The value of a series at a point.
    pub fn value(&self, series: usize, point: usize) -> Option<&Value> {
        self.values.get(series)?.get(point)?.as_ref()
    }

    /// All values.
    pub fn all(&self) -> impl Iterator<Item = &Value> {
        self.values.iter().flatten().flatten()
    }

    /// Adds the values of another run of the same device, unless they cannot stand together, because both runs have a
    /// cell, or have a series in different variants.
    pub(super) fn join(&mut self, other: &Self) {
        let clash = (0..self.values.len()).any(|series| {
            let (own, others) = (&self.values[series], &other.values[series]);
            let has = |values: &[Option<Value>]| values.iter().any(Option::is_some);
            let both = own
                .iter()
                .zip(others)
                .any(|(own, other)| own.is_some() && other.is_some());
            let variants = self.variants[series] != other.variants[series];
            both || (has(own) && has(others) && variants)
        });
        if clash {
            return;
        }
        let shift = self.runs.len();
        for (series, others) in other.values.iter().enumerate() {
            for (own, other) in self.values[series].iter_mut().zip(others) {
                let moved = other.map(|value| Value {
                    run: value.run + shift,
                    ..value
                });
                *own = own.or(moved);
            }
            if self.variants[series].is_empty() {
                self.variants[series].clone_from(&other.variants[series]);
            }
        }
        self.runs.extend_from_slice(&other.runs);
    }

    /// Whether the paper's authors measured it.
    pub fn is_published(&self) -> bool {
        self.source == Source::Paper
    }
}

impl Sheet {
    /// The table's number and what it shows.
    pub fn title(&self) -> String {
        format!("Table {}: {}", self.spec.number, self.spec.title)
    }

    /// Whether this is the best value of the device at the point, among those whose mask is right. Equal values are
    /// all best; a value without a rival is not.
    pub(super) fn is_best(&self, column: &Column, series: usize, point: usize) -> bool {
        let speed = |value: &Value| self.paper.quantity.speed(value.value);
        let rivals = (0..column.values.len()).filter_map(|series| column.value(series, point));
        let best = rivals.clone().filter(|value| value.mask.may_win());
        let best = best.map(speed).max_by(f64::total_cmp);
        let own = column
            .value(series, point)
            .filter(|value| value.mask.may_win());
        rivals.count() > 1 && own.is_some_and(|value| Some(speed(value)) == best)
    }

    /// What stands beside a value: in a table about draw calls, time of recording and draw calls.
    pub(super) fn beside(&self, value: &Value) -> Vec<String> {
        if !self.spec.shows_recording {
            return Vec::new();
        }
        let record_ms = value
            .record_ms
            .map(|record_ms| format!("{} ms", ms(record_ms)));
        let draws = value
            .draw_calls
            .map(|draws| format!("{} draws", count(draws.into())));
        record_ms.into_iter().chain(draws).collect()
    }

    /// Whether anything was measured for it here.
    pub fn is_measured(&self) -> bool {
        self.columns.iter().any(|column| !column.is_published())
    }

    /// What must be known to read it: marks, layout, variants.
    pub fn notes(&self) -> Vec<String> {
        let within = if self.spec.series_are_rows {
            "in each column"
        } else {
            "in each row of a device"
        };
        let quantity = self.paper.quantity;
        let mut notes = vec![format!(
            "{}. Bold: the {} {within}, of those whose mask was right; the paper says nothing of its masks. –: \
             not measured.",
            quantity.title(),
            quantity.best()
        )];
        let values = || self.columns.iter().flat_map(Column::all);
        for mask in [Mask::Wrong, Mask::Unverified, Mask::CutShort] {
            if values().any(|value| value.mask == mask) {
                let (mark, meaning) = mask.note();
                notes.push(format!("{mark}: {meaning}."));
            }
        }
        if values().any(|value| !self.beside(value).is_empty()) {
            notes.push(
                "Beside each measured value: median time for recording a frame on the processor, \
                 and draw calls."
                    .to_owned(),
            );
        }
        if self
            .paper
            .series_of(self.spec)
            .any(|series| !series.in_paper)
        {
            notes.push("*: not in the paper.".to_owned());
        }
        notes.extend(self.columns.iter().flat_map(|column| self.notes_of(column)));
        notes
    }

    fn notes_of(&self, column: &Column) -> Vec<String> {
        let mut notes = Vec::new();
        let device = &column.device;
        if let runs @ 2.. = column.runs.len() {
            notes.push(format!("{device}: from {runs} runs, which share no cell."));
        }
        let variants = self.paper.series_of(self.spec).zip(&column.variants);
        let named = variants.filter_map(|(series, variant)| {
            let besides = series.besides(variant);
            (!besides.is_empty()).then(|| format!("{} with {besides}", series.name))
        });
        let named: Vec<String> = named.collect();
        if !named.is_empty() {
            notes.push(format!("{device}: {}.", named.join("; ")));
        }
        notes
    }
}
