//! Shadow volumes that native stages make and passes count: what their methods share.
//!
//! A method says which [`Faces`] its volumes have and how they are made; here they are drawn and
//! counted, z-fail, z-pass, or for each object whichever is right and draws less. The count of a pixel
//! is a sum over objects, so objects may be counted in different ways in one frame.

use super::counter::{Counts, ROUND};
use super::faces::{Draws, Elements, Faces, open_edges};
use super::occlusion::{OCCLUSION_STAGE, Occlusion};
use super::occlusion_gpu::{ConditionalDraws, DeviceOcclusion};
use super::plan::{CasterPlan, FramePlan, Planner};
use super::volume_parameters::{Counting, Culling, Plan, StageVolumeParameters};
use super::{MethodError, PrepareContext};
use crate::frame::{DrawnVolumes, Frame, PreparedMethod};
use crate::geometry::Casting;
use crate::gpu::native::{
    BindingKind, Bindings, IndexedGeometry, NativePass, Pipeline, PipelineDesc, Raster, Target,
};
use crate::gpu::{Capability, Gpu};
use std::ops::Range;

/// Name of the stage that chooses, on the processor, how each object is counted.
pub(super) const CHOOSE_STAGE: &str = "choose";

/// Name of the stages that draw volumes that were taken to be hidden and are not.
const LATE_STAGE: &str = "late_volumes";

/// What every volume method needs of the device.
pub(super) const STENCIL: Capability = Capability::StencilBuffer;

/// Faces ready to be drawn.
struct PreparedFaces {
    z_fail: Option<Pipeline>,
    z_pass: Option<Pipeline>,
    drawn: Drawn,
    draws: Draws,
    /// Whether neighbours that are drawn alike are drawn by one call; else each by its own, as in the papers.
    joins: bool,
    /// Where the device decides about each object.
    conditional: Option<ConditionalDraws>,
}

/// What a draw takes: see [`Elements`].
enum Drawn {
    Vertices,
    Indexed(IndexedGeometry),
    /// So many elements each, and so many workgroups in a draw call at most.
    Workgroups(u32, u32),
}

