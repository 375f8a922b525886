//! Silhouettes and faces found by compute shaders.

use super::blocks::Blocks;
use super::kernel::Kernel;
use super::kernels::{Ask, Emit, Kernels};
use super::tables::{Tables, words};
use super::{DrawCalls, Extraction, SilhouetteCs};
use crate::geometry::Casting;
use crate::gpu::Stage;
use crate::methods::capping::{CappedPlan, Capping};
use crate::methods::corner::Weights;
use crate::methods::device_edges::edges_and_sides;
use crate::methods::plan_words;
use crate::methods::portable_volumes::{Corners, FaceDraws, INDIRECT_BYTES};
use crate::methods::{MethodError, PrepareContext};
use glam::Vec4;
use wgpu::BufferUsages as Usage;

/// Lists of [`Corners`].
const LISTS: u32 = 4;

/// Finds the faces of all volumes.
pub(super) struct Extractor {
    tables: Tables,
    ask: Ask,
    find_facings: Kernel,
    count_edges: Kernel,
    count_triangles: Kernel,
    sum_blocks: Kernel,
    make_draws: Kernel,
    /// Of each round.
    emit: Vec<Emit>,
    draws: wgpu::Buffer,
    /// How many each list has in a round.
    draw_count: u32,
}

impl Extractor {
    pub(super) fn new(
        context: &PrepareContext<'_>,
        parameters: &SilhouetteCs,
        (capping, weights): (&Capping, Weights),
    ) -> Result<Self, MethodError> {
        let gpu = context.gpu;
        let blocks = Blocks::new(&context.casters.mesh, context.casters.topology());
        let extraction = parameters.extraction;
        let most_bytes = u64::from(parameters.faces_mib) << 20;
        let records = edges_and_sides(&context.casters, extraction.sides_by());
        let tables = Tables::new(context, &blocks, &records, capping.caps, most_bytes)?;
        let first_blocks = match parameters.draw_calls {
            DrawCalls::Scene => vec![0, blocks.blocks.len() as u32],
            DrawCalls::Object => blocks.of_casters.clone(),
        };
        let draw_count = first_blocks.len() as u32 - 1;
        let draws = gpu.empty_buffer(
            "draws of shadow volumes",
            INDIRECT_BYTES * u64::from(tables.rounds * LISTS * draw_count.max(1)),
            Usage::STORAGE | Usage::INDIRECT,
        )?;
        let first_blocks = words(gpu, "the first block of each draw", &first_blocks)?;
        let kernels = Kernels {
            context,
            tables: &tables,
            records: &records,
            weights,
            count: blocks.blocks.len() as u32,
        };
        let ask = match extraction {
            Extraction::Clusters => kernels.ask_clusters(&blocks)?,
            Extraction::Facings => kernels.ask_facings()?,
        };
        Ok(Self {
            ask,
            find_facings: kernels.find_facings(),
            count_edges: kernels.count_edges(),
            count_triangles: kernels.count_triangles(capping),
            sum_blocks: kernels.sum_blocks(),
            make_draws: kernels.make_draws(draw_count, &first_blocks, &draws),
            emit: (0..tables.rounds)
                .map(|round| kernels.emit(capping, round))
                .collect(),
            tables,
            draws,
            draw_count,
        })
    }

    /// The corners of all faces.
    pub(super) fn elements(&self) -> &wgpu::Buffer {
        &self.tables.elements
    }

    /// Finds the silhouette, and how many corners its faces have.
    pub(super) fn extract(
        &self,
        stage: &mut Stage<'_, '_>,
        plans: &[CappedPlan],
        light: Vec4,
    ) -> anyhow::Result<()> {
        let words: Vec<_> = plans.iter().copied().map(plan_words::word).collect();
        stage.upload(&self.tables.plans, 0, bytemuck::cast_slice(&words))?;
        if let Ask::Clusters(ask) = &self.ask {
            let light = ask.clusters.light(light);
            stage.upload(&ask.light, 0, bytemuck::bytes_of(&light))?;
            // None yet, and one in each of the other dimensions.
            let none = [0, 1, 1, 0u32];
            stage.upload(&ask.workgroups, 0, bytemuck::bytes_of(&none))?;
            stage.encoder().clear_buffer(&ask.listed, 0, Some(4));
            stage.encoder().clear_buffer(&self.tables.marks, 0, None);
        }
        let has_triangles = plans.iter().any(|plan| plan.has_triangles());
        let mut pass = compute_pass(stage, "extract");
        if has_triangles || matches!(self.ask, Ask::Facings(_)) {
            self.find_facings.dispatch(&mut pass);
        }
        match &self.ask {
            Ask::Clusters(ask) => {
                ask.of_clusters.dispatch(&mut pass);
                ask.of_edges.dispatch_indirect(&mut pass, &ask.workgroups);
            }
            Ask::Facings(kernel) => kernel.dispatch(&mut pass),
        }
        self.count_edges.dispatch(&mut pass);
        if has_triangles {
            self.count_triangles.dispatch(&mut pass);
        }
        self.sum_blocks.dispatch(&mut pass);
        self.make_draws.dispatch(&mut pass);
        Ok(())
    }

    /// How often faces are made and drawn, until all are.
    pub(super) fn rounds(&self) -> u32 {
        self.tables.rounds
    }

    /// Makes the faces of a round.
    pub(super) fn emit(&self, stage: &mut Stage<'_, '_>, plans: &[CappedPlan], round: u32) {
        let has_triangles = plans.iter().any(|plan| plan.has_triangles());
        let mut pass = compute_pass(stage, "faces");
        let emit = &self.emit[round as usize];
        emit.of_edges.dispatch(&mut pass);
        if has_triangles {
            emit.of_triangles.dispatch(&mut pass);
        }
    }

    /// How the faces of a round are drawn.
    pub(super) fn corners(&self, plans: &[CappedPlan], round: u32) -> Corners {
        let list = |number: u32, may_have_faces: bool| {
            if !may_have_faces {
                return FaceDraws::NONE;
            }
            let first = (LISTS * round + number) * self.draw_count;
            FaceDraws::Indirect(self.draws.clone(), first..first + self.draw_count)
        };
        let any = |has: fn(&CappedPlan) -> bool| {
            let mut drawn = plans.iter().filter(|plan| plan.caster.is_drawn);
            drawn.any(has)
        };
        Corners {
            depth_passes: list(0, any(|plan| plan.caster.z_pass)),
            depth_fails: list(1, any(|plan| !plan.caster.z_pass)),
            everywhere: list(2, any(|plan| !plan.caster.z_pass)),
            of_open_edges: list(3, any(|plan| plan.caster.casting == Casting::EachSide)),
        }
    }
}

fn compute_pass<'s>(stage: &'s mut Stage<'_, '_>, label: &str) -> wgpu::ComputePass<'s> {
    let encoder = stage.encoder();
    encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
        label: Some(label),
        timestamp_writes: None,
    })
}
