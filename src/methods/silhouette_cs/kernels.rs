//! The compute shaders, each with its buffers.

use super::blocks::Blocks;
use super::kernel::{Bindings, Kernel, KernelDesc};
use super::tables::{Tables, words};
use crate::geometry::open_edges::is_irregular;
use crate::geometry::silhouette::{ClusterBox, ClusterLight, EdgeClusters};
use crate::gpu::{DeviceError, shader};
use crate::methods::PrepareContext;
use crate::methods::capping::{Capping, Caps};
use crate::methods::corner::Weights;
use crate::methods::device_edges::{EdgesAndSides, in_order};
use crate::methods::volume_parameters::FrontCap;
use wgpu::BufferUsages as Usage;

/// Twin of `EDGES` in listed.wgsl.
const EDGES_A_CLUSTER: usize = 16;

/// How silhouette edges are found.
pub(super) enum Ask {
    Clusters(Box<AskClusters>),
    /// Of facings that are known.
    Facings(Kernel),
}

/// First clusters are asked, then the edges of those that may have one on the silhouette.
pub(super) struct AskClusters {
    pub(super) clusters: EdgeClusters,
    pub(super) light: wgpu::Buffer,
    /// How many are listed, and which.
    pub(super) listed: wgpu::Buffer,
    /// What asks their edges.
    pub(super) workgroups: wgpu::Buffer,
    pub(super) of_clusters: Kernel,
    pub(super) of_edges: Kernel,
}

/// Makes faces.
pub(super) struct Emit {
    pub(super) of_edges: Kernel,
    pub(super) of_triangles: Kernel,
}

/// Makes the kernels over all blocks.
pub(super) struct Kernels<'a> {
    pub(super) context: &'a PrepareContext<'a>,
    pub(super) tables: &'a Tables,
    pub(super) records: &'a EdgesAndSides,
    pub(super) weights: Weights,
    /// Of the blocks.
    pub(super) count: u32,
}

