//! The drawing primitives that the charts are made of, and what all plots look alike in.

use anyhow::Result;
use plotters::coord::Shift;
use plotters::element::DashedPathElement;
use plotters::prelude::{
    Circle, Color, DrawingArea, DrawingBackend, FontDesc, FontTransform, IntoFont, PathElement,
    Polygon, RGBColor, Rectangle, ShapeStyle, TextStyle,
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

/// A drawing area that is so many pixels large, whatever the resolution behind it.
pub(super) struct Canvas<'a, DB: DrawingBackend> {
    area: &'a DrawingArea<DB, Shift>,
    size_px: (u32, u32),
    /// Pixels of the area for one of the canvas.
    scale: i32,
}

impl<'a, DB: DrawingBackend> Canvas<'a, DB>
where
    DB::ErrorType: 'static,
{
    pub(super) fn new(area: &'a DrawingArea<DB, Shift>, size_px: (u32, u32)) -> Result<Self> {
        area.fill(&PAPER)?;
        let (width, _) = area.dim_in_pixel();
        let scale = i32::try_from((width / size_px.0).max(1))?;
        Ok(Self {
            area,
            size_px,
            scale,
        })
    }

    /// Width and height in pixels.
    pub(super) fn size(&self) -> Px {
        (self.size_px.0 as i32, self.size_px.1 as i32)
    }

    /// The plot's title, top left.
    pub(super) fn title(&self, text: &str) -> Result<()> {
        let chars = self.size_px.0 / 10;
        self.text(&shortened(text, chars as usize), (16, 24), 18, INK, LEFT)
    }

    pub(super) fn text(
        &self,
        text: &str,
        at: Px,
        size_px: i32,
        color: RGBColor,
        pos: Pos,
    ) -> Result<()> {
        self.turned_text(text, at, self.font(size_px), color, pos)
    }

    /// Text read from bottom to top.
    pub(super) fn text_upwards(
        &self,
        text: &str,
        at: Px,
        size_px: i32,
        color: RGBColor,
        pos: Pos,
    ) -> Result<()> {
        let font = self.font(size_px).transform(FontTransform::Rotate270);
        self.turned_text(text, at, font, color, pos)
    }

    fn turned_text(
        &self,
        text: &str,
        at: Px,
        font: FontDesc<'_>,
        color: RGBColor,
        pos: Pos,
    ) -> Result<()> {
        let style = TextStyle::from(font).color(&color).pos(pos);
        Ok(self.area.draw_text(text, &style, self.scaled(at))?)
    }

    pub(super) fn line(&self, points: Vec<Px>, color: RGBColor, width_px: u32) -> Result<()> {
        let points: Vec<Px> = points.into_iter().map(|at| self.scaled(at)).collect();
        let path = PathElement::new(points, self.stroke(color, width_px));
        Ok(self.area.draw(&path)?)
    }

    /// A line of dashes, `dash_px` long and as far apart.
    pub(super) fn dashed_line(
        &self,
        points: Vec<Px>,
        color: RGBColor,
        width_px: u32,
        dash_px: i32,
    ) -> Result<()> {
        let points: Vec<Px> = points.into_iter().map(|at| self.scaled(at)).collect();
        let dash_px = dash_px * self.scale;
        let style = self.stroke(color, width_px);
        let path = DashedPathElement::new(points, dash_px, dash_px, style);
        Ok(self.area.draw(&path)?)
    }

    pub(super) fn rect(&self, corners: [Px; 2], fill: RGBColor) -> Result<()> {
        let corners = corners.map(|at| self.scaled(at));
        Ok(self.area.draw(&Rectangle::new(corners, fill.filled()))?)
    }

    /// The marker of the contender at `index`, `radius_px` about `at`.
    pub(super) fn marker(
        &self,
        index: usize,
        at: Px,
        radius_px: i32,
        fill: RGBColor,
    ) -> Result<()> {
        let (x, y) = self.scaled(at);
        let r = radius_px * self.scale;
        // A triangle or a diamond must reach farther to look as large as a circle.
        let far = r + r / 3;
        let style = fill.filled();
        let polygon = |points: Vec<Px>| self.area.draw(&Polygon::new(points, style));
        match index % MARKERS {
            0 => self.area.draw(&Circle::new((x, y), r, style))?,
            1 => polygon(vec![
                (x - r, y - r),
                (x + r, y - r),
                (x + r, y + r),
                (x - r, y + r),
            ])?,
            2 => polygon(vec![(x, y - far), (x + far, y + r), (x - far, y + r)])?,
            3 => polygon(vec![(x, y - far), (x + far, y), (x, y + far), (x - far, y)])?,
            4 => polygon(vec![(x, y + far), (x + far, y - r), (x - far, y - r)])?,
            _ => {
                let stroke = self.stroke(fill, 2);
                for points in [
                    [(x - r, y - r), (x + r, y + r)],
                    [(x - r, y + r), (x + r, y - r)],
                ] {
                    self.area.draw(&PathElement::new(points, stroke))?;
                }
            }
        }
        Ok(())
    }

    fn scaled(&self, (x, y): Px) -> Px {
        (x * self.scale, y * self.scale)
    }

    fn font(&self, size_px: i32) -> FontDesc<'static> {
        (FONT, size_px * self.scale).into_font()
    }

    fn stroke(&self, color: RGBColor, width_px: u32) -> ShapeStyle {
        color.stroke_width(width_px * self.scale.unsigned_abs())
    }
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
