//! Edges grouped for the device: what a [`PlaneTree`](super::PlaneTree) is on one level.

use super::lanes::OneBox;
use super::plane_tree::PlaneOrder;
use super::planes::Origin;
use crate::geometry::Topology;
use crate::scene::mesh::Mesh;
use bytemuck::{Pod, Zeroable};
use glam::Vec4;
use rayon::prelude::*;

/// A box in four dimensions around the planes of a cluster's edges. Twin of `Cluster` in
/// `shaders/methods/silhouette_cs/ask_clusters.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct ClusterBox {
    low: [f32; 4],
    high: [f32; 4],
    /// What rounding grows by, with the light's place and with its `w`.
    doubt: [f32; 2],
    unused: [f32; 2],
}

/// A light as a hyperplane. Twin of `DualLight` in `shaders/methods/silhouette_cs/ask_clusters.wgsl`.
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
    /// The edges of all clusters: [`Self::EDGES`] each, but for the last.
    pub edges: Vec<u32>,
}

/// Around all planes: edges of which nothing is known are in clusters that meet every light.
const ALL_PLANES: ClusterBox = ClusterBox {
    low: [-1.0; 4],
    high: [1.0; 4],
    doubt: [0.0; 2],
    unused: [0.0; 2],
};

impl EdgeClusters {
    /// The edges of a cluster.
    pub const EDGES: usize = 16;

    /// Builds them, on all cores. Some edges are to be asked for `always`, whatever their planes say.
    pub fn build(mesh: &Mesh, topology: &Topology, always: impl Fn(u32) -> bool) -> Self {
        let order = PlaneOrder::new(mesh, topology);
        // What rounding may do beyond all numbers, a device need not tell from none.
        let is_known = |edge: u32| order.planes[edge as usize].doubt.is_finite();
        let in_order = order.items.iter().map(|item| item.edge);
        let (mut edges, mut others): (Vec<_>, Vec<_>) =
            in_order.partition(|edge| is_known(*edge) && !always(*edge));
        others.extend(order.others());
        others.sort_unstable();
        let around = |edges: &[u32]| {
            let boxes = edges
                .iter()
                .map(|edge| OneBox::from(&order.planes[*edge as usize]));
            let around = boxes.fold(OneBox::EMPTY, OneBox::union);
            ClusterBox {
                low: around.low.to_array(),
                high: around.high.to_array(),
                doubt: around.doubt.to_array(),
                unused: [0.0; 2],
            }
        };
        let mut boxes: Vec<_> = edges.par_chunks(Self::EDGES).map(around).collect();
        // Those of the last cluster with a box are few, and may be asked for every light.
        let rest = edges.len() % Self::EDGES;
        if rest > 0 {
            others.splice(0..0, edges.drain(edges.len() - rest..));
            boxes.pop();
        }
        boxes.resize(boxes.len() + others.len().div_ceil(Self::EDGES), ALL_PLANES);
        edges.extend(others);
        Self {
            origin: order.origin,
            boxes,
            edges,
        }
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
