//! A picture with a strip of words below it.

use std::fmt::Write;
use std::path::Path;

use anyhow::Context;
use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::Tree;

use super::colour;
use crate::record::Image;
use crate::report::plots::png_options;

/// Height of the strip below a picture that has a scale.
const SCALE_STRIP_PX: u32 = 72;
/// Height of the strip with one line.
const LINE_STRIP_PX: u32 = 36;
const MARGIN_PX: f64 = 14.0;
/// Below this width letters shrink, so that a line is still seen whole.
const FULL_WIDTH_PX: f64 = 620.0;
/// Room for one label on a scale, between their middles.
const LABEL_PX: f64 = 58.0;

/// 8-bit RGB, rows from the top.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// Width and height.
    pub size_px: (u32, u32),
    /// Three a pixel.
    pub rgb: Vec<u8>,
}

/// A bar of colours with labels.
#[derive(Clone, Debug)]
pub struct Scale {
    /// What it is a scale of.
    pub title: String,
    /// The colours, of equal width, from the left.
    pub colours: Vec<[u8; 3]>,
    /// Places on the bar, from 0 to 1, and what stands below them, from the left.
    pub labels: Vec<(f64, String)>,
}

impl Picture {
    /// A picture without its opacity.
    #[must_use]
    pub fn of_rgba(size_px: (u32, u32), rgba: &[u8]) -> Self {
        let pixels = rgba.chunks_exact(4);
        Self {
            size_px,
            rgb: pixels.flat_map(|c| [c[0], c[1], c[2]]).collect(),
        }
    }

    /// The picture over a scale.
    ///
    /// # Errors
    /// When the scale cannot be drawn.
    pub fn over_scale(self, scale: &Scale) -> anyhow::Result<Self> {
        let svg = scale.svg(self.size_px.0);
        self.over(SCALE_STRIP_PX, &svg)
    }

    /// The picture over a line of words.
    ///
    /// # Errors
    /// When the line cannot be drawn.
    pub fn over_line(self, line: &str) -> anyhow::Result<Self> {
        let width_px = f64::from(self.size_px.0);
        let mut svg = String::new();
        text(&mut svg, width_px, (MARGIN_PX, 24.0), "start", 16.0, line);
        self.over(LINE_STRIP_PX, &svg)
    }

    /// The picture over a strip that this SVG draws.
    fn over(mut self, height_px: u32, content: &str) -> anyhow::Result<Self> {
        let width_px = self.size_px.0;
        let svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width_px}\" height=\"{height_px}\">\
             <rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>{content}</svg>"
        );
        let unreadable = "cannot draw the legend of a picture";
        let tree = Tree::from_str(&svg, png_options()).context(unreadable)?;
        let mut pixels = Pixmap::new(width_px, height_px).context(unreadable)?;
        resvg::render(&tree, Transform::identity(), &mut pixels.as_mut());
        // The strip is opaque, so that there is no alpha to undo.
        let strip = pixels.pixels().iter();
        self.rgb
            .extend(strip.flat_map(|c| [c.red(), c.green(), c.blue()]));
        self.size_px.1 += height_px;
        Ok(self)
    }

    /// Writes it as a PNG.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub fn write_png(&self, path: &Path) -> anyhow::Result<()> {
        Image::rgb(self.size_px, &self.rgb).write_png(path)
    }
}

impl Scale {
    fn svg(&self, width_px: u32) -> String {
        let width_px = f64::from(width_px);
        let (left, bar) = (MARGIN_PX, (width_px - 2.0 * MARGIN_PX).max(1.0));
        let mut svg = String::new();
        text(&mut svg, width_px, (left, 20.0), "start", 14.0, &self.title);
        let segment = bar / self.colours.len().max(1) as f64;
        for (i, colour) in self.colours.iter().enumerate() {
            let (x, fill) = (left + segment * i as f64, colour::hex(*colour));
            // A little wider, lest seams show. Writing to a String does not fail.
            let _ = write!(
                svg,
                "<rect x=\"{x:.2}\" y=\"29\" width=\"{:.2}\" height=\"16\" fill=\"{fill}\" shape-rendering=\"crispEdges\"/>",
                segment + 0.4
            );
        }
        let fitting = (bar / LABEL_PX).max(1.0);
        let every = (self.labels.len() as f64 / fitting).ceil().max(1.0) as usize;
        for (place, label) in self.labels.iter().step_by(every) {
            let x = left + bar * place;
            let anchor = match *place {
                place if place < 0.01 => "start",
                place if place > 0.99 => "end",
                _ => "middle",
            };
            text(&mut svg, width_px, (x, 62.0), anchor, 13.0, label);
        }
        svg
    }
}

fn text(svg: &mut String, width_px: f64, at: (f64, f64), anchor: &str, size: f64, words: &str) {
    let size = size * (width_px / FULL_WIDTH_PX).min(1.0);
    let escaped = words
        .replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;");
    // Writing to a String does not fail.
    let _ = write!(
        svg,
        "<text x=\"{:.2}\" y=\"{:.2}\" font-family=\"sans-serif\" font-size=\"{size:.2}\" \
         text-anchor=\"{anchor}\" fill=\"#1f2328\">{escaped}</text>",
        at.0, at.1
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_strip_makes_a_picture_higher_and_leaves_it_as_it_is() {
        for width in [1u32, 40, 900] {
            let picture = Picture {
                size_px: (width, 2),
                rgb: vec![7; 6 * width as usize],
            };
            let scale = Scale {
                title: "Hours <in> & out".to_owned(),
                colours: (0..9)
                    .map(|i| colour::of_amount(f64::from(i) / 8.0))
                    .collect(),
                labels: (0..5)
                    .map(|i| (f64::from(i) / 4.0, format!("{i} h")))
                    .collect(),
            };
            let drawn = picture.clone().over_scale(&scale).unwrap();
            assert_eq!(drawn.size_px, (width, 2 + SCALE_STRIP_PX));
            assert_eq!(drawn.rgb.len(), 3 * (width * drawn.size_px.1) as usize);
            assert_eq!(drawn.rgb[..picture.rgb.len()], picture.rgb[..]);
            let line = picture.over_line("10:00").unwrap();
            assert_eq!(line.size_px.1, 2 + LINE_STRIP_PX);
            if width == 900 {
                assert!(
                    line.rgb[6 * 900..].iter().any(|value| *value < 100),
                    "letters"
                );
            }
        }
    }
}
