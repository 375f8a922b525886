//! One picture of one scene, drawn by several methods and judged.

use super::{DeviceScene, Judgement, NoPicture, Truth, Verifier, contain};
use crate::frame::DepthSetup;
use crate::gpu::{Gpu, GpuError};
use crate::methods::ShadowMethod;
use crate::reference::{ReferenceCache, ReferenceMask};
use crate::scene::Scene;
use std::cell::RefCell;

/// Tries methods on the first view of scenes.
pub struct Judge {
    /// The device; opened again where it was lost.
    gpu: RefCell<Gpu>,
    /// Width and height of the pictures.
    pub size_px: (u32, u32),
    /// Truths are not worth keeping: no scene comes twice.
    cache: ReferenceCache,
}

/// What became of one method.
pub enum Attempt {
    /// It drew the picture.
    Drawn(Box<Drawn>),
    /// There is no picture.
    Missing(NoPicture),
}

/// A picture and how right it is.
pub struct Drawn {
    /// The shadow mask, 0 lit to 255 in shadow, by rows from the top.
    pub mask: Vec<u8>,
    /// How it compares with the truth.
    pub judgement: Judgement,
}

impl Attempt {
    /// The picture, if there is one.
    pub fn drawn(&self) -> Option<&Drawn> {
        match self {
            Self::Drawn(drawn) => Some(drawn),
            Self::Missing(_) => None,
        }
    }

    /// Pixels that are wrong farther than one pixel from the true boundary; 0 where nothing was drawn.
    pub fn artifact_px(&self) -> u64 {
        self.drawn()
            .map_or(0, |drawn| drawn.judgement.error.artifact_px)
    }
}

/// The truth of one picture and what each method made of it.
pub struct Trial {
    /// The truth; `None` where nothing was drawn.
    pub truth: Option<ReferenceMask>,
    /// One for each method.
    pub attempts: Vec<Attempt>,
}

impl Judge {
    /// For pictures of this size.
    pub fn new(gpu: &Gpu, size_px: (u32, u32)) -> Self {
        Self {
            gpu: RefCell::new(gpu.clone()),
            size_px,
            cache: ReferenceCache::open(None),
        }
    }

    /// The device, opened again if it was lost.
    ///
    /// # Errors
    /// When it cannot be opened again.
    pub fn gpu(&self) -> Result<Gpu, GpuError> {
        let mut gpu = self.gpu.borrow_mut();
        if gpu.lost().is_some() {
            *gpu = gpu.reopen()?;
        }
        Ok(gpu.clone())
    }

    /// Tries every method on the first view of `scene`: draws it, and compares the mask with the truth.
    pub fn trial(&self, scene: &Scene, methods: &[Box<dyn ShadowMethod>]) -> Trial {
        let mut truths: Vec<(DepthSetup, Truth)> = Vec::new();
        let mut reference = None;
        let attempts = self.on_devices(scene, methods, |device, method| {
            let reference = match &reference {
                Some(reference) => reference,
                None => reference.insert(Verifier::reference_of(scene)?),
            };
            let mut ready = device.prepare(method)?;
            let (gpu, resources) = (&device.gpu, &ready.resources);
            let verifier = Verifier::sharing(gpu, scene, resources, &self.cache, reference);
            let known = truths
                .iter()
                .position(|(depth, _)| *depth == resources.depth);
            let known = match known {
                Some(known) => known,
                None => {
                    truths.push((resources.depth, verifier.truth(&scene.flight.at(0.0))?));
                    truths.len() - 1
                }
            };
            let truth = &truths[known].1;
            let mask = verifier.draw_mask(ready.method.as_mut(), truth)?;
            let judgement = verifier.compare(&mask, truth, ready.method.as_ref())?;
            Ok(Box::new(Drawn { mask, judgement }))
        });
        let attempt = |attempt: Result<_, _>| attempt.map_or_else(Attempt::Missing, Attempt::Drawn);
        Trial {
            truth: truths.into_iter().next().map(|(_, truth)| truth.mask),
            attempts: attempts.into_iter().map(attempt).collect(),
        }
    }

    /// The masks that the methods draw of the first view of `scene`, held against no truth.
    pub fn masks(
        &self,
        scene: &Scene,
        methods: &[Box<dyn ShadowMethod>],
    ) -> Vec<Result<Vec<u8>, NoPicture>> {
        self.on_devices(scene, methods, |device, method| {
            let mut ready = device.prepare(method)?;
            ready.resources.set_view(&device.gpu, &scene.flight.at(0.0));
            ready
                .resources
                .draw_mask(&device.gpu, ready.method.as_mut())
        })
    }

    /// Lets `draw` give something for each method, on one device after another: where one is lost, the method
    /// that lost it has failed, and the next ones go on.
    fn on_devices<T>(
        &self,
        scene: &Scene,
        methods: &[Box<dyn ShadowMethod>],
        mut draw: impl FnMut(&DeviceScene<'_>, &dyn ShadowMethod) -> anyhow::Result<T>,
    ) -> Vec<Result<T, NoPicture>> {
        let mut attempts = Vec::with_capacity(methods.len());
        while attempts.len() < methods.len() {
            let device = match self.device_scene(scene) {
                Ok(device) => device,
                Err(error) => {
                    let left = methods.len() - attempts.len();
                    let reason = NoPicture::from(error);
                    attempts.extend((0..left).map(|_| Err(reason.clone())));
                    break;
                }
            };
            for method in &methods[attempts.len()..] {
                let work = || draw(&device, method.as_ref());
                attempts.push(contain(&device.gpu, None, work));
                if device.gpu.lost().is_some() {
                    break;
                }
            }
        }
        attempts
    }

    fn device_scene<'a>(&self, scene: &'a Scene) -> anyhow::Result<DeviceScene<'a>> {
        scene.flight.at(0.0).validate()?;
        Ok(DeviceScene::new(&self.gpu()?, scene, self.size_px)?)
    }
}
