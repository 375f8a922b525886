//! Shadow rays through the device's own acceleration structure, a pixel each: what hardware for ray tracing does.

use super::{Bound, Limit, MethodError, MethodInfo, PrepareContext, ShadowMethod, ray_limits};
use crate::frame::{Frame, PixelCompute, PixelKernel, PreparedMethod, read};
use crate::geometry::rays::{boxes, casters};
use crate::gpu::{Capability, acceleration};
use crate::metrics::Label;
use obvhs::aabb::Aabb;
use serde::{Deserialize, Serialize};
use std::time::Instant;

/// What the method is.
pub(super) static INFO: MethodInfo = MethodInfo {
    id: "ray_query",
    title: "shadow rays by the device's ray queries",
    source: "Whitted 1980; Vulkan's ray queries",
    needs: &[Capability::RayQuery],
    limits: &[
        ray_limits::LIMITS,
        &[Limit {
            text: "the device's arithmetic starts from points that are rounded: single pixels are wrong where the light \
               grazes a surface",
            with: &[],
            unless: &[("primitives", "boxes")],
            fails: &[("translation", 5.0)],
            kinds: &[Label::Grazing, Label::Seam, Label::Unlabelled],
            at_most: Bound::Px(5),
        }],
    ],
    clashes: &[],
    tolerated_share: 0.0,
};

/// What the device's structure holds.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Primitives {
    /// Triangles: the device finds which of them a ray meets.
    #[default]
    Triangles,
    /// A box around each: the device finds which boxes a ray meets, and the shader which triangles.
    Boxes,
}

/// The device finds what a ray meets by an arithmetic of its own, watertight where neighbours meet, from a point that is
/// rounded. So much of its distance from a triangle may a point lie beside it and still be within, for the shader: more
/// would let convex neighbours shadow each other, and less would lose what the device alone has met.
const SLACK: f64 = 1.0 / (1 << 22) as f64;

crate::parameters! {
    /// The method with its parameters.
    pub(super) struct RayQuery {
        primitives: Primitives = Primitives::default(), "what the device finds that a ray meets: triangles, or boxes around them";
    }
}

impl ShadowMethod for RayQuery {
    fn info(&self) -> &'static MethodInfo {
        &INFO
    }

    fn prepare(
        &self,
        context: &PrepareContext<'_>,
    ) -> Result<Box<dyn PreparedMethod>, MethodError> {
        Ok(Box::new(Prepared::new(context, self.primitives)?))
    }
}

/// The rays of one scene.
struct Prepared {
    /// `None` where nothing casts: a structure cannot be empty.
    rays: Option<PixelCompute>,
    build_us: u64,
}

impl Prepared {
    fn new(context: &PrepareContext<'_>, primitives: Primitives) -> Result<Self, MethodError> {
        let PrepareContext { gpu, resources, .. } = *context;
        let mesh = &context.scene.mesh;
        let triangles = casters(mesh);
        if triangles.is_empty() {
            return Ok(Self {
                rays: None,
                build_us: 0,
            });
        }
        let begin = Instant::now();
        let count = triangles.len() as u32;
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::BLAS_INPUT;
        let corners = bytemuck::cast_slice(&triangles);
        let casters = gpu.buffer("the triangles that cast", corners, usage)?;
        let (structure, slack) = match primitives {
            Primitives::Triangles => (acceleration::of_triangles(gpu, &casters, count)?, SLACK),
            Primitives::Boxes => {
                let ends = |of: &Aabb| [of.min.to_array(), of.max.to_array()];
                let boxes: Vec<_> = boxes(mesh, &triangles).iter().map(ends).collect();
                let boxes = bytemuck::cast_slice(&boxes);
                let boxes = gpu.buffer("boxes", boxes, wgpu::BufferUsages::BLAS_INPUT)?;
                (acceleration::of_boxes(gpu, &boxes, count)?, 0.0)
            }
        };
        let build_us = begin.elapsed().as_micros() as u64;
        let scene = &resources.scene;
        let of_structure = wgpu::BindingType::AccelerationStructure {
            vertex_return: false,
        };
        let kernel = PixelKernel {
            path: "methods/ray_query/trace.wgsl",
            constants: &[("slack", slack)],
            inputs: &[
                read(&scene.positions),
                read(&scene.indices),
                read(&casters),
                (of_structure, structure.as_binding()),
            ],
        };
        Ok(Self {
            rays: Some(PixelCompute::new(gpu, resources, &kernel)),
            build_us,
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
        vec![("acceleration_structure_us", self.build_us)]
    }
}
