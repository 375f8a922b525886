//! What compute shaders know of the casters.

use super::Extraction;
use super::blocks::Blocks;
use crate::gpu::{DeviceError, Gpu};
use crate::methods::capping::{Caps, fan_apexes};
use crate::methods::device_edges::{self, EdgesAndSides, SidesBy};
use crate::methods::{Casters, MethodError, PrepareContext};
use wgpu::BufferUsages as Usage;

/// Most corners of the faces of an edge for each of its triangles: of a side quad and two triangles of fans, and of a side
/// of an open edge.
const CORNERS_A_SIDE: u64 = 6 + 6;
const CORNERS_OF_OPEN: u64 = 6;

/// Most corners of a triangle's caps.
const CORNERS_OF_CAPS: u64 = 6;

/// Buffers that do not change from frame to frame, and those that one shader leaves for another.
pub(super) struct Tables {
    pub(super) blocks: wgpu::Buffer,
    pub(super) edges: wgpu::Buffer,
    pub(super) indices: wgpu::Buffer,
    pub(super) apexes: wgpu::Buffer,
    /// A word for each caster.
    pub(super) plans: wgpu::Buffer,
    pub(super) facings: wgpu::Buffer,
    /// A bit for each edge of a block.
    pub(super) marks: wgpu::Buffer,
    pub(super) multiplicities: wgpu::Buffer,
    pub(super) corners: wgpu::Buffer,
    pub(super) elements: wgpu::Buffer,
    /// Corners that it holds; a multiple of 3.
    pub(super) corners_a_round: u64,
    /// How often it must be filled, so that the most corners that there may be come to be drawn.
    pub(super) rounds: u32,
}

impl Extraction {
    /// What it knows the triangles of an edge by.
    pub(super) fn sides_by(self) -> SidesBy {
        match self {
            Self::Clusters => SidesBy::OppositeVertex,
            Self::Facings => SidesBy::Triangle,
        }
    }
}

impl Tables {
    pub(super) fn new(
        context: &PrepareContext<'_>,
        blocks: &Blocks,
        (edges, sides): &EdgesAndSides,
        caps: Caps,
        most_bytes: u64,
    ) -> Result<Self, MethodError> {
        let gpu = context.gpu;
        let casters = &*context.casters;
        let (mesh, topology) = (&*casters.mesh, &**casters.topology());
        device_edges::check(topology, blocks.of_casters.len() - 1)?;
        let apexes = match caps {
            Caps::Fan => fan_apexes(mesh, topology),
            Caps::Triangles | Caps::FarTriangles => Vec::new(),
        };
        let triangles = mesh.triangles.len() as u64;
        let most_corners = most_corners(casters, sides.len() as u64);
        let most_bytes = most_bytes.min(most_bytes_of_device(gpu));
        let corners_a_round = most_corners.min(most_bytes / 12 * 3).max(3);
        if most_corners + corners_a_round > u64::from(u32::MAX) {
            let message = format!("{triangles} triangles may have more faces than it can number");
            return Err(MethodError::Unavailable(message));
        }
        let words = |what: &str, contents: &[u32]| words(gpu, what, contents);
        let empty = |what: &str, words: u64, usage| {
            gpu.empty_buffer(what, 4 * words, Usage::STORAGE | usage)
        };
        let none = Usage::empty();
        Ok(Self {
            blocks: words(
                "blocks of edges and triangles",
                bytemuck::cast_slice(&blocks.blocks),
            )?,
            edges: words("the edges", bytemuck::cast_slice(edges))?,
            indices: context.indices()?,
            apexes: words("where fans meet", &apexes)?,
            plans: empty(
                "plans of casters",
                blocks.of_casters.len() as u64,
                Usage::COPY_DST,
            )?,
            facings: empty("the facings of triangles", 2 * triangles.div_ceil(32), none)?,
            multiplicities: empty("the multiplicities of edges", edges.len() as u64, none)?,
            marks: empty(
                "the edges with faces",
                blocks.blocks.len() as u64,
                Usage::COPY_DST,
            )?,
            corners: empty(
                "numbers of corners",
                4 * (blocks.blocks.len() as u64 + 1),
                none,
            )?,
            elements: empty("the faces of shadow volumes", corners_a_round, Usage::INDEX)?,
            corners_a_round,
            rounds: most_corners.div_ceil(corners_a_round).max(1) as u32,
        })
    }
}

/// The most corners that the faces of all volumes may have, whatever the light.
fn most_corners(casters: &Casters, sides: u64) -> u64 {
    let open_edges = casters.open_edges();
    let open: u64 = (0..casters.mesh.caster_object_count())
        .flat_map(|caster| open_edges.of(caster))
        .map(|open| u64::from(open.multiplicity.unsigned_abs()))
        .sum();
    let triangles = casters.mesh.triangles.len() as u64;
    CORNERS_A_SIDE * sides + CORNERS_OF_OPEN * open + CORNERS_OF_CAPS * triangles
}

fn most_bytes_of_device(gpu: &Gpu) -> u64 {
    let limits = gpu.device.limits();
    limits
        .max_buffer_size
        .min(limits.max_storage_buffer_binding_size)
}

/// A buffer for shaders to read.
pub(super) fn words(gpu: &Gpu, what: &str, contents: &[u32]) -> Result<wgpu::Buffer, DeviceError> {
    gpu.buffer(what, bytemuck::cast_slice(contents), Usage::STORAGE)
}
