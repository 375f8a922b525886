//! The checks: how a claim is held against numbers, and the rule in the words that the ledger prints.

use anyhow::Result;

use super::claims::{Check, Crossover, Faster, Grows, Pair, Share, SpeedUp};
use super::evidence::{Evidence, Finding, Ratio, Verdict};
use crate::report::format::{count, factor, percent};

/// A mean speed-up reproduces the claim if it lies within this factor of it.
const SPEED_UP_FACTOR: f64 = 2.0;
/// A crossover reproduces the claim if it lies within this factor of it.
const CROSSOVER_FACTOR: f64 = 2.0;
/// A share reproduces the claim if it lies within this factor of the shares claimed.
const SHARE_FACTOR: f64 = 1.5;

impl Check {
    pub(super) fn find(&self, evidence: &Evidence<'_>) -> Result<Finding> {
        match self {
            Self::SpeedUp(check) => check.find(evidence),
            Self::Faster(check) => check.find(evidence),
            Self::Crossover(check) => check.find(evidence),
            Self::Share(check) => check.find(evidence),
            Self::Grows(check) => check.find(evidence),
        }
    }

    /// How the verdict is reached.
    pub(super) fn rule(&self) -> String {
        match self {
            Self::SpeedUp(check) => check.rule(),
            Self::Faster(_) => "Reproduced: faster in every comparison. Trend only: in more than half of them.".to_owned(),
            Self::Crossover(_) => format!(
                "Reproduced: faster at every point up to 1/{CROSSOVER_FACTOR} of the claimed number \
                 of triangles, slower at every point from {CROSSOVER_FACTOR} times that number on, \
                 with at least one point on either side. Trend only: the ratio falls from the \
                 first to the last point measured. Where both are equally fast is interpolated \
                 between points, on log scales. A single point counts as not measured."
            ),
            Self::Share(_) => format!(
                "Reproduced: within a factor of {SHARE_FACTOR} of the range of the shares claimed. \
                 Trend only: below 100 %."
            ),
            Self::Grows(_) => "Reproduced: in each pair, the first method beats the second one on the large \
                               scene, and by a larger factor than on the small one. Trend only: the factor is \
                               larger for at least half of the pairs."
                .to_owned(),
        }
    }
}

/// The mean speed-up in percent, and the highest.
fn mean_and_max<'a>(ratios: impl Iterator<Item = &'a Ratio<'a>>) -> Option<(f64, f64)> {
    let all: Vec<f64> = ratios.map(|ratio| 100.0 * (ratio.ratio - 1.0)).collect();
    let max = all.iter().copied().max_by(f64::total_cmp)?;
    Some((all.iter().sum::<f64>() / all.len() as f64, max))
}

impl SpeedUp {
    fn find(&self, evidence: &Evidence<'_>) -> Result<Finding> {
        let (mut all, mut parts, mut first) = (Vec::new(), Vec::new(), None);
        for (index, table) in self.tables.iter().enumerate() {
            let ratios = evidence.ratios(*table, [&self.series, &self.over], |_| true)?;
            if let Some((mean, max)) = mean_and_max(ratios.list.iter()) {
                first = first.or((index == 0).then_some(mean));
                let (mean, max) = (percent(mean), percent(max));
                let (pairs, of) = (ratios.list.len(), ratios.possible);
                parts.push(format!(
                    "table {table}: mean {mean}, at most {max} ({pairs} of {of})"
                ));
            }
            all.push(ratios);
        }
        let overall = mean_and_max(all.iter().flat_map(|ratios| &ratios.list));
        let overall = overall.map(|(mean, _)| mean);
        if let (Some(mean), 2..) = (overall, parts.len()) {
            parts.push(format!("all: mean {}", percent(mean)));
        }
        let claimed = self.mean_percent / SPEED_UP_FACTOR..=self.mean_percent * SPEED_UP_FACTOR;
        let near = first.is_some_and(|mean| claimed.contains(&mean));
        let decisive = first.or(overall);
        let verdict = Verdict::of(near, decisive.is_some_and(|mean| mean > 0.0));
        let value = (decisive, "mean speed-up, %");
        Ok(Finding::new(&all, verdict, parts.join("; "), value))
    }

