//! Recording one frame: a chain of stages, each of wgpu's commands, native ones, work on the processor, or all of
//! these, timed on both clocks.

use super::Gpu;
use super::timeline::Event;
use super::timestamps::Timestamps;
use std::time::Instant;

/// Records the stages of one frame in order.
///
/// An encoder is wgpu's or native, never both, so native commands split the frame: what was recorded so far is
/// closed, the native commands follow in a buffer of their own, and a new wgpu encoder goes on after them. All are
/// submitted at once, unless a stage needs an answer of the device within the frame.
pub struct FrameRecorder<'a> {
    pub(super) gpu: &'a Gpu,
    pub(super) encoder: wgpu::CommandEncoder,
    pub(super) draw_calls: u32,
    /// Whether the encoder copies from the device's upload buffers.
    pub(super) uploads: bool,
    finished: Vec<wgpu::CommandBuffer>,
    /// Where the device writes down its time; `None` where nobody asks.
    timestamps: Option<Timestamps>,
    timestamp_count: u32,
    stages: Vec<&'static str>,
    events: Vec<Event>,
    /// Whether device commands were recorded since the last timestamp.
    is_dirty: bool,
    /// Part of the time since recording began that was not recording: work and waits on the processor.
    apart_ms: f64,
    wait_ms: f64,
}

/// A frame on its way to the device.
pub(super) struct Submitted {
    /// Names of its stages.
    pub(super) stages: Vec<&'static str>,
    /// What happened in it.
    pub(super) events: Vec<Event>,
    /// What to wait for.
    pub(super) submission: wgpu::SubmissionIndex,
    /// How many draw calls it has.
    pub(super) draw_calls: u32,
    /// When the last command was recorded.
    pub(super) recorded: Instant,
    /// What of the time before was not recording.
    pub(super) apart_ms: f64,
    /// What of that was waiting for the device.
    pub(super) wait_ms: f64,
}

impl<'a> FrameRecorder<'a> {
    pub(super) fn new(gpu: &'a Gpu, timestamps: Option<Timestamps>) -> Self {
        let mut recorder = Self {
            gpu,
            encoder: new_encoder(gpu),
            draw_calls: 0,
            uploads: false,
            finished: Vec::new(),
            timestamps,
            timestamp_count: 0,
            stages: Vec::new(),
            events: Vec::new(),
            is_dirty: false,
            apart_ms: 0.0,
            wait_ms: 0.0,
        };
        recorder.timestamp();
        recorder
    }

    /// A frame whose stages nobody times.
    pub fn untimed(gpu: &'a Gpu) -> Self {
        Self::new(gpu, None)
    }

