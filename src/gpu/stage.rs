//! One stage of a frame while it is recorded.

use super::native::{Bindings, NativePass, Target};
use super::{FrameRecorder, Gpu, Ticket, readback};
use std::ops::Range;

/// A stage under way. What it records for the device is timed by timestamps at its ends; what it does
/// [on the processor](Self::on_processor) is timed by the processor's clock.
pub struct Stage<'s, 'f> {
    frame: &'s mut FrameRecorder<'f>,
}

impl<'f> FrameRecorder<'f> {
    /// A stage; gives what `record` gives.
    pub fn stage<T>(
        &mut self,
        name: &'static str,
        record: impl FnOnce(&mut Stage<'_, 'f>) -> T,
    ) -> T {
        self.begin_stage(name);
        let result = record(&mut Stage { frame: self });
        self.end_device_work();
        result
    }
}

impl<'f> Stage<'_, 'f> {
    /// The device.
    pub fn gpu(&self) -> &'f Gpu {
        self.frame.gpu
    }

    /// The encoder that wgpu's passes and copies go into.
    pub fn encoder(&mut self) -> &mut wgpu::CommandEncoder {
        self.frame.begin_device_work();
        &mut self.frame.encoder
    }

    /// So many draw calls were recorded with [`Self::encoder`].
    pub fn count_draws(&mut self, draw_calls: u32) {
        self.frame.draw_calls += draw_calls;
    }

    /// Native draws into `target`. They see all that was recorded before, of draws, compute passes and uploads, and
    /// what is recorded after sees what they have written.
    pub fn native(
        &mut self,
        target: &Target,
        bindings: &Bindings,
        draw: impl FnOnce(&mut NativePass<'_>),
    ) {
        let frame = &mut *self.frame;
        frame.begin_device_work();
        // The native pass expects the textures as wgpu leaves them after a pass that wrote them.
        let as_left = |texture, state| wgpu::TextureTransition {
            texture,
            selector: None,
            state,
        };
        let depth = as_left(&target.depth, wgpu::TextureUses::DEPTH_STENCIL_WRITE);
        let counts = target.counts.texture();
        let counts = counts.map(|counts| as_left(counts, wgpu::TextureUses::COLOR_TARGET));
        let textures = std::iter::once(depth).chain(counts);
        frame
            .encoder
            .transition_resources(std::iter::empty(), textures);
        let (commands, draw_calls) = NativePass::record(&frame.gpu.device, target, bindings, draw);
        frame.push_native(commands);
        frame.draw_calls += draw_calls;
    }

    /// Work on the processor; gives what it gives.
    pub fn on_processor<T>(&mut self, work: impl FnOnce() -> T) -> T {
        self.frame.on_processor(work)
    }

    /// Brings `bytes` into a buffer with `COPY_DST`, before what this stage records next. Handing them over is the
    /// processor's time, the copy the device's. `offset` and the number of bytes are multiples of 4.
    ///
    /// # Errors
    /// When the device has no memory for them, or is lost.
    pub fn upload(
        &mut self,
        buffer: &wgpu::Buffer,
        offset: u64,
        bytes: &[u8],
    ) -> anyhow::Result<()> {
        let frame = &mut *self.frame;
        let uploads = &frame.gpu.uploads;
        let staged =
            frame.on_processor(|| uploads.stage(std::iter::once(bytes), bytes.len() as u64))?;
        if let Some(from) = staged {
            let bytes = bytes.len() as u64;
            self.copy_from_staged().copy_buffer_to_buffer(
                &from.buffer,
                from.offset,
                buffer,
                offset,
                bytes,
            );
        }
        Ok(())
    }

    /// Brings texels into a 2D texture with `COPY_DST`: all of them, rows from the top, tightly packed. Timed as
    /// [`Self::upload`].
    ///
    /// # Errors
    /// When the device has no memory for them, or is lost.
    ///
    /// # Panics
    /// When there are more or fewer bytes than the texture holds.
    pub fn upload_texture(&mut self, texture: &wgpu::Texture, texels: &[u8]) -> anyhow::Result<()> {
        let rows = readback::Rows::of(texture, wgpu::TextureAspect::All)?;
        assert_eq!(
            texels.len() as u64,
            rows.tight_bytes(),
            "all texels of the texture"
        );
        let frame = &mut *self.frame;
        let uploads = &frame.gpu.uploads;
        let tight = texels.chunks_exact(rows.row_bytes as usize);
        let staged = frame.on_processor(|| uploads.stage(tight, u64::from(rows.pitch_bytes)))?;
        if let Some(from) = staged {
            let source = wgpu::TexelCopyBufferInfo {
                buffer: &from.buffer,
                layout: rows.layout(from.offset),
            };
            self.copy_from_staged().copy_buffer_to_texture(
                source,
                texture.as_image_copy(),
                texture.size(),
            );
        }
        Ok(())
    }

    fn copy_from_staged(&mut self) -> &mut wgpu::CommandEncoder {
        self.frame.uploads = true;
        self.encoder()
    }

    /// Asks for a part of a buffer with `COPY_SRC` as it is at this point of the frame; the answer comes frames
    /// later. The ends of `bytes` are multiples of 4.
    pub fn read_back(&mut self, buffer: &wgpu::Buffer, bytes: Range<u64>) -> Ticket {
        let gpu = self.frame.gpu;
        let size = bytes.end - bytes.start;
        Ticket::new(gpu, self.encoder(), size, |encoder, into| {
            encoder.copy_buffer_to_buffer(buffer, bytes.start, into, 0, size);
        })
    }

    /// Asks for the results of queries, 8 bytes each; the answer comes frames later. They must have been made in
    /// this frame, before this point.
    pub fn read_queries(&mut self, queries: &wgpu::QuerySet, range: Range<u32>) -> Ticket {
        let gpu = self.frame.gpu;
        let size = u64::from(range.end - range.start) * u64::from(wgpu::QUERY_SIZE);
        let resolved = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("query results"),
            size,
            usage: wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC,
            mapped_at_creation: false,
        });
        self.encoder()
            .resolve_query_set(queries, range, &resolved, 0);
        self.read_back(&resolved, 0..size)
    }

    /// The texels of 2D textures with `COPY_SRC` as they are at this point of the frame, rows from the top, tightly
    /// packed: what was recorded so far is submitted, and the processor waits for it. Waiting is on neither clock;
    /// the device's work and the copy to where the texels can be read are.
    ///
    /// # Errors
    /// When the device is lost, or has no memory for the texels.
    pub fn read_now<const N: usize>(
        &mut self,
        textures: [&wgpu::Texture; N],
    ) -> anyhow::Result<[Vec<u8>; N]> {
        let asked: Vec<_> = textures
            .into_iter()
            .map(|texture| self.ask_for(texture))
            .collect::<Result<_, _>>()?;
        let gpu = self.frame.gpu;
        self.frame.submit_part();
        self.frame.wait(Gpu::wait_idle);
        self.frame.on_processor(|| {
            let mut texels = [const { Vec::new() }; N];
            for (texels, (ticket, rows)) in texels.iter_mut().zip(asked) {
                *texels = rows.pack(&ticket.wait(gpu)?);
            }
            Ok(texels)
        })
    }

    fn ask_for(&mut self, texture: &wgpu::Texture) -> anyhow::Result<(Ticket, readback::Rows)> {
        let gpu = self.frame.gpu;
        let rows = readback::Rows::of(texture, wgpu::TextureAspect::All)?;
        gpu.check_buffer(
            "the pixels read back",
            rows.bytes(),
            wgpu::BufferUsages::COPY_DST,
        )?;
        let ticket = Ticket::new(gpu, self.encoder(), rows.bytes(), |encoder, into| {
            let into = wgpu::TexelCopyBufferInfo {
                buffer: into,
                layout: rows.layout(0),
            };
            encoder.copy_texture_to_buffer(texture.as_image_copy(), into, texture.size());
        });
        Ok((ticket, rows))
    }

    /// The answers of tickets of this frame: what was recorded so far is submitted, and the processor waits for it. Waiting
    /// is on neither clock.
    ///
    /// # Errors
    /// As [`Ticket::poll`].
    pub fn answer_now(&mut self, tickets: Vec<Ticket>) -> anyhow::Result<Vec<Vec<u8>>> {
        self.frame.submit_part();
        let wait = |gpu: &Gpu| tickets.into_iter().map(|ticket| ticket.wait(gpu)).collect();
        self.frame.wait(wait)
    }

    /// The answer of a ticket of an earlier frame, for which the processor waits if it has to. Waiting is on neither
    /// clock, as the device is busy with its frames meanwhile.
    ///
    /// # Errors
    /// As [`Ticket::poll`].
    pub fn wait_for(&mut self, ticket: Ticket) -> anyhow::Result<Vec<u8>> {
        self.frame.wait(|gpu| ticket.wait(gpu))
    }
}
