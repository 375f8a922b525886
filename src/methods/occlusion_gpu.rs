//! Shadow volumes that the device draws or not by its own answers: nothing is read back.
//!
//! Each leaf of the tree over the casters is asked about in each frame, as in [`super::occlusion`]; a compute pass turns the
//! answers into the numbers of indirect draws, one instance or none.

use super::occlusion::{OCCLUSION_STAGE, VolumeLook};
use super::plan::{CasterPlan, FramePlan};
use crate::frame::fullscreen::bind_group;
use crate::frame::occlusion::{BoxQueries, BoxTree, Look, Sight};
use crate::frame::{Frame, FrameResources};
use crate::geometry::VisibleFaces;
use crate::gpu::native::IndirectDraws;
use crate::gpu::{DeviceError, Gpu, Stage, shader};
use std::ops::Range;

/// Of a caster that is drawn whatever the device answers. Twin of `ALWAYS` in conditional_draws.wgsl.
const ALWAYS: u32 = u32::MAX;

/// Casters of a workgroup of the compute pass.
const GROUP: u32 = 64;

/// Bytes of a draw's numbers.
const DRAW_BYTES: u64 = IndirectDraws::INDEXED_STRIDE;

/// What the device is asked in a frame, and what it makes of its answers.
pub(super) struct DeviceOcclusion {
    tree: BoxTree,
    queries: BoxQueries,
    answers: wgpu::Buffer,
    /// The query of each caster.
    query_of: Vec<u32>,
    query_of_buffer: wgpu::Buffer,
    pipeline: wgpu::ComputePipeline,
    faces: VisibleFaces,
}

/// The draws of the same faces of all casters.
pub(super) struct ConditionalDraws {
    numbers: wgpu::Buffer,
    pub(super) draws: IndirectDraws,
    /// Whether they take elements of an index buffer.
    pub(super) is_indexed: bool,
    bound: wgpu::BindGroup,
}

impl DeviceOcclusion {
    pub(super) fn new(gpu: &Gpu, resources: &FrameResources) -> Result<Self, DeviceError> {
        let tree = BoxTree::new(&resources.extents.casters);
        let leaves = tree.nodes.iter().filter(|node| node.children.is_none());
        let casters = resources.extents.casters.len();
        let usage = wgpu::BufferUsages::STORAGE;
        let device = &gpu.device;
        Ok(Self {
            queries: BoxQueries::new(gpu, &resources.depth_buffer()),
            answers: gpu.empty_buffer(
                "what boxes answered",
                BoxQueries::answer_bytes(leaves.count() as u32),
                usage | wgpu::BufferUsages::QUERY_RESOLVE,
            )?,
            query_of: vec![ALWAYS; casters],
            query_of_buffer: gpu.empty_buffer(
                "the boxes of casters",
                4 * casters.max(1) as u64,
                usage | wgpu::BufferUsages::COPY_DST,
            )?,
            pipeline: device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some("conditional_draws"),
                layout: None,
                module: &shader::wgsl(device, "methods/volumes/conditional_draws.wgsl"),
                entry_point: Some("conditional_draws"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                cache: None,
            }),
            tree,
            faces: VisibleFaces::default(),
        })
    }

    /// For faces of as many elements of each caster as a frame says.
    pub(super) fn draws(
        &self,
        gpu: &Gpu,
        is_indexed: bool,
    ) -> Result<ConditionalDraws, DeviceError> {
        let usage = wgpu::BufferUsages::STORAGE
            | wgpu::BufferUsages::INDIRECT
            | wgpu::BufferUsages::COPY_DST;
        let bytes = DRAW_BYTES * self.query_of.len().max(1) as u64;
        let numbers = gpu.empty_buffer("conditional draws", bytes, usage)?;
        let layout = self.pipeline.get_bind_group_layout(0);
        let bound = [&self.answers, &self.query_of_buffer, &numbers];
        let bound = bound.map(wgpu::Buffer::as_entire_binding);
        Ok(ConditionalDraws {
            bound: bind_group(&gpu.device, &layout, &bound),
            draws: IndirectDraws::indexed(&gpu.device, &numbers)?,
            numbers,
            is_indexed,
        })
    }

    /// Records what asks about the casters that the plan draws.
    ///
    /// # Errors
    /// When the device is lost.
    pub(super) fn ask(
        &mut self,
        frame: &mut Frame<'_>,
        plan: &mut FramePlan,
    ) -> anyhow::Result<()> {
        let resources = frame.resources();
        let Self {
            tree,
            queries,
            answers,
            query_of,
            query_of_buffer,
            faces,
            ..
        } = self;
        frame.stage(OCCLUSION_STAGE, |stage| {
            stage.on_processor(|| {
                let look = VolumeLook::new(resources);
                faces.clear();
                query_of.fill(ALWAYS);
                let mut open: Vec<u32> =
                    (!tree.nodes.is_empty()).then_some(0).into_iter().collect();
                while let Some(number) = open.pop() {
                    let node = &tree.nodes[number as usize];
                    match (look.sight(node.bounds), node.children) {
                        (Sight::Out, _) => {}
                        (_, Some(children)) => open.extend(children),
                        (Sight::Around, None) => {}
                        (Sight::InView, None) => {
                            for &caster in tree.objects(number) {
                                query_of[caster as usize] = faces.ends.len() as u32;
                            }
                            look.push(faces, node.bounds);
                        }
                    }
                }
            });
            plan.queries = faces.ends.len() as u32;
            stage.upload(query_of_buffer, 0, bytemuck::cast_slice(query_of))?;
            queries.begin();
            queries.ask_into(stage, &resources.depth_buffer(), faces, answers)
        })
    }

    /// Records what sets the draws of some faces, given the elements of each caster, by the answers.
    ///
    /// # Errors
    /// When the device is lost.
    pub(super) fn set(
        &self,
        stage: &mut Stage<'_, '_>,
        to: &ConditionalDraws,
        (elements, casters): (&[Range<u32>], &[CasterPlan]),
    ) -> anyhow::Result<()> {
        let numbers = elements.iter().zip(casters).map(|(elements, plan)| {
            let count = if plan.is_drawn {
                elements.len() as u32
            } else {
                0
            };
            // What is first comes before the vertex to be added, or the instance; these are 0.
            [count, u32::from(count > 0), elements.start, 0, 0]
        });
        let numbers: Vec<[u32; 5]> = numbers.collect();
        if numbers.is_empty() {
            return Ok(());
        }
        stage.upload(&to.numbers, 0, bytemuck::cast_slice(&numbers))?;
        let mut pass = stage
            .encoder()
            .begin_compute_pass(&wgpu::ComputePassDescriptor::default());
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &to.bound, &[]);
        pass.dispatch_workgroups((numbers.len() as u32).div_ceil(GROUP), 1, 1);
        Ok(())
    }
}