/// The shadow volumes of one scene.
pub(super) struct StencilVolumes {
    planner: Planner,
    faces: Vec<PreparedFaces>,
    /// Drawn after what the others have counted is in the mask.
    open_edges: Option<PreparedFaces>,
    bindings: Bindings,
    target: Target,
    counts: Counts,
    counters: Vec<(&'static str, u64)>,
    occlusion: Option<Occlusion>,
    device_occlusion: Option<DeviceOcclusion>,
    /// Of the last frame.
    plan: FramePlan,
}

impl StencilVolumes {
    /// Builds the pipelines of `faces`, drawn in their order. `buffers` are what shaders read at
    /// bindings 3, 4, ... (0 to 2 are frame, positions and indices); `counters` are told to the user.
    pub(super) fn new(
        context: &PrepareContext<'_>,
        parameters: &StageVolumeParameters,
        buffers: &[wgpu::Buffer],
        faces: Vec<Faces>,
        counters: Vec<(&'static str, u64)>,
    ) -> Result<Self, MethodError> {
        let PrepareContext { gpu, resources, .. } = context;
        let device = &gpu.device;
        let counting = parameters.counting;
        let counts = Counts::new(context, parameters.counter, parameters.depth_setup())?;
        let depth = &resources.targets.depth;
        let target = Target::new(device, depth, counts.count_in(), parameters.depth)?;
        let indices = context.indices()?;
        let mut bound = vec![
            (BindingKind::Uniform, &resources.uniform.buffer),
            (BindingKind::Storage, &resources.scene.positions),
            (BindingKind::Storage, &indices),
        ];
        bound.extend(buffers.iter().map(|buffer| (BindingKind::Storage, buffer)));
        let bindings = Bindings::new(device, &target, &bound)?;
        let device_occlusion = (parameters.culling == Culling::OcclusionGpu)
            .then(|| DeviceOcclusion::new(gpu, resources))
            .transpose()?;
        let prepare = |faces: Faces| -> Result<PreparedFaces, MethodError> {
            let mut faces = PreparedFaces::new(context, (&target, &bindings), parameters, faces)?;
            if let Some(occlusion) = &device_occlusion {
                let is_indexed = matches!(faces.drawn, Drawn::Indexed(_));
                faces.conditional = Some(occlusion.draws(gpu, is_indexed)?);
            }
            Ok(faces)
        };
        Ok(Self {
            planner: Planner::new(
                context,
                **parameters,
                parameters.casting,
                parameters.determinism,
            ),
            faces: faces.into_iter().map(prepare).collect::<Result<_, _>>()?,
            open_edges: (parameters.casting == Casting::EachSide && counting != Counting::ZFail)
                .then(|| prepare(open_edges(context)?))
                .transpose()?,
            bindings,
            target,
            counts,
            counters,
            occlusion: Occlusion::wanted(context, **parameters),
            device_occlusion,
            plan: FramePlan::default(),
        })
    }

    /// See [`Planner::take_all_as_closed`].
    pub(super) fn take_all_as_closed(&mut self) {
        self.planner.take_all_as_closed();
    }

    /// Draws the objects of each way of counting, faces after faces.
    fn draw(&self, pass: &mut NativePass<'_>, casters: &[CasterPlan]) {
        for faces in &self.faces {
            faces.draw(pass, casters, |_| true);
        }
    }

    /// Records the stages after which the device knows what to draw of the plan.
    fn ask_device(&mut self, frame: &mut Frame<'_>, plan: &mut FramePlan) -> anyhow::Result<()> {
        let Some(occlusion) = &mut self.device_occlusion else {
            return Ok(());
        };
        occlusion.ask(frame, plan)?;
        frame.stage(OCCLUSION_STAGE, |stage| {
            let all = self.faces.iter().chain(&self.open_edges);
            all.filter_map(|faces| Some((faces, faces.conditional.as_ref()?)))
                .try_for_each(|(faces, conditional)| {
                    let elements = faces.draws.of_frame();
                    occlusion.set(stage, conditional, (elements, &plan.casters))
                })
        })
    }

    /// Records the stages that draw what turns out not to be hidden, beside what the plan had drawn before.
    fn draw_late(&mut self, frame: &mut Frame<'_>, plan: &mut FramePlan) -> anyhow::Result<()> {
        let Some(mut occlusion) = self.occlusion.take() else {
            return Ok(());
        };
        while let Some(visible) = occlusion.go_on(frame)? {
            let mut late = plan.casters.clone();
            late.iter_mut().for_each(|caster| caster.is_drawn = false);
            for &caster in &visible {
                late[caster as usize].is_drawn = true;
                plan.casters[caster as usize].is_drawn = true;
            }
            if !visible.is_empty() {
                frame.stage(LATE_STAGE, |stage| {
                    stage.native(&self.target, &self.bindings, |pass| {
                        pass.set_modulus(ROUND.modulus);
                        self.draw(pass, &late);
                    });
                });
            }
        }
        occlusion.end(plan);
        self.occlusion = Some(occlusion);
        Ok(())
    }
}

impl PreparedFaces {
    fn new(
        context: &PrepareContext<'_>,
        (target, bindings): (&Target, &Bindings),
        parameters: &StageVolumeParameters,
        faces: Faces,
    ) -> Result<Self, MethodError> {
        let device = &context.gpu.device;
        let pipeline = |raster| {
            let mut stages = faces.stages.clone();
            stages.extend(faces.fragments.stage(parameters, raster));
            let desc = PipelineDesc {
                stages: &stages,
                input: faces.input,
                topology: faces.topology,
                raster,
                push_back_px: parameters.push_back_px as f32,
            };
            Pipeline::new(device, target, bindings, &desc)
        };
        let positions = &context.resources.scene.positions;
        let drawn = match faces.elements {
            Elements::Vertices => Drawn::Vertices,
            Elements::Indices(indices) => {
                Drawn::Indexed(IndexedGeometry::new(device, positions, &indices)?)
            }
            Elements::Workgroups(size) => Drawn::Workgroups(size, most_workgroups(context.gpu)),
        };
        let z_pass = faces.in_z_pass && parameters.counting != Counting::ZFail;
        Ok(Self {
            z_fail: (parameters.counting != Counting::ZPass)
                .then(|| pipeline(faces.z_fail))
                .transpose()?,
            z_pass: z_pass
                .then(|| pipeline(Raster::CountDepthPasses))
                .transpose()?,
            joins: parameters.plan == Plan::Auto || matches!(drawn, Drawn::Workgroups(..)),
            drawn,
            draws: faces.draws,
            conditional: None,
        })
    }

    /// Draws the objects that `takes` takes, those of each way of counting together.
    fn draw(
        &self,
        pass: &mut NativePass<'_>,
        casters: &[CasterPlan],
        takes: impl Fn(&CasterPlan) -> bool,
    ) {
        if let Drawn::Indexed(geometry) = &self.drawn {
            pass.set_geometry(geometry);
        }
        for (pipeline, is_z_pass) in [(&self.z_fail, false), (&self.z_pass, true)] {
            let Some(pipeline) = pipeline else { continue };
            pass.set_pipeline(pipeline);
            let is_drawn =
                |plan: &CasterPlan| plan.is_drawn && plan.z_pass == is_z_pass && takes(plan);
            let objects = self.draws.of_frame().iter().zip(casters);
            if let Some(conditional) = &self.conditional {
                let objects = (0..).zip(objects);
                for (number, (elements, plan)) in objects.filter(|(_, (_, plan))| is_drawn(plan)) {
                    pass.set_constants(constants(*plan, elements));
                    if conditional.is_indexed {
                        pass.draw_indexed_indirect(&conditional.draws, number);
                    } else {
                        pass.draw_indirect(&conditional.draws, number);
                    }
                }
                continue;
            }
            let drawn = objects.filter(|(_, plan)| is_drawn(plan));
            if self.joins {
                for (elements, plan) in together(drawn) {
                    self.draw_elements(pass, elements, plan);
                }
            } else {
                for (elements, plan) in drawn {
                    self.draw_elements(pass, elements.clone(), *plan);
                }
            }
        }
    }

