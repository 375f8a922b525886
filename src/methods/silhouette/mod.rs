//! Silhouette shadow volumes: what the tessellation and the geometry shader variant share.
//!
//! Side quads of silhouette edges, front and back caps of all casting triangles (Milet et al. 2014,
//! section 2.2). The two variants differ in the stages that make the side quads, nothing else.

mod edges;

use super::volume_parameters::StageVolumeParameters;
use super::volumes::{self, Faces, StencilVolumes};
use super::{MethodError, MethodInfo, PrepareContext, ShadowMethod};
use crate::frame::DepthSetup;
use crate::frame::PreparedMethod;
use crate::gpu::Gpu;
use crate::gpu::native::{PrimitiveTopology, Raster};
use crate::gpu::shader::{self, Spirv};
use crate::parameters;
use edges::{EdgePatches, EdgeRecords};
use serde::{Deserialize, Serialize};
use std::fmt::Debug;

/// The stages that make side quads of edges.
pub(super) trait SideStage: Debug + Clone + 'static {
    /// The method that uses them.
    fn info() -> &'static MethodInfo;
    /// Most side quads of one edge.
    const MAX_QUADS: u32;
    /// Most opposite vertices in one input patch.
    const MAX_PATCH_OPPOSITES: u32;
    /// The primitive that holds an edge and at least so many opposite vertices, and how many it really
    /// holds.
    fn patch(opposites: u32) -> (PrimitiveTopology, u32);
    /// The primitive that holds the number of an edge.
    const NUMBER: PrimitiveTopology;
    /// All shaders after the vertex stage.
    fn shaders(defines: &[(&str, u32)]) -> Vec<Spirv>;
}

/// How an edge comes to the shaders.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum EdgeInput {
    /// As a patch of vertices, end points and opposite ones, through vertex and element buffers (Milet
    /// et al. 2014, figure 4).
    #[default]
    Patch,
    /// As its number; the shaders fetch end points and opposite vertices from storage buffers.
    Storage,
}

parameters! {
    /// The parameters of both methods.
    pub(super) struct Silhouette<S: SideStage> {
        input: EdgeInput = EdgeInput::Patch,
            "how an edge comes to the shaders: patch (its vertices), storage (its number; they fetch)";
        max_multiplicity: u32 = 32, in 1..=S::MAX_QUADS,
            format!(
                "most opposite vertices of one primitive, with input=patch at most {}; edges with more are split",
                S::MAX_PATCH_OPPOSITES
            );
        ..volume: StageVolumeParameters;
    }
}

impl<S: SideStage> ShadowMethod for Silhouette<S> {
    fn info(&self) -> &'static MethodInfo {
        S::info()
    }

    fn depth_setup(&self) -> DepthSetup {
        self.volume.depth_setup()
    }

    fn prepare(
        &self,
        context: &PrepareContext<'_>,
    ) -> Result<Box<dyn PreparedMethod>, MethodError> {
        let parameters = &self.volume;
        let most_opposites = match self.input {
            EdgeInput::Storage => self.max_multiplicity,
            EdgeInput::Patch => self.max_multiplicity.min(S::MAX_PATCH_OPPOSITES),
        };
        let mesh = &context.scene.mesh;
        let topology = context.topology();
        let edges = EdgeRecords::new(mesh, topology, most_opposites);
        let mut counters = vec![
            ("edges", topology.edges.len() as u64),
            ("edge_records", edges.edges.len() as u64),
            (
                "extra_side_quads",
                edges.extra_side_quads(
                    mesh,
                    parameters.determinism,
                    context.scene.flight.at(0.0).light.place,
                ),
            ),
        ];
        let (sides, buffers) = match self.input {
            EdgeInput::Storage => Self::sides_by_number(context, parameters, edges)?,
            EdgeInput::Patch => {
                let (topology, opposites) = S::patch(edges.most_opposites());
                let most_bytes = context.gpu.device.limits().max_buffer_size;
                let patches =
                    EdgePatches::new(&edges, opposites, most_bytes).ok_or_else(too_many_patches)?;
                counters.push(("patch_vertices", patches.vertices_per_patch.into()));
                let sides = Self::sides_by_patch(context.gpu, parameters, topology, patches)?;
                (sides, Vec::new())
            }
        };
        let faces = vec![sides, volumes::caps(context, parameters)];
        let volumes = StencilVolumes::new(context, parameters, &buffers, faces, counters)?;
        Ok(Box::new(volumes))
    }
}

impl<S: SideStage> Silhouette<S> {
    fn sides_by_number(
        context: &PrepareContext<'_>,
        parameters: &StageVolumeParameters,
        edges: EdgeRecords,
    ) -> Result<(Faces, Vec<wgpu::Buffer>), MethodError> {
        let buffer = |label, contents: &[u8]| {
            let usage = wgpu::BufferUsages::STORAGE;
            context.gpu.buffer(label, contents, usage)
        };
        let buffers = vec![
            buffer("the edges", bytemuck::cast_slice(&edges.edges))?,
            buffer(
                "the opposite vertices",
                bytemuck::cast_slice(&edges.opposites),
            )?,
        ];
        // Room for exactly what this scene can need: a larger output slows a geometry stage down.
        let defines = parameters.defines(&[("MAX_MULTIPLICITY", edges.most_opposites())]);
        let mut stages = vec![shader::glsl("methods/volumes/index.vert", &[])];
        stages.extend(S::shaders(&defines));
        let faces = Faces {
            stages,
            topology: S::NUMBER,
            indices: None,
            draws: edges.objects,
            z_fail: Raster::CountDepthFails,
            in_z_pass: true,
        };
        Ok((faces, buffers))
    }

    fn sides_by_patch(
        gpu: &Gpu,
        parameters: &StageVolumeParameters,
        topology: PrimitiveTopology,
        patches: EdgePatches,
    ) -> Result<Faces, MethodError> {
        let opposites = patches.vertices_per_patch - 2;
        let defines = parameters.defines(&[
            ("MAX_MULTIPLICITY", opposites),
            ("PATCH_OPPOSITES", opposites),
        ]);
        let mut stages = vec![shader::glsl("methods/volumes/position.vert", &[])];
        stages.extend(S::shaders(&defines));
        let contents = bytemuck::cast_slice(&patches.indices);
        let indices = gpu.buffer("the edges as patches", contents, wgpu::BufferUsages::INDEX)?;
        Ok(Faces {
            stages,
            topology,
            indices: Some(indices),
            draws: patches.objects,
            z_fail: Raster::CountDepthFails,
            in_z_pass: true,
        })
    }
}

fn too_many_patches() -> MethodError {
    let advice = "this scene's edges do not fit into one buffer as patches of vertices: use a smaller \
                  max_multiplicity, or input=storage";
    MethodError::Unavailable(advice.to_owned())
}
