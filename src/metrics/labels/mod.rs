//! What kind of error wrong pixels are, where the evidence is clear.
//!
//! A label is a claim about the cause, so each has a rule of its own, in a file of its own, with the
//! thresholds beside it. What fits no rule stays [`Label::Unlabelled`]: no guess is made.
//!
//! Rules are asked in this order, and the first that holds decides: the whole frame
//! (`whole_frame`: inverted, offset); then, for each region of artifact pixels, overflow
//! (`blockers`), uncovered (`blockers`), staircase (`staircase`), detached shadow (`blockers`), leak (`streak`), acne
//! (`speckle`), seam and grazing. Boundary pixels belong to no region: they can only be part of a staircase, or of
//! what is true of the whole frame.

mod blockers;
mod clusters;
mod frame;
mod grazing;
mod seam;
mod speckle;
mod staircase;
mod streak;
mod whole_frame;

#[cfg(test)]
mod tests;

use rayon::prelude::*;

use super::label::Label;
use super::mask_error::{MaskComparison, Place};
use super::regions::{Artifact, Region, Sign, artifacts};
use crate::reference::ReferenceError;
use blockers::{is_detached, is_overflow, is_uncovered, samples_a_region};
use clusters::Clusters;
use frame::JudgedFrame;
pub use frame::{FrameContext, TexelLookup};
use grazing::is_grazing;
pub use seam::SEAM_STEPS;
use seam::is_seam;
use speckle::is_speckle;
use staircase::Staircase;
use streak::{Leaks, leaks};
use whole_frame::whole_frame;

/// The wrong pixels of a picture by region and by kind of error.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Analysis {
    /// Connected regions of artifact pixels, the largest first.
    pub regions: Vec<Region>,
    label_px: [u64; Label::ALL.len()],
}

impl Analysis {
    /// Wrong pixels with this label: all artifact pixels have one, if only `Unlabelled`, and of
    /// boundary pixels those with a label of their own.
    #[must_use]
    pub fn label_px(&self, label: Label) -> u64 {
        self.label_px[label as usize]
    }

    /// The word of each label that occurs, and its wrong pixels.
    pub fn label_counts(&self) -> impl Iterator<Item = (&'static str, u64)> {
        let counts = Label::ALL.map(|label| (label.word(), self.label_px(label)));
        counts.into_iter().filter(|(_, count)| *count > 0)
    }
}

/// Finds the regions of a comparison and tells what kind of errors they are.
///
/// # Errors
/// As [`Reference::trace`](crate::reference::Reference::trace), for a context of another picture.
pub fn analyse(
    comparison: &MaskComparison<'_>,
    context: &FrameContext<'_>,
) -> Result<Analysis, ReferenceError> {
    let frame = JudgedFrame::new(comparison, context)?;
    let mut artifacts = artifacts(comparison);
    let whole = whole_frame(comparison);
    let staircase = match whole {
        Some(_) => None,
        None => Staircase::find(&frame),
    };
    match whole {
        Some(label) => artifacts.iter_mut().for_each(|a| a.region.label = label),
        None => label_regions(&frame, &mut artifacts, staircase.as_ref()),
    }
    let mut analysis = Analysis {
        regions: artifacts.iter().map(|artifact| artifact.region).collect(),
        label_px: [0; Label::ALL.len()],
    };
    for Artifact { region, .. } in &artifacts {
        analysis.label_px[region.label as usize] += region.size_px;
    }
    let stairs = |pixel: usize| staircase.as_ref().is_some_and(|s| s.covers(pixel));
    for (pixel, result) in comparison.results().iter().enumerate() {
        if result.wrong_place() == Some(Place::Boundary)
            && let Some(label) = whole.or_else(|| stairs(pixel).then_some(Label::Staircase))
        {
            analysis.label_px[label as usize] += 1;
        }
    }
    Ok(analysis)
}

fn label_regions(
    frame: &JudgedFrame<'_>,
    artifacts: &mut [Artifact],
    staircase: Option<&Staircase>,
) {
    let link_px = frame.link_px();
    let samples = samples_a_region(artifacts.len());
    for sign in [Sign::FalseLit, Sign::FalseShadowed] {
        let clusters = Clusters::find(frame, artifacts, sign, link_px);
        let judged: Vec<_> = clusters
            .all
            .par_iter()
            .map(|cluster| {
                let acne = sign == Sign::FalseShadowed && is_speckle(frame, cluster);
                (leaks(frame, cluster), acne)
            })
            .collect();
        let label = |artifact: &Artifact, (leaks, acne): (Leaks, bool)| {
            let evidence = match sign {
                Sign::FalseLit => frame.evidence(&artifact.pixels, samples),
                Sign::FalseShadowed => Vec::new(),
            };
            if is_overflow(frame, &evidence) {
                Label::Overflow
            } else if is_uncovered(frame, &evidence) {
                Label::Uncovered
            } else if staircase.is_some_and(|staircase| staircase.holds(frame, artifact)) {
                Label::Staircase
            } else if is_detached(frame, &evidence) {
                Label::DetachedShadow
            } else if leaks.hold(frame, artifact) {
                Label::Leak
            } else if acne {
                Label::Acne
            } else if is_seam(frame, artifact) {
                Label::Seam
            } else if is_grazing(frame, artifact) {
                Label::Grazing
            } else {
                Label::Unlabelled
            }
        };
        artifacts
            .par_iter_mut()
            .enumerate()
            .for_each(|(index, artifact)| {
                if let Some(cluster) = clusters.of(index) {
                    artifact.region.label = label(artifact, judged[cluster]);
                }
            });
    }
}
