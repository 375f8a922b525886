//! Reference masks kept on disk: one PNG a mask, named by what it was traced from and sealed.

use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::SystemTime;

use super::cache_folder::{Contents, MASK_SUFFIX, PREFIX};
use super::{ReferenceMask, ReferenceView, Visibility};
use crate::output;
use crate::scene::Light;

/// Part of every key: raise it whenever a verdict may come out otherwise, so that masks traced by
/// an older program are not found.
const FORMAT_VERSION: u32 = 4;

/// Names a reference mask by all that it depends on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct CacheKey(blake3::Hash);

impl CacheKey {
    /// The key of a picture. `scene_hash` must stand for all that
    /// [`Reference::new`](super::Reference::new) is given: positions, triangles, and which of
    /// them cast.
    #[must_use]
    pub fn new(scene_hash: &str, light: Light, view: &ReferenceView, triangle_ids: &[u32]) -> Self {
        let mut hasher = blake3::Hasher::new();
        hasher.update(&FORMAT_VERSION.to_le_bytes());
        // Its length first, so that no hash runs into what follows.
        hasher.update(&(scene_hash.len() as u64).to_le_bytes());
        hasher.update(scene_hash.as_bytes());
        let light = light.place.to_array().into_iter().chain([light.radius]);
        for value in light.chain(view.view_projection.to_cols_array()) {
            hasher.update(&value.to_le_bytes());
        }
        hasher.update(&view.width.to_le_bytes());
        hasher.update(&view.height.to_le_bytes());
        let ids: Vec<u8> = triangle_ids
            .iter()
            .flat_map(|id| id.to_le_bytes())
            .collect();
        hasher.update(&ids);
        Self(hasher.finalize())
    }
}

/// A folder of reference masks, or none.
///
/// It only ever saves time: a file that is missing, damaged, or not of this key is traced anew, and
/// a folder that cannot be written is no error.
#[derive(Debug)]
pub struct ReferenceCache {
    dir: Option<PathBuf>,
    most_bytes: u64,
    /// What is in the folder; known once a mask was written.
    contents: Mutex<Option<Contents>>,
}

impl ReferenceCache {
    /// Default size limit of a cache folder, in MiB.
    pub const DEFAULT_MIB: u64 = 1024;

    /// A cache in `dir`, which need not exist yet; without one, nothing is kept.
    #[must_use]
    pub fn open(dir: Option<PathBuf>) -> Self {
        Self {
            dir,
            most_bytes: Self::DEFAULT_MIB << 20,
            contents: Mutex::new(None),
        }
    }

    /// The same with another bound on what the folder holds.
    #[must_use]
    pub fn with_most_bytes(self, most_bytes: u64) -> Self {
        Self { most_bytes, ..self }
    }

    /// The mask kept under a key, or else the one that `trace` makes, which is then kept.
    ///
    /// # Errors
    /// Those of `trace`.
    pub fn get_or_trace<E>(
        &self,
        key: &CacheKey,
        view: &ReferenceView,
        trace: impl FnOnce() -> Result<ReferenceMask, E>,
    ) -> Result<ReferenceMask, E> {
        if let Some(mask) = self.load(key, view) {
            return Ok(mask);
        }
        let mask = trace()?;
        self.store(key, &mask);
        Ok(mask)
    }

    fn load(&self, key: &CacheKey, view: &ReferenceView) -> Option<ReferenceMask> {
        let path = self.path(key)?;
        // A pipe would wait for a writer.
        let is_file = std::fs::metadata(&path).is_ok_and(|found| found.is_file());
        let mut file = is_file.then(|| File::open(&path)).transpose().ok()??;
        let mask = read_png(&mut file, key, view)?;
        // Those that are not used go first. Where this is not allowed, the time of writing has to do.
        let _ = file.set_modified(SystemTime::now());
        Some(mask)
    }

    fn store(&self, key: &CacheKey, mask: &ReferenceMask) {
        let (Some(dir), Some(path)) = (&self.dir, self.path(key)) else {
            return;
        };
        if let Err(error) = write_png(&path, key, mask) {
            log::debug!("reference mask not kept in {}: {error:#}", path.display());
            return;
        }
        // A thread that panicked left numbers that are right or a little off, which is good enough.
        let mut contents = self.contents.lock().unwrap_or_else(PoisonError::into_inner);
        match contents.as_mut() {
            Some(contents) => contents.add(&path),
            None => *contents = Some(Contents::scan(dir)),
        }
        if let Some(contents) = contents.as_mut() {
            contents.shrink_to(self.most_bytes);
        }
    }

    fn path(&self, key: &CacheKey) -> Option<PathBuf> {
        let name = format!("{PREFIX}{}{MASK_SUFFIX}", key.0.to_hex());
        Some(self.dir.as_ref()?.join(name))
    }
}

/// The text chunk that holds [`seal`].
const SEAL: &str = "svbench seal";

/// What a file says of itself, to be believed: a hash over the key and all pixels.
fn seal(key: &CacheKey, (width, height): (u32, u32), bytes: &[u8]) -> String {
    let mut hasher = blake3::Hasher::new();
    hasher.update(key.0.as_bytes());
    hasher.update(&width.to_le_bytes());
    hasher.update(&height.to_le_bytes());
    hasher.update(bytes);
    hasher.finalize().to_hex().to_string()
}

fn read_png(file: &mut File, key: &CacheKey, view: &ReferenceView) -> Option<ReferenceMask> {
    let mut reader = png::Decoder::new(BufReader::new(file)).read_info().ok()?;
    let info = reader.info();
    let size = (info.width, info.height);
    // Before there is any room for the picture: a damaged file may say that it is huge.
    if size != (view.width, view.height)
        || (info.color_type, info.bit_depth)
            != (png::ColorType::GrayscaleAlpha, png::BitDepth::Eight)
    {
        return None;
    }
    let texts = &info.uncompressed_latin1_text;
    let sealed = texts.iter().find(|text| text.keyword == SEAL)?.text.clone();
    let mut bytes = vec![0; reader.output_buffer_size()?];
    reader.next_frame(&mut bytes).ok()?;
    if sealed != seal(key, size, &bytes) {
        return None;
    }
    let pixels = bytes.as_chunks().0.iter().copied().map(of_bytes);
    ReferenceMask::new(size.0, size.1, pixels.collect()).ok()
}

/// Writes beside the file and renames, so that no reader ever meets half a file.
fn write_png(path: &Path, key: &CacheKey, mask: &ReferenceMask) -> anyhow::Result<()> {
    output::create_dir_all(path.parent().unwrap_or(Path::new(".")))?;
    let size = (mask.width, mask.height);
    let bytes: Vec<u8> = mask.visibility.iter().copied().flat_map(to_bytes).collect();
    output::write_with(path, |file| {
        let mut encoder = png::Encoder::new(file, size.0, size.1);
        encoder.set_color(png::ColorType::GrayscaleAlpha);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.add_text_chunk(SEAL.to_owned(), seal(key, size, &bytes))?;
        let mut encoder = encoder.write_header()?;
        encoder.write_image_data(&bytes)?;
        Ok(encoder.finish()?)
    })
}

/// What the visibility is at least and at most; the wrong way round where nothing is seen.
fn to_bytes(visibility: Option<Visibility>) -> [u8; 2] {
    let (low, high) = visibility.map_or((u8::MAX, 0), Visibility::bounds);
    [low, high]
}

fn of_bytes([low, high]: [u8; 2]) -> Option<Visibility> {
    Visibility::between(low, high)
}

#[cfg(test)]
#[path = "cache_tests.rs"]
mod tests;
