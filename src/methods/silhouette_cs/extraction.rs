//! Silhouettes and faces found by compute shaders.

use super::blocks::Blocks;
use super::kernel::{Kernel, KernelDesc};
use super::tables::{Tables, words};
use super::{DrawCalls, Extraction, SilhouetteCs, plans};
use crate::geometry::Casting;
use crate::geometry::open_edges::is_irregular;
use crate::geometry::silhouette::EdgeClusters;
use crate::gpu::{DeviceError, Stage, shader};
use crate::methods::capping::{CappedPlan, Capping, Caps};
use crate::methods::portable_volumes::{Corners, FaceDraws, INDIRECT_BYTES};
use crate::methods::volume_parameters::FrontCap;
use crate::methods::{MethodError, PrepareContext};
use glam::Vec4;
use wgpu::BufferUsages as Usage;

/// Lists of [`Corners`].
const LISTS: u32 = 4;

/// Finds the faces of all volumes.
pub(super) struct Extractor {
    tables: Tables,
    clusters: Option<Clusters>,
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

/// Makes faces.
struct Emit {
    of_edges: Kernel,
    of_triangles: Kernel,
}

impl Extractor {
    pub(super) fn new(
        context: &PrepareContext<'_>,
        parameters: &SilhouetteCs,
        capping: &Capping,
    ) -> Result<Self, MethodError> {
        let gpu = context.gpu;
        let blocks = Blocks::new(&context.casters.mesh, context.casters.topology());
        let extraction = parameters.extraction;
        let most_bytes = u64::from(parameters.faces_mib) << 20;
        let tables = Tables::new(context, &blocks, extraction, capping.caps, most_bytes)?;
        let (clusters, marks) = match extraction {
            Extraction::Clusters => {
                let (clusters, marks) = Clusters::new(context, &blocks)?;
                (Some(clusters), marks)
            }
            Extraction::Facings => {
                let all = 0..context.casters.topology().edges.len() as u32;
                (
                    None,
                    words(gpu, "the edges that are asked", &blocks.marks(all))?,
                )
            }
        };
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
            blocks: blocks.blocks.len() as u32,
        };
        let ask = match extraction {
            Extraction::Clusters => Kernels::ask_corners,
            Extraction::Facings => Kernels::ask_facings,
        };
        Ok(Self {
            clusters,
            find_facings: kernels.find_facings(),
            count_edges: ask(&kernels, &marks),
            count_triangles: kernels.count_triangles(capping),
            sum_blocks: kernels.sum_blocks(),
            make_draws: kernels.make_draws(draw_count, &first_blocks, &draws),
            emit: (0..tables.rounds)
                .map(|round| kernels.emit(&marks, capping, round))
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
        let words: Vec<_> = plans.iter().copied().map(plans::word).collect();
        stage.upload(&self.tables.plans, 0, bytemuck::cast_slice(&words))?;
        if let Some(clusters) = &self.clusters {
            clusters.begin(stage, light)?;
        }
        let has_triangles = plans.iter().any(|plan| plan.has_triangles());
        let mut pass = compute_pass(stage, "extract");
        if has_triangles || self.clusters.is_none() {
            self.find_facings.dispatch(&mut pass);
        }
        if let Some(mark) = self.clusters.as_ref().and_then(|own| own.mark.as_ref()) {
            mark.dispatch(&mut pass);
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

/// Marks the edges of clusters.
struct Clusters {
    clusters: EdgeClusters,
    /// `None` if there are no clusters.
    mark: Option<Kernel>,
    light: wgpu::Buffer,
    marks: wgpu::Buffer,
    /// The edges that are asked whatever the light.
    always: wgpu::Buffer,
}

impl Clusters {
    /// Gives also where edges are marked.
    fn new(
        context: &PrepareContext<'_>,
        blocks: &Blocks,
    ) -> Result<(Self, wgpu::Buffer), DeviceError> {
        let (gpu, casters) = (context.gpu, &context.casters);
        let (topology, triangles) = (casters.topology(), casters.edge_triangles());
        let mut clusters = EdgeClusters::build(&casters.mesh, topology);
        // Triangles that face the light may have such an edge on their silhouette where all together have not.
        let edges = (0..).zip(&topology.edges);
        let irregular = edges.filter(|(_, edge)| is_irregular(triangles.of(**edge)));
        let always = irregular.map(|(number, _)| number);
        let always = blocks.marks(always.chain(clusters.others.iter().copied()));
        let bits: Vec<_> = clusters
            .edges
            .iter()
            .map(|edge| blocks.bits[*edge as usize])
            .collect();
        let count = clusters.boxes.len() as u32;
        let boxes = bytemuck::cast_slice(&clusters.boxes);
        let boxes = gpu.buffer("clusters of edges", boxes, Usage::STORAGE)?;
        let bits = words(gpu, "the edges of clusters", &bits)?;
        let light = gpu.empty_buffer(
            "the light of clusters",
            size_of_val(&clusters.light(Vec4::W)) as u64,
            Usage::STORAGE | Usage::COPY_DST,
        )?;
        let usage = Usage::STORAGE | Usage::COPY_SRC;
        let always = gpu.buffer("edges always asked", bytemuck::cast_slice(&always), usage)?;
        let usage = Usage::STORAGE | Usage::COPY_DST;
        let marks = gpu.empty_buffer("the edges that are asked", always.size(), usage)?;
        let desc = KernelDesc {
            module: &shader::wgsl(&gpu.device, "methods/silhouette_cs/clusters.wgsl"),
            entry_point: "mark_clusters",
            constants: &[],
            frame: None,
            buffers: &[(0, &boxes), (1, &bits), (2, &light), (3, &marks)],
        };
        let mark = (count > 0).then(|| Kernel::new(gpu, &desc, count));
        // Only the device needs them from here on.
        clusters.edges = Vec::new();
        clusters.boxes = Vec::new();
        let own = Self {
            clusters,
            mark,
            light,
            marks: marks.clone(),
            always,
        };
        Ok((own, marks))
    }

    /// Unmarks all but those that are always asked, for a light.
    fn begin(&self, stage: &mut Stage<'_, '_>, light: Vec4) -> anyhow::Result<()> {
        let light = self.clusters.light(light);
        stage.upload(&self.light, 0, bytemuck::bytes_of(&light))?;
        let (from, to) = (&self.always, &self.marks);
        stage
            .encoder()
            .copy_buffer_to_buffer(from, 0, to, 0, from.size());
        Ok(())
    }
}

/// Makes the kernels over all blocks.
struct Kernels<'a> {
    context: &'a PrepareContext<'a>,
    tables: &'a Tables,
    /// How many there are.
    blocks: u32,
}

impl Kernels<'_> {
    /// One of `invocations` in the file of this name.
    fn kernel(
        &self,
        file: &str,
        entry_point: &str,
        constants: &[(&str, f64)],
        buffers: &[(u32, &wgpu::Buffer)],
        invocations: u32,
    ) -> Kernel {
        let gpu = self.context.gpu;
        let path = format!("methods/silhouette_cs/{file}.wgsl");
        let asks_light = matches!(file, "facings" | "ask_corners");
        let frame = &self.context.resources.uniform.buffer;
        let desc = KernelDesc {
            module: &shader::wgsl(&gpu.device, &path),
            entry_point,
            constants,
            frame: asks_light.then_some(frame),
            buffers,
        };
        Kernel::new(gpu, &desc, invocations)
    }

    fn find_facings(&self) -> Kernel {
        let positions = &self.context.resources.scene.positions;
        let Tables {
            indices, facings, ..
        } = self.tables;
        let buffers = [(0, positions), (1, indices), (2, facings)];
        let words = self.context.casters.mesh.triangles.len().div_ceil(32) as u32;
        self.kernel("facings", "find_facings", &[], &buffers, words)
    }

    /// With facings that edges find by themselves.
    fn ask_corners(&self, marks: &wgpu::Buffer) -> Kernel {
        let positions = &self.context.resources.scene.positions;
        self.count_edges("ask_corners", marks, positions)
    }

    /// With facings that are known.
    fn ask_facings(&self, marks: &wgpu::Buffer) -> Kernel {
        self.count_edges("ask_facings", marks, &self.tables.facings)
    }

    fn count_edges(&self, file: &str, marks: &wgpu::Buffer, asked: &wgpu::Buffer) -> Kernel {
        let Tables {
            blocks,
            plans,
            edges,
            sides,
            multiplicities,
            corners,
            ..
        } = self.tables;
        let buffers = [
            blocks,
            plans,
            edges,
            sides,
            marks,
            multiplicities,
            corners,
            asked,
        ];
        let buffers: Vec<_> = (0..).zip(buffers).collect();
        self.kernel(file, "count_edges", &[], &buffers, self.blocks)
    }

    fn count_triangles(&self, capping: &Capping) -> Kernel {
        let Tables {
            blocks,
            plans,
            facings,
            corners,
            ..
        } = self.tables;
        let buffers = [(0, blocks), (1, plans), (2, facings), (3, corners)];
        let constants = &caps_constants(capping);
        self.kernel(
            "count_triangles",
            "count_triangles",
            constants,
            &buffers,
            self.blocks,
        )
    }

    fn emit(&self, marks: &wgpu::Buffer, capping: &Capping, round: u32) -> Emit {
        Emit {
            of_edges: self.emit_edges(marks, round),
            of_triangles: self.emit_triangles(capping, round),
        }
    }

    /// See elements.wgsl.
    fn round_constants(&self, round: u32) -> [(&'static str, f64); 2] {
        [
            ("corners_a_round", self.tables.corners_a_round as f64),
            ("this_round", f64::from(round)),
        ]
    }

    fn emit_edges(&self, marks: &wgpu::Buffer, round: u32) -> Kernel {
        let Tables {
            blocks,
            plans,
            edges,
            multiplicities,
            apexes,
            corners,
            elements,
            ..
        } = self.tables;
        let buffers = [
            (0, blocks),
            (1, plans),
            (2, edges),
            (3, marks),
            (4, multiplicities),
            (5, apexes),
            (8, corners),
            (9, elements),
        ];
        let constants = &self.round_constants(round);
        self.kernel("emit_edges", "emit_edges", constants, &buffers, self.blocks)
    }

    fn emit_triangles(&self, capping: &Capping, round: u32) -> Kernel {
        let Tables {
            blocks,
            plans,
            facings,
            indices,
            corners,
            elements,
            ..
        } = self.tables;
        let buffers = [
            (0, blocks),
            (1, plans),
            (2, facings),
            (3, indices),
            (8, corners),
            (9, elements),
        ];
        let constants = [caps_constants(capping), self.round_constants(round)].concat();
        self.kernel(
            "emit_triangles",
            "emit_triangles",
            &constants,
            &buffers,
            self.blocks,
        )
    }

    /// One workgroup.
    fn sum_blocks(&self) -> Kernel {
        let buffers = [(0, &self.tables.corners)];
        self.kernel("sum_blocks", "sum_blocks", &[], &buffers, 1)
    }

    fn make_draws(&self, count: u32, first_blocks: &wgpu::Buffer, draws: &wgpu::Buffer) -> Kernel {
        let buffers = [(0, &self.tables.corners), (1, first_blocks), (2, draws)];
        let constants = [
            ("draw_count", f64::from(count)),
            ("corners_a_round", self.tables.corners_a_round as f64),
            ("rounds", f64::from(self.tables.rounds)),
        ];
        self.kernel("make_draws", "make_draws", &constants, &buffers, count)
    }
}

/// See caps.wgsl.
fn caps_constants(capping: &Capping) -> [(&'static str, f64); 2] {
    let is = |is: bool| f64::from(u8::from(is));
    [
        ("front_everywhere", is(capping.front_cap == FrontCap::Far)),
        ("far_triangles", is(capping.caps == Caps::FarTriangles)),
    ]
}
