//! Accuracy against speed: what each millisecond of shadow time buys in right pixels.
//!
//! A [`Cloud`] is what one chart shows: a point for each cell of a scene that was measured and
//! verified, or, over all scenes, for each contender. A point is *dominated* if another is no slower
//! and no less accurate and better in one of the two; those that nothing dominates are the *front*.
//! Equal points do not dominate each other. Medians and means decide; intervals are shown beside them
//! and decide nothing.

use super::curve::{Contender, Curve};
use super::load::Run;
use crate::record::statistics::{p05, p95};
use crate::record::{Status, Summary, SweepRecord};

mod table;

pub(super) use table::write;

/// Name of the file that holds every point.
pub(crate) const PARETO_FILE: &str = "pareto.csv";

#[derive(Debug, Clone)]
pub(crate) struct Cloud {
    /// The scene; `None` for the cloud over all scenes.
    pub scene: Option<String>,
    /// A point for each cell or contender, in the run's order.
    pub points: Vec<Point>,
}

#[derive(Debug, Clone)]
pub(crate) struct Point {
    pub contender: Contender,
    pub curve: Curve,
    pub sweep: Option<SweepRecord>,
    /// Median shadow time; over all scenes, the geometric mean of the medians.
    pub shadow_ms: f64,
    /// 5th and 95th percentile of shadow time over the frames; over all scenes, the least and the
    /// greatest median.
    pub shadow_ms_range: Option<(f64, f64)>,
    /// Wrong pixels per verified frame; over all scenes, the arithmetic mean of these.
    pub wrong_px: f64,
    /// 5th and 95th percentile of wrong pixels over the verified frames; over all scenes, the least and
    /// the greatest mean.
    pub wrong_px_range: Option<(f64, f64)>,
    /// What `wrong_px` is made of.
    pub counts: Counts,
    /// The place in the cloud of one that dominates this; `None` on the front.
    pub dominated_by: Option<usize>,
}

/// Sums over the verified frames, over all scenes where the point is.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(crate) struct Counts {
    /// Lit, but in shadow by the reference.
    pub false_lit: u64,
    /// In shadow, but lit by the reference.
    pub false_shadowed: u64,
    /// Of the wrong ones, those far from the true boundary.
    pub artifact_px: u64,
    /// Frames compared with the reference.
    pub verified_frames: u32,
}

impl Cloud {
    fn new(scene: Option<String>, mut points: Vec<Point>) -> Self {
        for index in 0..points.len() {
            let above = (0..points.len()).filter(|by| dominates(&points[*by], &points[index]));
            // The fastest, of equally fast ones the most exact: nothing dominates that one, so it is of the front.
            points[index].dominated_by = above.min_by(|a, b| {
                let (a, b) = (&points[*a], &points[*b]);
                let by_time = a.shadow_ms.total_cmp(&b.shadow_ms);
                by_time.then(a.wrong_px.total_cmp(&b.wrong_px))
            });
        }
        Self { scene, points }
    }

    /// The places of the front's points, the fastest first; of equally fast ones in the run's order.
    pub(crate) fn front(&self) -> Vec<usize> {
        let on_front = |index: &usize| self.points[*index].dominated_by.is_none();
        let mut front: Vec<usize> = (0..self.points.len()).filter(on_front).collect();
        let shadow_ms = |index: usize| self.points[index].shadow_ms;
        front.sort_by(|a, b| shadow_ms(*a).total_cmp(&shadow_ms(*b)));
        front
    }
}

fn dominates(one: &Point, other: &Point) -> bool {
    let no_worse = one.shadow_ms <= other.shadow_ms && one.wrong_px <= other.wrong_px;
    no_worse && (one.shadow_ms < other.shadow_ms || one.wrong_px < other.wrong_px)
}

/// The clouds of a run: the one over all scenes if there are several, then a cloud for each scene that
/// has any point.
pub(crate) fn clouds(run: &Run) -> Vec<Cloud> {
    let scenes = run.scenes().into_iter().map(|scene| {
        let rows = run.rows(scene).into_iter();
        let points = rows.filter_map(|row| point(run, row)).collect();
        Cloud::new(Some(scene.to_owned()), points)
    });
    let scenes: Vec<Cloud> = scenes.filter(|cloud| !cloud.points.is_empty()).collect();
    overall(&scenes).into_iter().chain(scenes).collect()
}

