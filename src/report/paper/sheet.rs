//! A table of a paper, filled in: published devices and measured ones side by side.

use serde::Serialize;

use super::published::{At, Publication, Quantity, Spec};
use crate::record::unique;
use crate::report::format::{count, ms, paper_value};
use crate::variant::Variant;

#[derive(Debug, Clone)]
pub(crate) struct Sheet {
    pub paper: &'static Publication,
    pub spec: &'static Spec,
    pub points: Vec<Point>,
    /// The devices: those of the paper first.
    pub columns: Vec<Column>,
}

#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Point {
    pub id: String,
    pub name: String,
    /// Its name in a sentence; empty where that is the same.
    pub short: String,
    /// The place on a figure's axis, where it is a number.
    pub number: Option<u64>,
    pub at: At,
}

/// What one device has in a table: its group of columns.
#[derive(Debug, Clone)]
pub(crate) struct Column {
    /// The device, and what tells it from another group of the same device.
    pub device: String,
    /// Its place in the list of device groups; none for a device of the paper.
    pub group: Option<usize>,
    /// What was measured.
    pub cells: Vec<Value>,
}

/// A value, and what is known about the picture behind it.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Value {
    /// Places of its series and its point in the table.
    pub series: usize,
    pub point: usize,
    /// In the paper's quantity.
    pub value: f64,
    pub mask: Mask,
    /// Median time for recording a frame on the processor.
    pub record_ms: Option<f64>,
    pub draw_calls: Option<u32>,
    /// The variant measured; one a series.
    pub variant: Variant,
    /// The run directory that it comes from; empty for the paper.
    pub run: String,
}

/// What is known about the shadow mask behind a value.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Mask {
    /// The paper says nothing of it.
    #[default]
    #[serde(rename = "")]
    Published,
    /// It agrees with the reference but at most at the true shadow boundary.
    Right,
    Wrong,
    Unverified,
    /// The run was cut off in this cell: its value rests on part of the flight.
    CutShort,
}

/// What is written behind a value of which that is known, and what it means.
const MARKS: [(Mask, &str, &str); 3] = [
    (
        Mask::Wrong,
        "†",
        "the shadow mask was wrong farther than one pixel from the true shadow boundary",
    ),
    (
        Mask::Unverified,
        "‡",
        "the shadow mask was not compared with the reference",
    ),
    (
        Mask::CutShort,
        "§",
        "the run was cut off in this cell, the value rests on part of the flight",
    ),
];

impl Point {
    /// Its name in a sentence.
    pub(super) fn said(&self) -> &str {
        if self.short.is_empty() {
            &self.name
        } else {
            &self.short
        }
    }
}

impl Value {
    /// The value as a table has it, with its mark: the paper's own digit for digit.
    pub(super) fn text(&self) -> String {
        let text = match self.mask {
            Mask::Published => self.value.to_string(),
            _ => paper_value(self.value),
        };
        let mark = MARKS.iter().find(|(mask, ..)| *mask == self.mask);
        text + mark.map_or("", |(_, mark, _)| mark)
    }

    /// Whether it may be called the best: being fast and wrong is no merit.
    fn may_win(&self) -> bool {
        matches!(self.mask, Mask::Published | Mask::Right)
    }
}

impl Column {
    pub(crate) fn value(&self, series: usize, point: usize) -> Option<&Value> {
        let mut values = self.cells.iter();
        values.find(|value| (value.series, value.point) == (series, point))
    }

    /// The variant in which a series was measured.
    pub(super) fn variant(&self, series: usize) -> Option<&Variant> {
        let value = self.cells.iter().find(|value| value.series == series);
        value.map(|value| &value.variant)
    }

    pub(crate) fn is_published(&self) -> bool {
        self.group.is_none()
    }
}

impl Sheet {
    pub(crate) fn title(&self) -> String {
        format!("Table {}: {}", self.spec.number, self.spec.title)
    }

    /// Whether this is the best value of the device at its point, among those whose mask is right. Equal values are
    /// all best; a value without a rival is not.
    pub(super) fn is_best(&self, column: &Column, value: &Value) -> bool {
        let speed = |value: &Value| self.paper.quantity.speed(value.value);
        let here = || {
            column
                .cells
                .iter()
                .filter(|other| other.point == value.point)
        };
        let mut others = here().filter(|other| other.may_win());
        here().count() > 1 && value.may_win() && others.all(|other| speed(other) <= speed(value))
    }

    /// What stands beside a value: in a table about draw calls, time of recording and draw calls.
    pub(super) fn beside(&self, value: &Value) -> Vec<String> {
        let record_ms = value.record_ms.map(|took| format!("{} ms", ms(took)));
        let draws = value
            .draw_calls
            .map(|draws| format!("{} draws", count(draws.into())));
        let beside = record_ms.into_iter().chain(draws);
        beside.filter(|_| self.spec.shows_recording).collect()
    }

    /// Whether anything was measured for it here.
    pub(crate) fn is_measured(&self) -> bool {
        self.columns.iter().any(|column| !column.is_published())
    }

    /// What must be known to read it: marks, layout, variants.
    pub(crate) fn notes(&self) -> Vec<String> {
        let within = if self.spec.series_are_rows {
            "in each column"
        } else {
            "in each row of a device"
        };
        let quantity = self.paper.quantity;
        let best = if quantity == Quantity::Fps {
            "highest"
        } else {
            "lowest"
        };
        let mut notes = vec![format!(
            "{}. Bold: the {best} {within}, of those whose mask was right; the paper says nothing of its masks. –: \
             not measured.",
            quantity.title(),
        )];
        let values = || self.columns.iter().flat_map(|column| &column.cells);
        for (mask, mark, meaning) in MARKS {
            if values().any(|value| value.mask == mask) {
                notes.push(format!("{mark}: {meaning}; never bold."));
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
        let device = &column.device;
        let runs = unique(column.cells.iter().map(|value| &value.run)).len();
        let several =
            (runs > 1).then(|| format!("{device}: from {runs} runs, which share no cell."));
        let series = self.paper.series_of(self.spec).enumerate();
        let named = series.filter_map(|(index, series)| {
            let besides = series.besides(column.variant(index)?);
            (!besides.is_empty()).then(|| format!("{} with {besides}", series.name))
        });
        let named: Vec<String> = named.collect();
        let named = (!named.is_empty()).then(|| format!("{device}: {}.", named.join("; ")));
        several.into_iter().chain(named).collect()
    }
}
