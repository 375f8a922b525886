//! What a measurer's numbers say about a claim, and the verdict.

use super::evidence::Ratios;

/// How a claim fares.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// The numbers bear it out.
    Reproduced,
    /// The direction is as claimed, the size is not.
    TrendOnly,
    /// The numbers contradict it.
    NotReproduced,
    /// There are no numbers for it.
    NotMeasured,
}

/// What numbers say about a claim.
#[derive(Debug, Clone, PartialEq)]
pub struct Finding {
    /// The verdict by the check's rule.
    pub verdict: Verdict,
    /// The figure that decides, where there is a single one.
    pub value: Option<f64>,
    /// What the figure is.
    pub unit: &'static str,
    /// What was found, for people.
    pub text: String,
    /// On how many comparisons it rests.
    pub pairs: usize,
    /// How many there would be had everything been measured.
    pub pairs_of: usize,
    /// In how many of them the mask of either side was wrong.
    pub wrong_masks: usize,
}

impl Verdict {
    /// The word for people and files.
    pub fn word(self) -> &'static str {
        match self {
            Self::Reproduced => "reproduced",
            Self::TrendOnly => "trend only",
            Self::NotReproduced => "not reproduced",
            Self::NotMeasured => "not measured",
        }
    }

    pub(super) fn of(reproduced: bool, trend: bool) -> Self {
        match (reproduced, trend) {
            (true, _) => Self::Reproduced,
            (false, true) => Self::TrendOnly,
            (false, false) => Self::NotReproduced,
        }
    }
}

impl Finding {
    pub(super) fn new(ratios: &[Ratios<'_>], verdict: Verdict, text: String) -> Self {
        let list = || ratios.iter().flat_map(|ratios| &ratios.list);
        let pairs = list().count();
        let is_measured = pairs > 0;
        Self {
            verdict: if is_measured {
                verdict
            } else {
                Verdict::NotMeasured
            },
            value: None,
            unit: "",
            text: if is_measured { text } else { String::new() },
            pairs,
            pairs_of: ratios.iter().map(|ratios| ratios.possible).sum(),
            wrong_masks: list().filter(|ratio| ratio.wrong).count(),
        }
    }

    pub(super) fn with_value(self, value: Option<f64>, unit: &'static str) -> Self {
        Self {
            value,
            unit,
            ..self
        }
    }

    /// How much it rests on, and how much of that is doubtful.
    pub fn rests_on(&self) -> String {
        let Self {
            pairs, pairs_of, ..
        } = self;
        match self.wrong_masks {
            0 => format!("{pairs} of {pairs_of}"),
            wrong => format!("{pairs} of {pairs_of}, {wrong} with a wrong mask"),
        }
    }
}