    fn draw_elements(&self, pass: &mut NativePass<'_>, elements: Range<u32>, plan: CasterPlan) {
        let (size, most) = match &self.drawn {
            Drawn::Workgroups(size, most) => (*size, *most),
            Drawn::Vertices => {
                pass.set_constants(constants(plan, &elements));
                return pass.draw(elements);
            }
            Drawn::Indexed(_) => {
                pass.set_constants(constants(plan, &elements));
                return pass.draw_indexed(elements);
            }
        };
        let most = most * size;
        for start in elements.clone().step_by(most as usize) {
            let part = start..elements.end.min(start.saturating_add(most));
            pass.set_constants(constants(plan, &part));
            pass.draw_meshes((part.end - part.start).div_ceil(size));
        }
    }
}

/// The most workgroups of a draw call. A processor keeps what all of a call make, and is 1.5 times as fast where that stays in
/// its caches.
fn most_workgroups(gpu: &Gpu) -> u32 {
    match gpu.info.device_type {
        wgpu::DeviceType::Cpu => 256,
        _ => NativePass::MOST_WORKGROUPS,
    }
}

/// Joins neighbours that are drawn alike.
fn together<'a>(
    objects: impl Iterator<Item = (&'a Range<u32>, &'a CasterPlan)>,
) -> Vec<(Range<u32>, CasterPlan)> {
    let mut joined: Vec<(Range<u32>, CasterPlan)> = Vec::new();
    for (elements, plan) in objects {
        match joined.last_mut() {
            Some((last, same)) if same == plan && last.end == elements.start => {
                last.end = elements.end;
            }
            _ => joined.push((elements.clone(), *plan)),
        }
    }
    joined
}

/// Twin of `Caster` in shaders/shared/caster.glsl.
fn constants(plan: CasterPlan, elements: &Range<u32>) -> [u32; 4] {
    let light_facing_only = u32::from(plan.casting != Casting::All);
    let end_plane = plan.end.index() as u32;
    [end_plane, light_facing_only, elements.start, elements.end]
}

impl PreparedMethod for StencilVolumes {
    fn begin(&mut self) {
        if let Some(occlusion) = &mut self.occlusion {
            occlusion.forget();
        }
    }

    fn record(&mut self, frame: &mut Frame<'_>) -> anyhow::Result<()> {
        let (view, casters) = (*frame.view(), &frame.resources().extents.casters);
        let mut plan = frame.stage(CHOOSE_STAGE, |stage| {
            stage.on_processor(|| self.planner.plan(&view, casters))
        });
        if let Some(occlusion) = &mut self.occlusion {
            occlusion.begin(frame, &mut plan)?;
        }
        for faces in &mut self.faces {
            if let Draws::Chosen(draws) = &mut faces.draws {
                draws.choose(frame)?;
            }
        }
        self.ask_device(frame, &mut plan)?;
        let targets = frame.targets();
        let near_counts = (plan.near_count, plan.near_count_of_rest);
        for round in self.counts.rounds() {
            frame.stage(round.volumes, |stage| {
                self.counts.begin(stage, targets, round);
                stage.native(&self.target, &self.bindings, |pass| {
                    pass.set_modulus(round.modulus);
                    self.draw(pass, &plan.casters);
                });
            });
            if round.modulus == ROUND.modulus {
                self.draw_late(frame, &mut plan)?;
            }
            self.counts.resolve(frame, round, near_counts, |stage| {
                stage.native(&self.target, &self.bindings, |pass| {
                    pass.set_modulus(round.modulus);
                    let takes = |plan: &CasterPlan| plan.casting == Casting::EachSide;
                    if let Some(open_edges) = &self.open_edges {
                        open_edges.draw(pass, &plan.casters, takes);
                    }
                });
            })?;
        }
        self.plan = plan;
        Ok(())
    }

    fn drawn_volumes(&self) -> Option<DrawnVolumes> {
        Some(self.plan.drawn())
    }

    fn counters(&self) -> Vec<(&'static str, u64)> {
        self.counters.clone()
    }
}
