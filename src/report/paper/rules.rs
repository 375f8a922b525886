//! How verdicts are reached, in the words that the ledger prints; [`super::judge`] follows them.

use super::claims::Check;

/// A mean speed-up reproduces the claim if it lies within this factor of it.
pub(super) const SPEED_UP_FACTOR: f64 = 2.0;
/// A crossover reproduces the claim if it lies within this factor of it.
pub(super) const CROSSOVER_FACTOR: f64 = 2.0;
/// A share reproduces the claim if it lies within this factor of the shares claimed.
pub(super) const SHARE_FACTOR: f64 = 1.5;

impl Check {
    /// How the verdict is reached.
    pub fn rule(&self) -> String {
        match self {
            Self::SpeedUp { tables, .. } => {
                let first = tables.first().copied().unwrap_or_default();
                let others: Vec<String> = tables.iter().skip(1).map(u8::to_string).collect();
                let alone = if others.is_empty() {
                    String::new()
                } else {
                    let others = others.join(" and ");
                    format!("; or table {first} was not measured, and the mean over table {others} is positive")
                };
                format!(
                    "Speed-up is speed over speed, less one, averaged over all rows of a table. Reproduced: \
                     the mean over table {first} is positive and within a factor of {SPEED_UP_FACTOR} of the \
                     claimed one (the highest value is shown, but decides nothing). Trend only: merely \
                     positive{alone}."
                )
            }
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
            Self::Grows { .. } => "Reproduced: in each pair, the first method beats the second one on the large \
                                   scene, and by a larger factor than on the small one. Trend only: the factor is \
                                   larger for at least half of the pairs."
                .to_owned(),
        }
    }
}