impl Kernels<'_> {
    /// One of `invocations`; its entry point has the name of its file.
    fn kernel(
        &self,
        entry_point: &str,
        constants: &[(&str, f64)],
        buffers: Bindings<'_>,
        invocations: u32,
    ) -> Kernel {
        self.kernel_with(entry_point, constants, (&[], buffers), invocations)
    }

    /// The same with uniforms.
    fn kernel_with(
        &self,
        entry_point: &str,
        constants: &[(&str, f64)],
        (uniforms, buffers): (Bindings<'_>, Bindings<'_>),
        invocations: u32,
    ) -> Kernel {
        let gpu = self.context.gpu;
        let path = format!("methods/silhouette_cs/{entry_point}.wgsl");
        let desc = KernelDesc {
            module: &shader::wgsl(&gpu.device, &path),
            entry_point,
            constants,
            uniforms,
            buffers,
        };
        Kernel::new(gpu, &desc, invocations)
    }

    pub(super) fn find_facings(&self) -> Kernel {
        let positions = &self.context.resources.scene.positions;
        let Tables {
            indices, facings, ..
        } = self.tables;
        let buffers = [(0, positions), (1, indices), (2, facings)];
        let words = self.context.casters.mesh.triangles.len().div_ceil(32) as u32;
        let uniforms = [(0, &self.context.resources.uniform.buffer)];
        let bound = (&uniforms[..], &buffers[..]);
        self.kernel_with("find_facings", &[], bound, words)
    }

    pub(super) fn ask_clusters(&self, blocks: &Blocks) -> Result<Ask, DeviceError> {
        let PrepareContext {
            gpu, ref casters, ..
        } = *self.context;
        let (topology, triangles) = (casters.topology(), casters.edge_triangles());
        // Triangles that face the light may have such an edge on their silhouette where all together have not.
        let is_irregular = |edge: u32| is_irregular(triangles.of(topology.edges[edge as usize]));
        let all = 0..topology.edges.len() as u32;
        let (mesh, groups) = (&casters.mesh, std::slice::from_ref(&all));
        let clusters = EdgeClusters::build(mesh, topology, groups, EDGES_A_CLUSTER, is_irregular);
        let count = clusters.boxes.len() as u32;
        let empty = |what: &str, words: u32, usage| {
            gpu.empty_buffer(what, 4 * u64::from(words), usage | Usage::COPY_DST)
        };
        let light_words = (size_of::<ClusterLight>() / 4) as u32;
        let light = empty("the light of clusters", light_words, Usage::UNIFORM)?;
        let listed = empty("clusters to be asked", 1 + count.max(1), Usage::STORAGE)?;
        let indirect = Usage::STORAGE | Usage::INDIRECT;
        let workgroups = empty("workgroups that ask edges", 4, indirect)?;
        let buffers = [(0, &self.boxes(&clusters)?), (1, &listed), (2, &workgroups)];
        let bound = (&[(0, &light)][..], &buffers[..]);
        Ok(Ask::Clusters(Box::new(AskClusters {
            of_clusters: self.kernel_with("ask_clusters", &[], bound, count),
            of_edges: self.ask_edges(blocks, &clusters, &listed)?,
            // The device has them.
            clusters: clusters.without_edges(),
            light,
            listed,
            workgroups,
        })))
    }

    /// What is listed says how many.
    fn ask_edges(
        &self,
        blocks: &Blocks,
        clusters: &EdgeClusters,
        listed: &wgpu::Buffer,
    ) -> Result<Kernel, DeviceError> {
        let PrepareContext { gpu, resources, .. } = self.context;
        let bit = |edge: &u32| blocks.bits.get(*edge as usize).copied().unwrap_or(0);
        let places: Vec<_> = clusters
            .edges
            .iter()
            .map(|edge| [*edge, bit(edge)])
            .collect();
        let places = bytemuck::cast_slice(&places);
        let places = words(gpu, "the numbers of clusters' edges", places)?;
        // In the order in which they are asked, memory is read once and ahead.
        let (edges, sides) = in_order(self.records, &clusters.edges);
        let edges = words(gpu, "the edges of clusters", bytemuck::cast_slice(&edges))?;
        let sides = words(gpu, "the triangles of clusters' edges", &sides)?;
        let Tables {
            plans,
            multiplicities,
            marks,
            ..
        } = self.tables;
        let buffers = [
            listed,
            plans,
            &edges,
            &sides,
            multiplicities,
            &places,
            &resources.scene.positions,
            marks,
        ];
        let buffers: Vec<_> = (0..).zip(buffers).collect();
        let uniforms = [(0, &resources.uniform.buffer)];
        let bound = (&uniforms[..], &buffers[..]);
        Ok(self.kernel_with("ask_edges", &[], bound, 0))
    }

    /// The boxes of clusters on the device, which has one at least.
    fn boxes(&self, clusters: &EdgeClusters) -> Result<wgpu::Buffer, DeviceError> {
        let gpu = self.context.gpu;
        let bytes = clusters.boxes.len().max(1) * size_of::<ClusterBox>();
        let usage = Usage::STORAGE | Usage::COPY_DST;
        let boxes = gpu.empty_buffer("clusters of edges", bytes as u64, usage)?;
        let contents = bytemuck::cast_slice(&clusters.boxes);
        gpu.queue.write_buffer(&boxes, 0, contents);
        Ok(boxes)
    }

    pub(super) fn ask_facings(&self) -> Result<Ask, DeviceError> {
        let (_, sides) = self.records;
        let sides = &words(self.context.gpu, "the triangles of edges", sides)?;
        let Tables {
            blocks,
            plans,
            edges,
            multiplicities,
            facings,
            marks,
            ..
        } = self.tables;
        let buffers = [blocks, plans, edges, sides, multiplicities, facings, marks];
        let buffers: Vec<_> = (0..).zip(buffers).collect();
        let kernel = self.kernel("ask_facings", &[], &buffers, self.count);
        Ok(Ask::Facings(kernel))
    }

    pub(super) fn count_edges(&self) -> Kernel {
        let Tables {
            blocks,
            plans,
            marks,
            multiplicities,
            corners,
            ..
        } = self.tables;
        let buffers = [blocks, plans, marks, multiplicities, corners];
        let buffers: Vec<_> = (0..).zip(buffers).collect();
        let constants = &self.weight_constants();
        self.kernel("count_edges", constants, &buffers, self.count)
    }

    pub(super) fn count_triangles(&self, capping: &Capping) -> Kernel {
        let Tables {
            blocks,
            plans,
            facings,
            corners,
            ..
        } = self.tables;
        let buffers = [(0, blocks), (1, plans), (2, facings), (3, corners)];
        let constants = &caps_constants(capping);
        self.kernel("count_triangles", constants, &buffers, self.count)
    }

    pub(super) fn emit(&self, capping: &Capping, round: u32) -> Emit {
        Emit {
            of_edges: self.emit_edges(round),
            of_triangles: self.emit_triangles(capping, round),
        }
    }

    /// See weights.wgsl.
    fn weight_constants(&self) -> [(&'static str, f64); 2] {
        [
            ("most_weight", f64::from(self.weights.most())),
            ("vertex_bits", f64::from(self.weights.vertex_bits)),
        ]
    }

    /// See elements.wgsl.
    fn round_constants(&self, round: u32) -> [(&'static str, f64); 2] {
        [
            ("corners_a_round", self.tables.corners_a_round as f64),
            ("this_round", f64::from(round)),
        ]
    }

    fn emit_edges(&self, round: u32) -> Kernel {
        let Tables {
            blocks,
            plans,
            edges,
            marks,
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
        let constants = [self.weight_constants(), self.round_constants(round)].concat();
        self.kernel("emit_edges", &constants, &buffers, self.count)
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
        self.kernel("emit_triangles", &constants, &buffers, self.count)
    }

    /// One workgroup.
    pub(super) fn sum_blocks(&self) -> Kernel {
        let buffers = [(0, &self.tables.corners)];
        self.kernel("sum_blocks", &[], &buffers, 1)
    }

    pub(super) fn make_draws(
        &self,
        count: u32,
        first_blocks: &wgpu::Buffer,
        draws: &wgpu::Buffer,
    ) -> Kernel {
        let buffers = [(0, &self.tables.corners), (1, first_blocks), (2, draws)];
        let constants = [
            ("draw_count", f64::from(count)),
            ("corners_a_round", self.tables.corners_a_round as f64),
            ("rounds", f64::from(self.tables.rounds)),
        ];
        self.kernel("make_draws", &constants, &buffers, count)
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
