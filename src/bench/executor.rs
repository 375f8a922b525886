//! What the schedule asks for, so that a stand-in can take the device's place in tests.
//!
//! An error of a cell's work is why that cell ends; [`Session::lost`] says whether the others must wait for the
//! next session.

use crate::frame::{DepthSetup, DrawnVolumes};
use crate::gpu::FrameTimes;
use crate::judge::{NoPicture, Observer};
use crate::methods::ShadowMethod;
use crate::record::{BiasRow, Cell, EdgeRecord, ImageKind, RegionRow, VerifiedFrame};
use crate::scene::Scene;
use std::time::Instant;

/// Opens scenes on a device.
pub(super) trait Executor {
    /// Whether the device can hold a mesh of so many triangles, which need not be built if not.
    fn check_mesh(&self, triangles: u64) -> anyhow::Result<()>;

    /// Makes `scene` ready for its cells, on a device that is opened again where it was lost.
    fn open<'a>(
        &'a mut self,
        scene: &'a Scene,
        size_px: (u32, u32),
    ) -> anyhow::Result<Box<dyn Session + 'a>>;
}

/// A scene on a device. Cells are known by their place among the scene's cells; what is made for one is kept until
/// the session ends. Whoever waits for the device does not do so for longer than until `deadline`.
pub(super) trait Session {
    /// Looks for the smallest bias without acne; `None` if the user wants the run to stop.
    fn find_bias(
        &mut self,
        cell: &Cell,
        method: &dyn ShadowMethod,
        observer: &dyn Observer,
        deadline: Option<Instant>,
    ) -> Result<Option<FoundBias>, NoPicture>;

    /// Makes a method ready to draw for a cell.
    fn prepare(
        &mut self,
        cell: usize,
        method: &dyn ShadowMethod,
        deadline: Option<Instant>,
    ) -> Result<Prepared, NoPicture>;

    /// Finds out what is true at a time of the flight, in frames with this depth buffer, and keeps it for
    /// [`Self::verify`] until the next time. Gives the true mask as a grey picture.
    fn trace(&mut self, depth: DepthSetup, time_s: f64) -> Result<Vec<u8>, NoPicture>;

    /// Draws a frame of a cell at the time that was traced, and compares it with the truth.
    fn verify(
        &mut self,
        cell: (usize, &Cell),
        frame: u32,
        deadline: Option<Instant>,
    ) -> Result<Verified, NoPicture>;

    /// How many frames may be under way at once.
    fn frames_in_flight(&self) -> usize;

    /// Draws a sequence of frames of a cell, of which the last is timed, and does not wait for them. Gives how its volumes
    /// were drawn, if it has any.
    fn draw(
        &mut self,
        cell: usize,
        times_s: &[f64],
        deadline: Option<Instant>,
    ) -> Result<Option<DrawnVolumes>, NoPicture>;

    /// Waits for the oldest of the timed frames under way.
    fn wait_for_oldest(&mut self, deadline: Option<Instant>) -> Result<FrameTimes, NoPicture>;

    /// Why the device is lost, once it is.
    fn lost(&self) -> Option<String>;

    /// The edges of the scene, if a method has asked for them.
    fn edges(&self) -> Option<EdgeRecord>;

    /// Ends the session.
    fn close(self: Box<Self>);
}

/// A bias that was found.
pub(super) struct FoundBias {
    /// In texels.
    pub slope_bias: f64,
    /// How it was found.
    pub row: BiasRow,
}

/// What is known of a method once it is ready.
#[derive(Default)]
pub(super) struct Prepared {
    /// What it counted.
    pub counters: Vec<(&'static str, u64)>,
    /// What a reader of its results should know.
    pub warnings: Vec<String>,
}

/// What came of a frame that was compared with the truth.
pub(super) struct Verified {
    /// The frame and its metrics.
    pub frame: VerifiedFrame,
    /// The largest regions of artifact pixels.
    pub regions: Vec<RegionRow>,
    /// Pictures of the frame that are kept.
    pub images: Vec<(ImageKind, Vec<u8>)>,
}

/// The times of the frames that are drawn for one that counts: `lead_in` frames before it, one of 60 a second, and
/// itself. None is before the start of the flight.
pub(super) fn sequence(time_s: f64, lead_in: u32) -> Vec<f64> {
    let earlier_s = |frames: u32| (time_s - f64::from(frames) * FRAME_S).max(0.0);
    (0..=lead_in).rev().map(earlier_s).collect()
}

/// What lies between a frame and the next: one of 60 a second.
pub(super) const FRAME_S: f64 = 1.0 / 60.0;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_lead_in_to_the_one_that_counts_and_never_start_before_the_flight() {
        assert_eq!(sequence(1.0, 0), [1.0]);
        let frames = [1.0 - 2.0 / 60.0, 1.0 - 1.0 / 60.0, 1.0];
        assert_eq!(sequence(1.0, 2), frames);
        assert_eq!(sequence(0.02, 3), [0.0, 0.0, 0.02 - 1.0 / 60.0, 0.02]);
        assert_eq!(sequence(0.0, 2), [0.0; 3]);
    }
}
