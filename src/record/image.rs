//! Pictures as PNG files.

use crate::output;
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
        output::write_with(path, |file| {
            let mut encoder = png::Encoder::new(file, self.size_px.0, self.size_px.1);
            encoder.set_color(self.colour);
            encoder.set_depth(png::BitDepth::Eight);
            let mut writer = encoder.write_header()?;
            writer.write_image_data(self.bytes)?;
            Ok(writer.finish()?)
        })
    }
}
