//! Measuring the methods of one scene, interleaved: at each camera position every method draws one
//! frame, in an order shuffled anew, so that a drift of the machine hits all alike.

use super::Observer;
use crate::frame::{GBUFFER_STAGE, SHADE_STAGE, Stage};
use crate::gpu::{FrameTimer, Gpu, StageTimes};
use crate::methods::PreparedMethod;
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
    /// Index of the method.
    pub method: usize,
    /// Number of the frame along the flight.
    pub frame: u32,
    /// Its time on the flight.
    pub time_s: f64,
    /// Its place in the order in which frames were drawn.
    pub order: u64,
    /// Its times.
    pub times: StageTimes,
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
    method: usize,
    frame: u32,
    time_s: f64,
    order: u64,
    warmup: bool,
}

/// Flies along the camera path, each method on its stage, and hands every measured frame to `keep`, frames later.
pub(super) fn measure(
    gpu: &Gpu,
    scene: &Scene,
    (stages, methods): (&[Stage], &[(usize, &dyn PreparedMethod)]),
    schedule: Schedule,
    observer: &dyn Observer,
    mut keep: impl FnMut(Measured) -> anyhow::Result<()>,
) -> anyhow::Result<()> {
    let times_s = scene.camera.frame_times(schedule.frames as usize);
    let warmup = std::iter::repeat_n(
        (0, times_s.first().copied().unwrap_or(0.0)),
        schedule.warmup_frames as usize,
    );
    let flight = (0..).zip(times_s.iter().copied());
    let rounds = warmup
        .map(|round| (round, true))
        .chain(flight.map(|round| (round, false)));

    let mut shuffle = ChaCha8Rng::seed_from_u64(schedule.seed);
    let mut order: Vec<usize> = (0..methods.len()).collect();
    let mut timer = FrameTimer::new(gpu);
    let mut drawn = 0;
    let mut keep_measured = |(tag, times): (Tag, StageTimes)| {
        let Tag {
            method,
            frame,
            time_s,
            order,
            warmup,
        } = tag;
        if warmup {
            Ok(())
        } else {
            keep(Measured {
                method,
                frame,
                time_s,
                order,
                times,
            })
        }
    };
    for ((frame, time_s), warmup) in rounds {
        let view = scene.camera.view_at(time_s);
        for stage in stages {
            stage.set_view(gpu, &view, scene.light);
        }
        order.shuffle(&mut shuffle);
        for &method in &order {
            if observer.interrupted() {
                break;
            }
            let tag = Tag {
                method,
                frame,
                time_s,
                order: drawn,
                warmup,
            };
            drawn += 1;
            let (stage, prepared) = methods[method];
            let done = timer.frame(gpu, tag, |recorder| {
                stages[stage].record(recorder, prepared);
            })?;
            done.map_or(Ok(()), &mut keep_measured)?;
            observer.advance(1);
        }
    }
    timer.finish(gpu)?.into_iter().try_for_each(keep_measured)
}
