//! Recording one frame: a chain of stages, wgpu's or native, with a timestamp between each two.

use super::Gpu;
use super::native::{Bindings, NativePass, Target};
use super::timer::{MAX_STAGES, Slot};
use std::time::Instant;

/// Records the stages of one frame in order.
///
/// An encoder is wgpu's or native, never both, so a native stage splits the frame: what was
/// recorded so far is closed, the native commands follow in a buffer of their own, and a new wgpu
/// encoder goes on after them. All are submitted at once.
pub struct FrameRecorder<'a> {
    gpu: &'a Gpu,
    encoder: wgpu::CommandEncoder,
    finished: Vec<wgpu::CommandBuffer>,
    slot: Option<&'a Slot>,
    stages: Vec<&'static str>,
    draw_calls: u32,
}

/// A frame on its way to the device.
pub(super) struct Submitted {
    /// Names of its stages.
    pub(super) stages: Vec<&'static str>,
    /// What to wait for.
    pub(super) submission: wgpu::SubmissionIndex,
    /// How many draw calls it has.
    pub(super) draw_calls: u32,
    /// When the last command was recorded.
    pub(super) recorded: Instant,
}

impl<'a> FrameRecorder<'a> {
    pub(super) fn new(gpu: &'a Gpu, slot: Option<&'a Slot>) -> Self {
        let mut encoder = new_encoder(gpu);
        if let Some(slot) = slot {
            encoder.write_timestamp(&slot.queries, 0);
        }
        Self {
            gpu,
            encoder,
            finished: Vec::new(),
            slot,
            stages: Vec::new(),
            draw_calls: 0,
        }
    }

    /// A frame whose stages nobody times.
    pub fn untimed(gpu: &'a Gpu) -> Self {
        Self::new(gpu, None)
    }

    /// A stage of wgpu commands; `record` gives the number of its draw calls.
    pub fn stage(
        &mut self,
        name: &'static str,
        record: impl FnOnce(&mut wgpu::CommandEncoder) -> u32,
    ) {
        self.draw_calls += record(&mut self.encoder);
        self.end_stage(name);
    }

    /// A stage of native draws into `target`.
    pub fn native_stage(
        &mut self,
        name: &'static str,
        target: &Target,
        bindings: &Bindings,
        draw: impl FnOnce(&mut NativePass<'_>),
    ) {
        // The native pass expects the texture as wgpu leaves it after a pass that wrote it.
        self.encoder.transition_resources(
            std::iter::empty(),
            std::iter::once(wgpu::TextureTransition {
                texture: &target.texture,
                selector: None,
                state: wgpu::TextureUses::DEPTH_STENCIL_WRITE,
            }),
        );
        let before = std::mem::replace(&mut self.encoder, new_encoder(self.gpu));
        self.finished.push(before.finish());
        let (commands, draw_calls) = NativePass::record(&self.gpu.device, target, bindings, draw);
        self.finished.push(commands);
        self.draw_calls += draw_calls;
        self.end_stage(name);
    }

    fn end_stage(&mut self, name: &'static str) {
        self.stages.push(name);
        assert!(
            self.stages.len() <= MAX_STAGES,
            "a frame has at most {MAX_STAGES} stages"
        );
        if let Some(slot) = self.slot {
            self.encoder
                .write_timestamp(&slot.queries, self.stages.len() as u32);
        }
    }

    /// Submits the frame, for whoever needs to know nothing of it.
    pub fn submit(self) {
        self.submit_timed();
    }

    pub(super) fn submit_timed(mut self) -> Submitted {
        if let Some(slot) = self.slot {
            slot.resolve(&mut self.encoder, self.stages.len());
        }
        self.finished.push(self.encoder.finish());
        let recorded = Instant::now();
        if loss::is_due() {
            self.gpu.device.destroy();
            // wgpu tells of it once nothing is under way any more.
            self.gpu.wait_idle();
        }
        Submitted {
            stages: self.stages,
            submission: self.gpu.queue.submit(self.finished),
            draw_calls: self.draw_calls,
            recorded,
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
