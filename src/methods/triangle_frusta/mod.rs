//! Each triangle's shadow frustum, held against a hierarchy of boxes around what the picture shows and then against the samples
//! of the tiles that it cuts: shadow volumes rasterised in compute, without silhouettes.

mod clusters;
mod tree;

use super::parts::{PartKernel, Parts};
use super::view_samples::ViewSamples;
use super::{Limit, MethodError, MethodInfo, PrepareContext, ShadowMethod, ray_limits};
use crate::frame::{Frame, PixelCompute, PreparedMethod, read, write};
use crate::geometry::rays::RayTriangle;
use tree::SampleTree;

/// What the method is.
pub(super) static INFO: MethodInfo = MethodInfo {
    id: "triangle_frusta",
    title: "a shadow frustum per triangle, in compute",
    source: "Sintorn, Olsson and Assarsson 2011; with slices, Sintorn, Kämpe, Olsson and Assarsson 2014",
    needs: &[],
    limits: &[
        ray_limits::LIMITS,
        &[Limit::in_words(
            "bias above 0: the shadow of what is nearer to a surface is lost, and light comes through at corners",
        )],
    ],
    clashes: &[],
    tolerated_share: 0.0,
};

/// Twin of `MOST_SLICES` in tree.wgsl.
const MOST_SLICES: u32 = 16;

crate::parameters! {
    /// The method with its parameters.
    pub(super) struct TriangleFrusta {
        slices: u32 = 4, in 1..=MOST_SLICES, "slices of depth whose samples have boxes of their own, two for each doubling of the distance: 1 for a hierarchical depth buffer alone, more for clusters";
        bias: f64 = 0.0, in 0.0..=1.0, "how far behind a triangle its shadow begins, in parts of the longest side of the scene's box";
    }
}

impl ShadowMethod for TriangleFrusta {
    fn info(&self) -> &'static MethodInfo {
        &INFO
    }

    fn prepare(
        &self,
        context: &PrepareContext<'_>,
    ) -> Result<Box<dyn PreparedMethod>, MethodError> {
        let bounds = context.resources.extents.scene;
        let bias = (self.bias * (bounds.high - bounds.low).max_element()) as f32;
        // In the order of a tree, neighbours in space are neighbours in memory.
        let mut triangles = context.casters.ray_tree().triangles.clone();
        for triangle in &mut triangles {
            triangle.contact += bias * triangle.double_area;
        }
        let frusta = match triangles.is_empty() {
            true => None,
            false => Some(Frusta::new(context, self.slices, &triangles)?),
        };
        Ok(Box::new(Prepared { frusta }))
    }
}

/// What casts the shadows of one scene on one picture.
struct Frusta {
    samples: ViewSamples,
    tree: SampleTree,
    parts: Parts,
    /// Of those that face the light, and of the others.
    cast_clusters: [PixelCompute; 2],
    cast_blocks: PartKernel,
    cluster_count: u32,
}

impl Frusta {
    fn new(
        context: &PrepareContext<'_>,
        slices: u32,
        triangles: &[RayTriangle],
    ) -> Result<Self, MethodError> {
        let buffer = |what, bytes| context.gpu.buffer(what, bytes, wgpu::BufferUsages::STORAGE);
        let casters = buffer("the triangles that cast", bytemuck::cast_slice(triangles))?;
        let clusters = clusters::of(&context.scene.mesh, triangles);
        let cluster_count = clusters.len() as u32;
        let clusters = buffer("clusters of triangles", bytemuck::cast_slice(&clusters))?;
        let samples = ViewSamples::new(context)?;
        let tree = SampleTree::new(context, slices, &samples)?;
        let parts = Parts::new(context)?;
        let inputs = [
            write(&parts.buffer),
            read(&casters),
            read(&samples.corners),
            read(&tree.centres),
            write(&tree.dark),
            read(&samples.points),
            read(&samples.ways),
            read(&tree.extents),
        ];
        let with_clusters = [&inputs[..], &[read(&clusters)]].concat();
        let cast_blocks = tree.kernel(context, "cast_blocks", &[], &inputs);
        Ok(Self {
            cast_clusters: [1.0, 0.0].map(|is_facing| {
                let constants = [("is_facing", is_facing)];
                tree.kernel(context, "cast_clusters", &constants, &with_clusters)
            }),
            cast_blocks: parts.kernel(context, cast_blocks)?,
            samples,
            tree,
            parts,
            cluster_count,
        })
    }
}

/// The method made ready.
struct Prepared {
    /// `None` where nothing casts.
    frusta: Option<Frusta>,
}

impl PreparedMethod for Prepared {
    fn record(&mut self, frame: &mut Frame<'_>) -> anyhow::Result<()> {
        let resources = frame.resources();
        let Some(frusta) = &self.frusta else {
            return Ok(());
        };
        let pass = wgpu::ComputePassDescriptor::default();
        frame.stage("samples", |stage| {
            let encoder = stage.encoder();
            resources.take_mask(encoder);
            frusta.tree.clear(encoder);
            let mut pass = encoder.begin_compute_pass(&pass);
            frusta.samples.record(&mut pass, resources);
        });
        frame.stage("tree", |stage| {
            let mut pass = stage.encoder().begin_compute_pass(&pass);
            frusta.tree.build(&mut pass, resources);
        });
        frame.stage("triangles", |stage| {
            let encoder = stage.encoder();
            for cast_clusters in &frusta.cast_clusters {
                frusta.parts.clear(encoder);
                let mut pass = encoder.begin_compute_pass(&pass);
                cast_clusters.times(&mut pass, resources, frusta.cluster_count);
                frusta.cast_blocks.record(&mut pass, resources);
                frusta.tree.darken(&mut pass, resources);
            }
            resources.give_mask(encoder);
        });
        Ok(())
    }

    fn counters(&self) -> Vec<(&'static str, u64)> {
        let count = |frusta: &Frusta| vec![("clusters", u64::from(frusta.cluster_count))];
        self.frusta.as_ref().map_or_else(Vec::new, count)
    }
}
