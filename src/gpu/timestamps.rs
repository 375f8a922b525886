//! Timestamps of one frame on the device, and how they come back.

use std::sync::mpsc::{self, Receiver};

/// Most timestamps that one frame may have: one a stage, and one a submission.
const MAX_TIMESTAMPS: u32 = 64;

const QUERY_BYTES: u64 = MAX_TIMESTAMPS as u64 * wgpu::QUERY_SIZE as u64;

/// The timestamps of one frame under way.
#[derive(Clone)]
pub(super) struct Timestamps {
    queries: wgpu::QuerySet,
    resolved: wgpu::Buffer,
    readable: wgpu::Buffer,
}

impl Timestamps {
    pub(super) fn new(device: &wgpu::Device) -> Self {
        let buffer = |label, usage| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size: QUERY_BYTES,
                usage,
                mapped_at_creation: false,
            })
        };
        Self {
            queries: device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("stage times"),
                ty: wgpu::QueryType::Timestamp,
                count: MAX_TIMESTAMPS,
            }),
            resolved: buffer(
                "stage times, resolved",
                wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC,
            ),
            readable: buffer(
                "stage times, readable",
                wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            ),
        }
    }

    /// Has the device write down its time as timestamp `index`.
    pub(super) fn write(&self, encoder: &mut wgpu::CommandEncoder, index: u32) {
        assert!(
            index < MAX_TIMESTAMPS,
            "a frame has at most {MAX_TIMESTAMPS} timestamps"
        );
        encoder.write_timestamp(&self.queries, index);
    }

    /// The first `count` timestamps, on their way to where they can be read.
    pub(super) fn resolve(&self, encoder: &mut wgpu::CommandEncoder, count: u32) {
        let bytes = u64::from(count) * u64::from(wgpu::QUERY_SIZE);
        encoder.resolve_query_set(&self.queries, 0..count, &self.resolved, 0);
        encoder.copy_buffer_to_buffer(&self.resolved, 0, &self.readable, 0, bytes);
    }

    /// Asks for them once the frame is submitted; something is received when they can be read.
    pub(super) fn map(&self) -> Receiver<Result<(), wgpu::BufferAsyncError>> {
        let (sender, mapped) = mpsc::channel();
        let tell = move |result| {
            // Nobody listens any more if the run was given up.
            let _ = sender.send(result);
        };
        self.readable.map_async(wgpu::MapMode::Read, .., tell);
        mapped
    }

    /// In ticks of the device's clock. What was not resolved is of an earlier frame.
    ///
    /// # Errors
    /// When they are not mapped.
    pub(super) fn ticks(&self) -> anyhow::Result<Vec<u64>> {
        let ticks = bytemuck::pod_collect_to_vec(&self.readable.get_mapped_range(..)?);
        self.readable.unmap();
        Ok(ticks)
    }
}
