//! Memory through which frames bring bytes to the device, used again once the device has read it.

use std::sync::{Mutex, MutexGuard, PoisonError};
use wgpu::util::StagingBelt;

/// What is made at once; larger uploads get memory of their own.
const CHUNK_BYTES: u64 = 4 << 20;

/// Upload memory of one device.
pub(super) struct Uploads(Mutex<StagingBelt>);

/// Bytes ready to be copied by the device.
pub(super) struct Staged {
    pub(super) buffer: wgpu::Buffer,
    pub(super) offset: u64,
}

impl Uploads {
    pub(super) fn new(device: &wgpu::Device) -> Self {
        Self(Mutex::new(StagingBelt::new(device.clone(), CHUNK_BYTES)))
    }

    /// Takes rows of bytes in, each at a multiple of `row_pitch` bytes; gives `None` for no bytes.
    pub(super) fn stage<'r>(
        &self,
        rows: impl ExactSizeIterator<Item = &'r [u8]>,
        row_pitch: u64,
    ) -> anyhow::Result<Option<Staged>> {
        let Some(size) = wgpu::BufferSize::new(row_pitch * rows.len() as u64) else {
            return Ok(None);
        };
        let alignment = const {
            wgpu::BufferSize::new(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT as u64).expect("not zero")
        };
        let mut belt = self.belt();
        let slice = belt.allocate(size, alignment);
        let mut view = slice.get_mapped_range_mut()?;
        for (i, row) in rows.enumerate() {
            let begin = i * row_pitch as usize;
            view.slice(begin..begin + row.len()).copy_from_slice(row);
        }
        Ok(Some(Staged {
            buffer: slice.buffer().clone(),
            offset: slice.offset(),
        }))
    }

    /// What was staged so far is copied by commands of `encoder`, which is complete, and of those before it.
    pub(super) fn close(&self, encoder: &wgpu::CommandEncoder) {
        self.belt().finish_and_recall_on_submit(encoder);
    }

    fn belt(&self) -> MutexGuard<'_, StagingBelt> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl std::fmt::Debug for Uploads {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Uploads")
    }
}
