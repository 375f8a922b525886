//! The hierarchy of boxes around what a picture shows.

use crate::frame::{FrameResources, Input, PixelCompute, PixelKernel, read, write};
use crate::gpu::DeviceError;
use crate::methods::PrepareContext;
use crate::methods::view_samples::{ViewSamples, scene_rounding};
use wgpu::BufferUsages as Usage;

/// Pixels along a side of a tile. Twin of `TILE` in tree.wgsl, as is what follows.
const TILE: u32 = 4;
/// Tiles along a side of a block.
const BLOCK_TILES: u32 = 4;
/// Bytes of either half of a node.
const NODE_BYTES: u64 = 16;

/// The boxes of one picture, in a tree for each slice of depth.
pub(super) struct SampleTree {
    /// The middles of all boxes.
    pub(super) centres: wgpu::Buffer,
    /// Half their sides.
    pub(super) extents: wgpu::Buffer,
    /// A word for each, not 0 where all its samples are in shadow.
    pub(super) dark: wgpu::Buffer,
    size: Size,
    bound_tiles: PixelCompute,
    bound_nodes: Levels,
    darken_tiles: PixelCompute,
    darken_nodes: Levels,
}

/// How large the trees are.
#[derive(Clone, Copy)]
struct Size {
    /// Tiles along a side of a square, a power of 2.
    side: u32,
    /// Trees.
    slices: u32,
}

impl Size {
    /// Tiles of one tree.
    fn tiles(self) -> u32 {
        self.side * self.side
    }

    /// Nodes of all trees.
    fn nodes(self) -> u32 {
        (4 * self.tiles() - 1) / 3 * self.slices
    }

    fn kernel(
        self,
        context: &PrepareContext<'_>,
        name: &str,
        constants: &[(&str, f64)],
        inputs: &[Input<'_>],
    ) -> PixelCompute {
        let size = [
            ("tiles", f64::from(self.side)),
            ("slices", f64::from(self.slices)),
            scene_rounding(context),
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
        let side = targets.width.max(targets.height).div_ceil(TILE);
        let size = Size {
            side: side.max(BLOCK_TILES).next_power_of_two(),
            slices,
        };
        let gpu = context.gpu;
        let count = u64::from(size.nodes());
        let of_each = || gpu.empty_buffer("boxes of tiles", NODE_BYTES * count, Usage::STORAGE);
        let (centres, extents) = (of_each()?, of_each()?);
        let usage = Usage::STORAGE | Usage::COPY_DST;
        let dark = gpu.empty_buffer("tiles in shadow", 4 * count, usage)?;
        let inputs = [
            read(&samples.corners),
            write(&samples.ways),
            write(&centres),
            write(&extents),
        ];
        let bound_tiles = size.kernel(context, "bound_tiles", &[], &inputs);
        let inputs = [read(&samples.ways), write(&dark)];
        Ok(Self {
            bound_nodes: Levels::new(context, size, "bound_nodes", &[&centres, &extents]),
            darken_tiles: size.kernel(context, "darken_tiles", &[], &inputs),
            darken_nodes: Levels::new(context, size, "darken_nodes", &[&dark]),
            centres,
            extents,
            dark,
            size,
            bound_tiles,
        })
    }

    /// A kernel that knows how large it is.
    pub(super) fn kernel(
        &self,
        context: &PrepareContext<'_>,
        name: &str,
        constants: &[(&str, f64)],
        inputs: &[Input<'_>],
    ) -> PixelCompute {
        self.size.kernel(context, name, constants, inputs)
    }

    /// Forgets what is in shadow.
    pub(super) fn clear(&self, encoder: &mut wgpu::CommandEncoder) {
        encoder.clear_buffer(&self.dark, 0, None);
    }

    /// Makes the boxes.
    pub(super) fn build(&self, pass: &mut wgpu::ComputePass<'_>, resources: &FrameResources) {
        self.bound_tiles.times(pass, resources, self.size.tiles());
        self.bound_nodes.record(pass, resources);
    }

    /// Brings the shadow of whole nodes to their pixels, and finds what nodes have no others left.
    pub(super) fn darken(&self, pass: &mut wgpu::ComputePass<'_>, resources: &FrameResources) {
        self.darken_tiles.times(pass, resources, self.size.tiles());
        self.darken_nodes.record(pass, resources);
    }
}

/// What goes from the level above tiles up to the root, each with the number of its nodes in all trees.
struct Levels(Vec<(PixelCompute, u32)>);

impl Levels {
    fn new(
        context: &PrepareContext<'_>,
        size: Size,
        name: &str,
        buffers: &[&wgpu::Buffer],
    ) -> Self {
        let inputs: Vec<_> = buffers.iter().map(|buffer| write(buffer)).collect();
        let of_level = |level: u32| {
            let count = 4_u32.pow(level);
            let constants = [
                ("first", f64::from((count - 1) / 3)),
                ("count", f64::from(count)),
            ];
            let kernel = size.kernel(context, name, &constants, &inputs);
            (kernel, count * size.slices)
        };
        Self((0..size.side.ilog2()).rev().map(of_level).collect())
    }

    fn record(&self, pass: &mut wgpu::ComputePass<'_>, resources: &FrameResources) {
        for (kernel, count) in &self.0 {
            kernel.times(pass, resources, *count);
        }
    }
}
