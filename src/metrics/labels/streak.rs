//! Leaks: streaks on a line through the light.
//!
//! A side of a shadow volume runs along lines through the light. Where two sides do not meet, what
//! leaks shows on such a line, as one streak or as a row of dots.

use glam::DVec2;

use super::clusters::Cluster;
use super::frame::JudgedFrame;
use crate::metrics::regions::Artifact;

/// A streak is at least this many pixels long,
const MIN_LENGTH_PX: f64 = 16.0;
/// at least this many times as long as it is wide (by standard deviations),
const MIN_RATIO: f64 = 5.0;
/// or, if it is broken into dots, this many times,
const MIN_BROKEN_RATIO: f64 = 10.0;
/// and points to or from the light to within this angle. By chance, one line in 30 does.
const MAX_ANGLE_DEGREES: f64 = 3.0;

/// A streak has at most this many others near it: more are a speckle or a pattern of stripes.
const MAX_REGIONS: usize = 4;

/// The variance of a pixel along each axis.
const PIXEL_VARIANCE: f64 = 1.0 / 12.0;

/// Which regions of a cluster are leaks.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Leaks {
    /// All: together they are one broken streak.
    All,
    /// Those that are streaks themselves.
    Streaks,
    None,
}

/// Judges a cluster as a whole. A shadow map has no volumes that could leak.
pub(super) fn leaks(frame: &JudgedFrame<'_>, cluster: &Cluster) -> Leaks {
    if frame.texel.is_some() {
        Leaks::None
    } else if is_streak(frame, &cluster.pixels, MIN_BROKEN_RATIO) {
        Leaks::All
    } else if cluster.regions <= MAX_REGIONS {
        Leaks::Streaks
    } else {
        Leaks::None
    }
}

impl Leaks {
    /// Whether a region of the cluster is a leak.
    pub(super) fn hold(self, frame: &JudgedFrame<'_>, artifact: &Artifact) -> bool {
        match self {
            Self::All => true,
            Self::Streaks => is_streak(frame, &artifact.pixels, MIN_RATIO),
            Self::None => false,
        }
    }
}

fn is_streak(frame: &JudgedFrame<'_>, pixels: &[usize], min_ratio: f64) -> bool {
    // What is shorter cannot be long enough, and most regions are.
    if (pixels.len() as f64) < MIN_LENGTH_PX / 4.0 {
        return false;
    }
    let places = || pixels.iter().map(|&pixel| place_px(pixel, frame.width));
    let axis = MainAxis::new(places());
    if axis.ratio < min_ratio || axis.length_px < MIN_LENGTH_PX {
        return false;
    }
    let sine = MAX_ANGLE_DEGREES.to_radians().sin();
    let radial = frame.probe.radial_px(axis.centre_px);
    radial.is_some_and(|radial| radial.perp_dot(axis.direction).abs() <= sine)
}

/// The centre of a pixel, in pixels from the top left corner.
fn place_px(pixel: usize, width: usize) -> DVec2 {
    DVec2::new((pixel % width) as f64 + 0.5, (pixel / width) as f64 + 0.5)
}

/// The axis along which pixels spread most (principal component analysis).
struct MainAxis {
    centre_px: DVec2,
    direction: DVec2,
    /// From the first to the last pixel along the axis.
    length_px: f64,
    /// Spread along the axis by the spread across it, as standard deviations.
    ratio: f64,
}

impl MainAxis {
    fn new(places: impl Iterator<Item = DVec2> + Clone) -> Self {
        let count = places.clone().count() as f64;
        let centre_px = places.clone().sum::<DVec2>() / count;
        let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
        for offset in places.clone().map(|place| place - centre_px) {
            xx += offset.x * offset.x / count;
            xy += offset.x * offset.y / count;
            yy += offset.y * offset.y / count;
        }
        let direction = DVec2::from_angle(0.5 * (2.0 * xy).atan2(xx - yy));
        let (mean, half) = (0.5 * (xx + yy), (0.5 * (xx - yy)).hypot(xy));
        let along = |place: DVec2| (place - centre_px).dot(direction);
        let low = places.clone().map(along).fold(f64::INFINITY, f64::min);
        let high = places.map(along).fold(f64::NEG_INFINITY, f64::max);
        let (most, least) = (mean + half, (mean - half).max(0.0));
        Self {
            centre_px,
            direction,
            length_px: high - low + 1.0,
            ratio: ((most + PIXEL_VARIANCE) / (least + PIXEL_VARIANCE)).sqrt(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_axis_of_a_line_is_the_line() {
        let along = DVec2::new(0.8, 0.6);
        let line = (0..40).map(move |i| DVec2::new(7.0, 3.0) + f64::from(i) * along);
        let axis = MainAxis::new(line);
        assert!(axis.direction.perp_dot(along).abs() < 1e-9);
        assert!((axis.length_px - 40.0).abs() < 1e-9);
        assert!((axis.ratio - 40.0).abs() < 0.1, "{}", axis.ratio);
        let square = (0..100).map(|i| place_px(i, 10));
        assert!(MainAxis::new(square).ratio < 1.01);
    }
}
