//! The executor of real runs: a device.

mod bias_search;
mod verify;

use super::executor::{Executor, FoundBias, Prepared, Session, Verified};
use crate::config::RunPlan;
use crate::frame::{DepthSetup, DrawnVolumes, SceneBuffers};
use crate::gpu::{FRAMES_IN_FLIGHT, FrameTimer, FrameTimes, Gpu};
use crate::judge::{DeviceScene, NoPicture, Observer, ReadyMethod, Truth, Verifier, contain};
use crate::methods::ShadowMethod;
use crate::record::{Cell, EdgeRecord};
use crate::reference::{Reference, ReferenceCache};
use crate::scene::Scene;
use anyhow::Context;
use std::rc::Rc;
use std::time::Instant;
use verify::Traced;

/// A device, opened again where it was lost.
pub(super) struct OnGpu<'a> {
    pub gpu: Gpu,
    pub plan: &'a RunPlan,
    pub cache: &'a ReferenceCache,
}

impl Executor for OnGpu<'_> {
    fn check_mesh(&self, triangles: u64) -> anyhow::Result<()> {
        Ok(SceneBuffers::check(&self.gpu, triangles)?)
    }

    fn open<'a>(
        &'a mut self,
        scene: &'a Scene,
        size_px: (u32, u32),
    ) -> anyhow::Result<Box<dyn Session + 'a>> {
        if let Some(loss) = self.gpu.lost() {
            let opened = self.gpu.reopen();
            self.gpu = opened.with_context(|| format!("{loss}, and cannot be opened again"))?;
        }
        let device = DeviceScene::new(&self.gpu, scene, size_px);
        Ok(Box::new(GpuSession {
            device: device.context("the scene cannot be drawn")?,
            plan: self.plan,
            cache: self.cache,
            reference: None,
            ready: Vec::new(),
            traced: None,
            bias_truths: Vec::new(),
            timer: FrameTimer::new(&self.gpu),
            shown: Vec::new(),
        }))
    }
}

/// A scene on a device.
struct GpuSession<'a> {
    device: DeviceScene<'a>,
    plan: &'a RunPlan,
    cache: &'a ReferenceCache,
    /// Made once somebody asks for a truth.
    reference: Option<Rc<Reference>>,
    /// The methods by cell.
    ready: Vec<Option<ReadyMethod>>,
    /// What is true where frames are verified.
    traced: Option<Traced>,
    /// What is true where biases are tried.
    bias_truths: Vec<(DepthSetup, Rc<[Truth]>)>,
    timer: FrameTimer,
    /// The time of the flight that frames with a depth buffer show, since measuring began.
    shown: Vec<(DepthSetup, f64)>,
}

impl GpuSession<'_> {
    fn reference(&mut self) -> anyhow::Result<Rc<Reference>> {
        let reference = match self.reference.take() {
            Some(reference) => reference,
            None => Verifier::reference_of(self.device.scene)?,
        };
        Ok(Rc::clone(self.reference.insert(reference)))
    }
}

