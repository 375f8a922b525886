//! Shadow rays in a compute shader, a pixel each, through a tree with four boxes a node: for devices without ray queries.

use super::{Limit, MethodError, MethodInfo, PrepareContext, ShadowMethod, ray_limits};
use crate::frame::{Frame, PixelCompute, PixelKernel, PreparedMethod, read};
use crate::geometry::rays::RayTree;
use std::rc::Rc;

/// What the method is.
pub(super) static INFO: MethodInfo = MethodInfo {
    id: "ray_compute",
    title: "shadow rays in a compute shader",
    source: "any-hit traversal of a wide hierarchy, Wald, Benthin and Boulos 2008",
    needs: &[],
    limits: &[
        ray_limits::LIMITS,
        &[Limit::in_words(
            "boxes nested in each other twenty deep and more, at which a tree needs more room than the shader has: unavailable",
        )],
    ],
    clashes: &[],
    tolerated_share: 0.0,
};

/// How many nodes may wait in the shader; trees of a million triangles need some thirty.
const STACK: usize = 64;

crate::parameters! {
    /// The method with its parameters.
    pub(super) struct RayCompute {}
}

impl ShadowMethod for RayCompute {
    fn info(&self) -> &'static MethodInfo {
        &INFO
    }

    fn prepare(
        &self,
        context: &PrepareContext<'_>,
    ) -> Result<Box<dyn PreparedMethod>, MethodError> {
        Ok(Box::new(Prepared::new(context)?))
    }
}

/// The rays of one scene.
struct Prepared {
    tree: Rc<RayTree>,
    /// `None` where nothing casts: a buffer has an element at least.
    rays: Option<PixelCompute>,
}

impl Prepared {
    fn new(context: &PrepareContext<'_>) -> Result<Self, MethodError> {
        let PrepareContext { gpu, resources, .. } = *context;
        let tree = Rc::clone(context.casters.ray_tree());
        if tree.stack > STACK {
            let reason = "its boxes are nested too deeply to be followed in a shader";
            return Err(MethodError::Unavailable(reason.to_owned()));
        }
        if tree.triangles.is_empty() {
            return Ok(Self { tree, rays: None });
        }
        let buffer = |label, bytes| gpu.buffer(label, bytes, wgpu::BufferUsages::STORAGE);
        let nodes = buffer("a tree of boxes", bytemuck::cast_slice(&tree.nodes))?;
        let triangles = buffer("its triangles", bytemuck::cast_slice(&tree.triangles))?;
        let scene = &resources.scene;
        let kernel = PixelKernel {
            path: "methods/ray_compute/trace.wgsl",
            constants: &[],
            inputs: &[&scene.positions, &scene.indices, &nodes, &triangles].map(read),
        };
        Ok(Self {
            rays: Some(PixelCompute::new(gpu, resources, &kernel)),
            tree,
        })
    }
}

impl PreparedMethod for Prepared {
    fn record(&mut self, frame: &mut Frame<'_>) -> anyhow::Result<()> {
        let resources = frame.resources();
        if let Some(rays) = &self.rays {
            frame.stage("rays", |stage| rays.record(stage, resources));
        }
        Ok(())
    }

    fn counters(&self) -> Vec<(&'static str, u64)> {
        self.tree.counters()
    }
}
