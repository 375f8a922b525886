//! Triangles that are held against boxes together.

use crate::geometry::rays::RayTriangle;
use crate::scene::Mesh;
use bytemuck::{Pod, Zeroable};
use glam::Vec3;

/// How many a cluster has. Twin of `CLUSTER` in frustum.wgsl.
const CLUSTER: usize = 32;

/// The box of a cluster. Twin of `Cluster` in cast_clusters.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
pub(super) struct Cluster {
    low: Vec3,
    unused_low: u32,
    high: Vec3,
    unused_high: u32,
    normal: Vec3,
    unused_normal: u32,
}

/// The clusters of triangles, which lie together where their numbers do.
pub(super) fn of(mesh: &Mesh, triangles: &[RayTriangle]) -> Vec<Cluster> {
    let normal = |triangle: &RayTriangle| {
        let corners = mesh.triangles[triangle.number as usize];
        let [a, b, c] = corners.map(|vertex| mesh.positions[vertex as usize]);
        (b - a).cross(c - a)
    };
    let around = |triangles: &[RayTriangle]| {
        let corners = || triangles.iter().flat_map(RayTriangle::corners);
        Cluster {
            low: corners().fold(Vec3::INFINITY, Vec3::min),
            unused_low: 0,
            high: corners().fold(Vec3::NEG_INFINITY, Vec3::max),
            unused_high: 0,
            normal: triangles.iter().map(normal).sum(),
            unused_normal: 0,
        }
    };
    triangles.chunks(CLUSTER).map(around).collect()
}
