//! The map of a light, and the kernels that fill and read it.

use super::{AliasFreeMap, Lists};
use crate::frame::{FrameResources, Input, PixelCompute, PixelKernel, read, write};
use crate::geometry::rays::casters;
use crate::gpu::DeviceError;
use crate::methods::PrepareContext;
use crate::methods::parts::{PartKernel, Parts};
use crate::methods::view_samples::{ViewSamples, scene_rounding};
use wgpu::BufferUsages as Usage;

/// Cells along a side of a tile. Twin of `TILE` in light_map.wgsl, as is what follows.
const TILE: u32 = 32;
/// Words of a tile.
const TILE_WORDS: u32 = 2 * (TILE * TILE + 1);
/// Samples that an invocation of `fit` looks at.
const PIXELS: u32 = 64;
/// Faces of the map of a lamp; a light at infinity uses one of them.
const FACES: u32 = 6;
/// The map of one scene and picture.
pub(super) struct LightMap {
    ranges: wgpu::Buffer,
    cells: wgpu::Buffer,
    fit: PixelCompute,
    place_samples: PixelCompute,
    sort: Option<Sort>,
    cover: Cover,
    sample_count: u32,
    tile_count: u32,
}

impl LightMap {
    /// `None` where nothing casts.
    ///
    /// # Errors
    /// When the device cannot hold it.
    pub(super) fn new(
        context: &PrepareContext<'_>,
        parameters: &AliasFreeMap,
        samples: &ViewSamples,
    ) -> Result<Option<Self>, DeviceError> {
        let gpu = context.gpu;
        let triangles = casters(&context.scene.mesh);
        if triangles.is_empty() {
            return Ok(None);
        }
        let tiles = parameters.resolution.div_ceil(TILE);
        let is_sorted = parameters.lists == Lists::Sorted;
        let maker = Maker {
            context,
            constants: [
                ("resolution", f64::from(tiles * TILE)),
                ("is_sorted", f64::from(u8::from(is_sorted))),
                scene_rounding(context),
            ],
        };
        let tile_count = FACES * tiles * tiles;
        let bytes = bytemuck::cast_slice(&triangles);
        let casters = gpu.buffer("the triangles that cast", bytes, Usage::STORAGE)?;
        let cell_words = tile_count * TILE_WORDS;
        let cells = maker.words("the cells of a light's map", cell_words, Usage::COPY_DST)?;
        let ranges = maker.words("the ranges of a light's map", 4 * FACES, Usage::COPY_DST)?;
        let ViewSamples { corners, ways, .. } = samples;
        let inputs = [read(corners), read(ways), write(&ranges)];
        let fit = maker.kernel("fit", &inputs);
        let inputs = [
            read(corners),
            read(&ranges),
            write(&cells),
            write(&samples.points),
            write(ways),
        ];
        let place_samples = maker.kernel("place_samples", &inputs);
        let sort = match is_sorted {
            true => Some(Sort::new(&maker, samples, &cells)?),
            false => None,
        };
        let listed = sort.as_ref().map_or(&samples.points, |sort| &sort.points);
        let read_by_triangles = [&casters, corners, &ranges, &cells, listed, ways].map(read);
        Ok(Some(Self {
            cover: Cover::new(&maker, &read_by_triangles, triangles.len() as u32)?,
            ranges,
            cells,
            fit,
            place_samples,
            sort,
            sample_count: samples.count,
            tile_count,
        }))
    }

    /// Empties it.
    pub(super) fn clear(&self, encoder: &mut wgpu::CommandEncoder) {
        encoder.clear_buffer(&self.ranges, 0, None);
        encoder.clear_buffer(&self.cells, 0, None);
        self.cover.parts.clear(encoder);
        if let Some(sort) = &self.sort {
            encoder.clear_buffer(&sort.taken, 0, None);
        }
    }

    /// Brings the samples into the lists of their cells.
    pub(super) fn list(&self, pass: &mut wgpu::ComputePass<'_>, resources: &FrameResources) {
        let invocations = self.sample_count.div_ceil(PIXELS);
        self.fit.times(pass, resources, invocations);
        self.place_samples.for_pixels(pass, resources);
        if let Some(sort) = &self.sort {
            sort.allot.times(pass, resources, self.tile_count);
            sort.sort_samples.for_pixels(pass, resources);
        }
    }

    /// Shadows what the triangles cover.
    pub(super) fn cover(&self, pass: &mut wgpu::ComputePass<'_>, resources: &FrameResources) {
        self.cover.record(pass, resources);
    }

    /// What is counted of it, by name.
    pub(super) fn counters(&self) -> Vec<(&'static str, u64)> {
        vec![("light_map_bytes", self.cells.size())]
    }
}

/// What makes sorted lists.
struct Sort {
    taken: wgpu::Buffer,
    /// All lists, one after another.
    points: wgpu::Buffer,
    allot: PixelCompute,
    sort_samples: PixelCompute,
}

impl Sort {
    fn new(
        maker: &Maker<'_>,
        samples: &ViewSamples,
        cells: &wgpu::Buffer,
    ) -> Result<Self, DeviceError> {
        let points = maker.words("sorted points", 4 * samples.count, Usage::empty())?;
        let taken = maker.words("how many samples are sorted", 4, Usage::COPY_DST)?;
        let inputs = [
            read(&samples.ways),
            read(cells),
            read(&samples.points),
            write(&points),
        ];
        Ok(Self {
            allot: maker.kernel("allot", &[write(cells), write(&taken)]),
            sort_samples: maker.kernel("sort_samples", &inputs),
            taken,
            points,
        })
    }
}

/// What holds triangles against the samples.
struct Cover {
    parts: Parts,
    cover: PixelCompute,
    cover_parts: PartKernel,
    triangle_count: u32,
}

impl Cover {
    fn new(
        maker: &Maker<'_>,
        inputs: &[Input<'_>],
        triangle_count: u32,
    ) -> Result<Self, DeviceError> {
        let parts = Parts::new(maker.context)?;
        let inputs = [&[write(&parts.buffer)], inputs].concat();
        let cover_parts = maker.kernel("cover_parts", &inputs);
        Ok(Self {
            cover: maker.kernel("cover", &inputs),
            cover_parts: parts.kernel(maker.context, cover_parts)?,
            parts,
            triangle_count,
        })
    }

    fn record(&self, pass: &mut wgpu::ComputePass<'_>, resources: &FrameResources) {
        self.cover.times(pass, resources, self.triangle_count);
        self.cover_parts.record(pass, resources);
    }
}

/// Makes buffers and kernels.
struct Maker<'a> {
    context: &'a PrepareContext<'a>,
    /// Of all kernels.
    constants: [(&'static str, f64); 3],
}

impl Maker<'_> {
    fn words(&self, what: &str, words: u32, usage: Usage) -> Result<wgpu::Buffer, DeviceError> {
        let gpu = self.context.gpu;
        gpu.empty_buffer(what, 4 * u64::from(words), Usage::STORAGE | usage)
    }

    fn kernel(&self, name: &str, inputs: &[Input<'_>]) -> PixelCompute {
        let kernel = PixelKernel {
            path: &format!("methods/alias_free_map/{name}.wgsl"),
            constants: &self.constants,
            inputs,
        };
        PixelCompute::new(self.context.gpu, self.context.resources, &kernel)
    }
}
