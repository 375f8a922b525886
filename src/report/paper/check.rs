//! The checks: what a measurer's numbers say about a claim, and the verdict.
//!
//! Each check's rule stands in [`Check::rule`], in the words that the ledger prints.

use anyhow::Result;

use super::claims::{Check, Pair};
use super::evidence::{Evidence, Ratio, Ratios};
use super::spec::{Place, Point};
use crate::report::format::{count, factor, percent};

/// A mean speed-up reproduces the claim if it lies within this factor of it.
const SPEED_UP_FACTOR: f64 = 2.0;
/// A crossover reproduces the claim if it lies within this factor of it.
const CROSSOVER_FACTOR: f64 = 2.0;
/// A share reproduces the claim if it lies within this factor of the shares claimed.
const SHARE_FACTOR: f64 = 1.5;

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

    fn of(reproduced: bool, trend: bool) -> Self {
        match (reproduced, trend) {
            (true, _) => Self::Reproduced,
            (false, true) => Self::TrendOnly,
            (false, false) => Self::NotReproduced,
        }
    }
}

impl Finding {
    fn new(ratios: &[Ratios<'_>], verdict: Verdict, text: String) -> Self {
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

    fn with_value(self, value: Option<f64>, unit: &'static str) -> Self {
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
                    .map(|than| evidence.ratios(*table, [series, than], |at| is_in(at, scenes)))
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
                let ratios = evidence.ratios(*table, [series, of], |at| is_in(at, &[*scene]))?;
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

fn is_in(point: Point, places: &[Place]) -> bool {
    places.iter().any(|place| point == Point::Scene(*place))
}

/// The mean speed-up in percent, and the highest.
fn mean_and_max<'a>(ratios: impl Iterator<Item = &'a Ratio<'a>>) -> Option<(f64, f64)> {
    let all: Vec<f64> = ratios.map(|ratio| 100.0 * (ratio.ratio - 1.0)).collect();
    let max = all.iter().copied().max_by(f64::total_cmp)?;
    Some((all.iter().sum::<f64>() / all.len() as f64, max))
}

fn speed_up(
    evidence: &Evidence<'_>,
    series: [&str; 2],
    tables: &[u8],
    claimed_percent: f64,
) -> Result<Finding> {
    let ratios = tables
        .iter()
        .map(|table| evidence.ratios(*table, series, |_| true))
        .collect::<Result<Vec<_>>>()?;
    let mut parts = Vec::new();
    let mut means = Vec::new();
    for (table, ratios) in tables.iter().zip(&ratios) {
        let found = mean_and_max(ratios.list.iter());
        means.push(found.map(|(mean, _)| mean));
        parts.extend(found.map(|(mean, max)| {
            let (mean, max) = (percent(mean), percent(max));
            let (pairs, of) = (ratios.list.len(), ratios.possible);
            format!("table {table}: mean {mean}, at most {max} ({pairs} of {of})")
        }));
    }
    let overall = mean_and_max(ratios.iter().flat_map(|ratios| &ratios.list));
    if let (Some((mean, _)), 2..) = (overall, parts.len()) {
        parts.push(format!("all: mean {}", percent(mean)));
    }
    let first = means.first().copied().flatten();
    let decisive = first.or(overall.map(|(mean, _)| mean));
    let near = first.is_some_and(|mean| within(mean, claimed_percent, SPEED_UP_FACTOR));
    let verdict = Verdict::of(near, decisive.is_some_and(|mean| mean > 0.0));
    Ok(Finding::new(&ratios, verdict, parts.join("; ")).with_value(decisive, "mean speed-up, %"))
}

fn within(value: f64, claimed: f64, factor: f64) -> bool {
    (claimed / factor..=claimed * factor).contains(&value)
}

fn faster(ratios: &[Ratios<'_>]) -> Finding {
    let all: Vec<f64> = ratios
        .iter()
        .flat_map(|ratios| ratios.list.iter().map(|ratio| ratio.ratio))
        .collect();
    let wins = all.iter().filter(|ratio| **ratio > 1.0).count();
    let min = all.iter().copied().fold(f64::INFINITY, f64::min);
    let max = all.iter().copied().fold(0.0, f64::max);
    let text = format!(
        "faster in {wins} of {}, by factors of {} to {}",
        all.len(),
        factor(min),
        factor(max)
    );
    let verdict = Verdict::of(wins == all.len(), 2 * wins > all.len());
    let worst = (!all.is_empty()).then_some(min);
    Finding::new(ratios, verdict, text).with_value(worst, "smallest factor")
}

fn crossover(ratios: Ratios<'_>, claimed: f64) -> Finding {
    let mut parts = Vec::new();
    let mut even = Vec::new();
    for device in ratios.devices() {
        let mut points: Vec<(f64, f64)> = ratios
            .of(device)
            .filter_map(|ratio| Some((ratio.point.number()? as f64, ratio.ratio)))
            .collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        let wins = points.iter().filter(|point| point.1 > 1.0).count();
        let here = crossing(&points);
        let at = here.map_or("no crossover".to_owned(), |triangles| {
            format!("even at about {} triangles", rounded(triangles))
        });
        let of = points.len();
        parts.push(format!("{device}: faster at {wins} of {of} points, {at}"));
        even.push((here, points));
    }
    let (reproduced, trend) = even.iter().fold((true, true), |(reproduced, trend), one| {
        let points = one.1.as_slice();
        let low = |point: &&(f64, f64)| point.0 <= claimed / CROSSOVER_FACTOR;
        let high = |point: &&(f64, f64)| point.0 >= claimed * CROSSOVER_FACTOR;
        let sides = points.iter().any(|p| low(&p)) && points.iter().any(|p| high(&p));
        let held = points.iter().filter(low).all(|point| point.1 > 1.0)
            && points.iter().filter(high).all(|point| point.1 < 1.0);
        let falls = points
            .first()
            .zip(points.last())
            .is_some_and(|(a, b)| b.1 < a.1);
        (reproduced && sides && held, trend && falls)
    });
    let single = even.iter().any(|(_, points)| points.len() < 2);
    let verdict = if single {
        Verdict::NotMeasured
    } else {
        Verdict::of(reproduced, trend)
    };
    let value = match even.as_slice() {
        [(here, _)] => *here,
        _ => None,
    };
    Finding::new(&[ratios], verdict, parts.join("; ")).with_value(value, "triangles at crossover")
}

/// Where the ratio passes from above 1 to below, between two points, on log scales.
fn crossing(points: &[(f64, f64)]) -> Option<f64> {
    points.windows(2).find_map(|pair| {
        let [(x0, y0), (x1, y1)] = *pair else {
            return None;
        };
        (y0 > 1.0 && y1 <= 1.0).then(|| {
            let along = y0.ln() / (y0.ln() - y1.ln());
            (x0.ln() + along * (x1.ln() - x0.ln())).exp()
        })
    })
}

/// To two digits: more would feign precision.
fn rounded(triangles: f64) -> String {
    let unit = 10_f64.powf(triangles.log10().floor() - 1.0).max(1.0);
    count(((triangles / unit).round() * unit) as u64)
}

fn share(ratios: Ratios<'_>, claimed: &[f64]) -> Finding {
    let shares: Vec<f64> = ratios.list.iter().map(|r| 100.0 * r.ratio).collect();
    let parts = ratios.list.iter().zip(&shares);
    let text: Vec<String> = parts
        .map(|(ratio, share)| format!("{}: {share:.1} %", ratio.device))
        .collect();
    let low = claimed.iter().copied().fold(f64::INFINITY, f64::min) / SHARE_FACTOR;
    let high = claimed.iter().copied().fold(0.0, f64::max) * SHARE_FACTOR;
    let near = shares.iter().all(|share| (low..=high).contains(share));
    let verdict = Verdict::of(near, shares.iter().all(|share| *share < 100.0));
    let value = match shares.as_slice() {
        [share] => Some(*share),
        _ => None,
    };
    Finding::new(&[ratios], verdict, text.join("; ")).with_value(value, "share, %")
}

fn grows(
    evidence: &Evidence<'_>,
    table: u8,
    [small, large]: [Place; 2],
    pairs: &[Pair],
) -> Result<Finding> {
    let mut all = Vec::new();
    let mut parts = Vec::new();
    let mut gains = Vec::new();
    for Pair { series, over } in pairs {
        let at = |place| evidence.ratios(table, [series, over], |point| is_in(point, &[place]));
        let (small, mut large) = (at(small)?, at(large)?);
        // Only a device that has both scenes counts.
        large
            .list
            .retain(|after| small.of(after.device).next().is_some());
        for after in &mut large.list {
            let Some(before) = small.of(after.device).next() else {
                continue;
            };
            after.wrong |= before.wrong;
            let [name, other] = large.names;
            parts.push(format!(
                "{}: {name} over {other} {}, on Sponza {}",
                after.device,
                factor(after.ratio),
                factor(before.ratio)
            ));
            gains.push((after.ratio > 1.0, after.ratio / before.ratio));
        }
        all.push(large);
    }
    let more = gains.iter().filter(|(_, gain)| *gain > 1.0).count();
    let reproduced = gains.iter().all(|(wins, gain)| *wins && *gain > 1.0);
    let verdict = Verdict::of(reproduced, 2 * more >= gains.len());
    let least = gains.iter().map(|(_, gain)| *gain).min_by(f64::total_cmp);
    Ok(Finding::new(&all, verdict, parts.join("; ")).with_value(least, "smallest gain, factor"))
}
