//! Measuring the methods of one scene, interleaved: at each camera position every method draws one
//! frame, in an order shuffled anew, so that a drift of the machine hits all alike.

use super::cell::CellRun;
use crate::frame::{FrameResources, GBUFFER_STAGE, SHADE_STAGE};
use crate::gpu::{FrameTimer, FrameTimes, Gpu};
use crate::judge::Observer;
use crate::record::run_dir::RunDir;
use crate::record::{RunDirError, in_one_line};
use crate::scene::Scene;
use rand::SeedableRng;
use rand::seq::SliceRandom;
use rand_chacha::ChaCha8Rng;

/// How to measure.
#[derive(Debug, Clone, Copy)]
pub(super) struct Schedule {
    /// Frames of each method, evenly spaced along the flight.
    pub frames: u32,
    /// Rounds over all methods before the first measured one, at the start of the flight.
    pub warmup_frames: u32,
    /// Seed of the order of the methods.
    pub seed: u64,
}

/// A frame that was measured.
pub(super) struct Measured {
    /// Number of the frame along the flight.
    pub frame: u32,
    /// Its time on the flight.
    pub time_s: f64,
    /// Its place in the order in which frames were drawn.
    pub order: u64,
    /// Its times.
    pub times: FrameTimes,
}

impl Measured {
    /// What the method adds to a frame: everything but G-buffer and shading.
    pub(super) fn shadow_ms(&self) -> f64 {
        let shared = self.times.stage_ms(GBUFFER_STAGE) + self.times.stage_ms(SHADE_STAGE);
        self.times.frame_ms() - shared
    }
}

#[derive(Clone, Copy)]
struct Tag {
    /// Index of the cell.
    cell: usize,
    frame: u32,
    time_s: f64,
    order: u64,
    warmup: bool,
}

/// Flies along the scene's flight, each cell that is ready on its stage, and keeps every measured frame, frames
/// later. A cell that breaks ends; where the device is lost, all ends. Frames that were measured already, on a
/// device that was lost, are not measured again.
pub(super) fn measure(
    gpu: &Gpu,
    scene: &Scene,
    stages: &[FrameResources],
    cells: &mut [CellRun<'_>],
    schedule: Schedule,
    (observer, dir): (&dyn Observer, &mut RunDir),
) -> Result<(), RunDirError> {
    let mut flight = Flight {
        gpu,
        cells,
        timer: FrameTimer::new(gpu),
        dir,
    };
    let mut shuffle = ChaCha8Rng::seed_from_u64(schedule.seed);
    let ready = |(i, run): (usize, &CellRun<'_>)| run.prepared().map(|_| i);
    let mut order: Vec<usize> = flight.cells.iter().enumerate().filter_map(ready).collect();
    let mut drawn = 0;
    for (frame, time_s, warmup) in rounds(scene, schedule) {
        let moment = scene.flight.at(time_s);
        for stage in stages {
            stage.set_view(gpu, &moment);
        }
        order.shuffle(&mut shuffle);
        for &cell in &order {
            if observer.interrupted() {
                break;
            }
            if !warmup && flight.cells[cell].has_sample(frame) {
                continue;
            }
            let tag = Tag {
                cell,
                frame,
                time_s,
                order: drawn,
                warmup,
            };
            drawn += 1;
            flight.draw(&stages[flight.cells[cell].stage], tag)?;
            if gpu.lost().is_some() {
                return Ok(());
            }
            observer.advance(1);
        }
    }
    flight.finish()
}

/// Number and time of each round of frames, and whether it only warms up.
fn rounds(scene: &Scene, schedule: Schedule) -> impl Iterator<Item = (u32, f64, bool)> {
    let times_s = scene.flight.frame_times(schedule.frames as usize);
    let start_s = times_s.first().copied().unwrap_or(0.0);
    let warmup = std::iter::repeat_n((0, start_s, true), schedule.warmup_frames as usize);
    let measured = (0..).zip(times_s);
    warmup.chain(measured.map(|(frame, time_s)| (frame, time_s, false)))
}

/// The frames of a scene's cells, some of them under way.
struct Flight<'a, 'b> {
    gpu: &'a Gpu,
    cells: &'a mut [CellRun<'b>],
    timer: FrameTimer<Tag>,
    dir: &'a mut RunDir,
}

impl Flight<'_, '_> {
    /// Draws one frame, unless its cell has broken before.
    fn draw(&mut self, stage: &FrameResources, tag: Tag) -> Result<(), RunDirError> {
        // First, lest what has come to its end gets lost if this frame breaks.
        match self.timer.make_room(self.gpu) {
            Ok(done) => done.map_or(Ok(()), |done| self.keep(done))?,
            Err(error) => {
                self.end(tag, &error);
                return Ok(());
            }
        }
        let Some(prepared) = self.cells[tag.cell].prepared_mut() else {
            return Ok(());
        };
        let drawn = self
            .timer
            .frame(self.gpu, tag, |recorder| stage.record(recorder, prepared));
        if let Err(error) = drawn {
            self.end(tag, &error);
        }
        Ok(())
    }

    /// Waits for what is under way.
    fn finish(mut self) -> Result<(), RunDirError> {
        while let Some(tag) = self.timer.under_way().copied() {
            match self.timer.finish_one(self.gpu) {
                Ok(done) => done.map_or(Ok(()), |done| self.keep(done))?,
                Err(error) => {
                    self.end(tag, &error);
                    break;
                }
            }
        }
        Ok(())
    }

    fn keep(&mut self, (tag, times): (Tag, FrameTimes)) -> Result<(), RunDirError> {
        let run = &mut self.cells[tag.cell];
        if tag.warmup || !run.is_open() {
            return Ok(());
        }
        let measured = Measured {
            frame: tag.frame,
            time_s: tag.time_s,
            order: tag.order,
            times,
        };
        let sample = run.sample(&measured);
        self.dir.append_sample(&sample)?;
        run.keep(&measured, sample);
        Ok(())
    }

    /// Ends the cell whose frame broke. Frames come to their end in order: a device is lost by the first that
    /// did not.
    fn end(&mut self, drawing: Tag, error: &anyhow::Error) {
        let tag = match self.gpu.lost() {
            Some(_) => self.timer.under_way().copied().unwrap_or(drawing),
            None => drawing,
        };
        let reason = format!(
            "frame {} at {:.1} s of the flight: {}",
            tag.frame,
            tag.time_s,
            in_one_line(error)
        );
        self.cells[tag.cell].fail(&reason);
    }
}
