//! Reference masks kept on disk: one 8-bit grey PNG a mask, named by what it was traced from.

use glam::Vec4;
use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};

use super::{ReferenceMask, ReferenceView, Verdict};
use crate::image::Image;
use crate::output;

/// Part of every key: raise it whenever a verdict may come out otherwise, so that masks traced by
/// an older program are not found.
const FORMAT_VERSION: u32 = 3;

/// Names a reference mask by all that it depends on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct CacheKey(blake3::Hash);

impl CacheKey {
    /// The key of a picture. `scene_hash` must stand for all that
    /// [`Reference::new`](super::Reference::new) is given: positions, triangles, and which of
    /// them cast.
    #[must_use]
    pub fn new(scene_hash: &str, light: Vec4, view: &ReferenceView, triangle_ids: &[u32]) -> Self {
        let mut hasher = blake3::Hasher::new();
        hasher.update(&FORMAT_VERSION.to_le_bytes());
        // Its length first, so that no hash runs into what follows.
        hasher.update(&(scene_hash.len() as u64).to_le_bytes());
        hasher.update(scene_hash.as_bytes());
        for value in light
            .to_array()
            .into_iter()
            .chain(view.view_projection.to_cols_array())
        {
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
/// It only ever saves time: a file that is missing, damaged or of another size is traced anew, and
/// a folder that cannot be written is no error.
#[derive(Clone, Debug)]
pub struct ReferenceCache {
    dir: Option<PathBuf>,
}

impl ReferenceCache {
    /// A cache in `dir`, which need not exist yet; without one, nothing is kept.
    #[must_use]
    pub fn open(dir: Option<PathBuf>) -> Self {
        Self { dir }
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
        let mask = read_png(&self.path(key)?)?;
        ((mask.width, mask.height) == (view.width, view.height)).then_some(mask)
    }

    fn store(&self, key: &CacheKey, mask: &ReferenceMask) {
        let Some(path) = self.path(key) else { return };
        if let Err(error) = write_png(&path, mask) {
            log::debug!("reference mask not kept in {}: {error:#}", path.display());
        }
    }

    fn path(&self, key: &CacheKey) -> Option<PathBuf> {
        Some(self.dir.as_ref()?.join(format!("{}.png", key.0.to_hex())))
    }
}

fn read_png(path: &Path) -> Option<ReferenceMask> {
    let mut reader = png::Decoder::new(BufReader::new(File::open(path).ok()?))
        .read_info()
        .ok()?;
    let mut bytes = vec![0; reader.output_buffer_size()?];
    let info = reader.next_frame(&mut bytes).ok()?;
    if (info.color_type, info.bit_depth) != (png::ColorType::Grayscale, png::BitDepth::Eight) {
        return None;
    }
    let verdicts = bytes
        .into_iter()
        .map(to_verdict)
        .collect::<Option<Vec<_>>>()?;
    ReferenceMask::new(info.width, info.height, verdicts).ok()
}

/// Writes beside the file and renames, so that no reader ever meets half a file.
fn write_png(path: &Path, mask: &ReferenceMask) -> anyhow::Result<()> {
    output::create_dir_all(path.parent().unwrap_or(Path::new(".")))?;
    let bytes: Vec<u8> = mask.verdicts.iter().copied().map(to_byte).collect();
    Image::grey((mask.width, mask.height), &bytes).write_png(path)
}

/// Unlike [`ReferenceMask::to_grey`], tells the background from what is lit.
fn to_byte(verdict: Verdict) -> u8 {
    match verdict {
        Verdict::Lit => 0,
        Verdict::Background => 64,
        Verdict::Ambiguous => 128,
        Verdict::Shadowed => 255,
    }
}

fn to_verdict(byte: u8) -> Option<Verdict> {
    match byte {
        0 => Some(Verdict::Lit),
        64 => Some(Verdict::Background),
        128 => Some(Verdict::Ambiguous),
        255 => Some(Verdict::Shadowed),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Mat4;
    use std::convert::Infallible;

    const VIEW: ReferenceView = ReferenceView {
        width: 2,
        height: 2,
        view_projection: Mat4::IDENTITY,
    };
    const IDS: [u32; 4] = [0, 1, 2, 3];

    fn key() -> CacheKey {
        CacheKey::new("scene", Vec4::ONE, &VIEW, &IDS)
    }

    fn mask() -> ReferenceMask {
        let verdicts = vec![
            Verdict::Background,
            Verdict::Lit,
            Verdict::Shadowed,
            Verdict::Ambiguous,
        ];
        ReferenceMask::new(2, 2, verdicts).unwrap()
    }

    /// Asks for the mask, and says whether it had to be traced.
    fn ask(cache: &ReferenceCache) -> bool {
        let mut traced = false;
        let found = cache.get_or_trace(&key(), &VIEW, || {
            traced = true;
            Ok::<_, Infallible>(mask())
        });
        assert_eq!(found.unwrap(), mask());
        traced
    }

    #[test]
    fn a_mask_is_traced_once() {
        let dir = tempfile::tempdir().unwrap();
        let cache = ReferenceCache::open(Some(dir.path().join("new")));
        assert!(ask(&cache));
        assert!(!ask(&cache));
        assert_eq!(
            std::fs::read_dir(dir.path().join("new")).unwrap().count(),
            1
        );
    }

    #[test]
    fn a_damaged_file_is_traced_anew_and_replaced() {
        let dir = tempfile::tempdir().unwrap();
        let cache = ReferenceCache::open(Some(dir.path().into()));
        ask(&cache);
        let path = cache.path(&key()).unwrap();
        let whole = std::fs::read(&path).unwrap();
        let other_size = ReferenceMask::new(1, 1, vec![Verdict::Lit]).unwrap();
        for damage in [&whole[..whole.len() / 2], b"no picture", b""] {
            std::fs::write(&path, damage).unwrap();
            assert!(ask(&cache));
            assert!(!ask(&cache));
        }
        write_png(&path, &other_size).unwrap();
        assert!(ask(&cache));
        assert_eq!(std::fs::read(&path).unwrap(), whole);
    }

    #[test]
    fn no_folder_or_one_that_cannot_be_made_is_no_error() {
        let dir = tempfile::tempdir().unwrap();
        let file = dir.path().join("file");
        std::fs::write(&file, "").unwrap();
        for dir in [None, Some(file.join("below"))] {
            let cache = ReferenceCache::open(dir);
            assert!(ask(&cache));
            assert!(ask(&cache));
        }
    }

    #[test]
    fn all_that_a_mask_depends_on_is_in_its_key() {
        let view = ReferenceView { height: 3, ..VIEW };
        let moved = ReferenceView {
            view_projection: Mat4::from_scale(2.0 * glam::Vec3::ONE),
            ..VIEW
        };
        let others = [
            CacheKey::new("scene2", Vec4::ONE, &VIEW, &IDS),
            CacheKey::new("scene", Vec4::X, &VIEW, &IDS),
            CacheKey::new("scene", Vec4::ONE, &view, &IDS),
            CacheKey::new("scene", Vec4::ONE, &moved, &IDS),
            CacheKey::new("scene", Vec4::ONE, &VIEW, &[0, 1, 2, 4]),
        ];
        assert!(others.iter().all(|other| *other != key()));
    }
}
