//! One value of a table, and what is known about the picture behind it.

use crate::report::format::paper_value;

/// One value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Value {
    /// In the paper's quantity.
    pub value: f64,
    /// What is known about what was drawn.
    pub mask: Mask,
    /// Median time for recording a frame on the processor.
    pub record_ms: Option<f64>,
    /// Draw calls of a frame.
    pub draw_calls: Option<u32>,
    /// Place of its run in its column's list.
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
    /// What is written behind a value, and what that means.
    pub(super) fn note(self) -> (&'static str, &'static str) {
        match self {
            Self::Published | Self::Right => ("", ""),
            Self::Wrong => (
                "†",
                "the shadow mask was wrong farther than one pixel from the true shadow boundary; never bold",
            ),
            Self::Unverified => (
                "‡",
                "the shadow mask was not compared with the reference; never bold",
            ),
            Self::CutShort => (
                "§",
                "the run was cut off in this cell, the value rests on part of the flight; never bold",
            ),
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
    pub(super) fn may_win(self) -> bool {
        matches!(self, Self::Published | Self::Right)
    }
}

impl Value {
    /// A value of which nothing else is known.
    pub(super) fn new(value: f64, mask: Mask) -> Self {
        Self {
            value,
            mask,
            record_ms: None,
            draw_calls: None,
            run: 0,
        }
    }

    /// The value as a table has it, with its mark: the paper's own digit for digit.
    pub(super) fn text(&self) -> String {
        let text = match self.mask {
            Mask::Published => self.value.to_string(),
            _ => paper_value(self.value),
        };
        text + self.mask.note().0
    }
}
