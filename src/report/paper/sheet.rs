//! A table of the paper, filled in: published devices and measured ones side by side.

use super::spec::{Point, Spec};
use crate::report::format::{count, ms, paper_fps};
use crate::variant::Variant;

/// A table with a group of columns for each device.
#[derive(Debug, Clone)]
pub struct Sheet {
    /// Which table it is.
    pub spec: &'static Spec,
    /// Where its series are measured.
    pub points: Vec<Point>,
    /// The devices: those of the paper first.
    pub columns: Vec<Column>,
}

/// What one device has in a table: its group of columns.
#[derive(Debug, Clone)]
pub struct Column {
    /// The device, and what tells it from another group of the same device.
    pub device: String,
    /// Who measured it.
    pub source: Source,
    /// By series, then by point; `None` where nothing was measured.
    pub cells: Vec<Vec<Option<Cell>>>,
    /// By series: the variant measured; empty where it is the default.
    pub variants: Vec<Variant>,
    /// The run directories that its cells come from; none for the paper.
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

/// One value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cell {
    /// Frames per second.
    pub fps: f64,
    /// What is known about what was drawn.
    pub mask: Mask,
    /// Median time for recording a frame on the processor.
    pub record_ms: Option<f64>,
    /// Draw calls of a frame.
    pub draw_calls: Option<u32>,
    /// Place of its run in [`Column::runs`].
    pub run: usize,
}

/// What is known about the shadow mask behind a value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mask {
    /// The paper says nothing of it.
    Published,
    /// It agrees with the reference but at most at the true shadow boundary.
    Right,
    /// It has artifacts.
    Wrong,
    /// It was not compared with the reference.
    Unverified,
    /// The run was cut off in this cell: its value rests on part of the flight.
    CutShort,
}

impl Mask {
    /// What is written behind a value.
    pub fn mark(self) -> &'static str {
        match self {
            Self::Published | Self::Right => "",
            Self::Wrong => "†",
            Self::Unverified => "‡",
            Self::CutShort => "§",
        }
    }

    /// What the mark means.
    pub fn note(self) -> &'static str {
        match self {
            Self::Published | Self::Right => "",
            Self::Wrong => {
                "the shadow mask was wrong farther than one pixel from the true shadow boundary; \
                 never bold"
            }
            Self::Unverified => "the shadow mask was not compared with the reference; never bold",
            Self::CutShort => {
                "the run was cut off in this cell, the value rests on part of the flight; never \
                 bold"
            }
        }
    }

    /// The word in the CSV files.
    pub fn word(self) -> &'static str {
        match self {
            Self::Published => "",
            Self::Right => "right",
            Self::Wrong => "wrong",
            Self::Unverified => "unverified",
            Self::CutShort => "cut_short",
        }
    }

    /// Whether a value may be called the best: being fast and wrong is no merit.
    fn may_win(self) -> bool {
        matches!(self, Self::Published | Self::Right)
    }
}

impl Cell {
    /// The value as a table has it: the paper's own digit for digit.
    pub fn text(&self) -> String {
        if self.mask == Mask::Published {
            self.fps.to_string()
        } else {
            paper_fps(self.fps)
        }
    }

    /// Time of recording and draw calls, where they are known.
    fn recording(&self) -> Vec<String> {
        let record_ms = self
            .record_ms
            .map(|record_ms| format!("{} ms", ms(record_ms)));
        let draw_calls = self
            .draw_calls
            .map(|draws| format!("{} draws", count(draws.into())));
        record_ms.into_iter().chain(draw_calls).collect()
    }
}

impl Column {
    /// The cell of a series at a point.
    pub fn cell(&self, series: usize, point: usize) -> Option<&Cell> {
        self.cells.get(series)?.get(point)?.as_ref()
    }

    /// The run directory that a cell comes from; empty for the paper.
    pub fn run_of(&self, cell: &Cell) -> &str {
        self.runs.get(cell.run).map_or("", String::as_str)
    }

