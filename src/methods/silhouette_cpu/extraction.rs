//! The ways in which silhouettes are found.

use crate::geometry::Topology;
use crate::geometry::silhouette::{BruteForce, Hextree, PlaneTree, SilhouetteEdge};
use crate::scene::Mesh;
use glam::Vec4;
use serde::{Deserialize, Serialize};

/// How silhouettes are found.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Extraction {
    /// Every edge is asked.
    BruteForce,
    /// In dual space, by the tree of Wallner 2006.
    Hextree,
    /// In dual space, by a balanced tree over edges.
    #[default]
    PlaneTree,
}

/// One of them, ready for a scene.
pub(super) enum Extractor {
    BruteForce(Box<BruteForce>),
    Hextree(Hextree),
    PlaneTree(PlaneTree),
}

impl Extractor {
    pub(super) fn new(
        extraction: Extraction,
        hextree_depth: u32,
        mesh: &Mesh,
        topology: &Topology,
    ) -> Self {
        match extraction {
            Extraction::BruteForce => Self::BruteForce(Box::new(BruteForce::build(mesh, topology))),
            Extraction::Hextree => Self::Hextree(Hextree::build(mesh, topology, hextree_depth)),
            Extraction::PlaneTree => Self::PlaneTree(PlaneTree::build(mesh, topology)),
        }
    }

    /// Finds the silhouette, in any order.
    pub(super) fn silhouette(
        &mut self,
        mesh: &Mesh,
        topology: &Topology,
        light: Vec4,
        found: &mut Vec<SilhouetteEdge>,
    ) {
        match self {
            Self::BruteForce(brute_force) => brute_force.silhouette(mesh, topology, light, found),
            Self::Hextree(tree) => tree.silhouette(mesh, topology, light, found),
            Self::PlaneTree(tree) => tree.silhouette(mesh, topology, light, found),
        }
    }
}
