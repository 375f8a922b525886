//! Silhouette shadow volumes: what the tessellation and the geometry shader variant share.
//!
//! Side quads of silhouette edges, front and back caps of all casting triangles, counted z-fail in
//! the stencil buffer (Milet et al. 2014, section 2.2). The two variants differ in the stages that
//! make the side quads, nothing else.

use super::{MethodError, PrepareContext, PreparedMethod};
use crate::frame::{Stage, StencilResolve};
use crate::geometry::{Edge, Topology, vertex_less};
use crate::gpu::native::{
    BindingKind, Bindings, Pipeline, PipelineDesc, PrimitiveTopology, Raster, Target,
};
use crate::gpu::shader::{self, Spirv};
use crate::gpu::{FrameRecorder, Gpu, Requirement};
use glam::Vec3;
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
        let positions = &context.scene.mesh.positions;
        let edges = EdgeRecords::new(positions, topology, max_multiplicity);
        let largest = edges
            .edges
            .iter()
            .map(|edge| edge.opposite_count)
            .max()
            .unwrap_or(0)
            .max(1);
        let target = Target::new(&gpu.device, &stage.targets.depth)?;
        let bindings = Bindings::new(
            &gpu.device,
            &[
                (BindingKind::Uniform, &stage.uniform.buffer),
                (BindingKind::Storage, &stage.scene.positions),
                (BindingKind::Storage, &stage.scene.indices),
                (
                    BindingKind::Storage,
                    &storage(gpu, "edges", bytemuck::cast_slice(&edges.edges)),
                ),
                (
                    BindingKind::Storage,
                    &storage(gpu, "opposites", bytemuck::cast_slice(&topology.opposites)),
                ),
            ],
        )?;
        let shaders = sides(largest);
        let caps = SideShaders {
            stages: vec![shader::glsl("methods/silhouette/caps.geom", &[])],
            topology: PrimitiveTopology::Points,
        };
        let pipeline = |shaders: SideShaders, raster| {
            let mut stages = vec![shader::glsl("methods/silhouette/index.vert", &[])];
            stages.extend(shaders.stages);
            let desc = PipelineDesc {
                stages: &stages,
                topology: shaders.topology,
                raster,
            };
            Pipeline::new(&gpu.device, &target, &bindings, &desc)
        };
        Ok(Self {
            sides: pipeline(shaders, Raster::CountDepthFails)?,
            // Every caster is in the depth buffer, so its front cap is never in front of what is
            // visible and fails every depth test; tested, it would compete with its own surface in
            // the last bit of depth. What the near plane cuts off is clipped and does not count. The
            // back cap is at infinity, behind everything.
            caps: pipeline(caps, Raster::CountAll)?,
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
            for (pipeline, draws) in [
                (&self.sides, &self.side_draws),
                (&self.caps, &self.cap_draws),
            ] {
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
    gpu.device
        .create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some(label),
            contents: if contents.is_empty() {
                &[0; 16]
            } else {
                contents
            },
            usage: wgpu::BufferUsages::STORAGE,
        })
}

/// Edges as the shaders take them: end points in the vertex order, and at most so many opposite
/// vertices. An edge with more is split into several with the same end points; multiplicities add
/// up, so the shadow stays the same.
struct EdgeRecords {
    edges: Vec<Edge>,
    objects: Vec<Range<u32>>,
}

impl EdgeRecords {
    fn new(positions: &[Vec3], topology: &Topology, max_opposites: u32) -> Self {
        let part_count = |edge: &Edge| edge.opposite_count.div_ceil(max_opposites);
        let mut edges = Vec::with_capacity(topology.edges.len());
        let mut objects = Vec::with_capacity(topology.object_edges.len());
        for range in &topology.object_edges {
            let start = edges.len() as u32;
            for edge in &topology.edges[range.start as usize..range.end as usize] {
                let edge = in_vertex_order(positions, *edge);
                let end = edge.first_opposite + edge.opposite_count;
                edges.extend((0..part_count(&edge)).map(|part| {
                    let first_opposite = edge.first_opposite + part * max_opposites;
                    let opposite_count = max_opposites.min(end - first_opposite);
                    Edge {
                        first_opposite,
                        opposite_count,
                        ..edge
                    }
                }));
            }
            objects.push(start..edges.len() as u32);
        }
        Self { edges, objects }
    }
}

fn in_vertex_order(positions: &[Vec3], edge: Edge) -> Edge {
    if vertex_less(positions[edge.b as usize], positions[edge.a as usize]) {
        Edge {
            a: edge.b,
            b: edge.a,
            ..edge
        }
    } else {
        edge
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn splitting_keeps_every_opposite_vertex_once() {
        let edge = |first_opposite, opposite_count| Edge {
            a: 0,
            b: 1,
            first_opposite,
            opposite_count,
        };
        let topology = Topology {
            edges: vec![edge(0, 2), edge(2, 7), edge(9, 1)],
            opposites: (0..10).collect(),
            object_edges: vec![0..2, 2..2, 2..3],
        };
        let records = EdgeRecords::new(&[Vec3::ZERO, Vec3::X], &topology, 3);
        let parts: Vec<_> = records
            .edges
            .iter()
            .map(|e| (e.first_opposite, e.opposite_count))
            .collect();
        assert_eq!(parts, [(0, 2), (2, 3), (5, 3), (8, 1), (9, 1)]);
        assert_eq!(records.objects, [0..4, 4..4, 4..5]);
    }

    #[test]
    fn end_points_come_in_the_vertex_order() {
        let topology = Topology {
            edges: vec![Edge {
                a: 0,
                b: 1,
                first_opposite: 0,
                opposite_count: 1,
            }],
            opposites: vec![0],
            object_edges: std::iter::once(0..1).collect(),
        };
        let ends = |positions: [Vec3; 2]| {
            let edge = EdgeRecords::new(&positions, &topology, 8).edges[0];
            (edge.a, edge.b)
        };
        assert_eq!(ends([Vec3::ZERO, Vec3::X]), (0, 1));
        assert_eq!(ends([Vec3::X, Vec3::ZERO]), (1, 0));
    }
}
