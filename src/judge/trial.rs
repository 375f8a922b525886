//! One picture of one scene, drawn by several methods and judged.

use super::verifier::{Judgement, Truth, Verifier};
use crate::frame::PreparedMethod;
use crate::frame::{DepthSetup, FrameResources};
use crate::geometry::Topology;
use crate::gpu::{Gpu, GpuError};
use crate::methods::{self, MethodError, PrepareContext, ShadowMethod};
use crate::record::in_one_line;
use crate::reference::{ReferenceCache, ReferenceMask};
use crate::scene::{Moment, Scene};
use std::cell::{OnceCell, RefCell};
use std::rc::Rc;

/// Draws the first view of scenes.
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

/// Why there is no picture.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum NoPicture {
    /// The method cannot run on this scene or device, for this reason.
    Unavailable(String),
    /// Something broke: the device was lost or has not enough memory, or the scene cannot be traced.
    Failed(String),
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

impl NoPicture {
    /// Why, in words.
    pub fn reason(&self) -> &str {
        match self {
            Self::Unavailable(reason) | Self::Failed(reason) => reason,
        }
    }

    fn failed(error: &anyhow::Error) -> Self {
        Self::Failed(in_one_line(error))
    }
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

    /// Draws the first view of `scene` with every method and judges the masks.
    pub fn judge(&self, scene: &Scene, methods: &[Box<dyn ShadowMethod>]) -> Trial {
        let mut truths: Vec<(DepthSetup, Truth)> = Vec::new();
        let attempts = self.on_devices(scene, methods, |set, methods, attempts| {
            let first = Verifier::new(&set.gpu, scene, &set.stages[0], &self.cache)?;
            for method in methods {
                let attempt = set.prepared(method.as_ref(), |stage, prepared| {
                    let verifier = first.on(stage);
                    let known = truths.iter().position(|(depth, _)| *depth == stage.depth);
                    let known = match known {
                        Some(known) => known,
                        None => {
                            truths.push((stage.depth, verifier.truth(&set.moment)?));
                            truths.len() - 1
                        }
                    };
                    let truth = &truths[known].1;
                    let mask = verifier.draw_mask(prepared, truth)?;
                    let judgement = verifier.judge(&mask, truth, prepared)?;
                    Ok(Box::new(Drawn { mask, judgement }))
                });
                attempts.push(attempt);
                if set.gpu.lost().is_some() {
                    break;
                }
            }
            Ok(())
        });
        let attempt = |attempt: Result<_, _>| attempt.map_or_else(Attempt::Missing, Attempt::Drawn);
        Trial {
            truth: truths.into_iter().next().map(|(_, truth)| truth.mask),
            attempts: attempts.into_iter().map(attempt).collect(),
        }
    }

    /// The masks that the methods draw of the first view of `scene`, judged by nobody.
    pub fn masks(
        &self,
        scene: &Scene,
        methods: &[Box<dyn ShadowMethod>],
    ) -> Vec<Result<Vec<u8>, NoPicture>> {
        self.on_devices(scene, methods, |set, methods, masks| {
            for method in methods {
                masks.push(set.prepared(method.as_ref(), |stage, prepared| {
                    stage.set_view(&set.gpu, &set.moment);
                    stage.draw_mask(&set.gpu, prepared)
                }));
                if set.gpu.lost().is_some() {
                    break;
                }
            }
            Ok(())
        })
    }

    /// Lets `work` give something for each method, on one device after another: where one is lost, the method
    /// that lost it has failed, and the next ones go on. An error of `work` is one for all that are left.
    fn on_devices<T>(
        &self,
        scene: &Scene,
        methods: &[Box<dyn ShadowMethod>],
        mut work: impl FnMut(&Set<'_>, &[Box<dyn ShadowMethod>], &mut Attempts<T>) -> anyhow::Result<()>,
    ) -> Attempts<T> {
        let mut attempts = Vec::with_capacity(methods.len());
        while attempts.len() < methods.len() {
            let rest = &methods[attempts.len()..];
            let done = self
                .set(scene, rest)
                .and_then(|set| work(&set, rest, &mut attempts));
            if let Err(error) = done {
                let left = methods.len() - attempts.len();
                attempts.extend((0..left).map(|_| Err(NoPicture::failed(&error))));
            }
        }
        attempts
    }

    fn set<'a>(
        &self,
        scene: &'a Scene,
        methods: &[Box<dyn ShadowMethod>],
    ) -> anyhow::Result<Set<'a>> {
        let moment = scene.flight.at(0.0);
        moment.validate()?;
        let gpu = self.gpu()?;
        let setups = methods.iter().map(|method| method.depth_setup());
        Ok(Set {
            stages: FrameResources::for_setups(&gpu, scene, self.size_px, setups)?,
            topology: Rc::default(),
            gpu,
            scene,
            moment,
        })
    }
}

/// What came of each method so far.
type Attempts<T> = Vec<Result<T, NoPicture>>;

/// A scene on one device.
struct Set<'a> {
    gpu: Gpu,
    scene: &'a Scene,
    stages: Vec<FrameResources>,
    moment: Moment,
    topology: Rc<OnceCell<Topology>>,
}

impl Set<'_> {
    /// What `draw` gives of the method made ready and the stage that it draws on.
    fn prepared<T>(
        &self,
        method: &dyn ShadowMethod,
        draw: impl FnOnce(&FrameResources, &mut dyn PreparedMethod) -> anyhow::Result<T>,
    ) -> Result<T, NoPicture> {
        let setup = method.depth_setup();
        let unavailable = NoPicture::Unavailable;
        method.info().check(&self.gpu).map_err(unavailable)?;
        setup.check(&self.gpu).map_err(unavailable)?;
        let Some(stage) = self.stages.iter().find(|stage| stage.depth == setup) else {
            unreachable!("there is a stage for each setup that the device can draw")
        };
        let context = PrepareContext::sharing(&self.gpu, self.scene, stage, &self.topology);
        let mut prepared = match methods::prepare(method, &context) {
            Ok(prepared) => prepared,
            Err(MethodError::Unavailable(reason)) => return Err(unavailable(reason)),
            Err(error) => return Err(NoPicture::failed(&error.into())),
        };
        draw(stage, prepared.as_mut()).map_err(|error| NoPicture::failed(&error))
    }
}