    fn rule(&self) -> String {
        let first = self.tables.first().copied().unwrap_or_default();
        let others: Vec<String> = self.tables.iter().skip(1).map(u8::to_string).collect();
        let alone = match others.join(" and ") {
            others if others.is_empty() => others,
            others => format!(
                "; or table {first} was not measured, and the mean over table {others} is positive"
            ),
        };
        format!(
            "Speed-up is speed over speed, less one, averaged over all rows of a table. Reproduced: \
             the mean over table {first} is positive and within a factor of {SPEED_UP_FACTOR} of the \
             claimed one (the highest value is shown, but decides nothing). Trend only: merely \
             positive{alone}."
        )
    }
}

impl Faster {
    fn find(&self, evidence: &Evidence<'_>) -> Result<Finding> {
        let of = |than: &String| {
            evidence.ratios(self.table, [&self.series, than], |point| {
                self.scenes.contains(&point.id)
            })
        };
        let ratios = self.than.iter().map(of).collect::<Result<Vec<_>>>()?;
        let all = ratios.iter().flat_map(|ratios| &ratios.list);
        let mut all: Vec<f64> = all.map(|ratio| ratio.ratio).collect();
        all.sort_by(f64::total_cmp);
        let pairs = all.len();
        let wins = all.iter().filter(|ratio| **ratio > 1.0).count();
        let least = all.first().copied();
        let [min, max] = [least, all.last().copied()].map(|end| factor(end.unwrap_or_default()));
        let text = format!("faster in {wins} of {pairs}, by factors of {min} to {max}");
        let verdict = Verdict::of(wins == pairs, 2 * wins > pairs);
        let value = (least, "smallest factor");
        Ok(Finding::new(&ratios, verdict, text, value))
    }
}

/// A number of triangles, and the ratio there.
type At = (f64, f64);

impl Crossover {
    fn find(&self, evidence: &Evidence<'_>) -> Result<Finding> {
        let ratios = evidence.ratios(self.table, [&self.series, &self.than], |_| true)?;
        let devices = ratios.devices().into_iter();
        let devices: Vec<(&str, Vec<At>)> = devices
            .map(|device| (device, by_triangles(ratios.of(device))))
            .collect();
        let part = |(device, points): &(&str, Vec<At>)| {
            let at = crossing(points).map_or("no crossover".to_owned(), |triangles| {
                format!("even at about {} triangles", rounded(triangles))
            });
            let wins = points.iter().filter(|point| point.1 > 1.0).count();
            let whose = ratios.whose(device);
            format!("{whose}faster at {wins} of {} points, {at}", points.len())
        };
        let text = devices.iter().map(part).collect::<Vec<_>>().join("; ");
        let all = |holds: &dyn Fn(&[At]) -> bool| devices.iter().all(|(_, points)| holds(points));
        let verdict = if all(&|points| points.len() >= 2) {
            let crosses = all(&|points| crosses_near(points, self.triangles as f64));
            let falls = all(&|points| matches!(points, [first, .., last] if last.1 < first.1));
            Verdict::of(crosses, falls)
        } else {
            Verdict::NotMeasured
        };
        let value = match devices.as_slice() {
            [(_, points)] => crossing(points),
            _ => None,
        };
        let value = (value, "triangles at crossover");
        Ok(Finding::new(&[ratios], verdict, text, value))
    }
}

fn by_triangles<'a>(ratios: impl Iterator<Item = &'a Ratio<'a>>) -> Vec<At> {
    let at = |ratio: &Ratio<'_>| Some((ratio.point.number? as f64, ratio.ratio));
    let mut points: Vec<At> = ratios.filter_map(at).collect();
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    points
}

