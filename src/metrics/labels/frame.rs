//! What the rules may ask of the picture.

use glam::DVec3;

use crate::metrics::distances::EdgeDistances;
use crate::metrics::mask_error::MaskComparison;
use crate::reference::{Evidence, EvidenceProbe, Reference, ReferenceError, ReferenceView};
use crate::scene::Light;

/// Which texel of its shadow map a method looks up for a point in world space: layer, column, row.
/// `None` for a point that the map does not cover.
pub type TexelLookup<'a> = dyn Fn(DVec3) -> Option<[i64; 3]> + Sync + 'a;

/// The picture that a comparison belongs to.
#[derive(Clone, Copy)]
pub struct FrameContext<'a> {
    /// The scene.
    pub reference: &'a Reference,
    /// The light of the picture.
    pub light: Light,
    /// The view that the mask was drawn from.
    pub view: &'a ReferenceView,
    /// As [`Reference::trace`] takes them.
    pub triangle_ids: &'a [u32],
    /// How far pixels are from the true edge, of the reference that was compared with.
    pub edges: &'a EdgeDistances,
    /// The texels of the shadow map, for a method that has one.
    pub texel: Option<&'a TexelLookup<'a>>,
    /// How many texels to each side of that one have a say too, in a filtered map.
    pub texel_reach: u32,
}

/// Regions with a gap of at most this many pixels belong together.
const LINK_PX: f64 = 4.0;
/// So do those with a gap of at most this many texels, up to a limit in pixels.
const LINK_TEXELS: f64 = 2.0;
const LINK_MAX_PX: f64 = 64.0;

/// The size of a texel is measured at this many wrong pixels.
const TEXEL_SAMPLES: usize = 64;

/// A comparison with what is known of its picture.
pub(super) struct JudgedFrame<'a> {
    pub(super) comparison: &'a MaskComparison<'a>,
    pub(super) probe: EvidenceProbe<'a>,
    pub(super) edges: &'a EdgeDistances,
    pub(super) texel: Option<&'a TexelLookup<'a>>,
    pub(super) texel_reach: u32,
    /// The median width of texels at wrong pixels, in pixels of the picture.
    pub(super) texel_px: Option<f64>,
    pub(super) width: usize,
}

impl<'a> JudgedFrame<'a> {
    pub(super) fn new(
        comparison: &'a MaskComparison<'a>,
        context: &FrameContext<'a>,
    ) -> Result<Self, ReferenceError> {
        let (expected, found) = (context.view.pixel_count(), comparison.results().len());
        if comparison.width() != context.view.width || expected != found {
            return Err(ReferenceError::WrongSize { expected, found });
        }
        let FrameContext {
            reference,
            light,
            view,
            triangle_ids,
            edges,
            texel,
            texel_reach,
        } = *context;
        let mut frame = Self {
            comparison,
            probe: reference.evidence(light, view, triangle_ids)?,
            edges,
            texel,
            texel_reach,
            texel_px: None,
            width: view.width as usize,
        };
        frame.texel_px = frame.median_texel_px();
        Ok(frame)
    }

    /// What is known of at most `samples` of these pixels, evenly spread.
    pub(super) fn evidence(&self, pixels: &[usize], samples: usize) -> Vec<Evidence> {
        spread(pixels, samples)
            .filter_map(|&pixel| self.probe.at(pixel))
            .collect()
    }

    /// The width of the texel at a point, across the light, in world units.
    pub(super) fn texel_size(&self, point: DVec3, px_size: f64) -> Option<f64> {
        let texel = self.texel?;
        let own = texel(point)?;
        let (across, up) = self
            .probe
            .towards_light(point)
            .try_normalize()?
            .any_orthonormal_pair();
        let reach = |direction: DVec3| {
            let inside = |reach: f64| texel(point + reach * direction) == Some(own);
            let (mut low, mut high) = (0.0, px_size / 4.0);
            // A texel of more than 250,000 pixels is no texel.
            while inside(high) && high < px_size * f64::from(1 << 18) {
                (low, high) = (high, 2.0 * high);
            }
            for _ in 0..6 {
                let middle = 0.5 * (low + high);
                if inside(middle) {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            high
        };
        Some(0.5 * (reach(across) + reach(-across) + reach(up) + reach(-up)))
    }

    /// The largest gap between regions that belong together.
    pub(super) fn link_px(&self) -> u8 {
        let texels = LINK_TEXELS * self.texel_px.unwrap_or(0.0);
        texels.clamp(LINK_PX, LINK_MAX_PX) as u8
    }

    fn median_texel_px(&self) -> Option<f64> {
        self.texel?;
        let results = self.comparison.results().iter().enumerate();
        let wrong: Vec<usize> = results
            .filter(|(_, result)| result.wrong_place().is_some())
            .map(|(pixel, _)| pixel)
            .collect();
        let size_px = |&pixel: &usize| {
            let point = self.probe.point(pixel)?;
            let px_size = self.probe.px_size(point);
            Some(self.texel_size(point, px_size)? / px_size)
        };
        let mut sizes: Vec<f64> = spread(&wrong, TEXEL_SAMPLES).filter_map(size_px).collect();
        sizes.sort_by(f64::total_cmp);
        sizes.get(sizes.len() / 2).copied()
    }
}

/// At most `count` of these, evenly spread.
pub(super) fn spread<T>(all: &[T], count: usize) -> impl Iterator<Item = &T> {
    let step = all.len().div_ceil(count.max(1)).max(1);
    all.iter().step_by(step)
}
