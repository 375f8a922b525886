//! Memory that is read here and there: more than half of what finding a silhouette in a tree costs.

use bytemuck::Pod;
use memmap2::MmapMut;
use std::hint::black_box;
use std::ops::Deref;

/// Values on large pages, where the system has them. A silhouette takes a few bytes each of thousands of places in a tree:
/// on pages of the usual size, finding where a page is takes longer than reading from it.
pub(super) enum LargePages<T> {
    Mapped {
        bytes: MmapMut,
        values: usize,
    },
    /// Where there is little to map, or mapping is not possible.
    Usual(Vec<T>),
}

/// The size of a large page on most processors.
const PAGE_BYTES: usize = 2 << 20;

/// How much a processor fetches at a time.
const LINE_BYTES: usize = 64;

/// How many values are worth fetching together: more than a processor has under way, and few enough to stay at hand.
pub(super) const AT_A_TIME: usize = 32;

/// Brings some values near. Nothing here waits for what was read, as work on them would, so that they come together.
pub(super) fn fetch<'a, T: Pod>(values: impl Iterator<Item = &'a T>) {
    let of_each_line = |value| bytemuck::bytes_of::<T>(value).iter().step_by(LINE_BYTES);
    black_box(values.flat_map(of_each_line).fold(0, |all, one| all ^ one));
}

impl<T: Pod> LargePages<T> {
    pub(super) fn new(values: Vec<T>) -> Self {
        let from: &[u8] = bytemuck::cast_slice(&values);
        if from.len() < PAGE_BYTES {
            return Self::Usual(values);
        }
        let Ok(mut bytes) = MmapMut::map_anon(from.len()) else {
            return Self::Usual(values);
        };
        // No more than a hint: without large pages, reading is slower.
        #[cfg(target_os = "linux")]
        let _ = bytes.advise(memmap2::Advice::HugePage);
        bytes.copy_from_slice(from);
        Self::Mapped {
            bytes,
            values: values.len(),
        }
    }
}

impl<T: Pod> Deref for LargePages<T> {
    type Target = [T];

    fn deref(&self) -> &[T] {
        match self {
            // A map begins with a page, so that values of any alignment lie right.
            Self::Mapped { bytes, values } => {
                bytemuck::cast_slice(&bytes[..values * size_of::<T>()])
            }
            Self::Usual(values) => values,
        }
    }
}
