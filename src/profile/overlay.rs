//! The shadows of all steps over each other, as in figures 5 to 7 of G. Wallner, *Geometry of Real Time Shadows*,
//! 2006.

use super::colour;
use super::day::Day;
use super::picture::{Picture, Scale};
use crate::reference::{ReferenceMask, Verdict};

/// How much of the colour of a step its shadow takes.
const FILL: f64 = 0.42;
/// How much its edge does.
const EDGE: f64 = 0.9;

/// A picture in which shadows are laid over each other, the latest on top. It never holds more than one picture.
#[derive(Clone, Debug)]
pub struct Overlay {
    picture: Picture,
}

impl Overlay {
    /// Without any shadow: the scene without the sun.
    #[must_use]
    pub fn new(base: Picture) -> Self {
        Self { picture: base }
    }

    /// Lays the shadow of a step over it.
    pub fn add(&mut self, truth: &ReferenceMask, colour: [u8; 3]) {
        let width = truth.width as usize;
        let shadowed: Vec<bool> = truth
            .verdicts()
            .map(|verdict| verdict == Verdict::Shadowed)
            .collect();
        // At an edge the neighbour to the right or below is lit, or the other way round.
        let is_lit = |pixel: usize| truth.verdict(pixel) == Verdict::Lit;
        for (pixel, rgb) in self.picture.rgb.chunks_exact_mut(3).enumerate() {
            if !shadowed[pixel] {
                continue;
            }
            let (x, count) = (pixel % width, shadowed.len());
            let beside = [
                (x + 1 < width).then_some(pixel + 1),
                (x > 0).then(|| pixel.wrapping_sub(1)),
                Some(pixel + width).filter(|below| *below < count),
                pixel.checked_sub(width),
            ];
            let is_edge = beside.into_iter().flatten().any(is_lit);
            let part = if is_edge { EDGE } else { FILL };
            let mixed = colour::mix([rgb[0], rgb[1], rgb[2]], colour, part);
            rgb.copy_from_slice(&mixed);
        }
    }

    /// The picture, with the times below it.
    ///
    /// # Errors
    /// When the legend cannot be drawn.
    pub fn finish(self, day: &Day) -> anyhow::Result<Picture> {
        let steps: Vec<_> = day.daylight().collect();
        let count = steps.len() as f64;
        let request = &day.request;
        self.picture.over_scale(&Scale {
            title: format!(
                "Shadows on {} by local time ({}), the later over the earlier",
                request.day.date(),
                request.day.zone_name()
            ),
            colours: (0..steps.len())
                .map(|i| colour_of(i, steps.len()))
                .collect(),
            labels: steps
                .iter()
                .enumerate()
                .map(|(i, (_, step, _))| ((i as f64 + 0.5) / count, day.clock(step)))
                .collect(),
        })
    }
}

/// The colour of one of so many steps.
#[must_use]
pub fn colour_of(step: usize, count: usize) -> [u8; 3] {
    colour::of_time(step as f64 / count.saturating_sub(1).max(1) as f64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::fixtures::of_verdicts;

    #[test]
    fn shadows_are_filled_and_edged_and_the_rest_stays() {
        use Verdict::{Ambiguous, Background, Lit, Shadowed};
        let truth = of_verdicts(
            3,
            2,
            vec![Shadowed, Shadowed, Lit, Shadowed, Background, Ambiguous],
        );
        let mut overlay = Overlay::new(Picture {
            size_px: (3, 2),
            rgb: vec![100; 18],
        });
        overlay.add(&truth, [200, 0, 100]);
        let fill = colour::mix([100; 3], [200, 0, 100], FILL);
        let edge = colour::mix([100; 3], [200, 0, 100], EDGE);
        let expected = [fill, edge, [100; 3], fill, [100; 3], [100; 3]];
        assert_eq!(overlay.picture.rgb, expected.as_flattened());
        assert_eq!(colour_of(0, 1), colour_of(0, 5));
    }
}