/// Whether the ratio is above 1 well below the number of triangles claimed, and below 1 well above.
fn crosses_near(points: &[At], claimed: f64) -> bool {
    let is_low = |point: &&At| point.0 <= claimed / CROSSOVER_FACTOR;
    let is_high = |point: &&At| point.0 >= claimed * CROSSOVER_FACTOR;
    let both =
        points.iter().any(|point| is_low(&point)) && points.iter().any(|point| is_high(&point));
    both && points.iter().filter(is_low).all(|point| point.1 > 1.0)
        && points.iter().filter(is_high).all(|point| point.1 < 1.0)
}

/// Where the ratio passes from above 1 to below, between two points, on log scales.
fn crossing(points: &[At]) -> Option<f64> {
    let mut pairs = points.iter().zip(points.iter().skip(1));
    let ((x0, y0), (x1, y1)) = pairs.find(|(one, next)| one.1 > 1.0 && next.1 <= 1.0)?;
    let along = y0.ln() / (y0.ln() - y1.ln());
    Some((x0.ln() + along * (x1.ln() - x0.ln())).exp())
}

/// To two digits: more would feign precision.
fn rounded(triangles: f64) -> String {
    let unit = 10_f64.powf(triangles.log10().floor() - 1.0).max(1.0);
    count(((triangles / unit).round() * unit) as u64)
}

impl Share {
    fn find(&self, evidence: &Evidence<'_>) -> Result<Finding> {
        let ratios = evidence.ratios(self.table, [&self.series, &self.of], |point| {
            point.id == self.scene
        })?;
        let shares: Vec<f64> = ratios.list.iter().map(|r| 100.0 * r.ratio).collect();
        let parts = ratios.list.iter().zip(&shares);
        let parts =
            parts.map(|(ratio, share)| format!("{}{share:.1} %", ratios.whose(ratio.device)));
        let text = parts.collect::<Vec<_>>().join("; ");
        let low = self.percent.iter().copied().fold(f64::INFINITY, f64::min) / SHARE_FACTOR;
        let high = self.percent.iter().copied().fold(0.0, f64::max) * SHARE_FACTOR;
        let near = shares.iter().all(|share| (low..=high).contains(share));
        let verdict = Verdict::of(near, shares.iter().all(|share| *share < 100.0));
        let value = match shares.as_slice() {
            [share] => Some(*share),
            _ => None,
        };
        Ok(Finding::new(&[ratios], verdict, text, (value, "share, %")))
    }
}

impl Grows {
    fn find(&self, evidence: &Evidence<'_>) -> Result<Finding> {
        let (mut all, mut parts, mut gains) = (Vec::new(), Vec::new(), Vec::new());
        for Pair { series, over } in &self.pairs {
            let at = |scene: &str| {
                evidence.ratios(self.table, [series, over], |point| point.id == scene)
            };
            let (small, mut large) = (at(&self.small)?, at(&self.large)?);
            let [name, other] = large.names;
            // Only a device that has both scenes counts.
            large.list.retain_mut(|after| {
                let Some(before) = small.of(after.device).next() else {
                    return false;
                };
                after.wrong |= before.wrong;
                parts.push(format!(
                    "{}{name} over {other} {}, on {} {}",
                    small.whose(after.device),
                    factor(after.ratio),
                    before.point.said(),
                    factor(before.ratio)
                ));
                gains.push((after.ratio > 1.0, after.ratio / before.ratio));
                true
            });
            all.push(large);
        }
        let more = gains.iter().filter(|(_, gain)| *gain > 1.0).count();
        let reproduced = gains.iter().all(|(wins, gain)| *wins && *gain > 1.0);
        let verdict = Verdict::of(reproduced, 2 * more >= gains.len());
        let least = gains.iter().map(|(_, gain)| *gain).min_by(f64::total_cmp);
        let value = (least, "smallest gain, factor");
        Ok(Finding::new(&all, verdict, parts.join("; "), value))
    }
}
