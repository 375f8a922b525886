//! One frame of one cell against the truth.

use super::Verified;
use crate::bench::executor::{FRAME_S, sequence};
use crate::config::RunPlan;
use crate::judge::{Judgement, ReadyMethod, Truth, Verifier, flicker};
use crate::metrics::{Findings, METRICS, MetricValues};
use crate::record::{Cell, ImageKind, RegionRow, VerifiedFrame};
use crate::reference::Motion;
use crate::scene::Flight;

/// Regions of artifact pixels that are kept of each frame, the largest ones.
const MAX_REGIONS: usize = 8;

/// What is true at a time of the flight, and in the frame after it where flicker is looked for.
pub(super) struct Traced {
    time_s: f64,
    pub(super) truth: Truth,
    /// When the next frame is, what is true in it, and where what was seen has gone.
    next: Option<(f64, Truth, Motion)>,
    /// The picture as it should be.
    picture: Option<Vec<u8>>,
}

impl Traced {
    pub(super) fn new(
        plan: &RunPlan,
        verifier: &Verifier<'_>,
        flight: &Flight,
        time_s: f64,
    ) -> anyhow::Result<Self> {
        let truth = verifier.truth(&flight.at(time_s))?;
        let picture = plan.verification.flip;
        let picture = picture.then(|| verifier.true_picture(&truth)).transpose()?;
        // At the end of the flight there is no next frame, and the one before does as well.
        let next_s = if time_s + FRAME_S <= flight.duration_s() {
            time_s + FRAME_S
        } else {
            (time_s - FRAME_S).max(0.0)
        };
        let next = plan.verification.flicker.then(|| {
            let next = verifier.truth(&flight.at(next_s))?;
            let motion = verifier.motion(&truth, &next)?;
            Ok::<_, anyhow::Error>((next_s, next, motion))
        });
        Ok(Self {
            time_s,
            next: next.transpose()?,
            truth,
            picture,
        })
    }

    /// Draws the frame with a method and compares it; gives the pictures of the first one.
    pub(super) fn verify(
        &self,
        plan: &RunPlan,
        verifier: &Verifier<'_>,
        ready: &mut ReadyMethod,
        (cell, frame): (&Cell, u32),
    ) -> anyhow::Result<Verified> {
        let keep_pictures = frame == 0;
        let mask = draw(plan, verifier, ready, (self.time_s, &self.truth))?;
        let picture = match keep_pictures || self.picture.is_some() {
            true => Some(verifier.read_picture()?),
            false => None,
        };
        // Before the next frame is drawn, in which a shadow map may be looked up otherwise.
        let judgement = verifier.compare(&mask, &self.truth, ready.method.as_ref())?;
        let flicker = match &self.next {
            Some((next_s, next, motion)) => {
                let next_mask = draw(plan, verifier, ready, (*next_s, next))?;
                Some(flicker(motion, (&mask, &self.truth), (&next_mask, next))?)
            }
            None => None,
        };
        let flip = match (&self.picture, &picture) {
            (Some(truth), Some(picture)) => Some(verifier.flip(&self.truth, truth, picture)?),
            _ => None,
        };
        let findings = Findings {
            mask: &mask,
            truth: &self.truth.mask,
            error: judgement.error,
            distances: &judgement.distances,
            analysis: &judgement.analysis,
            flicker,
            flip,
        };
        let metrics = MetricValues::measure(METRICS, &findings);
        let regions = regions(cell, frame, &judgement);
        let mut images = Vec::new();
        if let Some(picture) = picture.filter(|_| keep_pictures) {
            images.push((ImageKind::Picture, picture));
            images.push((ImageKind::Mask, mask));
            images.push((ImageKind::Error, judgement.error_map));
        }
        Ok(Verified {
            frame: self.row(cell, frame, metrics),
            regions,
            images,
        })
    }

    fn row(&self, cell: &Cell, frame: u32, metrics: MetricValues) -> VerifiedFrame {
        VerifiedFrame {
            metrics,
            ..VerifiedFrame::of(cell, frame, self.time_s)
        }
    }
}

/// The mask of a frame at a time of the flight, of which this is true, after those that lead in to it.
fn draw(
    plan: &RunPlan,
    verifier: &Verifier<'_>,
    ready: &mut ReadyMethod,
    (time_s, truth): (f64, &Truth),
) -> anyhow::Result<Vec<u8>> {
    let times_s = sequence(time_s, plan.lead_in);
    let lead_in_s = &times_s[..plan.lead_in as usize];
    verifier.draw_mask_after(lead_in_s, ready, truth)
}

fn regions(cell: &Cell, frame: u32, judgement: &Judgement) -> Vec<RegionRow> {
    let largest = judgement.analysis.regions.iter().take(MAX_REGIONS);
    largest
        .map(|region| RegionRow {
            scene: cell.scene.clone(),
            method: cell.method.clone(),
            variant: cell.variant.clone(),
            frame,
            sign: region.sign.word().to_owned(),
            label: region.label.word().to_owned(),
            size_px: region.size_px,
            left: region.left,
            top: region.top,
            right: region.right,
            bottom: region.bottom,
        })
        .collect()
}
