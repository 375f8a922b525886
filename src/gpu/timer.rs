//! Times of a frame's stages, read back frames later so that measuring never stalls.

use super::recorder::Submitted;
use super::timeline::{StageTime, Timeline};
use super::timestamps::Timestamps;
use super::{FrameRecorder, Gpu};
use anyhow::Context;
use std::collections::VecDeque;
use std::sync::mpsc::Receiver;
use std::time::Instant;

/// Frames that may be under way at once. As many as a swap chain would allow: the CPU may run
/// ahead, yet the queue does not grow without bound.
pub const FRAMES_IN_FLIGHT: usize = 3;

/// Times of one frame, in milliseconds.
#[derive(Debug, Clone, PartialEq)]
pub struct FrameTimes {
    /// In the order of execution.
    pub stages: Vec<StageTime>,
    /// What each stage adds to the frame: its time on both clocks less what of it lies beside other stages' work.
    /// Sums up to the whole frame.
    added_ms: Vec<f64>,
    /// What recording the frame's commands took of the processor; the method's own work there is not in it.
    pub record_ms: f64,
    /// What recording and submitting took of the processor; the method's own work there is not in it.
    pub cpu_ms: f64,
    /// How long the processor waited for the device within the frame.
    pub wait_ms: f64,
    /// Draw calls of the frame.
    pub draw_calls: u32,
}

impl FrameTimes {
    /// Times on the device that nobody measured, one stage after the other, for tests of whoever reads them.
    #[cfg(test)]
    pub(crate) fn of_stages(stages: &[(&'static str, f64)]) -> Self {
        let stage = |&(name, device_ms): &(_, _)| StageTime {
            name,
            device_ms,
            processor_ms: 0.0,
        };
        Self {
            stages: stages.iter().map(stage).collect(),
            added_ms: stages.iter().map(|(_, ms)| *ms).collect(),
            record_ms: 0.0,
            cpu_ms: 0.0,
            wait_ms: 0.0,
            draw_calls: 0,
        }
    }

    /// The whole frame on both clocks, work that overlaps counted once; see [`super::timeline`].
    pub fn frame_ms(&self) -> f64 {
        self.added_ms.iter().sum()
    }

    /// Names of the stages, each once, in the order in which the first of each ran.
    pub fn stage_names(&self) -> Vec<&'static str> {
        let mut names = Vec::new();
        for stage in &self.stages {
            if !names.contains(&stage.name) {
                names.push(stage.name);
            }
        }
        names
    }

    /// What the stages called `name` add to the frame; 0 where there is none.
    pub fn stage_ms(&self, name: &str) -> f64 {
        let stages = self.stages.iter().zip(&self.added_ms);
        let named = stages.filter(|(stage, _)| stage.name == name);
        named.map(|(_, ms)| ms).sum()
    }
}

struct Pending {
    timestamps: Timestamps,
    frame: Submitted,
    record_ms: f64,
    cpu_ms: f64,
    mapped: Receiver<Result<(), wgpu::BufferAsyncError>>,
}

/// Hands out frames to record and gives back their times, in the order in which they were submitted.
pub struct FrameTimer {
    free: Vec<Timestamps>,
    pending: VecDeque<Pending>,
    period_ns: f64,
}

impl FrameTimer {
    /// A timer for `gpu`.
    pub fn new(gpu: &Gpu) -> Self {
        Self {
            free: Vec::new(),
            pending: VecDeque::new(),
            period_ns: f64::from(gpu.queue.get_timestamp_period()),
        }
    }

    /// Records a frame with `record`, submits it, and gives back a frame that has come to its end
    /// if the limit of frames in flight was reached.
    ///
    /// # Errors
    /// When the device is lost.
    pub fn frame<'g>(
        &mut self,
        gpu: &'g Gpu,
        record: impl FnOnce(FrameRecorder<'g>) -> anyhow::Result<FrameRecorder<'g>>,
    ) -> anyhow::Result<Option<FrameTimes>> {
        let done = self.make_room(gpu)?;
        let timestamps = match self.free.pop() {
            Some(timestamps) => timestamps,
            None => gpu.attempt(|| Ok::<_, anyhow::Error>(Timestamps::new(&gpu.device)))?,
        };
        let pending = gpu.attempt(|| {
            let begin = Instant::now();
            let frame = record(FrameRecorder::new(gpu, Some(timestamps.clone())))?.submit_timed();
            let cpu_ms = begin.elapsed().as_secs_f64() * 1e3 - frame.apart_ms;
            let record_ms = (frame.recorded - begin).as_secs_f64() * 1e3 - frame.apart_ms;
            let mapped = timestamps.map();
            Ok::<_, anyhow::Error>(Pending {
                timestamps,
                frame,
                record_ms,
                cpu_ms,
                mapped,
            })
        })?;
        self.pending.push_back(pending);
        Ok(done)
    }

    /// Waits for the oldest frame if the limit of frames in flight is reached, so that [`Self::frame`] need not.
    ///
    /// # Errors
    /// When the device is lost.
    pub fn make_room(&mut self, gpu: &Gpu) -> anyhow::Result<Option<FrameTimes>> {
        match self.pending.len() {
            FRAMES_IN_FLIGHT => self.finish_one(gpu),
            _ => Ok(None),
        }
    }

    /// Waits for all frames under way.
    ///
    /// # Errors
    /// When the device is lost.
    pub fn finish(&mut self, gpu: &Gpu) -> anyhow::Result<Vec<FrameTimes>> {
        std::iter::from_fn(|| self.finish_one(gpu).transpose()).collect()
    }

    /// Waits for the oldest of the frames under way; `None` if there are none.
    ///
    /// # Errors
    /// When the device is lost.
    pub fn finish_one(&mut self, gpu: &Gpu) -> anyhow::Result<Option<FrameTimes>> {
        gpu.attempt(|| self.wait_for_oldest(gpu))
    }

    fn wait_for_oldest(&mut self, gpu: &Gpu) -> anyhow::Result<Option<FrameTimes>> {
        let Some(oldest) = self.pending.front() else {
            return Ok(None);
        };
        // Only for this frame: those submitted after it keep the device busy.
        let wait = wgpu::PollType::Wait {
            submission_index: Some(oldest.frame.submission.clone()),
            timeout: None,
        };
        gpu.poll(wait)?;
        oldest
            .mapped
            .try_recv()
            .context("a frame's times got lost")??;
        let Some(Pending {
            timestamps,
            frame,
            record_ms,
            cpu_ms,
            ..
        }) = self.pending.pop_front()
        else {
            return Ok(None);
        };
        let ticks = timestamps.ticks()?;
        let ms = |from: u32, to: u32| {
            let ticks = ticks[to as usize].saturating_sub(ticks[from as usize]);
            ticks as f64 * self.period_ns / 1e6
        };
        let Timeline { stages, added_ms } = Timeline::new(&frame.stages, &frame.events, ms);
        let times = FrameTimes {
            stages,
            added_ms,
            record_ms,
            cpu_ms,
            wait_ms: frame.wait_ms,
            draw_calls: frame.draw_calls,
        };
        self.free.push(timestamps);
        Ok(Some(times))
    }
}
