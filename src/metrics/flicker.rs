//! Errors in time: surface points that turn from right to wrong or back while the eye moves.

use super::mask_error::{MaskComparison, PixelResult};
use crate::reference::{Motion, Verdict};

/// How steady a method's errors are from one picture to the next.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Flicker {
    /// Pixels whose surface point the next picture shows too, lit in both by the reference or in
    /// shadow in both.
    pub followed_px: u64,
    /// Of these, the ones that turn from right to wrong or from wrong to right.
    pub flicker_px: u64,
}

impl Flicker {
    /// Holds two pictures of one method against each other. `motion` leads from the first to the
    /// second; it depends on the views alone and is shared by all methods.
    #[must_use]
    pub fn between(
        motion: &Motion,
        before: &MaskComparison<'_>,
        after: &MaskComparison<'_>,
    ) -> Self {
        let state = |comparison: &MaskComparison<'_>, pixel: usize| {
            let verdict = Verdict::of(*comparison.truth.visibility.get(pixel)?);
            let decided = matches!(verdict, Verdict::Lit | Verdict::Shadowed);
            decided.then(|| (verdict, comparison.results()[pixel] == PixelResult::Right))
        };
        let mut flicker = Self::default();
        for (pixel, target) in motion.pairs() {
            match (state(before, pixel), state(after, target)) {
                (Some((truth, right)), Some((next_truth, next_right))) if truth == next_truth => {
                    flicker.followed_px += 1;
                    flicker.flicker_px += u64::from(right != next_right);
                }
                _ => {}
            }
        }
        flicker
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::fixtures::{Scene, sphere, square, view};
    use crate::scene::Light;
    use glam::{Vec3, Vec4};

    const LIGHT: Vec4 = Vec4::new(2.0, 6.0, 1.0, 1.0);

    #[test]
    fn only_errors_that_come_or_go_flicker() {
        let scene = Scene::default()
            .cast(&sphere(Vec3::Y, 0.8, 60))
            .receive(&square(8.0, 0.0));
        let reference = scene.reference();
        let views = [0.0, 0.03].map(|x| {
            view(
                Vec3::new(x + 2.0, 3.0, 4.0),
                Vec3::new(x, 0.5, 0.0),
                160,
                120,
            )
        });
        let [(ids, truth), (next_ids, next_truth)] =
            views.map(|view| scene.trace(Light::at(LIGHT), &view));
        let motion = reference
            .follow((&views[0], &ids), (&views[1], &next_ids))
            .unwrap();
        let flicker = |mask: &[u8], next_mask: &[u8]| {
            let before = MaskComparison::new(mask, &truth, |_, _| false).unwrap();
            let after = MaskComparison::new(next_mask, &next_truth, |_, _| false).unwrap();
            Flicker::between(&motion, &before, &after)
        };
        let (exact, next_exact) = (truth.to_grey(), next_truth.to_grey());
        let steady = flicker(&exact, &next_exact);
        assert_eq!(steady.flicker_px, 0);
        let surface = ids.iter().filter(|&&id| id != 0).count() as u64;
        assert!(
            steady.followed_px > surface * 9 / 10,
            "{steady:?} of {surface}"
        );

        let all_lit = flicker(&[0; 160 * 120], &[0; 160 * 120]);
        assert_eq!(all_lit, steady, "wrong in both is steady");

        // A block on the floor goes wrong in the second picture only.
        let mut broken = next_exact.clone();
        for row in 95..105 {
            broken[row * 160 + 100..row * 160 + 110].fill(255);
        }
        let came = flicker(&exact, &broken);
        assert_eq!(came.followed_px, steady.followed_px);
        assert!((80..=120).contains(&came.flicker_px), "{came:?}");
    }
}
