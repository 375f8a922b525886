//! What the reference says of a pixel, and of a picture.

use super::ReferenceError;

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
    /// Whether geometry is seen here.
    #[must_use]
    pub fn is_surface(self) -> bool {
        self != Self::Background
    }
}

/// The verdicts of a picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ReferenceMask {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// One a pixel, by rows, the top row first.
    pub verdicts: Vec<Verdict>,
}

impl ReferenceMask {
    /// A mask of the given size.
    ///
    /// # Errors
    /// [`ReferenceError::WrongSize`] unless there are `width` × `height` verdicts.
    pub fn new(width: u32, height: u32, verdicts: Vec<Verdict>) -> Result<Self, ReferenceError> {
        let expected = width as usize * height as usize;
        if verdicts.len() != expected {
            return Err(ReferenceError::WrongSize {
                expected,
                found: verdicts.len(),
            });
        }
        Ok(Self {
            width,
            height,
            verdicts,
        })
    }

    /// The verdict at column `x` and row `y`, or `None` outside the picture.
    #[must_use]
    pub fn get(&self, x: i64, y: i64) -> Option<Verdict> {
        let inside =
            (0..i64::from(self.width)).contains(&x) && (0..i64::from(self.height)).contains(&y);
        inside.then(|| self.verdicts[y as usize * self.width as usize + x as usize])
    }

    /// The picture as grey values: background and lit 0, shadowed 255, ambiguous 128.
    #[must_use]
    pub fn to_grey(&self) -> Vec<u8> {
        let grey = |verdict: &Verdict| match verdict {
            Verdict::Background | Verdict::Lit => 0,
            Verdict::Shadowed => 255,
            Verdict::Ambiguous => 128,
        };
        self.verdicts.iter().map(grey).collect()
    }

    /// Pixels with this verdict.
    #[must_use]
    pub fn count(&self, verdict: Verdict) -> u64 {
        self.verdicts.iter().filter(|&&v| v == verdict).count() as u64
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
    use super::*;

    fn mask(rows: &[&str]) -> ReferenceMask {
        let verdicts = rows.iter().flat_map(|row| row.chars()).map(|c| match c {
            '#' => Verdict::Shadowed,
            '.' => Verdict::Lit,
            '?' => Verdict::Ambiguous,
            _ => Verdict::Background,
        });
        ReferenceMask::new(rows[0].len() as u32, rows.len() as u32, verdicts.collect()).unwrap()
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
        let error = ReferenceMask::new(2, 2, vec![Verdict::Lit; 3]).unwrap_err();
        assert_eq!(
            error,
            ReferenceError::WrongSize {
                expected: 4,
                found: 3
            }
        );
    }
}
