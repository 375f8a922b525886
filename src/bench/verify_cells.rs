//! Verifying the cells of a scene: every method against the truth, in some frames of the flight.

use super::RunRequest;
use super::cell::CellRun;
use crate::gpu::Gpu;
use crate::judge::Verifier;
use crate::judge::{Judgement, Truth, flicker};
use crate::metrics::{Findings, METRICS, MetricValues};
use crate::record::Image;
use crate::record::run_dir::RunDir;
use crate::record::{Cell, ImageKind, RegionRow, VerifiedFrame};
use crate::record::{RunDirError, in_one_line};
use crate::reference::Motion;
use crate::scene::{Flight, Scene};
use crate::variant::Variant;
use anyhow::Context;

/// How much later the next frame is whose errors are compared for flicker: one of 60 a second.
const FRAME_S: f64 = 1.0 / 60.0;

/// Regions of artifact pixels that are kept of each frame, the largest ones.
const MAX_REGIONS: usize = 8;

/// Compares every method with the truth in some frames of the flight, and keeps the pictures of the
/// first. `verifiers` has one for each stage that cells are drawn on. A cell that cannot be compared ends; where
/// the device is lost, all ends. Frames that were compared already, on a device that was lost, are not again.
pub(super) fn verify_cells(
    request: &RunRequest<'_>,
    gpu: &Gpu,
    scene: &Scene,
    verifiers: &[Verifier<'_>],
    cells: &mut [CellRun<'_>],
    dir: &mut RunDir,
) -> Result<(), RunDirError> {
    let size_px = request.plan.size_px;
    let times_s = request.plan.verified_times(&scene.flight);
    let is_used = |stage: usize| {
        let mut ready = cells.iter().filter(|run| run.prepared().is_some());
        ready.any(|run| run.stage == stage)
    };
    let used: Vec<usize> = (0..verifiers.len())
        .filter(|stage| is_used(*stage))
        .collect();
    for (frame, time_s) in (0..).zip(times_s) {
        for &stage in &used {
            if request.observer.interrupted() {
                return Ok(());
            }
            let verifier = &verifiers[stage];
            request.observer.phase(&format!(
                "{}: tracing the truth at {time_s:.1} s",
                scene.name
            ));
            let waits = |run: &CellRun<'_>| {
                run.stage == stage
                    && run.prepared().is_some()
                    && run.verified.len() <= frame as usize
            };
            if !cells.iter().any(waits) {
                continue;
            }
            let place = format!("verifying at {time_s:.1} s of the flight");
            let moment = match Verified::new(request, verifier, &scene.flight, time_s) {
                Ok(moment) => moment,
                Err(error) => {
                    let reason = in_one_line(&error.context(place));
                    let waiting = cells.iter_mut().filter(|run| waits(run));
                    waiting.for_each(|run| run.fail(&reason));
                    match gpu.lost() {
                        Some(_) => return Ok(()),
                        None => continue,
                    }
                }
            };
            if frame == 0 && stage == used[0] {
                let grey = moment.truth.mask.to_grey();
                let image = Image::grey(size_px, &grey);
                dir.write_image(
                    (&scene.name, "", &Variant::default()),
                    ImageKind::Reference,
                    &image,
                )?;
            }
            for run in cells.iter_mut().filter(|run| waits(run)) {
                if request.observer.interrupted() {
                    return Ok(());
                }
                match judge_cell(request, &moment, frame, run) {
                    Ok(judged) => keep(request, judged, (frame, time_s), run, dir)?,
                    Err(error) => run.fail(&in_one_line(&error.context(place.clone()))),
                }
                if gpu.lost().is_some() {
                    return Ok(());
                }
            }
        }
    }
    Ok(())
}

/// A time on the flight, and the frame after it where flicker is looked for.
struct Verified<'a> {
    verifier: &'a Verifier<'a>,
    truth: Truth,
    /// What is true in the next frame, and where what was seen has gone.
    next: Option<(Truth, Motion)>,
    /// The picture as it should be.
    picture: Option<Vec<u8>>,
}

