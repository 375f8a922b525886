//! The cloud over all scenes.
//!
//! A contender is on it if it was measured and verified in every scene that has any point: a mean over
//! fewer scenes would not compare. Shadow times differ between scenes by factors, so their mean is the
//! geometric one, and a contender twice as fast in each scene stands at half the time. Wrong pixels are
//! counts that may be zero, so theirs is the arithmetic mean: each scene counts for as much as one frame
//! of it shows. The interval is the range over the scenes, not a spread of one measurement.

use super::{Cloud, Counts, Point};

/// The cloud over all scenes; `None` for fewer than two, or without a contender in all of them.
pub(super) fn cloud(scenes: &[Cloud]) -> Option<Cloud> {
    let (first, rest) = scenes.split_first()?;
    if rest.is_empty() {
        return None;
    }
    let points: Vec<Point> = first
        .points
        .iter()
        .filter_map(|point| {
            let same = |cloud: &'_ Cloud| {
                let found = cloud.points.iter().find(|p| p.contender == point.contender);
                found.cloned()
            };
            let own: Option<Vec<Point>> = scenes.iter().map(same).collect();
            mean_of(&own?)
        })
        .collect();
    (!points.is_empty()).then(|| Cloud::new(None, points))
}

fn mean_of(own: &[Point]) -> Option<Point> {
    let first = own.first()?;
    let scenes = own.len() as f64;
    let shadow_ms: Vec<f64> = own.iter().map(|point| point.shadow_ms).collect();
    let wrong_px: Vec<f64> = own.iter().map(|point| point.wrong_px).collect();
    let log_mean = shadow_ms.iter().map(|ms| ms.ln()).sum::<f64>() / scenes;
    let counts = own.iter().fold(Counts::default(), |sum, point| Counts {
        false_lit: sum.false_lit + point.counts.false_lit,
        false_shadowed: sum.false_shadowed + point.counts.false_shadowed,
        artifact_px: sum.artifact_px + point.counts.artifact_px,
        verified_frames: sum.verified_frames + point.counts.verified_frames,
    });
    Some(Point {
        shadow_ms: log_mean.exp(),
        shadow_ms_range: range(&shadow_ms),
        wrong_px: wrong_px.iter().sum::<f64>() / scenes,
        wrong_px_range: range(&wrong_px),
        counts,
        dominated_by: None,
        ..first.clone()
    })
}

fn range(values: &[f64]) -> Option<(f64, f64)> {
    let least = values.iter().copied().min_by(f64::total_cmp)?;
    let greatest = values.iter().copied().max_by(f64::total_cmp)?;
    Some((least, greatest))
}
