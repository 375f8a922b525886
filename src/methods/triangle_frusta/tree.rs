//! The hierarchy of boxes around what a picture shows.

use crate::frame::{FrameResources, Input, PixelCompute, PixelKernel, read, write};
use crate::gpu::DeviceError;
use crate::methods::PrepareContext;
use crate::methods::view_samples::ViewSamples;
use wgpu::BufferUsages as Usage;

/// Pixels along a side of a tile. Twin of `TILE` in tree.wgsl, as is what follows.
const TILE: u32 = 4;
/// Bytes of a node.
const NODE_BYTES: u64 = 32;

/// The boxes of one picture, in a tree for each slice of depth.
pub(super) struct SampleTree {
    /// All nodes.
    pub(super) nodes: wgpu::Buffer,
    /// A word for each, not 0 where all its samples are in shadow.
    pub(super) dark: wgpu::Buffer,
    size: Size,
    bound_tiles: PixelCompute,
    /// From the lowest to the root, each with the number of its nodes in all trees.
    bound_nodes: Vec<(PixelCompute, u32)>,
    darken_tiles: PixelCompute,
}

/// How large the trees are.
#[derive(Clone, Copy)]
struct Size {
    /// Tiles along a side of a square, a power of 2.
    tiles: u32,
    slices: u32,
}

impl Size {
    /// Tiles of all trees.
    fn tile_count(self) -> u32 {
        self.tiles * self.tiles * self.slices
    }

    /// Nodes of all trees.
    fn node_count(self) -> u32 {
        (4 * self.tiles * self.tiles - 1) / 3 * self.slices
    }

    fn kernel(
        self,
        context: &PrepareContext<'_>,
        name: &str,
        constants: &[(&str, f64)],
        inputs: &[Input<'_>],
    ) -> PixelCompute {
        let size = [
            ("tiles", f64::from(self.tiles)),
            ("slices", f64::from(self.slices)),
        ];
        let kernel = PixelKernel {
            path: &format!("methods/triangle_frusta/{name}.wgsl"),
            constants: &[&size, constants].concat(),
            inputs,
        };
        PixelCompute::new(context.gpu, context.resources, &kernel)
    }
}

impl SampleTree {
    /// For pictures of the context's size.
    ///
    /// # Errors
    /// When the device cannot hold it.
    pub(super) fn new(
        context: &PrepareContext<'_>,
        slices: u32,
        samples: &ViewSamples,
    ) -> Result<Self, DeviceError> {
        let targets = &context.resources.targets;
        let tiles = targets.width.max(targets.height).div_ceil(TILE);
        let size = Size {
            tiles: tiles.next_power_of_two(),
            slices,
        };
        let gpu = context.gpu;
        let count = u64::from(size.node_count());
        let nodes = gpu.empty_buffer("boxes of tiles", NODE_BYTES * count, Usage::STORAGE)?;
        let usage = Usage::STORAGE | Usage::COPY_DST;
        let dark = gpu.empty_buffer("tiles in shadow", 4 * count, usage)?;
        let inputs = [read(&samples.buffer), write(&nodes)];
        let bound_tiles = size.kernel(context, "bound_tiles", &[], &inputs);
        let levels = size.tiles.ilog2();
        let of_level = |level: u32| {
            let count = 4_u32.pow(level);
            let constants = [
                ("first", f64::from((count - 1) / 3)),
                ("count", f64::from(count)),
            ];
            let inputs = [write(&nodes)];
            let kernel = size.kernel(context, "bound_nodes", &constants, &inputs);
            (kernel, count * slices)
        };
        let bound_nodes = (0..levels).rev().map(of_level).collect();
        let inputs = [read(&samples.buffer), read(&dark)];
        Ok(Self {
            darken_tiles: size.kernel(context, "darken_tiles", &[], &inputs),
            nodes,
            dark,
            size,
            bound_tiles,
            bound_nodes,
        })
    }

    /// A kernel that knows how large it is.
    pub(super) fn kernel(
        &self,
        context: &PrepareContext<'_>,
        name: &str,
        inputs: &[Input<'_>],
    ) -> PixelCompute {
        self.size.kernel(context, name, &[], inputs)
    }

    /// Forgets what is in shadow.
    pub(super) fn clear(&self, encoder: &mut wgpu::CommandEncoder) {
        encoder.clear_buffer(&self.dark, 0, None);
    }

    /// Makes the boxes.
    pub(super) fn build(&self, pass: &mut wgpu::ComputePass<'_>, resources: &FrameResources) {
        let tiles = self.size.tiles * self.size.tiles;
        self.bound_tiles.times(pass, resources, tiles);
        for (kernel, count) in &self.bound_nodes {
            kernel.times(pass, resources, *count);
        }
    }

    /// Brings the shadow of whole nodes to their pixels.
    pub(super) fn darken(&self, pass: &mut wgpu::ComputePass<'_>, resources: &FrameResources) {
        let count = self.size.tile_count();
        self.darken_tiles.times(pass, resources, count);
    }
}
