//! Shadow rays on the processor, sixteen at a time on all cores: which triangle each pixel shows is read back, and the mask
//! is brought to the device. What a program without a capable device would do.

use super::{Casters, MethodError, MethodInfo, PrepareContext, ShadowMethod, ray_limits};
use crate::frame::{Frame, PreparedMethod};
use crate::geometry::rays::Picture;
use crate::scene::Mesh;
use std::borrow::Cow;
use std::rc::Rc;
use std::sync::Arc;

/// What the method is.
pub(super) static INFO: MethodInfo = MethodInfo {
    id: "ray_cpu",
    title: "shadow rays on the processor",
    source: "packets after Wald, Slusallek, Benthin and Wagner 2001",
    needs: &[],
    limits: &[ray_limits::LIMITS],
    clashes: &[],
    tolerated_share: 0.0,
};

crate::parameters! {
    /// The method with its parameters.
    pub(super) struct RayCpu {}
}

impl ShadowMethod for RayCpu {
    fn info(&self) -> &'static MethodInfo {
        &INFO
    }

    fn prepare(
        &self,
        context: &PrepareContext<'_>,
    ) -> Result<Box<dyn PreparedMethod>, MethodError> {
        context.casters.ray_tree();
        Ok(Box::new(Prepared {
            mesh: Arc::clone(&context.scene.mesh),
            casters: Rc::clone(&context.casters),
        }))
    }
}

/// The rays of one scene.
struct Prepared {
    /// All that is seen.
    mesh: Arc<Mesh>,
    casters: Rc<Casters>,
}

impl PreparedMethod for Prepared {
    fn record(&mut self, frame: &mut Frame<'_>) -> anyhow::Result<()> {
        let targets = frame.targets();
        let view = *frame.view();
        let picture = Picture {
            size_px: [targets.width as usize, targets.height as usize],
            eye: view.eye,
            clip_to_eye_ray: view.clip_to_eye_ray,
            light: view.light.place,
        };
        let [ids, mut mask] = frame.stage("read_back", |stage| {
            stage.read_now([&targets.triangle_ids, &targets.mask])
        })?;
        frame.stage("rays", |stage| {
            stage.on_processor(|| {
                // Bytes need not begin where a number may; mostly they do.
                let ids = bytemuck::try_cast_slice(&ids)
                    .map_or_else(|_| bytemuck::pod_collect_to_vec(&ids).into(), Cow::Borrowed);
                picture.add_shadows(&self.mesh, self.casters.ray_tree(), &ids, &mut mask);
            });
        });
        frame.stage("upload", |stage| stage.upload_texture(&targets.mask, &mask))
    }

    fn counters(&self) -> Vec<(&'static str, u64)> {
        self.casters.ray_tree().counters()
    }
}
