//! A second way to know: what is true all around a pixel's centre.

use glam::DVec2;

use super::segment::ExactLight;
use super::surface::point_seen;
use super::view::Projection;
use super::{Reference, ReferenceError, ReferenceView, Verdict};
use crate::scene::Light;

/// How far from the centre the places are that are asked: twice the step of the rasteriser's grid.
const RADIUS_PX: f64 = 1.0 / 128.0;

/// Places on each of two circles, of the whole radius and of half of it.
const PLACES: u32 = 8;

/// Tells which pixels no tie excuses: those whose shadow is the same all around their centre.
///
/// [`Self::unanimous`] asks the exact geometry at places around the centre, not at it, and knows neither the G-buffer
/// nor the rule for [ambiguous](Verdict::Ambiguous) pixels. [`Self::drawn`] asks the triangle that the G-buffer shows,
/// without that rule: a mask that differs from both is wrong, whatever [`Reference::trace`] says.
pub struct SurroundingsProbe<'a> {
    reference: &'a Reference,
    light: ExactLight,
    projection: Projection,
}

impl Reference {
    /// A probe into the picture of a view.
    ///
    /// # Errors
    /// [`ReferenceError::BadLight`], [`ReferenceError::BadMatrix`].
    pub fn surroundings(
        &self,
        light: Light,
        view: &ReferenceView,
    ) -> Result<SurroundingsProbe<'_>, ReferenceError> {
        Ok(SurroundingsProbe {
            reference: self,
            light: ExactLight::new(light)?,
            projection: Projection::new(view)?,
        })
    }
}

impl SurroundingsProbe<'_> {
    /// The verdict at 16 places within 1/128 pixel of the centre of a pixel; `None` where they are not all
    /// lit, all in shadow, or all background.
    #[must_use]
    pub fn unanimous(&self, x: u32, y: u32) -> Option<Verdict> {
        let centre_px = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5);
        let place = |i: u32| {
            let angle = std::f64::consts::TAU * (f64::from(i) + 0.25) / f64::from(PLACES);
            let radius = if i < PLACES {
                RADIUS_PX
            } else {
                RADIUS_PX / 2.0
            };
            centre_px + radius * DVec2::from_angle(angle)
        };
        let mut verdicts = (0..2 * PLACES).map(|i| {
            let place_px = place(i);
            self.reference
                .verdict_at(&self.projection, place_px, self.light)
        });
        let first = verdicts
            .next()
            .filter(|first| *first != Verdict::Ambiguous)?;
        verdicts.all(|verdict| verdict == first).then_some(first)
    }

    /// The verdict for the point of the drawn triangle at a pixel's centre, or nearest to it; `None` where it
    /// is not seen there.
    #[must_use]
    pub fn drawn(&self, x: u32, y: u32, id: u32) -> Option<Verdict> {
        let Some(triangle) = id.checked_sub(1) else {
            return Some(Verdict::Background);
        };
        let centre_px = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5);
        let (tree, projection) = (&self.reference.tree, &self.projection);
        let own = tree.primitive(triangle);
        let point = point_seen(projection, centre_px, &own.corners, tree.scale)?;
        let visibility = self
            .reference
            .judge(own, point, projection.eye, self.light, &mut None);
        Some(Verdict::of(Some(visibility)))
    }
}
