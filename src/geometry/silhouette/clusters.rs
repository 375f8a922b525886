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
/// `shaders/methods/silhouette_cs/clusters.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct ClusterBox {
    low: [f32; 4],
    high: [f32; 4],
    /// What rounding grows by, with the light's place and with its `w`.
    doubt: [f32; 2],
    unused: [f32; 2],
}

/// A light as a hyperplane. Twin of `DualLight` in `shaders/methods/silhouette_cs/clusters.wgsl`.
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
    /// Edges in no cluster: they may be on the silhouette of any light.
    pub others: Vec<u32>,
}

impl EdgeClusters {
    /// The edges of a cluster.
    pub const EDGES: usize = 32;

    /// Builds them, on all cores.
    pub fn build(mesh: &Mesh, topology: &Topology) -> Self {
        let order = PlaneOrder::new(mesh, topology);
        let mut others: Vec<u32> = order.others().collect();
        // What rounding may do beyond all numbers, a device need not tell from none.
        let is_known = |edge: u32| order.planes[edge as usize].doubt.is_finite();
        let edges = order.items.iter().map(|item| item.edge);
        let (edges, unknown): (Vec<_>, Vec<_>) = edges.partition(|edge| is_known(*edge));
        others.extend(unknown);
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
        Self {
            origin: order.origin,
            boxes: edges.par_chunks(Self::EDGES).map(around).collect(),
            edges,
            others,
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
