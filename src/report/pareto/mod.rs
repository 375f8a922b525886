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

mod overall;
mod table;

pub(super) use table::write;

/// Name of the file that holds every point.
pub const PARETO_FILE: &str = "pareto.csv";

/// The points of one chart.
#[derive(Debug, Clone)]
pub struct Cloud {
    /// The scene; `None` for the cloud over all scenes.
    pub scene: Option<String>,
    /// A point for each cell or contender, in the run's order.
    pub points: Vec<Point>,
}

/// A cell of a scene, or a contender over all scenes.
#[derive(Debug, Clone)]
pub struct Point {
    /// Whose point it is.
    pub contender: Contender,
    /// The curve that it is on.
    pub curve: Curve,
    /// Where on the curve, if a sweep made it.
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
pub struct Counts {
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
    /// A cloud whose front is marked.
    fn new(scene: Option<String>, mut points: Vec<Point>) -> Self {
        for (point, by) in dominators(&points).into_iter().enumerate() {
            points[point].dominated_by = by;
        }
        Self { scene, points }
    }

    /// The places of the front's points, the fastest first; of equally fast ones in the run's order.
    pub fn front(&self) -> Vec<usize> {
        let on_front = |index: &usize| self.points[*index].dominated_by.is_none();
        let mut front: Vec<usize> = (0..self.points.len()).filter(on_front).collect();
        front.sort_by(|a, b| {
            self.points[*a]
                .shadow_ms
                .total_cmp(&self.points[*b].shadow_ms)
        });
        front
    }
}

/// The clouds of a run: the one over all scenes if there are several, then a cloud for each scene that
/// has any point.
pub fn clouds(run: &Run) -> Vec<Cloud> {
    let scenes: Vec<Cloud> = run
        .scenes()
        .into_iter()
        .map(|scene| {
            let rows = run.rows(scene).into_iter();
            let points = rows.filter_map(|row| point(run, row)).collect();
            Cloud::new(Some(scene.to_owned()), points)
        })
        .filter(|cloud| !cloud.points.is_empty())
        .collect();
    overall::cloud(&scenes).into_iter().chain(scenes).collect()
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
    let shadow_ms: Vec<f64> = run.samples_of(row).map(|sample| sample.shadow_ms).collect();
    let wrong = run.frames_of(row).map(|frame| frame.wrong_px() as f64);
    let wrong: Vec<f64> = wrong.collect();
    let contender = run.contender(row);
    let sweep = run.sweep_of(&contender).cloned();
    Some(Point {
        curve: Curve::of(&contender, sweep.as_ref()),
        contender,
        sweep,
        shadow_ms: row
            .shadow_ms_median
            .filter(|ms| ms.is_finite() && *ms > 0.0)?,
        // As the summary has it, to the last digit.
        shadow_ms_range: p05(&shadow_ms).zip(row.shadow_ms_p95),
        wrong_px: wrong_px / f64::from(counts.verified_frames),
        wrong_px_range: p05(&wrong).zip(p95(&wrong)),
        counts,
        dominated_by: None,
    })
}

fn dominates(one: &Point, other: &Point) -> bool {
    let no_worse = one.shadow_ms <= other.shadow_ms && one.wrong_px <= other.wrong_px;
    no_worse && (one.shadow_ms < other.shadow_ms || one.wrong_px < other.wrong_px)
}

/// For each point, one of the front that dominates it, the fastest of several. There is always one:
/// whoever dominates a dominator dominates the point too.
fn dominators(points: &[Point]) -> Vec<Option<usize>> {
    let is_on_front = |point: &Point| !points.iter().any(|other| dominates(other, point));
    let front: Vec<usize> = (0..points.len())
        .filter(|index| is_on_front(&points[*index]))
        .collect();
    points
        .iter()
        .map(|point| {
            let above = front
                .iter()
                .copied()
                .filter(|by| dominates(&points[*by], point));
            above.min_by(|a, b| points[*a].shadow_ms.total_cmp(&points[*b].shadow_ms))
        })
        .collect()
}

#[cfg(test)]
mod tests;
