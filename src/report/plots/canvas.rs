//! The drawing primitives that the charts are made of, and what all plots look alike in.

use anyhow::Result;
use plotters::coord::Shift;
use plotters::element::DashedPathElement;
use plotters::prelude::{
    Circle, Color, Cross, DrawingArea, FontTransform, IntoFont, PathElement, Polygon, RGBColor,
    Rectangle, SVGBackend, TextStyle,
};
use plotters::style::text_anchor::{HPos, Pos, VPos};

pub(super) type Px = (i32, i32);

/// A rectangle in pixels.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rect {
    pub(super) left: i32,
    pub(super) top: i32,
    pub(super) right: i32,
    pub(super) bottom: i32,
}

/// Family name under which the program's own font is registered.
pub(super) const FONT: &str = "sans-serif";
/// Text that must be read. The page's style sheet names these colours, up to [`WHISKER`], to turn them
/// over in a dark scheme: change them together.
pub(super) const INK: RGBColor = RGBColor(0x1F, 0x23, 0x28);
/// Text that may be read.
pub(super) const MUTED: RGBColor = RGBColor(0x59, 0x63, 0x6E);
/// Grid lines.
pub(super) const GRID: RGBColor = RGBColor(0xE1, 0xE4, 0xE8);
pub(super) const PAPER: RGBColor = RGBColor(0xFF, 0xFF, 0xFF);

/// The Pareto front: unlike any colour of a contender.
pub(super) const FRONT: RGBColor = RGBColor(0x7B, 0x3F, 0xE4);
/// Markers of what is dominated.
pub(super) const FADED: RGBColor = RGBColor(0x93, 0x9C, 0xA6);
/// Intervals that must not outshine what they are about.
pub(super) const WHISKER: RGBColor = RGBColor(0xB9, 0xC1, 0xC9);

/// Okabe and Ito's palette, which people with any of the common colour blindnesses can tell apart,
/// without its yellow, too faint on white.
const PALETTE: [RGBColor; 7] = [
    RGBColor(0x00, 0x72, 0xB2),
    RGBColor(0xD5, 0x5E, 0x00),
    RGBColor(0x00, 0x9E, 0x73),
    RGBColor(0xCC, 0x79, 0xA7),
    RGBColor(0x00, 0x00, 0x00),
    RGBColor(0xE6, 0x9F, 0x00),
    RGBColor(0x56, 0xB4, 0xE9),
];
/// Markers: as many as are told apart at a glance. Seven colours and six shapes make 42 pairs.
const MARKERS: usize = 6;

/// What a line or a marker looks like.
#[derive(Debug, Clone, Copy)]
pub(super) struct Style {
    pub(super) color: RGBColor,
    /// 0 for a marker without a line.
    pub(super) width_px: u32,
    /// Number of the marker's shape.
    pub(super) marker: Option<usize>,
    /// Length of a line's dashes; 0 for a solid one.
    pub(super) dash_px: i32,
    /// Half the length of the bars across a line's ends.
    pub(super) cap_px: i32,
}

impl Style {
    pub(super) const fn line(color: RGBColor, width_px: u32) -> Self {
        Self {
            color,
            width_px,
            marker: None,
            dash_px: 0,
            cap_px: 0,
        }
    }

    /// The colour and marker of the curve at this place in the run's list.
    pub(super) fn of(index: usize) -> Self {
        Self {
            marker: Some(index),
            ..Self::line(PALETTE[index % PALETTE.len()], 2)
        }
    }

    /// A line that is context, not result: thin and dashed.
    pub(super) fn dashed(self, dash_px: i32) -> Self {
        Self {
            width_px: 1,
            dash_px,
            ..self
        }
    }
}

pub(super) struct Canvas<'a, 'b>(pub(super) &'a DrawingArea<SVGBackend<'b>, Shift>);

impl Canvas<'_, '_> {
    pub(super) fn text(&self, text: &str, at: Px, style: &TextStyle<'_>) -> Result<()> {
        if !text.is_empty() {
            self.0.draw_text(text, style, at)?;
        }
        Ok(())
    }

