//! One type for both outputs, so that a chart is drawn by one function: an SVG, and a PNG of more pixels.

use std::error::Error;
use std::io;

use plotters::prelude::{
    BitMapBackend, DrawingBackend, FontDesc, RGBAColor, SVGBackend, TextStyle,
};
use plotters_backend::{
    BackendColor, BackendCoord, BackendStyle, BackendTextStyle, DrawingErrorKind,
};

/// Pixels of a PNG for each of a plot: text set at whole pixels is uneven at fewer.
pub(super) const PNG_SCALE: u32 = 2;

/// Where plots are drawn. Both are told sizes and places in pixels of the SVG.
pub(super) enum Backend<'a> {
    Svg(SVGBackend<'a>),
    Png(BitMapBackend<'a>),
}

type Done = Result<(), DrawingErrorKind<io::Error>>;

fn told<E: Error + Send + Sync + 'static>(
    error: DrawingErrorKind<E>,
) -> DrawingErrorKind<io::Error> {
    match error {
        DrawingErrorKind::DrawingError(error) => {
            DrawingErrorKind::DrawingError(io::Error::other(error))
        }
        DrawingErrorKind::FontError(error) => DrawingErrorKind::FontError(error),
    }
}

/// A call of either backend, with the factor from our pixels to its own.
macro_rules! on {
    ($self:ident, $backend:ident, $scale:ident => $call:expr) => {
        match $self {
            Backend::Svg($backend) => {
                let $scale = 1;
                $call.map_err(told)
            }
            Backend::Png($backend) => {
                let $scale = PNG_SCALE;
                $call.map_err(told)
            }
        }
    };
}

fn place((x, y): BackendCoord, scale: u32) -> BackendCoord {
    let scale = scale as i32;
    (x * scale, y * scale)
}

/// A style with thicker lines.
struct Thick<'a, S>(&'a S, u32);

impl<S: BackendStyle> BackendStyle for Thick<'_, S> {
    fn color(&self) -> BackendColor {
        self.0.color()
    }

    fn stroke_width(&self) -> u32 {
        self.0.stroke_width() * self.1
    }
}

/// A style with larger letters.
fn large<S: BackendTextStyle>(style: &S, scale: u32) -> TextStyle<'_> {
    let BackendColor { alpha, rgb } = style.color();
    let size = style.size() * f64::from(scale);
    let font = FontDesc::new(style.family(), size, style.style()).transform(style.transform());
    let color = RGBAColor(rgb.0, rgb.1, rgb.2, alpha);
    font.color(&color).pos(style.anchor())
}

impl DrawingBackend for Backend<'_> {
    type ErrorType = io::Error;

    fn get_size(&self) -> (u32, u32) {
        match self {
            Self::Svg(svg) => svg.get_size(),
            Self::Png(png) => {
                let (width, height) = png.get_size();
                (width / PNG_SCALE, height / PNG_SCALE)
            }
        }
    }

    fn ensure_prepared(&mut self) -> Done {
        on!(self, backend, _scale => backend.ensure_prepared())
    }

    fn present(&mut self) -> Done {
        on!(self, backend, _scale => backend.present())
    }

    fn draw_pixel(&mut self, at: BackendCoord, color: BackendColor) -> Done {
        on!(self, backend, scale => backend.draw_pixel(place(at, scale), color))
    }

    fn draw_line<S: BackendStyle>(
        &mut self,
        from: BackendCoord,
        to: BackendCoord,
        style: &S,
    ) -> Done {
        on!(self, backend, s => backend.draw_line(place(from, s), place(to, s), &Thick(style, s)))
    }

    fn draw_rect<S: BackendStyle>(
        &mut self,
        from: BackendCoord,
        to: BackendCoord,
        style: &S,
        fill: bool,
    ) -> Done {
        on!(self, backend, s => backend.draw_rect(place(from, s), place(to, s), &Thick(style, s), fill))
    }

    fn draw_path<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        path: I,
        style: &S,
    ) -> Done {
        let path: Vec<BackendCoord> = path.into_iter().collect();
        on!(self, backend, s => {
            backend.draw_path(path.iter().map(|at| place(*at, s)), &Thick(style, s))
        })
    }

    fn draw_circle<S: BackendStyle>(
        &mut self,
        at: BackendCoord,
        radius: u32,
        style: &S,
        fill: bool,
    ) -> Done {
        on!(self, backend, s => backend.draw_circle(place(at, s), radius * s, &Thick(style, s), fill))
    }

    fn fill_polygon<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        corners: I,
        style: &S,
    ) -> Done {
        let corners: Vec<BackendCoord> = corners.into_iter().collect();
        on!(self, backend, s => {
            backend.fill_polygon(corners.iter().map(|at| place(*at, s)), &Thick(style, s))
        })
    }

    fn draw_text<S: BackendTextStyle>(&mut self, text: &str, style: &S, at: BackendCoord) -> Done {
        on!(self, backend, scale => backend.draw_text(text, &large(style, scale), place(at, scale)))
    }
}
