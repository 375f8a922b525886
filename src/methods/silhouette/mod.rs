//! Silhouette shadow volumes: what the tessellation and the geometry shader variant share.
//!
//! Side quads of silhouette edges, front and back caps of all casting triangles (Milet et al. 2014,
//! section 2.2). The two variants differ in the stages that make the side quads, nothing else.

mod near_silhouette;

use super::edge_records::{EdgePatches, EdgeRecords};
use super::faces::{self, Draws, Elements, Faces, Fragments};
use super::volume_parameters::{Plan, StageVolumeParameters, refuse_both};
use super::volumes::StencilVolumes;
use super::{MethodError, MethodInfo, PrepareContext, ShadowMethod};
use crate::frame::{DepthSetup, PreparedMethod, SceneBuffers};
use crate::geometry::{Casting, EdgeTriangles};
use crate::gpu::native::{PrimitiveTopology, Raster, VertexInput};
use crate::gpu::shader::{self, Spirv};
use crate::parameters;
use near_silhouette::{EdgeElements, NearSilhouette};
use serde::{Deserialize, Serialize};
use std::fmt::Debug;
use std::marker::PhantomData;

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

/// Which edges are asked for their multiplicity.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Edges {
    /// All.
    #[default]
    All,
    /// Those that the groups of a tree over the planes of their triangles leave, see
    /// [`crate::geometry::silhouette::PlaneTree`].
    NearSilhouette,
}

parameters! {
    /// The parameters of both methods.
    pub(super) struct Silhouette<S: SideStage> {
        input: EdgeInput = EdgeInput::Patch,
            "how an edge comes to the shaders: patch (its vertices), storage (its number; they fetch)";
        edges: Edges = Edges::All,
            "which edges are asked: all; near_silhouette (of groups with triangles on both sides of the light)";
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
        let parameters = &self.volume.planned(&context.scene.flight.light)?;
        let context = &parameters.casters(context)?;
        let most_opposites = match self.input {
            EdgeInput::Storage => self.max_multiplicity,
            EdgeInput::Patch => self.max_multiplicity.min(S::MAX_PATCH_OPPOSITES),
        };
        let mesh = &context.casters.mesh;
        let topology = context.casters.topology();
        let triangles = match parameters.casting {
            Casting::LightFacing | Casting::EachSide => Some(&**context.casters.edge_triangles()),
            Casting::All => None,
        };
        let edges = EdgeRecords::new(mesh, topology, triangles, most_opposites);
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
        let sides = Sides {
            context,
            parameters,
            edges,
            triangles,
            chosen: self.edges()? == Edges::NearSilhouette,
            stage: PhantomData::<S>,
        };
        let (sides, buffers) = match self.input {
            EdgeInput::Storage => sides.by_number()?,
            EdgeInput::Patch => {
                let (sides, vertices_per_patch) = sides.by_patch()?;
                counters.push(("patch_vertices", vertices_per_patch.into()));
                (sides, Vec::new())
            }
        };
        let faces = vec![sides, faces::caps(context, parameters)];
        let volumes = StencilVolumes::new(context, parameters, &buffers, faces, counters)?;
        Ok(Box::new(volumes))
    }
}

impl<S: SideStage> Silhouette<S> {
    /// Which edges are asked, as planned.
    fn edges(&self) -> Result<Edges, MethodError> {
        if self.volume.plan == Plan::Auto {
            refuse_both("edges", self.edges != Edges::All)?;
            return Ok(Edges::NearSilhouette);
        }
        Ok(self.edges)
    }
}

/// What side quads are made of.
struct Sides<'a, S> {
    context: &'a PrepareContext<'a>,
    parameters: &'a StageVolumeParameters,
    edges: EdgeRecords,
    /// Where not all triangles cast.
    triangles: Option<&'a EdgeTriangles>,
    /// Whether the edges of a frame are chosen on the processor.
    chosen: bool,
    stage: PhantomData<S>,
}

impl<S: SideStage> Sides<'_, S> {
    fn by_number(self) -> Result<(Faces, Vec<wgpu::Buffer>), MethodError> {
        let buffer = |label, contents: &[u8]| {
            let usage = wgpu::BufferUsages::STORAGE;
            self.context.gpu.buffer(label, contents, usage)
        };
        let edges = &self.edges;
        let buffers = vec![
            buffer("the edges", bytemuck::cast_slice(&edges.edges))?,
            buffer(
                "the opposite vertices",
                bytemuck::cast_slice(&edges.opposites),
            )?,
        ];
        // Room for exactly what this scene can need: a larger output slows a geometry stage down.
        let defines = self
            .parameters
            .defines_of_sides(&[("MAX_MULTIPLICITY", edges.most_opposites())]);
        let mut stages = vec![shader::glsl("methods/volumes/index.vert", &[])];
        stages.extend(S::shaders(&defines));
        let (elements, draws) = if self.chosen {
            let (indices, draws) = self.chosen(EdgeElements::Number)?;
            (Elements::Indices(indices), draws)
        } else {
            (Elements::Vertices, Draws::All(self.edges.objects))
        };
        let faces = Faces {
            stages,
            fragments: Fragments::CountWeights,
            input: VertexInput::Numbers,
            topology: S::NUMBER,
            elements,
            draws,
            z_fail: Raster::CountDepthFails,
            in_z_pass: true,
        };
        Ok((faces, buffers))
    }

    /// Gives also how many vertices a patch has.
    fn by_patch(self) -> Result<(Faces, u32), MethodError> {
        let (topology, opposites) = S::patch(self.edges.most_opposites());
        let gpu = self.context.gpu;
        let most_bytes = gpu.device.limits().max_buffer_size;
        let patches =
            EdgePatches::new(&self.edges, opposites, most_bytes).ok_or_else(too_many_patches)?;
        let defines = self.parameters.defines_of_sides(&[
            ("MAX_MULTIPLICITY", opposites),
            ("PATCH_OPPOSITES", opposites),
        ]);
        let mut stages = vec![shader::glsl("methods/volumes/position.vert", &[])];
        stages.extend(S::shaders(&defines));
        let vertices_per_patch = patches.vertices_per_patch;
        let (indices, draws) = if self.chosen {
            self.chosen(EdgeElements::Patches(vertices_per_patch, patches.indices))?
        } else {
            let contents = bytemuck::cast_slice(&patches.indices);
            let usage = wgpu::BufferUsages::INDEX;
            let indices = gpu.buffer("the edges as patches", contents, usage)?;
            (indices, Draws::All(patches.objects))
        };
        let faces = Faces {
            stages,
            fragments: Fragments::CountWeights,
            input: SceneBuffers::NATIVE_INPUT,
            topology,
            elements: Elements::Indices(indices),
            draws,
            z_fail: Raster::CountDepthFails,
            in_z_pass: true,
        };
        Ok((faces, vertices_per_patch))
    }

    fn chosen(&self, elements: EdgeElements) -> Result<(wgpu::Buffer, Draws), MethodError> {
        let PrepareContext { gpu, casters, .. } = self.context;
        let of = (&*casters.mesh, &**casters.topology(), self.triangles);
        let chosen = NearSilhouette::new(gpu, of, &self.edges, elements)?;
        let buffer = chosen.buffer().clone();
        Ok((buffer, Draws::Chosen(Box::new(chosen))))
    }
}

fn too_many_patches() -> MethodError {
    let advice = "this scene's edges do not fit into one buffer as patches of vertices: use a smaller \
                  max_multiplicity, or input=storage";
    MethodError::Unavailable(advice.to_owned())
}
