//! Silhouette shadow volumes by task and mesh shaders: a task asks a cluster of edges, and has side quads made of those on the
//! silhouette.

use super::clash;
use super::device_edges;
use super::edge_records::EdgeRecords;
use super::faces::{ChooseDraws, Draws, Elements, Faces, Fragments, SELECT_STAGE};
use super::volume_limits;
use super::volume_parameters::StageVolumeParameters;
use super::volumes::{STENCIL, StencilVolumes};
use super::{MethodError, MethodInfo, PrepareContext, ShadowMethod};
use crate::frame::{DepthSetup, Frame, PreparedMethod};
use crate::geometry::Casting;
use crate::geometry::open_edges::is_irregular;
use crate::geometry::silhouette::{ClusterLight, EdgeClusters};
use crate::gpu::Capability;
use crate::gpu::native::{PrimitiveTopology, Raster, VertexInput};
use crate::gpu::shader;
use crate::parameters;
use std::ops::Range;
use wgpu::BufferUsages as Usage;

/// What the method is.
pub(super) static INFO: MethodInfo = MethodInfo {
    id: "silhouette_ms",
    title: "silhouette shadow volumes by task and mesh shaders",
    source: "left to future work in Milet et al. 2014; clusters after Wallner 2006, section 2.1",
    needs: &[Capability::MeshStage, STENCIL],
    limits: &[volume_limits::LIMITS, volume_limits::STAGE_LIMITS],
    clashes: clash::OF_VOLUMES,
    tolerated_share: 0.0,
};

/// Triangles of a workgroup. Twin of `TRIANGLES` in caps.mesh.
const TRIANGLES: u32 = 32;

/// Every device lets a task have so many invocations.
const MOST_EDGES: u32 = 128;

parameters! {
    /// The method's parameters.
    pub(super) struct SilhouetteMs {
        edges_per_task: u32 = MOST_EDGES, in 1..=MOST_EDGES,
            "how many edges a task asks: a cluster";
        ..volume: StageVolumeParameters;
    }
}

impl ShadowMethod for SilhouetteMs {
    fn info(&self) -> &'static MethodInfo {
        &INFO
    }

    fn depth_setup(&self) -> DepthSetup {
        self.volume.depth_setup()
    }

    fn prepare(
        &self,
        context: &PrepareContext<'_>,
    ) -> Result<Box<dyn PreparedMethod>, MethodError> {
        let parameters = &self.volume.planned(&context.scene.flight.light)?;
        parameters.refuse_draws_by_object()?;
        let context = &parameters.casters(context)?;
        let casters = &context.casters;
        let topology = casters.topology();
        device_edges::check(topology, casters.mesh.caster_object_count())?;
        let triangles = match parameters.casting {
            Casting::LightFacing | Casting::EachSide => Some(&**casters.edge_triangles()),
            Casting::All => None,
        };
        // No edge is split, so records have the numbers of their edges.
        let edges = EdgeRecords::new(&casters.mesh, topology, triangles, u32::MAX);
        assert_eq!(edges.edges.len(), topology.edges.len());
        let clusters = clusters(context, &edges.objects, self.edges_per_task);
        let counters = vec![
            ("edges", topology.edges.len() as u64),
            ("clusters", clusters.boxes.len() as u64),
        ];
        let (choose, buffers) = bound(context, &edges, clusters)?;
        let faces = vec![self.sides(parameters, choose), caps(context, parameters)];
        let volumes = StencilVolumes::new(context, parameters, &buffers, faces, counters)?;
        Ok(Box::new(volumes))
    }
}

impl SilhouetteMs {
    fn sides(&self, parameters: &StageVolumeParameters, tasks: TasksOfLight) -> Faces {
        let defines = parameters.defines_of_sides(&[("EDGES", self.edges_per_task)]);
        let shader = |path| shader::glsl(path, &defines);
        Faces {
            stages: vec![
                shader("methods/silhouette_ms/sides.task"),
                shader("methods/silhouette_ms/sides.mesh"),
            ],
            fragments: Fragments::CountWeights,
            input: VertexInput::Numbers,
            topology: PrimitiveTopology::Meshes,
            elements: Elements::Workgroups(1),
            draws: Draws::Chosen(Box::new(tasks)),
            z_fail: Raster::CountDepthFails,
            in_z_pass: true,
        }
    }
}

/// Those of each object that casts, given their edges, and so many of them each.
fn clusters(
    context: &PrepareContext<'_>,
    objects: &[Range<u32>],
    edges_per_task: u32,
) -> EdgeClusters {
    let casters = &context.casters;
    let (topology, triangles) = (casters.topology(), casters.edge_triangles());
    // Triangles that face the light may have such an edge on their silhouette where all together have not.
    let is_irregular = |edge: u32| is_irregular(triangles.of(topology.edges[edge as usize]));
    EdgeClusters::build(
        &casters.mesh,
        topology,
        objects,
        edges_per_task as usize,
        is_irregular,
    )
}

/// Buffers at bindings 3 and on, and what brings the light to them.
fn bound(
    context: &PrepareContext<'_>,
    edges: &EdgeRecords,
    clusters: EdgeClusters,
) -> Result<(TasksOfLight, Vec<wgpu::Buffer>), MethodError> {
    let gpu = context.gpu;
    let buffer = |what, contents: &[u8]| gpu.buffer(what, contents, Usage::STORAGE);
    let light = gpu.empty_buffer(
        "the light of clusters",
        size_of::<ClusterLight>() as u64,
        Usage::STORAGE | Usage::COPY_DST,
    )?;
    let buffers = vec![
        buffer("the edges", bytemuck::cast_slice(&edges.edges))?,
        buffer(
            "the opposite vertices",
            bytemuck::cast_slice(&edges.opposites),
        )?,
        buffer("clusters of edges", bytemuck::cast_slice(&clusters.boxes))?,
        buffer(
            "the edges of clusters",
            bytemuck::cast_slice(&clusters.edges),
        )?,
        light.clone(),
    ];
    let tasks = clusters.of_groups.clone();
    // The device has the rest.
    let clusters = clusters.without_edges();
    Ok((
        TasksOfLight {
            clusters,
            light,
            tasks,
        },
        buffers,
    ))
}

fn caps(context: &PrepareContext<'_>, parameters: &StageVolumeParameters) -> Faces {
    let defines = parameters.defines(&[]);
    Faces {
        stages: vec![shader::glsl("methods/silhouette_ms/caps.mesh", &defines)],
        fragments: Fragments::Count,
        input: VertexInput::Numbers,
        topology: PrimitiveTopology::Meshes,
        elements: Elements::Workgroups(TRIANGLES),
        draws: Draws::All(context.casters.triangles()),
        z_fail: parameters.front_cap_raster(),
        in_z_pass: false,
    }
}

/// The tasks of each object that casts, and what they know of the light.
struct TasksOfLight {
    clusters: EdgeClusters,
    light: wgpu::Buffer,
    tasks: Vec<Range<u32>>,
}

impl ChooseDraws for TasksOfLight {
    fn choose(&mut self, frame: &mut Frame<'_>) -> anyhow::Result<()> {
        let light = self.clusters.light(frame.view().light.place);
        frame.stage(SELECT_STAGE, |stage| {
            stage.upload(&self.light, 0, bytemuck::bytes_of(&light))
        })
    }

    fn chosen(&self) -> &[Range<u32>] {
        &self.tasks
    }
}
