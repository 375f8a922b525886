//! Silhouette shadow volumes: what the tessellation and the geometry shader variant share.
//!
//! Side quads of silhouette edges, front and back caps of all casting triangles, counted z-fail in
//! the stencil buffer (Milet et al. 2014, section 2.2). The two variants differ in the stages that
//! make the side quads, nothing else.

use super::{MethodError, PrepareContext, PreparedMethod};
use crate::frame::{Stage, StencilResolve};
use crate::geometry::{Edge, Topology};
use crate::gpu::native::{
    BindingKind, Bindings, Pipeline, PipelineDesc, PrimitiveTopology, Raster, Target,
};
use crate::gpu::shader::{self, Spirv};
use crate::gpu::{FrameRecorder, Gpu, Requirement};
use std::borrow::Cow;
use std::ops::Range;
use wgpu::util::DeviceExt;

/// Name of the stage that draws the volumes into the stencil buffer.
const VOLUMES_STAGE: &str = "volumes";

/// The stages that make side quads.
pub(super) struct SideShaders {
    /// All after the vertex stage.
    pub stages: Vec<Spirv>,
    /// What one edge is for them.
    pub topology: PrimitiveTopology,
}

/// What both variants need of the device.
pub(super) const COMMON_NEEDS: [Requirement; 2] =
    [Requirement::GeometryStage, Requirement::StencilBuffer];

/// What both variants cannot do.
pub(super) const COUNTER_LIMIT: &str =
    "counts in 8 bits: wrong where 256 or a multiple of it volumes overlap in front of a surface";

/// Silhouette volumes of one scene.
pub(super) struct SilhouetteVolumes {
    sides: Pipeline,
    caps: Pipeline,
    bindings: Bindings,
    target: Target,
    resolve: StencilResolve,
    side_draws: Vec<Range<u32>>,
    cap_draws: Vec<Range<u32>>,
}

impl SilhouetteVolumes {
    /// Uploads the edges and builds the pipelines; an edge has at most `max_multiplicity` opposite
    /// vertices when `sides` gets the largest number that there really is.
    pub(super) fn new(
        context: &PrepareContext<'_>,
        max_multiplicity: u32,
        sides: impl FnOnce(u32) -> SideShaders,
    ) -> Result<Self, MethodError> {
        let PrepareContext { gpu, stage, .. } = context;
        let topology = context.topology();
        let edges = SplitEdges::new(topology, max_multiplicity);
        let largest = edges.edges.iter().map(|edge| edge.opposite_count).max().unwrap_or(0).max(1);
        let target = Target::new(&gpu.device, &stage.targets.depth)?;
        let bindings = Bindings::new(
            &gpu.device,
            &[
                (BindingKind::Uniform, &stage.uniform.buffer),
                (BindingKind::Storage, &stage.scene.positions),
                (BindingKind::Storage, &stage.scene.indices),
                (BindingKind::Storage, &storage(gpu, "edges", bytemuck::cast_slice(&edges.edges))),
                (
                    BindingKind::Storage,
                    &storage(gpu, "opposites", bytemuck::cast_slice(&topology.opposites)),
                ),
            ],
        )?;
        let shaders = sides(largest);
        // Front caps lie on the far plane: every caster is in the depth buffer, so its front cap
        // is never in front of what is visible and always fails the depth test. In place, it
        // would compete with its own surface in the last bit of depth. Clipping happens before, so
        // what the near plane cuts off is not counted. Back caps are on the far plane anyway.
        let caps_range = [0.0, 0.0];
        let caps = SideShaders {
            stages: vec![shader::glsl("methods/silhouette/caps.geom", &[])],
            topology: PrimitiveTopology::Points,
        };
        let pipeline = |shaders: SideShaders, depth_range| {
            let mut stages = vec![shader::glsl("methods/silhouette/index.vert", &[])];
            stages.extend(shaders.stages);
            let desc = PipelineDesc {
                stages: &stages,
                topology: shaders.topology,
                raster: Raster::CountDepthFails { depth_range },
            };
            Pipeline::new(&gpu.device, &target, &bindings, &desc)
        };
        Ok(Self {
            sides: pipeline(shaders, [0.0, 1.0])?,
            caps: pipeline(caps, caps_range)?,
            resolve: StencilResolve::new(gpu),
            bindings,
            target,
            side_draws: edges.objects,
            cap_draws: stage.scene.casters.clone(),
        })
    }
}

impl PreparedMethod for SilhouetteVolumes {
    fn record(&self, frame: &mut FrameRecorder<'_>, stage: &Stage) {
        frame.native_stage(VOLUMES_STAGE, &self.target, &self.bindings, |pass| {
            for (pipeline, draws) in
                [(&self.sides, &self.side_draws), (&self.caps, &self.cap_draws)]
            {
                pass.set_pipeline(pipeline);
                for draw in draws {
                    pass.draw(draw.clone());
                }
            }
        });
        self.resolve.record(frame, &stage.targets);
    }
}

/// A storage buffer; Vulkan has no empty ones, so an empty scene gets a few bytes nobody reads.
fn storage(gpu: &Gpu, label: &str, contents: &[u8]) -> wgpu::Buffer {
    gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: Some(label),
        contents: if contents.is_empty() { &[0; 16] } else { contents },
        usage: wgpu::BufferUsages::STORAGE,
    })
}

/// Edges with at most so many opposite vertices: one with more is split into several with the same
/// end points. Multiplicities add up, so the shadow stays the same.
struct SplitEdges<'a> {
    edges: Cow<'a, [Edge]>,
    objects: Vec<Range<u32>>,
}

impl<'a> SplitEdges<'a> {
    fn new(topology: &'a Topology, max_opposites: u32) -> Self {
        if topology.edges.iter().all(|edge| edge.opposite_count <= max_opposites) {
            let objects = topology.object_edges.clone();
            return Self { edges: Cow::Borrowed(&topology.edges), objects };
        }
        let mut edges = Vec::with_capacity(topology.edges.len() + 1);
        let mut objects = Vec::with_capacity(topology.object_edges.len());
        for range in &topology.object_edges {
            let start = edges.len() as u32;
            for edge in &topology.edges[range.start as usize..range.end as usize] {
                let end = edge.first_opposite + edge.opposite_count;
                edges.extend((edge.first_opposite..end).step_by(max_opposites as usize).map(
                    |first| Edge {
                        first_opposite: first,
                        opposite_count: max_opposites.min(end - first),
                        ..*edge
                    },
                ));
            }
            objects.push(start..edges.len() as u32);
        }
        Self { edges: Cow::Owned(edges), objects }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn splitting_keeps_every_opposite_vertex_once() {
        let edge = |first_opposite, opposite_count| Edge { a: 0, b: 1, first_opposite, opposite_count };
        let topology = Topology {
            edges: vec![edge(0, 2), edge(2, 7), edge(9, 1)],
            opposites: (0..10).collect(),
            object_edges: vec![0..2, 2..2, 2..3],
        };
        let split = SplitEdges::new(&topology, 3);
        let parts: Vec<_> =
            split.edges.iter().map(|e| (e.first_opposite, e.opposite_count)).collect();
        assert_eq!(parts, [(0, 2), (2, 3), (5, 3), (8, 1), (9, 1)]);
        assert_eq!(split.objects, [0..4, 4..4, 4..5]);
        assert!(matches!(SplitEdges::new(&topology, 7).edges, Cow::Borrowed(_)));
    }
}
