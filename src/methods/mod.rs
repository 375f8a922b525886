//! The shadow methods. Each is one file here, a folder of shaders, and one line in `registry.rs`.
//!
//! A method gets the G-buffer and the view and leaves the shadow mask; all else happens outside.
//! A [`ShadowMethod`] is a method with its parameters, as a configuration names it; a
//! [`PreparedMethod`] is that method made ready for one scene on one device.

mod adjacency_gs;
mod alias_free_map;
mod capping;
mod casters;
mod clash;
mod corner;
mod counter;
mod cube_shadow_map;
mod declare;
mod depth_map;
mod device_edges;
mod domain;
mod edge_records;
mod faces;
mod frustum;
mod light_depth;
mod limit;
mod occlusion;
mod occlusion_gpu;
mod parameters;
mod parts;
mod plan;
mod plan_words;
mod portable_volumes;
mod ray_compute;
mod ray_cpu;
mod ray_limits;
mod ray_query;
mod registry;
mod shadow_map;
mod side_quad;
mod silhouette;
mod silhouette_cpu;
mod silhouette_cs;
mod silhouette_gs;
mod silhouette_ms;
mod silhouette_ts;
mod silhouette_vs;
mod triangle_frusta;
mod triangle_gs;
mod triangle_ts;
mod view_samples;
mod volume_limits;
mod volume_parameters;
mod volumes;

pub use casters::Casters;
pub use clash::{Clash, Effect};
pub use domain::Domain;
pub use limit::{Bound, Limit};
pub use parameters::{
    Parameter, ParameterError, ParameterValue, Parameters, read as read_parameter,
};
pub use registry::{Registration, Registry};

use crate::frame::{DepthSetup, FrameResources, PreparedMethod};
use crate::gpu::{Capability, DeviceError, Gpu};
use crate::scene::Scene;
use crate::variant::Variant;
use serde::Serialize;
use std::rc::Rc;
use std::sync::Arc;

/// What a method is, needs and cannot do; printed by `svbench list methods`.
#[derive(Debug, Clone, Serialize)]
pub struct MethodInfo {
    /// Its id in configurations and results.
    pub id: &'static str,
    /// One line for people.
    pub title: &'static str,
    /// Where it comes from.
    pub source: &'static str,
    /// What it needs of the device.
    pub needs: &'static [Capability],
    /// What it cannot do or gets wrong, by design: what it shares with others, and its own.
    #[serde(serialize_with = "in_one_list")]
    pub limits: &'static [&'static [Limit]],
    /// Which of its parameters do not go together.
    #[serde(skip)]
    pub clashes: &'static [Clash],
    /// The part of a picture that may be wrong away from true edges before that is a failure: 0 for a method
    /// that is exact to the pixel.
    pub tolerated_share: f64,
}

fn in_one_list<T: Serialize, S: serde::Serializer>(
    groups: &&'static [&'static [T]],
    serializer: S,
) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(groups.iter().copied().flatten())
}

impl MethodInfo {
    /// Whether `gpu` has what it needs with any parameters.
    ///
    /// # Errors
    /// The reason why not, as a sentence for people.
    pub fn check(&self, gpu: &Gpu) -> Result<(), String> {
        self.needs
            .iter()
            .try_for_each(|capability| gpu.check(*capability))
    }
}

