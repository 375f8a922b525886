//! A scene on a device, and methods made ready on it.

use super::NoPicture;
use crate::frame::{DepthSetup, FrameResources, PreparedMethod};
use crate::gpu::{DeviceError, Gpu};
use crate::methods::{self, Casters, PrepareContext, ShadowMethod};
use crate::scene::{Moment, Scene};
use std::cell::RefCell;
use std::rc::Rc;

/// A scene on a device at one size: frame resources for each depth buffer that methods ask for, and its
/// casters.
pub struct DeviceScene<'a> {
    /// The device.
    pub gpu: Gpu,
    /// The scene as data.
    pub scene: &'a Scene,
    resources: RefCell<Vec<Rc<FrameResources>>>,
    casters: Rc<Casters>,
}

/// A method that can draw frames of a scene.
pub struct ReadyMethod {
    /// The method.
    pub method: Box<dyn PreparedMethod>,
    /// What it draws with.
    pub resources: Rc<FrameResources>,
}

impl<'a> DeviceScene<'a> {
    /// Uploads `scene`, for pictures of `width` × `height` pixels.
    ///
    /// # Errors
    /// When the device cannot hold it.
    pub fn new(
        gpu: &Gpu,
        scene: &'a Scene,
        (width, height): (u32, u32),
    ) -> Result<Self, DeviceError> {
        let usual = FrameResources::new(gpu, scene, width, height)?;
        Ok(Self {
            gpu: gpu.clone(),
            scene,
            resources: RefCell::new(vec![Rc::new(usual)]),
            casters: Rc::new(Casters::of(scene)),
        })
    }

    /// The resources of frames with one depth buffer, made when somebody first asks for them.
    ///
    /// # Errors
    /// When the device cannot draw with it, or cannot hold it.
    pub fn resources(&self, depth: DepthSetup) -> Result<Rc<FrameResources>, NoPicture> {
        let mut known = self.resources.borrow_mut();
        if let Some(found) = known.iter().find(|resources| resources.depth == depth) {
            return Ok(Rc::clone(found));
        }
        depth.check(&self.gpu).map_err(NoPicture::Unavailable)?;
        let made = known[0].with_depth(&self.gpu, depth);
        let made = Rc::new(made.map_err(anyhow::Error::from)?);
        known.push(Rc::clone(&made));
        Ok(made)
    }

    /// Makes a method ready: the one way from a method to something that draws.
    ///
    /// # Errors
    /// Why it cannot run here, or what broke.
    pub fn prepare(&self, method: &dyn ShadowMethod) -> Result<ReadyMethod, NoPicture> {
        let check = method.info().check(&self.gpu);
        check.map_err(NoPicture::Unavailable)?;
        let resources = self.resources(method.depth_setup())?;
        let context = PrepareContext::sharing(&self.gpu, self.scene, &resources, &self.casters);
        let prepared = methods::prepare(method, &context).map_err(anyhow::Error::from)?;
        Ok(ReadyMethod {
            method: prepared,
            resources,
        })
    }

    /// What casts the scene's shadows.
    pub fn casters(&self) -> &Rc<Casters> {
        &self.casters
    }
}

impl ReadyMethod {
    /// Begins a sequence of frames, whatever was drawn before, and draws the first of them: those that lead in to
    /// the one that counts, and that nobody times or looks at.
    ///
    /// # Errors
    /// When the device is lost.
    pub fn begin(&mut self, gpu: &Gpu, lead_in: &[Moment]) -> anyhow::Result<()> {
        self.resources.begin(self.method.as_mut());
        for moment in lead_in {
            self.resources.set_view(gpu, moment);
            self.resources.draw(gpu, self.method.as_mut())?;
        }
        Ok(())
    }

    /// Draws the next frame of the sequence, whose view was set, and reads its mask: 0 lit to 255 in shadow.
    ///
    /// # Errors
    /// When the device is lost, or the method's.
    pub fn draw_mask(&mut self, gpu: &Gpu) -> anyhow::Result<Vec<u8>> {
        self.resources.draw_next_mask(gpu, self.method.as_mut())
    }
}
