//! Read-backs that answer frames later, so that nothing waits for them.

use super::Gpu;
use anyhow::Context;
use std::sync::mpsc::{Receiver, TryRecvError, channel};

/// Bytes that the device was asked for in a frame (see [`super::Stage::read_back`]); they are there once it has
/// drawn that frame. To throw a ticket away is to want no answer.
pub struct Ticket {
    buffer: wgpu::Buffer,
    mapped: Receiver<Result<(), wgpu::BufferAsyncError>>,
}

impl Ticket {
    /// For so many bytes, which `copy` brings into the buffer that it is given.
    pub(super) fn new(
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        bytes: u64,
        copy: impl FnOnce(&mut wgpu::CommandEncoder, &wgpu::Buffer),
    ) -> Self {
        let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("read back"),
            size: bytes,
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        copy(encoder, &buffer);
        let (sender, mapped) = channel();
        encoder.map_buffer_on_submit(&buffer, wgpu::MapMode::Read, .., move |result| {
            // Nobody listens any more where the ticket was thrown away.
            let _ = sender.send(result);
        });
        Self { buffer, mapped }
    }

    /// The bytes if they are there; never waits. A ticket answers once.
    ///
    /// # Errors
    /// When the device is lost, the frame was never submitted, or the ticket has answered before.
    pub fn poll(&mut self, gpu: &Gpu) -> anyhow::Result<Option<Vec<u8>>> {
        gpu.poll(wgpu::PollType::Poll)?;
        match self.mapped.try_recv() {
            Ok(mapped) => {
                mapped?;
                let bytes = self.buffer.get_mapped_range(..)?.to_vec();
                self.buffer.unmap();
                Ok(Some(bytes))
            }
            Err(TryRecvError::Empty) => Ok(None),
            Err(TryRecvError::Disconnected) => anyhow::bail!(
                "a read-back has no answer: its frame was not submitted, or it was answered before"
            ),
        }
    }

    /// The bytes, after all that was submitted is done.
    pub(super) fn wait(mut self, gpu: &Gpu) -> anyhow::Result<Vec<u8>> {
        gpu.poll(wgpu::PollType::wait_indefinitely())?;
        self.poll(gpu)?.context("a read-back got lost")
    }
}
