//! A film: an animated PNG, which every browser plays.

use std::fs::File;
use std::io::BufWriter;
use std::path::{Path, PathBuf};

use anyhow::{Context, ensure};
use png::{BitDepth, ColorType, Encoder, Writer};

use super::day::{Day, Step};
use super::picture::Picture;
use crate::output;

/// A film of at most this length shows each frame for half a second; a longer one goes faster.
const LONGEST_S: f64 = 20.0;
const LONGEST_FRAME_MS: f64 = 500.0;
/// How dark a picture of the night is, against one under the sky of the day.
const NIGHT: f64 = 0.35;
/// Faster than this, browsers do as they please.
const SHORTEST_FRAME_MS: f64 = 40.0;

/// A film that grows on disk frame by frame, and is only held in memory as the frame under way.
pub struct Film {
    path: PathBuf,
    writer: Writer<BufWriter<File>>,
    missing: u32,
}

impl Film {
    /// Begins a film of so many frames of one size, which plays again and again.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub fn create(path: &Path, size_px: (u32, u32), frames: u32) -> anyhow::Result<Self> {
        let file = BufWriter::new(output::create(path)?);
        let mut encoder = Encoder::new(file, size_px.0, size_px.1);
        encoder.set_color(ColorType::Rgb);
        encoder.set_depth(BitDepth::Eight);
        let begin = || -> anyhow::Result<Writer<_>> {
            encoder.set_animated(frames, 0)?;
            encoder.set_frame_delay(frame_ms(frames), 1000)?;
            Ok(encoder.write_header()?)
        };
        let writer = begin().with_context(|| format!("cannot write {}", path.display()))?;
        Ok(Self {
            path: path.to_owned(),
            writer,
            missing: frames,
        })
    }

    /// Adds a frame.
    ///
    /// # Errors
    /// When it is of another size, or cannot be written.
    pub fn add(&mut self, frame: &Picture) -> anyhow::Result<()> {
        self.missing = self.missing.saturating_sub(1);
        let added = self.writer.write_image_data(&frame.rgb);
        added.with_context(|| format!("cannot write {}", self.path.display()))
    }

    /// Ends the film.
    ///
    /// # Errors
    /// When frames are missing, or the file cannot be written.
    pub fn finish(self) -> anyhow::Result<()> {
        let (missing, path) = (self.missing, self.path.display());
        ensure!(missing == 0, "{path} lacks {missing} frames");
        let ended = self.writer.finish();
        ended.with_context(|| format!("cannot write {}", self.path.display()))
    }
}

/// What stands below a frame.
pub(super) fn caption(day: &Day, step: &Step) -> String {
    let request = &day.request;
    let sun = match step.light {
        Some(_) => format!(
            "sun {:.1}° high, azimuth {:.0}°",
            step.position.elevation_deg, step.position.azimuth_deg
        ),
        None => "night".to_owned(),
    };
    format!(
        "{} {} ({})  ·  {sun}",
        request.day.date(),
        day.clock(step),
        request.day.zone_name()
    )
}

/// The scene at night, from the scene under the sky of the day.
pub(super) fn night(dark: &Picture) -> Picture {
    let darker = |value: &u8| (f64::from(*value) * NIGHT) as u8;
    Picture {
        size_px: dark.size_px,
        rgb: dark.rgb.iter().map(darker).collect(),
    }
}

fn frame_ms(frames: u32) -> u16 {
    let ms = 1000.0 * LONGEST_S / f64::from(frames.max(1));
    ms.clamp(SHORTEST_FRAME_MS, LONGEST_FRAME_MS) as u16
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_film_has_its_frames_and_comes_back() {
        let room = tempfile::tempdir().unwrap();
        let path = room.path().join("day.png");
        let frame = |value: u8| Picture {
            size_px: (3, 2),
            rgb: vec![value; 18],
        };
        let mut film = Film::create(&path, (3, 2), 3).unwrap();
        for value in [10, 20, 30] {
            film.add(&frame(value)).unwrap();
        }
        film.finish().unwrap();
        let file = std::io::BufReader::new(File::open(&path).unwrap());
        let mut reader = png::Decoder::new(file).read_info().unwrap();
        let info = reader.info();
        let control = info.animation_control.unwrap();
        assert_eq!((control.num_frames, control.num_plays), (3, 0));
        for value in [10, 20, 30] {
            let mut buffer = vec![0; 18];
            reader.next_frame(&mut buffer).unwrap();
            assert_eq!(buffer, frame(value).rgb);
        }
        assert_eq!((frame_ms(9), frame_ms(100), frame_ms(1441)), (500, 200, 40));
    }

    #[test]
    fn a_film_without_all_of_its_frames_is_no_film() {
        let room = tempfile::tempdir().unwrap();
        let film = Film::create(&room.path().join("day.png"), (3, 2), 2).unwrap();
        assert!(film.finish().is_err());
    }
}
