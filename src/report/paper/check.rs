//! The checks: what a measurer's numbers say about a claim, and the verdict.
//!
//! Each check's rule stands in [`Check::rule`], in the words that the ledger prints; `judge` follows
//! them.

use anyhow::Result;

use super::claims::Check;
use super::evidence::{Evidence, Ratios};
use super::judge::{
    self, CROSSOVER_FACTOR, SHARE_FACTOR, SPEED_UP_FACTOR, crossover, faster, grows, share,
    speed_up,
};

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
        let (verdict, text) = if pairs == 0 {
            (Verdict::NotMeasured, String::new())
        } else {
            (verdict, text)
        };
        Self {
            verdict,
            value: None,
            unit: "",
            text,
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
}

impl Check {
    /// How the verdict is reached.
    pub fn rule(&self) -> String {
        match self {
            Self::SpeedUp { .. } => format!(
                "Speed-up is FPS over FPS, less one, averaged over all rows of a table. Reproduced: \
                 the mean over table 1 is positive and within a factor of {SPEED_UP_FACTOR} of the \
                 claimed one (the highest value is shown, but decides nothing). Trend only: merely \
                 positive; or table 1 was not measured, and the mean over table 2 is positive."
            ),
            Self::Faster { .. } => "Reproduced: faster in every comparison. Trend only: in more \
                                    than half of them."
                .to_owned(),
            Self::Crossover { .. } => format!(
                "Reproduced: faster at every point up to 1/{CROSSOVER_FACTOR} of the claimed number \
                 of triangles, slower at every point from {CROSSOVER_FACTOR} times that number on, \
                 with at least one point on either side. Trend only: the ratio falls from the \
                 first to the last point measured. Where both are equally fast is interpolated \
                 between points, on log scales. A single point counts as not measured."
            ),
            Self::Share { .. } => format!(
                "Reproduced: within a factor of {SHARE_FACTOR} of the range of the shares claimed. \
                 Trend only: below 100 %."
            ),
            Self::Grows { .. } => "Reproduced: each silhouette method beats the per-triangle method \
                                   of its stage on the large scene, and by a larger factor than on \
                                   Sponza. Trend only: the factor is larger for at least half of the \
                                   stages."
                .to_owned(),
        }
    }

    /// What the evidence says.
    pub(super) fn find(&self, evidence: &Evidence<'_>) -> Result<Finding> {
        match self {
            Self::SpeedUp {
                series,
                over,
                tables,
                mean_percent,
                ..
            } => speed_up(evidence, [series, over], tables, *mean_percent),
            Self::Faster {
                table,
                series,
                than,
                scenes,
            } => {
                let ratios = than
                    .iter()
                    .map(|than| {
                        evidence.ratios(*table, [series, than], |at| judge::is_in(at, scenes))
                    })
                    .collect::<Result<Vec<_>>>()?;
                Ok(faster(&ratios))
            }
            Self::Crossover {
                table,
                series,
                than,
                triangles,
            } => {
                let ratios = evidence.ratios(*table, [series, than], |_| true)?;
                Ok(crossover(ratios, *triangles as f64))
            }
            Self::Share {
                table,
                scene,
                series,
                of,
                percent,
            } => {
                let ratios =
                    evidence.ratios(*table, [series, of], |at| judge::is_in(at, &[*scene]))?;
                Ok(share(ratios, percent))
            }
            Self::Grows {
                table,
                small,
                large,
                pairs,
            } => grows(evidence, *table, [*small, *large], pairs),
        }
    }
}
