//! Silhouette shadow volumes without any extraction: a vertex shader asks each edge at every corner of its side quads. It runs
//! wherever there is a stencil buffer and vertex shaders may read [`BUFFERS`] storage buffers.

mod quads;

use super::capping::{CappedPlan, CappedPlanner, Capping, Caps};
use super::counter::{Counter, ROUND};
use super::device_edges::{self, SidesBy};
use super::plan_words;
use super::portable_volumes::{CornerStage, Corners, FaceDraws, PortableVolumes};
use super::volume_parameters::{CASTING_WORDS, FrontCap, PortableVolumeParameters};
use super::volumes::STENCIL;
use super::{MethodError, MethodInfo, PrepareContext, ShadowMethod, clash, volume_limits};
use crate::frame::fullscreen::{bind_group, bind_group_layout, buffer_binding};
use crate::frame::{DepthSetup, DrawnVolumes, Frame, PreparedMethod};
use crate::geometry::Casting;
use crate::parameters;
use quads::Quads;
use wgpu::BufferUsages as Usage;

/// What the method is.
pub(super) static INFO: MethodInfo = MethodInfo {
    id: "silhouette_vs",
    title: "silhouette shadow volumes, every edge asked by a vertex shader",
    source: "after Milet et al. 2014, algorithm 2, without the stages that leave edges out",
    needs: &[STENCIL],
    limits: &[volume_limits::LIMITS],
    clashes: clash::OF_VOLUMES,
    tolerated_share: 0.0,
};

/// Storage buffers that its shader reads.
const BUFFERS: u32 = 7;

parameters! {
    /// The method's parameters.
    pub(super) struct SilhouetteVs {
        casting: Casting = Casting::LightFacing,
            CASTING_WORDS;
        ..volume: PortableVolumeParameters;
    }
}

impl ShadowMethod for SilhouetteVs {
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
        let volume = self.volume.planned(&context.scene.flight.light)?;
        let casting = volume.planned_casting(self.casting, Self::default().casting)?;
        let context = &volume.casters(context)?;
        let casters = &context.casters;
        let capping = Capping {
            front_cap: volume.front_cap,
            caps: Caps::Triangles,
            closed: casters.are_closed().to_vec(),
        };
        let most = context
            .gpu
            .device
            .limits()
            .max_storage_buffers_per_shader_stage;
        if most < BUFFERS {
            let message =
                format!("a shader may read {most} storage buffers here, and it reads {BUFFERS}");
            return Err(MethodError::Unavailable(message));
        }
        let quads = Quads::new(casters, volume.counter.into())?;
        let bytes = (4 * casters.mesh.caster_object_count()).max(4) as u64;
        let usage = Usage::STORAGE | Usage::COPY_DST;
        let plans = context.gpu.empty_buffer("plans of casters", bytes, usage)?;
        Ok(Box::new(VsVolumes {
            volumes: volumes(context, &volume, &quads, &plans)?,
            planner: CappedPlanner::new(context, *volume, casting, capping),
            plans,
            quads,
            drawn: DrawnVolumes::default(),
        }))
    }
}

