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
use crate::methods::volume_parameters::FrontCap;
use wgpu::BufferUsages as Usage;

/// Twin of `EDGES` in ask_clusters.wgsl.
const EDGES_A_CLUSTER: usize = 16;

/// How silhouette edges are found.
pub(super) enum Ask {
    Clusters {
        clusters: EdgeClusters,
        kernel: Kernel,
        light: wgpu::Buffer,
    },
    /// Of facings that are known.
    Facings(Kernel),
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
            gpu,
            resources,
            ref casters,
            ..
        } = *self.context;
        let (topology, triangles) = (casters.topology(), casters.edge_triangles());
        // Triangles that face the light may have such an edge on their silhouette where all together have not.
        let is_irregular = |edge: u32| is_irregular(triangles.of(topology.edges[edge as usize]));
        let all = 0..topology.edges.len() as u32;
        let (mesh, groups) = (&casters.mesh, std::slice::from_ref(&all));
        let clusters = EdgeClusters::build(mesh, topology, groups, EDGES_A_CLUSTER, is_irregular);
        let edges = clusters.edges.iter();
        let edges: Vec<_> = edges
            .map(|edge| [*edge, blocks.bits.get(*edge as usize).copied().unwrap_or(0)])
            .collect();
        let boxes = self.boxes(&clusters)?;
        let cluster_edges = bytemuck::cast_slice(&edges);
        let cluster_edges = words(gpu, "the edges of clusters", cluster_edges)?;
        let light = gpu.empty_buffer(
            "the light of clusters",
            size_of::<ClusterLight>() as u64,
            Usage::UNIFORM | Usage::COPY_DST,
        )?;
        let Tables {
            plans,
            edges,
            sides,
            multiplicities,
            marks,
            ..
        } = self.tables;
        let buffers = [
            &boxes,
            plans,
            edges,
            sides,
            multiplicities,
            &cluster_edges,
            &resources.scene.positions,
            marks,
        ];
        let buffers: Vec<_> = (0..).zip(buffers).collect();
        let uniforms = [(0, &resources.uniform.buffer), (1, &light)];
        let bound = (&uniforms[..], &buffers[..]);
        let kernel = self.kernel_with("ask_clusters", &[], bound, clusters.boxes.len() as u32);
        // The device has them.
        let clusters = clusters.without_edges();
        Ok(Ask::Clusters {
            clusters,
            kernel,
            light,
        })
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

    pub(super) fn ask_facings(&self) -> Ask {
        let Tables {
            blocks,
            plans,
            edges,
            sides,
            multiplicities,
            facings,
            marks,
            ..
        } = self.tables;
        let buffers = [blocks, plans, edges, sides, multiplicities, facings, marks];
        let buffers: Vec<_> = (0..).zip(buffers).collect();
        Ask::Facings(self.kernel("ask_facings", &[], &buffers, self.count))
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