impl Session for GpuSession<'_> {
    fn find_bias(
        &mut self,
        cell: &Cell,
        method: &dyn ShadowMethod,
        observer: &dyn Observer,
        deadline: Option<Instant>,
    ) -> Result<Option<FoundBias>, NoPicture> {
        let gpu = self.device.gpu.clone();
        contain(&gpu, deadline, || {
            let reference = self.reference()?;
            let (scene, depth) = (self.device.scene, method.depth_setup());
            let resources = self.device.resources(depth)?;
            let verifier = Verifier::sharing(&gpu, scene, &resources, self.cache, &reference);
            let known = self.bias_truths.iter().find(|(setup, _)| *setup == depth);
            let truths = match known {
                Some((_, truths)) => Rc::clone(truths),
                None => {
                    let times_s = self.plan.bias_times(&scene.flight).into_iter();
                    let truths = times_s.map(|s| verifier.truth(&scene.flight.at(s)));
                    let truths: Rc<[Truth]> = truths.collect::<anyhow::Result<_>>()?;
                    self.bias_truths.push((depth, Rc::clone(&truths)));
                    truths
                }
            };
            let search = method.bias_search().context("it has no bias to look for")?;
            let on = (&verifier, &*truths);
            bias_search::find(cell, &search, &self.device, on, observer)
        })
    }

    fn prepare(
        &mut self,
        cell: usize,
        method: &dyn ShadowMethod,
        deadline: Option<Instant>,
    ) -> Result<Prepared, NoPicture> {
        let Self { device, ready, .. } = self;
        contain(&device.gpu, deadline, || {
            let made = device.prepare(method)?;
            let prepared = Prepared {
                counters: made.method.counters(),
                warnings: made.method.warnings(),
            };
            if ready.len() <= cell {
                ready.resize_with(cell + 1, || None);
            }
            ready[cell] = Some(made);
            Ok(prepared)
        })
    }

    fn trace(&mut self, depth: DepthSetup, time_s: f64) -> Result<Vec<u8>, NoPicture> {
        // What was true before need not be kept beside it.
        self.traced = None;
        let gpu = self.device.gpu.clone();
        contain(&gpu, None, || {
            let reference = self.reference()?;
            let (scene, resources) = (self.device.scene, self.device.resources(depth)?);
            let verifier = Verifier::sharing(&gpu, scene, &resources, self.cache, &reference);
            let traced = Traced::new(self.plan, &verifier, &scene.flight, time_s)?;
            Ok(self.traced.insert(traced).truth.mask.to_grey())
        })
    }

    fn verify(
        &mut self,
        (index, cell): (usize, &Cell),
        frame: u32,
        deadline: Option<Instant>,
    ) -> Result<Verified, NoPicture> {
        let gpu = self.device.gpu.clone();
        contain(&gpu, deadline, || {
            let reference = self.reference()?;
            let traced = self.traced.as_ref().context("nothing was traced")?;
            let ready = of_cell(&mut self.ready, index)?;
            let resources = Rc::clone(&ready.resources);
            let verifier =
                Verifier::sharing(&gpu, self.device.scene, &resources, self.cache, &reference);
            traced.verify(self.plan, &verifier, ready, (cell, frame))
        })
    }

    fn frames_in_flight(&self) -> usize {
        FRAMES_IN_FLIGHT
    }

    fn draw(
        &mut self,
        cell: usize,
        times_s: &[f64],
        deadline: Option<Instant>,
    ) -> Result<Option<DrawnVolumes>, NoPicture> {
        let Self {
            device,
            ready,
            timer,
            shown,
            ..
        } = self;
        let (gpu, scene) = (&device.gpu, device.scene);
        contain(gpu, deadline, || {
            let ready = of_cell(ready, cell)?;
            let (time_s, lead_in) = times_s.split_last().context("no frame to draw")?;
            let lead_in: Vec<_> = lead_in.iter().map(|s| scene.flight.at(*s)).collect();
            ready.begin(gpu, &lead_in)?;
            let depth = ready.resources.depth;
            if !lead_in.is_empty() || !shown.contains(&(depth, *time_s)) {
                ready.resources.set_view(gpu, &scene.flight.at(*time_s));
                shown.retain(|(setup, _)| *setup != depth);
                shown.push((depth, *time_s));
            }
            let done = timer.frame(gpu, |frame| {
                ready.resources.record(frame, ready.method.as_mut())
            })?;
            anyhow::ensure!(done.is_none(), "there was no room for another frame");
            Ok(ready.method.drawn_volumes())
        })
    }

    fn wait_for_oldest(&mut self, deadline: Option<Instant>) -> Result<FrameTimes, NoPicture> {
        let Self { device, timer, .. } = self;
        contain(&device.gpu, deadline, || {
            let done = timer.finish_one(&device.gpu)?;
            done.context("no frame is under way")
        })
    }

    fn lost(&self) -> Option<String> {
        self.device.gpu.lost().map(|loss| loss.to_string())
    }

    fn edges(&self) -> Option<EdgeRecord> {
        let counts = self.device.casters().topology_if_built()?.counts();
        Some(EdgeRecord {
            boundary: counts.boundary as u64,
            manifold: counts.manifold as u64,
            non_manifold: counts.non_manifold as u64,
        })
    }

    fn close(self: Box<Self>) {
        if self.device.gpu.hangs() {
            // The device may still use all of it.
            std::mem::forget(self);
        }
    }
}

fn of_cell(ready: &mut [Option<ReadyMethod>], cell: usize) -> anyhow::Result<&mut ReadyMethod> {
    let ready = ready.get_mut(cell).and_then(Option::as_mut);
    ready.context("it is not ready to be drawn")
}