    pub(super) fn line(&self, points: &[Px], style: Style) -> Result<()> {
        let (stroke, dash_px) = (style.color.stroke_width(style.width_px), style.dash_px);
        let path = points.to_vec();
        if dash_px > 0 {
            self.0
                .draw(&DashedPathElement::new(path, dash_px, dash_px, stroke))?;
        } else if style.width_px > 0 {
            self.0.draw(&PathElement::new(path, stroke))?;
        }
        if let (Some(first), Some(last), 1..) = (points.first(), points.last(), style.cap_px) {
            let is_upright = first.0 == last.0;
            let (dx, dy) = if is_upright {
                (style.cap_px, 0)
            } else {
                (0, style.cap_px)
            };
            for (x, y) in [first, last] {
                let cap = vec![(x - dx, y - dy), (x + dx, y + dy)];
                self.0.draw(&PathElement::new(cap, stroke))?;
            }
        }
        Ok(())
    }

    pub(super) fn rect(&self, corners: [Px; 2], fill: RGBColor) -> Result<()> {
        Ok(self.0.draw(&Rectangle::new(corners, fill.filled()))?)
    }

    /// The marker of a style, if it has one, `r` pixels about `(x, y)`.
    pub(super) fn marker(&self, style: Style, (x, y): Px, r: i32) -> Result<()> {
        let Some(marker) = style.marker else {
            return Ok(());
        };
        let fill = style.color.filled();
        // A triangle or a diamond must reach farther to look as large as a circle.
        let far = r + r / 3;
        let polygon = |points: &[Px]| self.0.draw(&Polygon::new(points, fill));
        match marker % MARKERS {
            0 => self.0.draw(&Circle::new((x, y), r, fill))?,
            1 => return self.rect([(x - r, y - r), (x + r, y + r)], style.color),
            2 => polygon(&[(x, y - far), (x + far, y + r), (x - far, y + r)])?,
            3 => polygon(&[(x, y - far), (x + far, y), (x, y + far), (x - far, y)])?,
            4 => polygon(&[(x, y + far), (x + far, y - r), (x - far, y - r)])?,
            _ => self
                .0
                .draw(&Cross::new((x, y), r, style.color.stroke_width(2)))?,
        }
        Ok(())
    }
}

/// Text that is centred vertically on its place.
pub(super) fn font(size_px: i32, color: RGBColor, pos: HPos) -> TextStyle<'static> {
    let style = (FONT, size_px).into_font().color(&color);
    style.pos(Pos::new(pos, VPos::Center))
}

/// Text read from bottom to top.
pub(super) fn upright(size_px: i32, color: RGBColor, pos: HPos) -> TextStyle<'static> {
    font(size_px, color, pos).transform(FontTransform::Rotate270)
}

/// Width of text in pixels, a little too wide rather than too narrow: an SVG is set in the reader's
/// font, not in ours.
pub(super) fn text_width_px(text: &str, size_px: i32) -> i32 {
    (text.chars().count() as f64 * f64::from(size_px) * 0.56).ceil() as i32
}

/// `text` in at most `chars` characters, an ellipsis in place of its middle: names in a series
/// differ at their ends.
pub(super) fn shortened(text: &str, chars: usize) -> String {
    let all: Vec<char> = text.chars().collect();
    if all.len() <= chars {
        return text.to_owned();
    }
    let kept = chars.saturating_sub(1);
    let (head, tail) = (&all[..kept - kept / 2], &all[all.len() - kept / 2..]);
    head.iter().chain(&['…']).chain(tail).collect()
}

#[cfg(test)]
mod tests {
    use super::shortened;

    #[test]
    fn a_long_name_loses_its_middle() {
        assert_eq!(shortened("short", 5), "short");
        assert_eq!(shortened("spheres_10x10_n140", 9), "sphe…n140");
        assert_eq!(shortened("ab", 1), "…");
    }
}
