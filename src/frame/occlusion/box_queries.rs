//! Draws boxes against the depth buffer and counts what passes.

use crate::frame::{FrameUniform, Targets};
use crate::geometry::VisibleFaces;
use crate::gpu::{DepthDirection, Gpu, Stage, Ticket, shader};
use std::ops::Range;

/// Most queries of a set.
const MOST_IN_SET: u32 = wgpu::QUERY_SET_MAX_QUERIES;

/// Bytes of a corner.
const CORNER_BYTES: u64 = 16;

/// What boxes are drawn against, as a view sees it.
#[derive(Clone, Copy)]
pub struct DepthBuffer<'a> {
    /// With the view.
    pub uniform: &'a FrameUniform,
    /// With the depth.
    pub targets: &'a Targets,
    /// Which way it runs.
    pub direction: DepthDirection,
}

/// Draws boxes with an occlusion query each.
pub struct BoxQueries {
    pipeline: wgpu::RenderPipeline,
    corners: wgpu::Buffer,
    sets: Vec<wgpu::QuerySet>,
    /// Of the sets, how many queries were made in this frame.
    made: u32,
}

impl BoxQueries {
    /// For frames with this depth buffer.
    pub fn new(gpu: &Gpu, depth: &DepthBuffer<'_>) -> Self {
        let device = &gpu.device;
        let module = shader::wgsl(device, "frame/boxes.wgsl");
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("boxes"),
            bind_group_layouts: &[Some(&depth.uniform.layout)],
            ..Default::default()
        });
        let corners = wgpu::VertexBufferLayout {
            array_stride: CORNER_BYTES,
            step_mode: wgpu::VertexStepMode::Vertex,
            attributes: &wgpu::vertex_attr_array![0 => Float32x4],
        };
        let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("boxes"),
            layout: Some(&layout),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("vertex"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: &[Some(corners)],
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: Some(wgpu::DepthStencilState {
                format: depth.targets.depth.format(),
                depth_write_enabled: Some(false),
                depth_compare: Some(depth.direction.nearer()),
                stencil: wgpu::StencilState::default(),
                bias: wgpu::DepthBiasState::default(),
            }),
            multisample: wgpu::MultisampleState::default(),
            fragment: None,
            multiview_mask: None,
            cache: None,
        });
        Self {
            pipeline,
            corners: corners_buffer(gpu, 1 << 12),
            sets: Vec::new(),
            made: 0,
        }
    }

    /// The first query of a frame comes next.
    pub fn begin(&mut self) {
        self.made = 0;
    }

    /// Asks about boxes; the answers come in their order, 8 bytes each: how many samples passed, or any number but 0 in its
    /// place.
    ///
    /// # Errors
    /// When the device is lost or has no memory for the boxes.
    pub fn ask(
        &mut self,
        stage: &mut Stage<'_, '_>,
        depth: &DepthBuffer<'_>,
        boxes: &VisibleFaces,
    ) -> anyhow::Result<Vec<Ticket>> {
        self.upload(stage, boxes)?;
        let made = self.draw_all(stage, depth, boxes);
        let read = |(set, places): (usize, Range<u32>)| stage.read_queries(&self.sets[set], places);
        Ok(made.into_iter().map(read).collect())
    }

    /// Asks about all boxes of a frame; the answers come to a buffer of at least [`Self::answer_bytes`].
    ///
    /// # Errors
    /// As [`Self::ask`].
    pub fn ask_into(
        &mut self,
        stage: &mut Stage<'_, '_>,
        depth: &DepthBuffer<'_>,
        boxes: &VisibleFaces,
        answers: &wgpu::Buffer,
    ) -> anyhow::Result<()> {
        assert_eq!(self.made, 0, "all boxes of a frame at once");
        self.upload(stage, boxes)?;
        for (set, places) in self.draw_all(stage, depth, boxes) {
            let offset = Self::answer_bytes(MOST_IN_SET) * set as u64;
            let encoder = stage.encoder();
            encoder.resolve_query_set(&self.sets[set], places, answers, offset);
        }
        Ok(())
    }

    /// Bytes of so many answers.
    pub fn answer_bytes(boxes: u32) -> u64 {
        u64::from(boxes.max(1)) * u64::from(wgpu::QUERY_SIZE)
    }

    fn upload(&mut self, stage: &mut Stage<'_, '_>, boxes: &VisibleFaces) -> anyhow::Result<()> {
        let bytes: &[u8] = bytemuck::cast_slice(&boxes.corners);
        // What was uploaded before in this frame may still be drawn from it.
        if self.corners.size() < bytes.len() as u64 || self.made > 0 {
            self.corners = corners_buffer(stage.gpu(), bytes.len() as u64);
        }
        stage.upload(&self.corners, 0, bytes)
    }

    /// Draws boxes with the next queries, which it gives by their sets.
    fn draw_all(
        &mut self,
        stage: &mut Stage<'_, '_>,
        depth: &DepthBuffer<'_>,
        boxes: &VisibleFaces,
    ) -> Vec<(usize, Range<u32>)> {
        let mut made = Vec::new();
        let (mut first, mut corner) = (0, 0);
        while first < boxes.ends.len() {
            let place = self.made % MOST_IN_SET;
            let set = (self.made / MOST_IN_SET) as usize;
            if set == self.sets.len() {
                self.sets.push(query_set(stage.gpu()));
            }
            let room = (MOST_IN_SET - place) as usize;
            let ends = &boxes.ends[first..boxes.ends.len().min(first + room)];
            corner = self.draw(stage, depth, (set, place), (corner, ends));
            let count = ends.len() as u32;
            made.push((set, place..place + count));
            first += ends.len();
            self.made += count;
        }
        stage.count_draws(boxes.ends.len() as u32);
        made
    }

    /// Draws boxes whose corners follow each other, with queries from a place of a set on. Gives where the last ends.
    fn draw(
        &self,
        stage: &mut Stage<'_, '_>,
        depth: &DepthBuffer<'_>,
        (set, place): (usize, u32),
        (mut corner, ends): (u32, &[u32]),
    ) -> u32 {
        let mut pass = stage
            .encoder()
            .begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some("boxes"),
                depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                    view: &depth.targets.depth_view,
                    depth_ops: None,
                    stencil_ops: None,
                }),
                occlusion_query_set: Some(&self.sets[set]),
                ..Default::default()
            });
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &depth.uniform.bind_group, &[]);
        pass.set_vertex_buffer(0, self.corners.slice(..));
        for (query, &end) in (place..).zip(ends) {
            pass.begin_occlusion_query(query);
            if corner < end {
                pass.draw(corner..end, 0..1);
            }
            pass.end_occlusion_query();
            corner = end;
        }
        corner
    }
}

fn corners_buffer(gpu: &Gpu, bytes: u64) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("the corners of boxes"),
        size: bytes.next_power_of_two().max(CORNER_BYTES),
        usage: wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}

fn query_set(gpu: &Gpu) -> wgpu::QuerySet {
    gpu.device.create_query_set(&wgpu::QuerySetDescriptor {
        label: Some("boxes"),
        ty: wgpu::QueryType::Occlusion,
        count: MOST_IN_SET,
    })
}
