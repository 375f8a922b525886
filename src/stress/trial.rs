//! One picture of one scene, drawn by several methods and judged.

use crate::bench::Verifier;
use crate::bench::verify::{Judgement, Truth};
use crate::frame::Stage;
use crate::gpu::Gpu;
use crate::methods::{MethodError, PrepareContext, PreparedMethod, ShadowMethod};
use crate::reference::{ReferenceCache, ReferenceMask};
use crate::scene::Scene;

/// Draws the first view of scenes.
pub struct Studio<'a> {
    /// The device.
    pub gpu: &'a Gpu,
    /// Width and height of the pictures.
    pub size_px: (u32, u32),
    /// Truths are not worth keeping: no scene comes twice.
    cache: ReferenceCache,
}

/// What became of one method.
pub enum Attempt {
    /// It drew the picture.
    Drawn(Box<Drawn>),
    /// It cannot run on this scene or device, for this reason.
    Unavailable(String),
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
            Self::Unavailable(_) => None,
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
    /// The truth.
    pub truth: ReferenceMask,
    /// One for each method.
    pub attempts: Vec<Attempt>,
}

impl<'a> Studio<'a> {
    /// For pictures of this size.
    pub fn new(gpu: &'a Gpu, size_px: (u32, u32)) -> Self {
        Self {
            gpu,
            size_px,
            cache: ReferenceCache::open(None),
        }
    }

    /// Draws the first view of `scene` with every method and judges the masks.
    ///
    /// # Errors
    /// When the device is lost, the scene cannot be traced, or a method's parameters or shaders are refused.
    pub fn judge(&self, scene: &Scene, methods: &[Box<dyn ShadowMethod>]) -> anyhow::Result<Trial> {
        let stages = self.stages(scene, methods);
        let context = PrepareContext::new(self.gpu, scene, &stages[0]);
        let first = Verifier::new(self.gpu, scene, &stages[0], &self.cache)?;
        let view = scene.camera.view_at(0.0);
        let mut truths: Vec<Option<Truth>> = stages.iter().map(|_| None).collect();
        let mut attempts = Vec::with_capacity(methods.len());
        for method in methods {
            let (stage, prepared) = match self.prepare(&stages, &context, method.as_ref()) {
                Ok(ready) => ready,
                Err(MethodError::Unavailable(reason)) => {
                    attempts.push(Attempt::Unavailable(reason));
                    continue;
                }
                Err(error) => return Err(refused(method.as_ref(), error)),
            };
            let verifier = first.on(&stages[stage]);
            let truth = match &mut truths[stage] {
                Some(truth) => truth,
                none => none.insert(verifier.truth(&view)?),
            };
            let mask = verifier.draw_mask(prepared.as_ref(), truth)?;
            let judgement = verifier.judge(&mask, truth, prepared.as_ref())?;
            attempts.push(Attempt::Drawn(Box::new(Drawn { mask, judgement })));
        }
        let truth = match truths.into_iter().flatten().next() {
            Some(truth) => truth,
            None => first.truth(&view)?,
        };
        Ok(Trial {
            truth: truth.mask,
            attempts,
        })
    }

    /// The masks that the methods draw of the first view of `scene`, judged by nobody; an error is the
    /// reason why a method cannot.
    ///
    /// # Errors
    /// When the device is lost, or a method's parameters or shaders are refused.
    pub fn masks(
        &self,
        scene: &Scene,
        methods: &[Box<dyn ShadowMethod>],
    ) -> anyhow::Result<Vec<Result<Vec<u8>, String>>> {
        let stages = self.stages(scene, methods);
        let context = PrepareContext::new(self.gpu, scene, &stages[0]);
        let view = scene.camera.view_at(0.0);
        let mut masks = Vec::with_capacity(methods.len());
        for method in methods {
            masks.push(match self.prepare(&stages, &context, method.as_ref()) {
                Ok((stage, prepared)) => {
                    let stage = &stages[stage];
                    stage.set_view(self.gpu, &view, scene.light);
                    Ok(stage.draw_mask(self.gpu, prepared.as_ref())?)
                }
                Err(MethodError::Unavailable(reason)) => Err(reason),
                Err(error) => return Err(refused(method.as_ref(), error)),
            });
        }
        Ok(masks)
    }

    fn stages(&self, scene: &Scene, methods: &[Box<dyn ShadowMethod>]) -> Vec<Stage> {
        let setups = methods.iter().map(|method| method.depth_setup());
        Stage::for_setups(self.gpu, scene, self.size_px, setups)
    }

    /// The method made ready, and which of the stages it draws on.
    fn prepare(
        &self,
        stages: &[Stage],
        context: &PrepareContext<'_>,
        method: &dyn ShadowMethod,
    ) -> Result<(usize, Box<dyn PreparedMethod>), MethodError> {
        let setup = method.depth_setup();
        let unavailable = MethodError::Unavailable;
        method.info().check(self.gpu).map_err(unavailable)?;
        setup.check(self.gpu).map_err(unavailable)?;
        let Some(stage) = stages.iter().position(|stage| stage.depth == setup) else {
            unreachable!("there is a stage for each setup that the device can draw")
        };
        let prepared = method.prepare(&context.on(&stages[stage]))?;
        Ok((stage, prepared))
    }
}

fn refused(method: &dyn ShadowMethod, error: MethodError) -> anyhow::Error {
    anyhow::Error::new(error).context(format!("method `{}`", method.name()))
}
