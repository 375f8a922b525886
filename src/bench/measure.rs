//! Measuring the methods of one scene, interleaved: at each camera position every method draws one
//! frame, in an order shuffled anew, so that a drift of the machine hits all alike.

use super::Watched;
use super::cell::{CellRun, Measured};
use super::executor::{Session, sequence};
use crate::frame::DrawnVolumes;
use crate::gpu::FrameTimes;
use crate::judge::NoPicture;
use crate::record::RunDirError;
use crate::record::run_dir::RunDir;
use crate::scene::Flight;
use rand::SeedableRng;
use rand::seq::SliceRandom;
use rand_chacha::ChaCha8Rng;
use std::collections::VecDeque;

#[derive(Clone, Copy)]
struct Tag {
    /// Index of the cell.
    cell: usize,
    frame: u32,
    time_s: f64,
    order: u64,
    warmup: bool,
    volumes: Option<DrawnVolumes>,
}

/// Flies along the scene's flight with each cell that is ready, and keeps every measured frame, frames
/// later. A cell that breaks ends; where the device is lost, all ends. Frames that were measured already, on a
/// device that was lost, are not measured again.
pub(super) fn measure(
    watched: Watched<'_>,
    flight: &Flight,
    session: &mut dyn Session,
    cells: &mut [CellRun<'_>],
    dir: &mut RunDir,
) -> Result<(), RunDirError> {
    let plan = watched.plan;
    let mut shuffle = ChaCha8Rng::seed_from_u64(plan.seed);
    let ready = |(i, run): (usize, &CellRun<'_>)| run.is_ready().then_some(i);
    let mut order: Vec<usize> = cells.iter().enumerate().filter_map(ready).collect();
    let mut frames = Frames {
        session,
        cells,
        under_way: VecDeque::new(),
        dir,
    };
    let mut drawn = 0;
    let times_s = flight.frame_times(plan.frames as usize);
    for (frame, time_s, warmup) in rounds(&times_s, plan.warmup_frames) {
        let times_s = sequence(time_s, plan.lead_in);
        order.shuffle(&mut shuffle);
        for &cell in &order {
            if watched.observer.interrupted() {
                break;
            }
            if !warmup && frames.cells[cell].has_sample(frame) {
                continue;
            }
            let tag = Tag {
                cell,
                frame,
                time_s,
                order: drawn,
                warmup,
                volumes: None,
            };
            drawn += 1;
            frames.draw(&times_s, tag)?;
            if frames.session.lost().is_some() {
                return Ok(());
            }
            watched.observer.advance(1);
        }
    }
    frames.finish()
}

/// Number and time of each round of frames, and whether it only warms up.
fn rounds(times_s: &[f64], warmup_frames: u32) -> impl Iterator<Item = (u32, f64, bool)> {
    let start_s = times_s.first().copied().unwrap_or(0.0);
    let warmup = std::iter::repeat_n((0, start_s, true), warmup_frames as usize);
    let measured = (0..).zip(times_s);
    warmup.chain(measured.map(|(frame, time_s)| (frame, *time_s, false)))
}

/// The frames of a scene's cells, some of them under way.
struct Frames<'a, 'b> {
    session: &'a mut dyn Session,
    cells: &'a mut [CellRun<'b>],
    /// Those that were drawn and not waited for yet, the oldest first.
    under_way: VecDeque<Tag>,
    dir: &'a mut RunDir,
}

impl Frames<'_, '_> {
    /// Draws one frame, unless its cell has broken before.
    fn draw(&mut self, times_s: &[f64], tag: Tag) -> Result<(), RunDirError> {
        // First, lest what has come to its end gets lost if this frame breaks.
        if self.under_way.len() >= self.session.frames_in_flight() {
            self.wait_for_oldest()?;
        }
        let run = &mut self.cells[tag.cell];
        if !run.is_ready() || self.session.lost().is_some() {
            return Ok(());
        }
        let (session, under_way) = (&mut *self.session, &mut self.under_way);
        let drawn = run.time.spend(|deadline| {
            let volumes = session.draw(tag.cell, times_s, deadline)?;
            // Also if it took too long: it will come to its end.
            under_way.push_back(Tag { volumes, ..tag });
            Ok(())
        });
        match drawn {
            Ok(()) => {}
            // A device is lost by the first frame that did not come to its end, which may be an earlier one.
            Err(error) => match self.session.lost() {
                Some(_) => self.end(*self.under_way.front().unwrap_or(&tag), error),
                None => self.end(tag, error),
            },
        }
        Ok(())
    }

    /// Waits for what is under way.
    fn finish(mut self) -> Result<(), RunDirError> {
        while !self.under_way.is_empty() && self.session.lost().is_none() {
            self.wait_for_oldest()?;
        }
        Ok(())
    }

    /// Waits for the oldest frame, and keeps it. Frames come to their end in order.
    fn wait_for_oldest(&mut self) -> Result<(), RunDirError> {
        let Some(tag) = self.under_way.pop_front() else {
            return Ok(());
        };
        let session = &mut *self.session;
        let time = &mut self.cells[tag.cell].time;
        match time.spend(|deadline| session.wait_for_oldest(deadline)) {
            Ok(times) => self.keep(tag, times),
            Err(error) => {
                self.end(tag, error);
                Ok(())
            }
        }
    }

    fn keep(&mut self, tag: Tag, times: FrameTimes) -> Result<(), RunDirError> {
        let run = &mut self.cells[tag.cell];
        if tag.warmup || !run.is_open() {
            return Ok(());
        }
        let measured = Measured {
            frame: tag.frame,
            time_s: tag.time_s,
            order: tag.order,
            times,
            volumes: tag.volumes,
        };
        let sample = run.sample(&measured);
        self.dir.append_sample(&sample)?;
        run.keep(&measured, sample);
        Ok(())
    }

    /// Ends the cell whose frame broke.
    fn end(&mut self, tag: Tag, error: NoPicture) {
        let place = format!("frame {} at {:.1} s of the flight", tag.frame, tag.time_s);
        self.cells[tag.cell].refuse(error.at(&place));
    }
}
