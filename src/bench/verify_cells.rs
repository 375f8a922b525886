//! Verifying the cells of a scene: every method against the truth, in some frames of the flight.

use super::Watched;
use super::cell::CellRun;
use super::executor::{Session, Verified};
use crate::frame::DepthSetup;
use crate::judge::NoPicture;
use crate::record::run_dir::RunDir;
use crate::record::{Image, ImageKind, RunDirError};
use crate::scene::Scene;
use crate::variant::Variant;

/// Compares every method with the truth in some frames of the flight, and keeps the pictures of the
/// first. A cell that cannot be compared ends; where the device is lost, all ends. Frames that were compared
/// already, on a device that was lost, are not again.
pub(super) fn verify_cells(
    watched: Watched<'_>,
    scene: &Scene,
    session: &mut dyn Session,
    cells: &mut [CellRun<'_>],
    dir: &mut RunDir,
) -> Result<(), RunDirError> {
    let mut depths: Vec<DepthSetup> = Vec::new();
    for run in cells.iter().filter(|run| run.is_ready()) {
        if !depths.contains(&run.depth()) {
            depths.push(run.depth());
        }
    }
    for (frame, time_s) in (0..).zip(watched.plan.verified_times(&scene.flight)) {
        for &depth in &depths {
            let waits = |run: &CellRun<'_>| {
                run.is_ready() && run.depth() == depth && run.verified.len() <= frame as usize
            };
            if watched.observer.interrupted() || session.lost().is_some() {
                return Ok(());
            }
            if !cells.iter().any(waits) {
                continue;
            }
            let text = format!("{}: tracing the truth at {time_s:.1} s", scene.name);
            watched.observer.phase(&text);
            let place = place(time_s);
            let truth = match session.trace(depth, time_s) {
                Ok(truth) => truth,
                Err(error) => {
                    let error = error.at(&place);
                    let waiting = cells.iter_mut().filter(|run| waits(run));
                    waiting.for_each(|run| run.refuse(error.clone()));
                    continue;
                }
            };
            if frame == 0 && depth == depths[0] {
                let size_px = cells.first().map(|run| (run.cell.width, run.cell.height));
                let image = Image::grey(size_px.unwrap_or_default(), &truth);
                let nobody = Variant::default();
                dir.write_image((&scene.name, "", &nobody), ImageKind::Reference, &image)?;
            }
            for (index, run) in cells.iter_mut().enumerate() {
                if !waits(run) {
                    continue;
                }
                if watched.observer.interrupted() || session.lost().is_some() {
                    return Ok(());
                }
                let verified = verify(watched, session, (index, frame), run);
                match verified {
                    Ok(verified) => keep(watched, verified, run, dir)?,
                    Err(error) => run.refuse(error.at(&place)),
                }
            }
        }
    }
    Ok(())
}

fn place(time_s: f64) -> String {
    format!("verifying at {time_s:.1} s of the flight")
}

fn verify(
    watched: Watched<'_>,
    session: &mut dyn Session,
    (index, frame): (usize, u32),
    run: &mut CellRun<'_>,
) -> Result<Verified, NoPicture> {
    let (cell, time) = (&run.cell, &mut run.time);
    let text = format!("{}: verifying {}", cell.scene, cell.method);
    watched.observer.phase(&text);
    time.spend(|deadline| session.verify((index, cell), frame, deadline))
}

/// Keeps what was found.
fn keep(
    watched: Watched<'_>,
    found: Verified,
    run: &mut CellRun<'_>,
    dir: &mut RunDir,
) -> Result<(), RunDirError> {
    let cell = &run.cell;
    let size_px = (cell.width, cell.height);
    for (kind, pixels) in &found.images {
        let image = match kind {
            ImageKind::Picture => Image::rgba(size_px, pixels),
            ImageKind::Error => Image::rgb(size_px, pixels),
            ImageKind::Mask | ImageKind::Reference => Image::grey(size_px, pixels),
        };
        dir.write_image((&cell.scene, &cell.method, &cell.variant), *kind, &image)?;
    }
    dir.append_verified(&found.frame, &found.regions)?;
    run.verified.push(found.frame);
    watched.observer.advance(1);
    Ok(())
}
