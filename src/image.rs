//! Pictures as PNG files, and replacing files whole.

use anyhow::Context;
use std::fs::File;
use std::io::BufWriter;
use std::path::Path;

/// An 8-bit picture, rows from the top.
pub struct Image<'a> {
    size_px: (u32, u32),
    colour: png::ColorType,
    bytes: &'a [u8],
}

impl<'a> Image<'a> {
    /// One byte a pixel.
    pub fn grey(size_px: (u32, u32), bytes: &'a [u8]) -> Self {
        Self {
            size_px,
            colour: png::ColorType::Grayscale,
            bytes,
        }
    }

    /// Red, green, blue.
    pub fn rgb(size_px: (u32, u32), bytes: &'a [u8]) -> Self {
        Self {
            size_px,
            colour: png::ColorType::Rgb,
            bytes,
        }
    }

    /// Red, green, blue, opacity.
    pub fn rgba(size_px: (u32, u32), bytes: &'a [u8]) -> Self {
        Self {
            size_px,
            colour: png::ColorType::Rgba,
            bytes,
        }
    }

    /// Writes the picture to `path`, whole or not at all.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub fn write_png(&self, path: &Path) -> anyhow::Result<()> {
        replace_file(path, |file| {
            let mut encoder =
                png::Encoder::new(BufWriter::new(file), self.size_px.0, self.size_px.1);
            encoder.set_color(self.colour);
            encoder.set_depth(png::BitDepth::Eight);
            let mut writer = encoder.write_header()?;
            writer.write_image_data(self.bytes)?;
            Ok(writer.finish()?)
        })
    }
}

/// Writes a file beside `path` and renames it there, so that nobody ever finds half of it.
///
/// # Errors
/// When the file cannot be written; `path` is then as it was.
pub fn replace_file(
    path: &Path,
    write: impl FnOnce(&mut File) -> anyhow::Result<()>,
) -> anyhow::Result<()> {
    let folder = path
        .parent()
        .filter(|folder| !folder.as_os_str().is_empty());
    let attempt = || {
        let mut file = tempfile::NamedTempFile::new_in(folder.unwrap_or(Path::new(".")))?;
        write(file.as_file_mut())?;
        file.persist(path)?;
        anyhow::Ok(())
    };
    attempt().with_context(|| format!("cannot write {}", path.display()))
}
