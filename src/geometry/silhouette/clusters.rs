//! Edges grouped for the device: what a [`PlaneTree`](super::PlaneTree) is on one level.

use super::lanes::OneBox;
use super::plane_tree::PlaneOrder;
use super::planes::{EdgePlanes, Origin};
use crate::geometry::Topology;
use crate::scene::mesh::Mesh;
use bytemuck::{Pod, Zeroable};
use glam::Vec4;
use rayon::prelude::*;
use std::ops::Range;

/// A box in four dimensions around the planes of a cluster's edges. Twin of `Cluster` in
/// `shaders/methods/silhouette_cs/ask_clusters.wgsl` and `shaders/methods/silhouette_ms/clusters.glsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct ClusterBox {
    low: [f32; 4],
    high: [f32; 4],
    /// What rounding grows by, with the light's place and with its `w`.
    doubt: [f32; 2],
    unused: [f32; 2],
}

/// A light as a hyperplane. Twin of `DualLight` in the same shaders.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct ClusterLight {
    light: [f32; 4],
    size: [f32; 2],
    unused: [f32; 2],
}

/// The edges of a mesh in clusters by the planes of their triangles. A cluster whose box lies on one side of the
/// light's hyperplane has no silhouette edge.
pub struct EdgeClusters {
    origin: Origin,
    /// The clusters.
    pub boxes: Vec<ClusterBox>,
    /// The edges of all clusters, as many each; in two of a group, the last one with a box and the last one of edges that every
    /// light asks, there may be [`Self::NO_EDGE`] instead.
    pub edges: Vec<u32>,
    /// The clusters of each group.
    pub of_groups: Vec<Range<u32>>,
}

/// Around all planes: edges of which nothing is known are in clusters that meet every light.
const ALL_PLANES: ClusterBox = ClusterBox {
    low: [-1.0; 4],
    high: [1.0; 4],
    doubt: [0.0; 2],
    unused: [0.0; 2],
};

impl EdgeClusters {
    /// Where a cluster has fewer edges than others.
    pub const NO_EDGE: u32 = u32::MAX;

    /// Builds them, on all cores, of so many edges each. No cluster has edges of two groups, which follow each other. Some edges
    /// are to be asked for `always`, whatever their planes say.
    pub fn build(
        mesh: &Mesh,
        topology: &Topology,
        groups: &[Range<u32>],
        size: usize,
        always: impl Fn(u32) -> bool,
    ) -> Self {
        let order = PlaneOrder::new(mesh, topology);
        // What rounding may do beyond all numbers, a device need not tell from none.
        let is_known = |edge: u32| order.planes[edge as usize].doubt.is_finite();
        let in_order = order.items.iter().map(|item| item.edge);
        let (known, mut others): (Vec<_>, Vec<_>) =
            in_order.partition(|edge| is_known(*edge) && !always(*edge));
        others.extend(order.others());
        others.sort_unstable();
        let (known, others) = (by_group(groups, &known), by_group(groups, &others));
        let mut all = Self {
            boxes: Vec::with_capacity(topology.edges.len() / size + groups.len()),
            edges: Vec::with_capacity(topology.edges.len()),
            of_groups: Vec::with_capacity(groups.len()),
            origin: order.origin,
        };
        for (edges, others) in known.into_iter().zip(others) {
            let first = all.boxes.len();
            let around = |edges: &[u32]| around(edges, &order.planes);
            all.boxes.par_extend(edges.par_chunks(size).map(around));
            let of_others = others.len().div_ceil(size);
            all.boxes.resize(all.boxes.len() + of_others, ALL_PLANES);
            all.edges.extend(edges);
            // The last one with a box may be short.
            all.edges
                .resize(size * (all.boxes.len() - of_others), Self::NO_EDGE);
            all.edges.extend(others);
            all.edges.resize(size * all.boxes.len(), Self::NO_EDGE);
            all.of_groups.push(first as u32..all.boxes.len() as u32);
        }
        all
    }

    /// What is left to do without them, once a device has the boxes and edges.
    #[must_use]
    pub fn without_edges(self) -> Self {
        Self {
            boxes: Vec::new(),
            edges: Vec::new(),
            ..self
        }
    }

    /// A light to hold against the boxes.
    pub fn light(&self, light: Vec4) -> ClusterLight {
        let (light, size) = self.origin.light(light).components();
        ClusterLight {
            light,
            size,
            unused: [0.0; 2],
        }
    }
}

/// Of edges those of each group, in the same order.
fn by_group(groups: &[Range<u32>], edges: &[u32]) -> Vec<Vec<u32>> {
    let mut of_groups = vec![Vec::new(); groups.len()];
    for &edge in edges {
        let group = groups.partition_point(|group| group.end <= edge);
        of_groups[group].push(edge);
    }
    of_groups
}

/// The box around the planes of edges.
fn around(edges: &[u32], planes: &[EdgePlanes]) -> ClusterBox {
    let boxes = edges
        .iter()
        .map(|edge| OneBox::from(&planes[*edge as usize]));
    let around = boxes.fold(OneBox::EMPTY, OneBox::union);
    ClusterBox {
        low: around.low.to_array(),
        high: around.high.to_array(),
        doubt: around.doubt.to_array(),
        unused: [0.0; 2],
    }
}
