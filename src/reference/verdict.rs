//! What the reference says of a pixel, and of a picture.

use super::{ReferenceError, Visibility};

/// What the reference says of one pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Verdict {
    /// No geometry is seen here, so no shadow either.
    Background,
    /// The light reaches the visible side of the surface.
    Lit,
    /// Another triangle blocks the light, or the surface faces away from it.
    Shadowed,
    /// Too close to call: left out of error counts.
    Ambiguous,
}

impl Verdict {
    /// Of how much of the light reaches what a pixel shows; `None` where it shows nothing. A surface that less than
    /// half of the light reaches is in shadow, for masks of one bit.
    #[must_use]
    pub fn of(visibility: Option<Visibility>) -> Self {
        const HALF: u8 = 128;
        match visibility.map(Visibility::bounds) {
            None => Self::Background,
            Some((HALF.., _)) => Self::Lit,
            Some((_, ..HALF)) => Self::Shadowed,
            Some(_) => Self::Ambiguous,
        }
    }

    /// Whether geometry is seen here.
    #[must_use]
    pub fn is_surface(self) -> bool {
        self != Self::Background
    }
}

/// The truth of a picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ReferenceMask {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// How much of the light reaches what each pixel shows, by rows, the top row first; `None` where it shows nothing.
    pub visibility: Vec<Option<Visibility>>,
}

impl ReferenceMask {
    /// A mask of the given size.
    ///
    /// # Errors
    /// [`ReferenceError::WrongSize`] unless there are `width` × `height` pixels.
    pub fn new(
        width: u32,
        height: u32,
        visibility: Vec<Option<Visibility>>,
    ) -> Result<Self, ReferenceError> {
        let expected = width as usize * height as usize;
        if visibility.len() != expected {
            return Err(ReferenceError::WrongSize {
                expected,
                found: visibility.len(),
            });
        }
        Ok(Self {
            width,
            height,
            visibility,
        })
    }

    /// The verdict at column `x` and row `y`, or `None` outside the picture.
    #[must_use]
    pub fn get(&self, x: i64, y: i64) -> Option<Verdict> {
        let inside =
            (0..i64::from(self.width)).contains(&x) && (0..i64::from(self.height)).contains(&y);
        inside.then(|| self.verdict(y as usize * self.width as usize + x as usize))
    }

    /// The verdict of a pixel, counted by rows from the top.
    #[must_use]
    pub fn verdict(&self, pixel: usize) -> Verdict {
        Verdict::of(self.visibility[pixel])
    }

    /// The verdict of each pixel.
    pub fn verdicts(&self) -> impl ExactSizeIterator<Item = Verdict> + '_ {
        self.visibility.iter().copied().map(Verdict::of)
    }

    /// The picture as grey values: background and lit 0, in shadow 255, unknown 128.
    #[must_use]
    pub fn to_grey(&self) -> Vec<u8> {
        let grey = |visibility: &Option<Visibility>| {
            let value = visibility.map_or(1.0, Visibility::value);
            ((1.0 - value) * f64::from(u8::MAX)).round() as u8
        };
        self.visibility.iter().map(grey).collect()
    }

    /// Pixels with this verdict.
    #[must_use]
    pub fn count(&self, verdict: Verdict) -> u64 {
        self.verdicts().filter(|&v| v == verdict).count() as u64
    }

    /// Whether one of the eight neighbours that show geometry has another verdict than this pixel,
    /// or either is ambiguous: the true shadow boundary then passes within a pixel of its centre.
    ///
    /// Background is no shadow boundary, neither at the pixel nor beside it.
    #[must_use]
    pub fn boundary_among_neighbours(&self, x: u32, y: u32) -> bool {
        let (x, y) = (i64::from(x), i64::from(y));
        let Some(centre) = self.get(x, y).filter(|v| v.is_surface()) else {
            return false;
        };
        (-1..=1)
            .flat_map(|dy| (-1..=1).map(move |dx| (dx, dy)))
            .any(|(dx, dy)| {
                self.get(x + dx, y + dy)
                    .is_some_and(|v| v == Verdict::Ambiguous || (v.is_surface() && v != centre))
            })
    }
}

#[cfg(test)]
mod tests {
    use super::super::fixtures::of_verdicts;
    use super::*;

    fn mask(rows: &[&str]) -> ReferenceMask {
        let verdicts = rows.iter().flat_map(|row| row.chars()).map(|c| match c {
            '#' => Verdict::Shadowed,
            '.' => Verdict::Lit,
            '?' => Verdict::Ambiguous,
            _ => Verdict::Background,
        });
        of_verdicts(rows[0].len() as u32, rows.len() as u32, verdicts.collect())
    }

    #[test]
    fn a_verdict_needs_more_than_its_half() {
        let of = |low, high| Verdict::of(Visibility::between(low, high));
        assert_eq!(of(128, 255), Verdict::Lit);
        assert_eq!(of(0, 127), Verdict::Shadowed);
        assert_eq!(of(127, 128), Verdict::Ambiguous);
        assert_eq!(Verdict::of(None), Verdict::Background);
    }

    #[test]
    fn grey_hides_the_background() {
        assert_eq!(mask(&["#. ?"]).to_grey(), [255, 0, 0, 128]);
    }

    #[test]
    fn a_neighbour_of_the_other_verdict_is_a_boundary() {
        let mask = mask(&["....", "....", "...#"]);
        assert!(mask.boundary_among_neighbours(2, 1));
        assert!(!mask.boundary_among_neighbours(1, 1));
    }

    #[test]
    fn ambiguous_is_a_boundary_and_background_is_none() {
        assert!(mask(&["..?"]).boundary_among_neighbours(1, 0));
        assert!(!mask(&[".. "]).boundary_among_neighbours(1, 0));
        assert!(!mask(&["# ."]).boundary_among_neighbours(1, 0));
    }

    #[test]
    fn a_wrong_size_is_an_error() {
        let error = ReferenceMask::new(2, 2, vec![None; 3]).unwrap_err();
        assert_eq!(
            error,
            ReferenceError::WrongSize {
                expected: 4,
                found: 3
            }
        );
    }
}
