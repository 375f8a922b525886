//! The drawing primitives that the charts are made of, and what all plots look alike in.

use anyhow::Result;
use plotters::coord::Shift;
use plotters::element::DashedPathElement;
use plotters::prelude::{
    Circle, Color, DrawingArea, FontTransform, IntoFont, PathElement, Polygon, RGBColor, Rectangle,
    SVGBackend, TextStyle,
};
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// A place on the canvas in pixels, from the top left.
pub(super) type Px = (i32, i32);

/// Family name under which the program's own font is registered.
pub(super) const FONT: &str = "sans-serif";
/// Text that must be read. The page's style sheet names these colours, up to [`WHISKER`], to turn them
/// over in a dark scheme: change them together.
pub(super) const INK: RGBColor = RGBColor(0x1F, 0x23, 0x28);
/// Text that may be read.
pub(super) const MUTED: RGBColor = RGBColor(0x59, 0x63, 0x6E);
/// Grid lines.
pub(super) const GRID: RGBColor = RGBColor(0xE1, 0xE4, 0xE8);
/// Behind everything.
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

/// The colour of the curve at `index`.
pub(super) fn color(index: usize) -> RGBColor {
    PALETTE[index % PALETTE.len()]
}

/// Where text stands with respect to its place.
pub(super) const LEFT: Pos = Pos {
    h_pos: HPos::Left,
    v_pos: VPos::Center,
};
/// Ends at its place.
pub(super) const RIGHT: Pos = Pos {
    h_pos: HPos::Right,
    v_pos: VPos::Center,
};
/// Centred on its place.
pub(super) const CENTER: Pos = Pos {
    h_pos: HPos::Center,
    v_pos: VPos::Center,
};

/// Where a plot is drawn.
pub(super) struct Canvas<'a, 'b>(pub(super) &'a DrawingArea<SVGBackend<'b>, Shift>);

impl Canvas<'_, '_> {
    /// Width and height in pixels.
    pub(super) fn size(&self) -> Px {
        let (width, height) = self.0.dim_in_pixel();
        (width as i32, height as i32)
    }

    /// The plot's title, top left.
    pub(super) fn title(&self, text: &str) -> Result<()> {
        let chars = self.size().0 / 10;
        self.text(&shortened(text, chars as usize), (16, 24), 18, INK, LEFT)
    }

    pub(super) fn text(
        &self,
        text: &str,
        at: Px,
        size: i32,
        color: RGBColor,
        pos: Pos,
    ) -> Result<()> {
        Ok(self.0.draw_text(text, &font(size, color).pos(pos), at)?)
    }

    /// Text read from bottom to top.
    pub(super) fn text_upwards(
        &self,
        text: &str,
        at: Px,
        size: i32,
        color: RGBColor,
        pos: Pos,
    ) -> Result<()> {
        let style = font(size, color).transform(FontTransform::Rotate270);
        Ok(self.0.draw_text(text, &style.pos(pos), at)?)
    }

    pub(super) fn line(&self, points: Vec<Px>, color: RGBColor, width_px: u32) -> Result<()> {
        Ok(self
            .0
            .draw(&PathElement::new(points, color.stroke_width(width_px)))?)
    }

    /// A thin line of dashes, `dash_px` long and as far apart.
    pub(super) fn dashed_line(&self, points: Vec<Px>, color: RGBColor, dash_px: i32) -> Result<()> {
        let path = DashedPathElement::new(points, dash_px, dash_px, color.stroke_width(1));
        Ok(self.0.draw(&path)?)
    }

    pub(super) fn rect(&self, corners: [Px; 2], fill: RGBColor) -> Result<()> {
        Ok(self.0.draw(&Rectangle::new(corners, fill.filled()))?)
    }

    /// The marker of the contender at `index`, `r` pixels about `(x, y)`.
    pub(super) fn marker(&self, index: usize, (x, y): Px, r: i32, fill: RGBColor) -> Result<()> {
        // A triangle or a diamond must reach farther to look as large as a circle.
        let far = r + r / 3;
        let polygon = |points: &[Px]| self.0.draw(&Polygon::new(points, fill.filled()));
        match index % MARKERS {
            0 => self.0.draw(&Circle::new((x, y), r, fill.filled()))?,
            1 => return self.rect([(x - r, y - r), (x + r, y + r)], fill),
            2 => polygon(&[(x, y - far), (x + far, y + r), (x - far, y + r)])?,
            3 => polygon(&[(x, y - far), (x + far, y), (x, y + far), (x - far, y)])?,
            4 => polygon(&[(x, y + far), (x + far, y - r), (x - far, y - r)])?,
            _ => {
                self.line(vec![(x - r, y - r), (x + r, y + r)], fill, 2)?;
                self.line(vec![(x - r, y + r), (x + r, y - r)], fill, 2)?;
            }
        }
        Ok(())
    }
}

/// The program's own font.
pub(super) fn font(size_px: i32, color: RGBColor) -> TextStyle<'static> {
    (FONT, size_px).into_font().color(&color)
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