impl<'a> Verified<'a> {
    fn new(
        request: &RunRequest<'_>,
        verifier: &'a Verifier<'_>,
        flight: &Flight,
        time_s: f64,
    ) -> anyhow::Result<Self> {
        let verification = &request.plan.verification;
        let truth = verifier.truth(&flight.at(time_s))?;
        let picture = verification
            .flip
            .then(|| verifier.true_picture(&truth))
            .transpose()?;
        // At the end of the flight there is no next frame, and the one before does as well.
        let next_s = if time_s + FRAME_S <= flight.duration_s() {
            time_s + FRAME_S
        } else {
            (time_s - FRAME_S).max(0.0)
        };
        let next = verification
            .flicker
            .then(|| {
                let next = verifier.truth(&flight.at(next_s))?;
                let motion = verifier.motion(&truth, &next)?;
                Ok::<_, anyhow::Error>((next, motion))
            })
            .transpose()?;
        Ok(Self {
            verifier,
            truth,
            next,
            picture,
        })
    }
}

/// What came of one method at one moment.
struct Judged {
    mask: Vec<u8>,
    picture: Option<Vec<u8>>,
    judgement: Judgement,
    metrics: MetricValues,
}

/// Judges one method at one moment.
fn judge_cell(
    request: &RunRequest<'_>,
    moment: &Verified<'_>,
    frame: u32,
    run: &mut CellRun<'_>,
) -> anyhow::Result<Judged> {
    let (verifier, truth, cell) = (moment.verifier, &moment.truth, &run.cell);
    let text = format!("{}: verifying {}", cell.scene, cell.method);
    request.observer.phase(&text);
    let prepared = run.prepared_mut().context("it is not ready to be drawn")?;
    let mask = verifier.draw_mask(prepared, truth)?;
    let picture = match (&moment.picture, frame) {
        (None, 1..) => None,
        _ => Some(verifier.read_picture()?),
    };
    let judgement = verifier.judge(&mask, truth, prepared)?;
    let flicker = match &moment.next {
        Some((next, motion)) => {
            let next_mask = verifier.draw_mask(prepared, next)?;
            Some(flicker(motion, (&mask, truth), (&next_mask, next))?)
        }
        None => None,
    };
    let flip = match (&moment.picture, &picture) {
        (Some(truth), Some(picture)) => Some(verifier.flip(&moment.truth, truth, picture)?),
        _ => None,
    };
    let findings = Findings {
        mask: &mask,
        truth: &truth.mask,
        error: judgement.error,
        distances: &judgement.distances,
        analysis: &judgement.analysis,
        flicker,
        flip,
    };
    Ok(Judged {
        metrics: MetricValues::measure(METRICS, &findings),
        mask,
        picture,
        judgement,
    })
}

/// Keeps what was found.
fn keep(
    request: &RunRequest<'_>,
    judged: Judged,
    (frame, time_s): (u32, f64),
    run: &mut CellRun<'_>,
    dir: &mut RunDir,
) -> Result<(), RunDirError> {
    let Judged {
        mask,
        picture,
        judgement,
        metrics,
    } = judged;
    let cell = &run.cell;
    if let Some(picture) = picture.filter(|_| frame == 0) {
        let size_px = request.plan.size_px;
        let cell = (&*cell.scene, &*cell.method, &cell.variant);
        let write = |kind, image: Image<'_>| dir.write_image(cell, kind, &image);
        write(ImageKind::Picture, Image::rgba(size_px, &picture))?;
        write(ImageKind::Mask, Image::grey(size_px, &mask))?;
        write(ImageKind::Error, Image::rgb(size_px, &judgement.error_map))?;
    }
    let verified = VerifiedFrame {
        scene: cell.scene.clone(),
        method: cell.method.clone(),
        variant: cell.variant.clone(),
        width: cell.width,
        height: cell.height,
        frame,
        time_s,
        metrics,
    };
    dir.append_verified(&verified, &regions(cell, frame, &judgement))?;
    run.verified.push(verified);
    request.observer.advance(1);
    Ok(())
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