/// Why a method cannot run on a scene.
#[derive(Debug, thiserror::Error)]
pub enum MethodError {
    /// The device or the scene lacks what the method needs.
    #[error("{0}")]
    Unavailable(String),
    /// A parameter is out of what this device can do.
    #[error("{0}")]
    Parameter(String),
    /// The driver refused.
    #[error(transparent)]
    Native(#[from] crate::gpu::native::NativeError),
    /// The device lacks what the method needs, or is lost.
    #[error(transparent)]
    Device(#[from] DeviceError),
}

/// Makes `method` ready for a scene. The device meets [`MethodInfo::needs`].
///
/// # Errors
/// When it cannot run on this scene or device.
pub fn prepare(
    method: &dyn ShadowMethod,
    context: &PrepareContext<'_>,
) -> Result<Box<dyn PreparedMethod>, MethodError> {
    context.gpu.attempt(|| method.prepare(context))
}

/// What a method is prepared with: the scene, the shared stages, and what casts.
#[derive(Clone)]
pub struct PrepareContext<'a> {
    /// The device.
    pub gpu: &'a Gpu,
    /// The scene as data.
    pub scene: &'a Scene,
    /// The scene on the device, targets and view.
    pub resources: &'a FrameResources,
    /// What casts its shadows.
    pub casters: Rc<Casters>,
}

impl<'a> PrepareContext<'a> {
    /// For the methods of one scene.
    pub fn new(gpu: &'a Gpu, scene: &'a Scene, resources: &'a FrameResources) -> Self {
        Self::sharing(gpu, scene, resources, &Rc::new(Casters::of(scene)))
    }

    /// For the methods of one scene; what they derive from its casters somebody else keeps.
    pub fn sharing(
        gpu: &'a Gpu,
        scene: &'a Scene,
        resources: &'a FrameResources,
        casters: &Rc<Casters>,
    ) -> Self {
        Self {
            gpu,
            scene,
            resources,
            casters: Rc::clone(casters),
        }
    }

    /// For a method that needs no more of the casters than those that may be lit in part.
    ///
    /// # Errors
    /// When the light does not stand still.
    fn without_occluded(&self) -> Result<Self, MethodError> {
        let casters = self.casters.unoccluded().ok_or_else(light_moves)?;
        let Self {
            gpu,
            scene,
            resources,
            ..
        } = *self;
        Ok(Self::sharing(gpu, scene, resources, &casters))
    }

    /// The corners of the triangles that cast, on the device.
    fn indices(&self) -> Result<wgpu::Buffer, DeviceError> {
        if Arc::ptr_eq(&self.casters.mesh, &self.scene.mesh) {
            return Ok(self.resources.scene.indices.clone());
        }
        let mut corners = self.casters.mesh.triangles.clone();
        // A buffer cannot be empty.
        corners.resize(corners.len().max(1), [0; 3]);
        let usage = wgpu::BufferUsages::INDEX | wgpu::BufferUsages::STORAGE;
        let contents = bytemuck::cast_slice(&corners);
        self.gpu.buffer("the triangles that cast", contents, usage)
    }
}

fn light_moves() -> MethodError {
    let advice = "occluded=left_out needs a light that stands still, and this scene's moves: set occluded=cast";
    MethodError::Unavailable(advice.to_owned())
}

/// Gives the same method with a slope bias in texels.
pub type WithBias<'a> = Box<dyn Fn(f64) -> Box<dyn ShadowMethod> + 'a>;

/// A shadow map whose slope bias is to be found.
pub struct BiasSearch<'a> {
    /// Side of the map in texels.
    pub resolution: u32,
    /// Gives the map with a bias.
    pub with_bias: WithBias<'a>,
}

/// A method with its parameters.
pub trait ShadowMethod: Parameters {
    /// What it is.
    fn info(&self) -> &'static MethodInfo;

    /// The parameters that differ from their defaults.
    fn variant(&self) -> Variant {
        parameters::difference(self.parameters())
    }

    /// Id and variant as they are written on the command line: `id,name=value`.
    fn name(&self) -> String {
        self.variant().full_name(self.info().id)
    }

    /// The depth buffer that its frames are to be drawn with.
    fn depth_setup(&self) -> DepthSetup {
        DepthSetup::default()
    }

    /// How to try biases, for a method whose parameters ask for the smallest one without acne.
    fn bias_search(&self) -> Option<BiasSearch<'_>> {
        None
    }

    /// Makes it ready for a scene, for [`prepare`](prepare()), which also hears what the device has against it.
    ///
    /// # Errors
    /// When it cannot run on this scene or device.
    fn prepare(&self, context: &PrepareContext<'_>)
    -> Result<Box<dyn PreparedMethod>, MethodError>;
}
