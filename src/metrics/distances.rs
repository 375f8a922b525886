//! How far from the true shadow edge wrong pixels lie.

use imageproc::distance_transform::euclidean_squared_distance_transform;
use imageproc::image::{GrayImage, Luma};

use super::mask_error::{MaskComparison, Place};
use crate::reference::ReferenceMask;

/// The largest distance of each class but the last, in pixels.
pub const DISTANCE_LIMITS_PX: [u32; 7] = [1, 2, 4, 8, 16, 32, 64];

const NAMES: [&str; DISTANCE_LIMITS_PX.len() + 1] = ["1", "2", "4", "8", "16", "32", "64", "more"];

/// The edge runs between pixels: half a pixel from the centre of those beside it.
const EDGE_FROM_CENTRE_PX: f64 = 0.5;

/// How far each pixel is from the true shadow edge: computed once for a reference, and shared by
/// all masks that are held against it.
#[derive(Clone, Debug)]
pub struct EdgeDistances {
    /// By rows from the top; infinite where the picture has no edge.
    distance_px: Vec<f64>,
}

impl EdgeDistances {
    /// Measures a reference.
    ///
    /// A pixel beside the edge has a neighbour that says otherwise
    /// ([`ReferenceMask::boundary_among_neighbours`]) and counts as half a pixel away from it; any
    /// other is farther by its Euclidean distance from the nearest of those (distance transform of
    /// Felzenszwalb and Huttenlocher 2012). Edges of shadows that no pixel centre hits are not seen.
    #[must_use]
    pub fn new(truth: &ReferenceMask) -> Self {
        let edges = GrayImage::from_fn(truth.width, truth.height, |x, y| {
            Luma([u8::from(truth.boundary_among_neighbours(x, y))])
        });
        let distance_px = if edges.iter().any(|&edge| edge != 0) {
            let squared = euclidean_squared_distance_transform(&edges);
            let from_edge = |squared: &f64| squared.sqrt() + EDGE_FROM_CENTRE_PX;
            squared.iter().map(from_edge).collect()
        } else {
            vec![f64::INFINITY; truth.visibility.len()]
        };
        Self { distance_px }
    }

    /// How far a pixel is from the edge, in pixels.
    pub(super) fn of(&self, pixel: usize) -> f64 {
        self.distance_px
            .get(pixel)
            .copied()
            .unwrap_or(f64::INFINITY)
    }
}

/// Wrong pixels by their distance from the true shadow edge.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Distances {
    classes: [u64; NAMES.len()],
    /// Of the farthest wrong pixel, in pixels; `None` where nothing is wrong or the picture has no
    /// edge.
    pub max_px: Option<f64>,
}

impl Distances {
    /// The name of each class and its number of wrong pixels. The name is the largest distance, in
    /// pixels, that the class holds, and `more` for what is farther, or in a picture without an edge.
    pub fn classes(&self) -> impl Iterator<Item = (&'static str, u64)> {
        NAMES.into_iter().zip(self.classes)
    }
}

impl MaskComparison<'_> {
    /// How far from the true shadow edge the wrong pixels are. `edges` must be those of the
    /// reference that was compared with.
    ///
    /// Pixels at the [boundary](Place::Boundary) are within one pixel by definition, also where the
    /// edge is too fine for [`EdgeDistances`].
    #[must_use]
    pub fn distances(&self, edges: &EdgeDistances) -> Distances {
        let mut distances = Distances::default();
        for (result, &distance_px) in self.results().iter().zip(&edges.distance_px) {
            let distance_px = match result.wrong_place() {
                None => continue,
                Some(Place::Boundary) => distance_px.min(EDGE_FROM_CENTRE_PX),
                Some(Place::Artifact) => distance_px,
            };
            let class = DISTANCE_LIMITS_PX.partition_point(|&limit| f64::from(limit) < distance_px);
            distances.classes[class] += 1;
            if distance_px.is_finite() {
                distances.max_px = Some(distances.max_px.unwrap_or(0.0).max(distance_px));
            }
        }
        distances
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::Verdict;
    use crate::reference::fixtures::{of_verdicts, visibility};

    /// Lit left of column 10, in shadow from there on.
    fn truth() -> ReferenceMask {
        let verdict = |pixel: usize| match pixel % 100 {
            0..10 => Verdict::Lit,
            _ => Verdict::Shadowed,
        };
        of_verdicts(100, 20, (0..2000).map(verdict).collect())
    }

    fn distances(truth: &ReferenceMask, mask: &[u8], thin_shadow: bool) -> Distances {
        let comparison = MaskComparison::new(mask, truth, |_, _| thin_shadow).unwrap();
        comparison.distances(&EdgeDistances::new(truth))
    }

    #[test]
    fn wrong_pixels_fall_into_classes_by_distance() {
        let truth = truth();
        let mut mask = truth.to_grey();
        for column in [10, 11, 12, 13, 26, 99] {
            mask[500 + column] = 0;
        }
        let distances = distances(&truth, &mask, false);
        let counts: Vec<_> = distances.classes().collect();
        // Column 10 is beside the edge at 10.0, and column c is c - 9.5 away from it.
        let expected = [1, 1, 2, 0, 0, 1, 0, 1];
        assert_eq!(counts, NAMES.into_iter().zip(expected).collect::<Vec<_>>());
        assert_eq!(distances.max_px, Some(89.5));
    }

    #[test]
    fn the_distance_is_euclidean() {
        let mut truth = truth();
        truth.visibility.fill(visibility(Verdict::Shadowed));
        truth.visibility[5 * 100 + 50] = visibility(Verdict::Lit);
        let mut mask = truth.to_grey();
        // Three columns and four rows from the pixel beside the edge at (51, 6).
        mask[10 * 100 + 54] = 0;
        assert_eq!(distances(&truth, &mask, false).max_px, Some(5.5));
        // A diagonal step: all digits are of 64 bits, none are those of a 32-bit number written out.
        let mut mask = truth.to_grey();
        mask[7 * 100 + 52] = 0;
        let diagonal = 2f64.sqrt() + 0.5;
        assert_eq!(distances(&truth, &mask, false).max_px, Some(diagonal));
    }

    #[test]
    fn a_boundary_that_no_centre_shows_is_within_a_pixel() {
        let truth = truth();
        let mut mask = truth.to_grey();
        mask[560] = 0;
        let distances = distances(&truth, &mask, true);
        assert_eq!(distances.classes().next(), Some(("1", 1)));
        assert_eq!(distances.max_px, Some(0.5));
    }

    #[test]
    fn no_edge_is_no_distance_and_no_error_neither() {
        let mut truth = truth();
        let right = distances(&truth, &truth.to_grey(), false);
        assert_eq!(right, Distances::default());
        truth.visibility.fill(visibility(Verdict::Lit));
        let distances = distances(&truth, &[255; 2000], false);
        assert_eq!(distances.classes().last(), Some(("more", 2000)));
        assert_eq!(distances.max_px, None);
    }
}