    /// Adds the cells of another run of the same device; `false` where they cannot stand together,
    /// because both runs have a cell, or have a series in different variants.
    pub(super) fn join(&mut self, other: &Self) -> bool {
        let both =
            |(own, others): (&Option<Cell>, &Option<Cell>)| own.is_some() && others.is_some();
        let clash = (0..self.cells.len()).any(|series| {
            let (own, others) = (&self.cells[series], &other.cells[series]);
            let measured = |cells: &[Option<Cell>]| cells.iter().any(Option::is_some);
            let variants = self.variants[series] != other.variants[series];
            own.iter().zip(others).any(both) || (measured(own) && measured(others) && variants)
        });
        if clash {
            return false;
        }
        let shift = self.runs.len();
        for (series, others) in other.cells.iter().enumerate() {
            for (own, cell) in self.cells[series].iter_mut().zip(others) {
                let moved = cell.map(|cell| Cell {
                    run: cell.run + shift,
                    ..cell
                });
                *own = own.or(moved);
            }
            if self.variants[series].is_empty() {
                self.variants[series].clone_from(&other.variants[series]);
            }
        }
        self.runs.extend_from_slice(&other.runs);
        true
    }

    /// Whether the paper's authors measured it.
    pub fn is_published(&self) -> bool {
        self.source == Source::Paper
    }

    /// How many cells it has.
    pub fn count(&self) -> usize {
        self.cells.iter().flatten().flatten().count()
    }

    /// Whether this is the highest value of the device at the point, among those whose mask is
    /// right. Equal values are all best; a value without a rival is not.
    pub fn is_best(&self, series: usize, point: usize) -> bool {
        let here = |series| self.cell(series, point);
        let rivals = (0..self.cells.len()).filter_map(here);
        if rivals.clone().count() < 2 {
            return false;
        }
        let best = rivals
            .filter(|cell| cell.mask.may_win())
            .map(|cell| cell.fps)
            .max_by(f64::total_cmp);
        here(series).is_some_and(|cell| cell.mask.may_win() && Some(cell.fps) == best)
    }
}

impl Sheet {
    /// The table's number and what it shows.
    pub fn title(&self) -> String {
        format!("Table {}: {}", self.spec.number, self.spec.title)
    }

    /// What stands beside a value: in a table about draw calls, time of recording and draw calls.
    pub fn beside(&self, cell: &Cell) -> Vec<String> {
        if self.spec.shows_recording {
            cell.recording()
        } else {
            Vec::new()
        }
    }

    /// Whether anything was measured for it here.
    pub fn is_measured(&self) -> bool {
        self.columns.iter().any(|column| !column.is_published())
    }

    /// What must be known to read it: marks, layout, variants.
    pub fn notes(&self) -> Vec<String> {
        let spec = self.spec;
        let within = if spec.series_are_rows {
            "in each column"
        } else {
            "in each row of a device"
        };
        let mut notes = vec![format!(
            "Frames per second. Bold: the highest {within}, of those whose mask was right; the \
             paper says nothing of its masks. –: not measured."
        )];
        let cells = || self.columns.iter().flat_map(|c| c.cells.iter().flatten());
        for mask in [Mask::Wrong, Mask::Unverified, Mask::CutShort] {
            if cells().flatten().any(|cell| cell.mask == mask) {
                notes.push(format!("{}: {}.", mask.mark(), mask.note()));
            }
        }
        if cells().flatten().any(|cell| !self.beside(cell).is_empty()) {
            notes.push(
                "Beside each measured value: median time for recording a frame on the processor, \
                 and draw calls."
                    .to_owned(),
            );
        }
        if spec.series.iter().any(|series| !series.in_paper) {
            notes.push("*: not in the paper.".to_owned());
        }
        for column in &self.columns {
            if let runs @ 2.. = column.runs.len() {
                notes.push(format!(
                    "{}: from {runs} runs, which share no cell.",
                    column.device
                ));
            }
            let variants = spec.series.iter().zip(&column.variants);
            let named: Vec<String> = variants
                .map(|(series, variant)| (series.name, series.besides(variant)))
                .filter(|(_, besides)| !besides.is_empty())
                .map(|(name, besides)| format!("{name} with {besides}"))
                .collect();
            if !named.is_empty() {
                notes.push(format!("{}: {}.", column.device, named.join("; ")));
            }
        }
        notes
    }
}