/// The pipelines, and what their vertex shader reads.
fn volumes(
    context: &PrepareContext<'_>,
    parameters: &PortableVolumeParameters,
    quads: &Quads,
    plans: &wgpu::Buffer,
) -> Result<PortableVolumes, MethodError> {
    let gpu = context.gpu;
    let casters = &context.casters;
    let words = |what: &str, contents: &[u32]| {
        let contents = bytemuck::cast_slice(contents);
        gpu.buffer(what, contents, Usage::STORAGE)
    };
    device_edges::check(casters.topology(), casters.mesh.caster_object_count())?;
    let (edges, sides) = device_edges::edges_and_sides(casters, SidesBy::OppositeVertex);
    let mut of_triangles = vec![0_u32; casters.mesh.triangles.len().max(1)];
    for (caster, triangles) in (0..).zip(casters.mesh.casters()) {
        of_triangles[triangles.triangle_range()].fill(caster);
    }
    let buffers = [
        words("side quads", bytemuck::cast_slice(&quads.quads))?,
        plans.clone(),
        words("the edges", bytemuck::cast_slice(&edges))?,
        words("the triangles of edges", &sides)?,
        context.indices()?,
        words("the casters of triangles", &of_triangles)?,
        context.resources.scene.positions.clone(),
    ];
    let read_only = buffer_binding(wgpu::BufferBindingType::Storage { read_only: true });
    let stages = wgpu::ShaderStages::VERTEX;
    let layout = bind_group_layout(&gpu.device, "faces", stages, &[read_only; BUFFERS as usize]);
    let bound = buffers.each_ref().map(wgpu::Buffer::as_entire_binding);
    let takes_weights = Counter::from(parameters.counter).takes_weights();
    let stage = CornerStage {
        path: "methods/silhouette_vs/face.wgsl",
        entry_point: "face",
        constants: &[
            ("first_open", f64::from(quads.first_open)),
            ("first_front", f64::from(quads.first_front)),
            ("first_back", f64::from(quads.first_back)),
            ("weighted", f64::from(u8::from(takes_weights))),
        ],
        layout: &layout,
        bind_group: &bind_group(&gpu.device, &layout, &bound),
    };
    PortableVolumes::new(context, parameters, &stage)
}

/// The method ready for a scene.
struct VsVolumes {
    planner: CappedPlanner,
    quads: Quads,
    volumes: PortableVolumes,
    plans: wgpu::Buffer,
    /// Of the last frame.
    drawn: DrawnVolumes,
}

impl PreparedMethod for VsVolumes {
    fn begin(&mut self) {
        self.planner.begin();
    }

    fn record(&mut self, frame: &mut Frame<'_>) -> anyhow::Result<()> {
        let resources = frame.resources();
        let (plan, plans) = self.planner.choose(frame)?;
        let Self { quads, volumes, .. } = self;
        let targets = frame.targets();
        let corners = frame.stage(ROUND.volumes, |stage| -> anyhow::Result<Corners> {
            let words: Vec<_> = plans.iter().copied().map(plan_words::word).collect();
            stage.upload(&self.plans, 0, bytemuck::cast_slice(&words))?;
            let corners = corners(quads, &self.planner.capping, &plans);
            volumes.counts.begin(stage, targets, &ROUND);
            volumes.record(stage, resources, None, &corners);
            Ok(corners)
        })?;
        let near_counts = (plan.near_count, plan.near_count_of_rest);
        volumes
            .counts
            .resolve(frame, &ROUND, near_counts, |stage| {
                volumes.record_open_edges(stage, resources, None, &corners);
            })?;
        self.drawn = plan.drawn();
        Ok(())
    }

    fn drawn_volumes(&self) -> Option<DrawnVolumes> {
        Some(self.drawn)
    }
}

/// The corners of a frame.
fn corners(quads: &Quads, capping: &Capping, plans: &[CappedPlan]) -> Corners {
    let mut depth_passes = Vec::new();
    let mut depth_fails = Vec::new();
    let mut fronts = Vec::new();
    let mut backs = Vec::new();
    let mut of_open_edges = Vec::new();
    let drawn = plans.iter().enumerate();
    for (caster, plan) in drawn.filter(|(_, plan)| plan.caster.is_drawn) {
        let sides = quads.sides(caster, plan.caster.casting);
        if plan.caster.z_pass {
            depth_passes.extend(sides);
        } else {
            depth_fails.extend(sides);
            fronts.push(quads.fronts(caster));
            if !plan.far_ends_meet {
                backs.push(quads.backs(caster));
            }
        }
        if plan.caster.casting == Casting::EachSide {
            of_open_edges.push(quads.open(caster));
        }
    }
    match capping.front_cap {
        FrontCap::Far => backs.splice(0..0, fronts),
        FrontCap::InPlace => depth_fails.splice(0..0, fronts),
    };
    let draws = |ranges| FaceDraws::Vertices(quads::joined(ranges));
    Corners {
        depth_passes: draws(depth_passes),
        depth_fails: draws(depth_fails),
        everywhere: draws(backs),
        of_open_edges: draws(of_open_edges),
    }
}