    /// The device that the frame is for.
    pub fn gpu(&self) -> &'a Gpu {
        self.gpu
    }

    /// What follows is a stage of this name.
    pub(super) fn begin_stage(&mut self, name: &'static str) {
        self.stages.push(name);
    }

    /// The device's commands from here on are part of the stage.
    pub(super) fn begin_device_work(&mut self) {
        self.is_dirty = true;
    }

    /// Times what the device was given since the last timestamp, if anything.
    pub(super) fn end_device_work(&mut self) {
        if std::mem::take(&mut self.is_dirty) {
            let from = self.timestamp_count.saturating_sub(1);
            self.timestamp();
            self.events.push(Event::Device {
                stage: self.stages.len() - 1,
                from,
                to: self.timestamp_count.saturating_sub(1),
            });
        }
    }

    fn timestamp(&mut self) {
        if let Some(timestamps) = &self.timestamps {
            timestamps.write(&mut self.encoder, self.timestamp_count);
            self.timestamp_count += 1;
        }
    }

    /// Work on the processor, as a part of the stage.
    pub(super) fn on_processor<T>(&mut self, work: impl FnOnce() -> T) -> T {
        // Where the device is this processor, earlier frames would slow the work down.
        if self.timestamps.is_some() && self.gpu.is_software() && !self.has_worked() {
            self.apart(|recorder| recorder.gpu.wait_idle());
        }
        let begin = Instant::now();
        let result = work();
        let ms = begin.elapsed().as_secs_f64() * 1e3;
        self.apart_ms += ms;
        let stage = self.stages.len() - 1;
        self.events.push(Event::Processor { stage, ms });
        result
    }

    /// Whether some of this frame is with the device or was worked on the processor already.
    fn has_worked(&self) -> bool {
        let has_worked = |event: &Event| !matches!(event, Event::Device { .. });
        self.events.iter().any(has_worked)
    }

    /// Puts native commands after what was recorded so far.
    pub(super) fn push_native(&mut self, commands: wgpu::CommandBuffer) {
        self.close_encoder();
        self.finished.push(commands);
    }

    fn close_encoder(&mut self) {
        let encoder = std::mem::replace(&mut self.encoder, new_encoder(self.gpu));
        if std::mem::take(&mut self.uploads) {
            self.gpu.uploads.close(&encoder);
        }
        self.finished.push(encoder.finish());
    }

    /// Submits what was recorded so far.
    pub(super) fn submit_part(&mut self) {
        self.end_device_work();
        self.close_encoder();
        self.gpu.queue.submit(std::mem::take(&mut self.finished));
        self.events.push(Event::Submit);
        // What the device does between two submissions is not this frame's.
        self.timestamp();
    }

    /// Waits for the device to do what was submitted, and for `answer`.
    pub(super) fn wait<T>(&mut self, answer: impl FnOnce(&Gpu) -> T) -> T {
        self.events.push(Event::Wait);
        self.apart(|recorder| answer(recorder.gpu))
    }

    /// Something that is neither recording nor a method's work.
    fn apart<T>(&mut self, wait: impl FnOnce(&Self) -> T) -> T {
        let begin = Instant::now();
        let result = wait(self);
        let ms = begin.elapsed().as_secs_f64() * 1e3;
        self.apart_ms += ms;
        self.wait_ms += ms;
        result
    }

    /// Submits the frame, for whoever needs to know nothing of it.
    pub fn submit(self) {
        self.submit_timed();
    }

    pub(super) fn submit_timed(mut self) -> Submitted {
        if let Some(timestamps) = &self.timestamps {
            timestamps.resolve(&mut self.encoder, self.timestamp_count);
        }
        self.close_encoder();
        let recorded = Instant::now();
        if loss::is_due() {
            self.gpu.device.destroy();
            // wgpu tells of it once nothing is under way any more.
            self.gpu.wait_idle();
        }
        Submitted {
            stages: self.stages,
            events: self.events,
            submission: self.gpu.queue.submit(self.finished),
            draw_calls: self.draw_calls,
            recorded,
            apart_ms: self.apart_ms,
            wait_ms: self.wait_ms,
        }
    }
}

/// A device that is lost on purpose, for tests of the program.
mod loss {
    use std::sync::LazyLock;
    use std::sync::atomic::{AtomicU64, Ordering};

    /// Frames of this process after which its device is lost, counted from 1 and separated by commas.
    static DUE: LazyLock<Vec<u64>> = LazyLock::new(|| {
        let frames = std::env::var("SVBENCH_TEST_LOSE_DEVICE").unwrap_or_default();
        frames.split(',').filter_map(|n| n.parse().ok()).collect()
    });
    static FRAMES: AtomicU64 = AtomicU64::new(0);

    pub(super) fn is_due() -> bool {
        !DUE.is_empty() && DUE.contains(&(FRAMES.fetch_add(1, Ordering::Relaxed) + 1))
    }
}

fn new_encoder(gpu: &Gpu) -> wgpu::CommandEncoder {
    gpu.device
        .create_command_encoder(&wgpu::CommandEncoderDescriptor {
            label: Some("frame"),
        })
}
