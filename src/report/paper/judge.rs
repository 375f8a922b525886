//! The checks: how a claim is held against numbers, a function a check; the rules in words are in [`super::rules`].

use anyhow::Result;

use super::claims::{Check, Pair};
use super::evidence::{Evidence, Ratio, Ratios};
use super::finding::{Finding, Verdict};
use super::rules::{CROSSOVER_FACTOR, SHARE_FACTOR, SPEED_UP_FACTOR};
use crate::report::format::{count, factor, percent};

impl Check {
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
                let of = |than: &String| {
                    evidence.ratios(*table, [series, than], |point| scenes.contains(&point.id))
                };
                Ok(faster(&than.iter().map(of).collect::<Result<Vec<_>>>()?))
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
                let ratios = evidence.ratios(*table, [series, of], |point| point.id == *scene)?;
                Ok(share(ratios, percent))
            }
            Self::Grows {
                table,
                small,
                large,
                pairs,
            } => grows(evidence, *table, [small, large], pairs),
        }
    }
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

/// A number of triangles, and the ratio there.
type At = (f64, f64);

fn crossover(ratios: Ratios<'_>, claimed: f64) -> Finding {
    let devices: Vec<(&str, Vec<At>)> = ratios
        .devices()
        .into_iter()
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
    let text: Vec<String> = devices.iter().map(part).collect();
    let all =
        |holds: fn(&[At], f64) -> bool| devices.iter().all(|(_, points)| holds(points, claimed));
    let verdict = if all(|points, _| points.len() >= 2) {
        let crosses = all(crosses_near);
        let falls = all(|points, _| match points {
            [first, .., last] => last.1 < first.1,
            _ => false,
        });
        Verdict::of(crosses, falls)
    } else {
        Verdict::NotMeasured
    };
    let value = match devices.as_slice() {
        [(_, points)] => crossing(points),
        _ => None,
    };
    Finding::new(&[ratios], verdict, text.join("; ")).with_value(value, "triangles at crossover")
}

/// Triangles and ratio, by ascending triangles.
fn by_triangles<'a>(ratios: impl Iterator<Item = &'a Ratio<'a>>) -> Vec<At> {
    let mut points: Vec<At> = ratios
        .filter_map(|ratio| Some((ratio.point.number? as f64, ratio.ratio)))
        .collect();
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    points
}

/// Whether the ratio is above 1 well below the number of triangles claimed, and below 1 well above.
fn crosses_near(points: &[At], claimed: f64) -> bool {
    let low = points
        .iter()
        .filter(|point| point.0 <= claimed / CROSSOVER_FACTOR);
    let high = points
        .iter()
        .filter(|point| point.0 >= claimed * CROSSOVER_FACTOR);
    let both = low.clone().next().is_some() && high.clone().next().is_some();
    both && low.clone().all(|point| point.1 > 1.0) && high.clone().all(|point| point.1 < 1.0)
}

/// Where the ratio passes from above 1 to below, between two points, on log scales.
fn crossing(points: &[At]) -> Option<f64> {
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
        .map(|(ratio, share)| format!("{}{share:.1} %", ratios.whose(ratio.device)))
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
    [small, large]: [&str; 2],
    pairs: &[Pair],
) -> Result<Finding> {
    let mut all = Vec::new();
    let mut parts = Vec::new();
    let mut gains = Vec::new();
    for Pair { series, over } in pairs {
        let at = |place| evidence.ratios(table, [series, over], |point| point.id == place);
        let (before_name, small, mut large) =
            (evidence.place(table, small)?, at(small)?, at(large)?);
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
                "{}{name} over {other} {}, on {before_name} {}",
                small.whose(after.device),
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
