//! GPU times of a frame's stages, read back frames later so that measuring never stalls.

use super::recorder::Submitted;
use super::{FrameRecorder, Gpu};
use anyhow::Context;
use std::collections::VecDeque;
use std::sync::mpsc::Receiver;
use std::time::Instant;

/// Most stages that one frame may have.
pub const MAX_STAGES: usize = 15;

/// Frames that may be under way at once. As many as a swap chain would allow: the CPU may run
/// ahead, yet the queue does not grow without bound.
pub const FRAMES_IN_FLIGHT: usize = 3;

const QUERIES: u32 = MAX_STAGES as u32 + 1;
const QUERY_BYTES: u64 = QUERIES as u64 * wgpu::QUERY_SIZE as u64;

/// GPU times of one frame.
#[derive(Debug, Clone, PartialEq)]
pub struct StageTimes {
    /// `(stage, milliseconds)` in the order of execution.
    pub stages: Vec<(&'static str, f64)>,
    /// What recording the frame's commands took of the CPU, in milliseconds.
    pub record_ms: f64,
    /// What recording and submitting took of the CPU, in milliseconds.
    pub cpu_ms: f64,
    /// Draw calls of the frame.
    pub draw_calls: u32,
}

impl StageTimes {
    /// The whole frame: first timestamp to last.
    pub fn frame_ms(&self) -> f64 {
        self.stages.iter().map(|(_, ms)| ms).sum()
    }

    /// Time of the stage called `name`; 0 where there is none.
    pub fn stage_ms(&self, name: &str) -> f64 {
        self.stages
            .iter()
            .filter(|(stage, _)| *stage == name)
            .map(|(_, ms)| ms)
            .sum()
    }
}

/// The queries of one frame in flight.
pub(super) struct Slot {
    pub(super) queries: wgpu::QuerySet,
    resolved: wgpu::Buffer,
    readable: wgpu::Buffer,
}

impl Slot {
    fn new(device: &wgpu::Device) -> Self {
        let buffer = |label, usage| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size: QUERY_BYTES,
                usage,
                mapped_at_creation: false,
            })
        };
        Self {
            queries: device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("stage times"),
                ty: wgpu::QueryType::Timestamp,
                count: QUERIES,
            }),
            resolved: buffer(
                "stage times, resolved",
                wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC,
            ),
            readable: buffer(
                "stage times, readable",
                wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            ),
        }
    }

    pub(super) fn resolve(&self, encoder: &mut wgpu::CommandEncoder, stages: usize) {
        encoder.resolve_query_set(&self.queries, 0..stages as u32 + 1, &self.resolved, 0);
        encoder.copy_buffer_to_buffer(&self.resolved, 0, &self.readable, 0, QUERY_BYTES);
    }
}

struct Pending<T> {
    tag: T,
    slot: Slot,
    frame: Submitted,
    record_ms: f64,
    cpu_ms: f64,
    mapped: Receiver<Result<(), wgpu::BufferAsyncError>>,
}

/// Hands out frames to record and gives back their times, each with the caller's `tag`, in the
/// order in which they were submitted.
pub struct FrameTimer<T> {
    free: Vec<Slot>,
    pending: VecDeque<Pending<T>>,
    period_ns: f64,
}

impl<T> FrameTimer<T> {
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
    pub fn frame(
        &mut self,
        gpu: &Gpu,
        tag: T,
        record: impl FnOnce(&mut FrameRecorder<'_>),
    ) -> anyhow::Result<Option<(T, StageTimes)>> {
        let done = self.make_room(gpu)?;
        let slot = match self.free.pop() {
            Some(slot) => slot,
            None => gpu.attempt(|| Ok::<_, anyhow::Error>(Slot::new(&gpu.device)))?,
        };
        let pending = gpu.attempt(|| {
            let begin = Instant::now();
            let mut recorder = FrameRecorder::new(gpu, Some(&slot));
            record(&mut recorder);
            let frame = recorder.submit_timed();
            let cpu_ms = begin.elapsed().as_secs_f64() * 1e3;
            let record_ms = (frame.recorded - begin).as_secs_f64() * 1e3;
            let (sender, mapped) = std::sync::mpsc::channel();
            slot.readable
                .map_async(wgpu::MapMode::Read, .., move |result| {
                    // Nobody listens any more if the run was given up.
                    let _ = sender.send(result);
                });
            Ok::<_, anyhow::Error>(Pending {
                tag,
                slot,
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
    pub fn make_room(&mut self, gpu: &Gpu) -> anyhow::Result<Option<(T, StageTimes)>> {
        match self.pending.len() {
            FRAMES_IN_FLIGHT => self.finish_one(gpu),
            _ => Ok(None),
        }
    }

    /// Waits for all frames under way.
    ///
    /// # Errors
    /// When the device is lost.
    pub fn finish(&mut self, gpu: &Gpu) -> anyhow::Result<Vec<(T, StageTimes)>> {
        std::iter::from_fn(|| self.finish_one(gpu).transpose()).collect()
    }

    /// Waits for the oldest of the frames under way; `None` if there are none.
    ///
    /// # Errors
    /// When the device is lost.
    pub fn finish_one(&mut self, gpu: &Gpu) -> anyhow::Result<Option<(T, StageTimes)>> {
        gpu.attempt(|| self.wait_for_oldest(gpu))
    }

    /// The tag of the oldest frame under way, the first to come to its end: where the device was lost, the
    /// frame that lost it.
    pub fn under_way(&self) -> Option<&T> {
        self.pending.front().map(|pending| &pending.tag)
    }

    fn wait_for_oldest(&mut self, gpu: &Gpu) -> anyhow::Result<Option<(T, StageTimes)>> {
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
            tag,
            slot,
            frame,
            record_ms,
            cpu_ms,
            ..
        }) = self.pending.pop_front()
        else {
            return Ok(None);
        };
        let ticks: Vec<u64> = {
            let bytes = slot.readable.get_mapped_range(..)?;
            bytemuck::pod_collect_to_vec(&bytes)
        };
        slot.readable.unmap();
        let ms = |pair: &[u64]| pair[1].saturating_sub(pair[0]) as f64 * self.period_ns / 1e6;
        let named = frame.stages.into_iter().zip(ticks.windows(2).map(ms));
        let times = StageTimes {
            stages: named.collect(),
            record_ms,
            cpu_ms,
            draw_calls: frame.draw_calls,
        };
        self.free.push(slot);
        Ok(Some((tag, times)))
    }
}