/// The point of a cell; `None` where it was not both measured (in more time than the
/// device can tell from none) and verified, or at another size than
/// the run's: pixels of pictures of different sizes do not compare.
fn point(run: &Run, row: &Summary) -> Option<Point> {
    let own_size = (row.width, row.height) == (run.info.width, run.info.height);
    if row.status != Status::Ok || row.verified_frames == 0 || !own_size {
        return None;
    }
    let counts = Counts {
        false_lit: row.false_lit?,
        false_shadowed: row.false_shadowed?,
        artifact_px: row.artifact_px?,
        verified_frames: row.verified_frames,
    };
    let wrong_px = (counts.false_lit + counts.false_shadowed) as f64;
    let all_ms: Vec<f64> = run.samples_of(row).map(|sample| sample.shadow_ms).collect();
    let all_px = run.frames_of(row).map(|frame| frame.wrong_px() as f64);
    let all_px: Vec<f64> = all_px.collect();
    let shadow_ms = row.shadow_ms_median?;
    let contender = run.contender(row);
    let sweep = run.sweep_of(&contender).cloned();
    (shadow_ms.is_finite() && shadow_ms > 0.0).then(|| Point {
        curve: Curve::of(&contender, sweep.as_ref()),
        contender,
        sweep,
        shadow_ms,
        // As the summary has it, to the last digit.
        shadow_ms_range: p05(&all_ms).zip(row.shadow_ms_p95),
        wrong_px: wrong_px / f64::from(counts.verified_frames),
        wrong_px_range: p05(&all_px).zip(p95(&all_px)),
        counts,
        dominated_by: None,
    })
}

/// The cloud over all scenes; `None` for fewer than two, or without a contender in all of them.
///
/// A contender is on it if it was measured and verified in every scene that has any point: a mean over
/// fewer scenes would not compare. Shadow times differ between scenes by factors, so their mean is the
/// geometric one, and a contender twice as fast in each scene stands at half the time. Wrong pixels are
/// counts that may be zero, so theirs is the arithmetic mean: each scene counts for as much as one frame
/// of it shows. The interval is the range over the scenes, not a spread of one measurement.
fn overall(scenes: &[Cloud]) -> Option<Cloud> {
    let [first, _, ..] = scenes else {
        return None;
    };
    let points = first.points.iter().filter_map(|point| {
        let same = |cloud: &'_ Cloud| {
            let found = cloud.points.iter().find(|p| p.contender == point.contender);
            found.cloned()
        };
        scenes.iter().map(same).collect::<Option<Vec<Point>>>()
    });
    let points: Vec<Point> = points.map(|own| mean_of(&own)).collect();
    (!points.is_empty()).then(|| Cloud::new(None, points))
}

/// The mean of the points of one contender, of which there is one a scene.
fn mean_of(own: &[Point]) -> Point {
    let mean = |of: fn(&Point) -> f64| own.iter().map(of).sum::<f64>() / own.len() as f64;
    let range = |of: fn(&Point) -> f64| {
        let values = || own.iter().map(of);
        let least = values().min_by(f64::total_cmp);
        least.zip(values().max_by(f64::total_cmp))
    };
    let sum = |of: fn(&Counts) -> u64| own.iter().map(|point| of(&point.counts)).sum();
    Point {
        shadow_ms: mean(|point| point.shadow_ms.ln()).exp(),
        shadow_ms_range: range(|point| point.shadow_ms),
        wrong_px: mean(|point| point.wrong_px),
        wrong_px_range: range(|point| point.wrong_px),
        counts: Counts {
            false_lit: sum(|counts| counts.false_lit),
            false_shadowed: sum(|counts| counts.false_shadowed),
            artifact_px: sum(|counts| counts.artifact_px),
            verified_frames: own.iter().map(|point| point.counts.verified_frames).sum(),
        },
        dominated_by: None,
        ..own[0].clone()
    }
}

#[cfg(test)]
mod tests;
