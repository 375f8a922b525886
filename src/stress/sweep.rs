//! The corpus swept: every value of every cause, every method against the truth.

use super::cause::Cause;
use super::finding::Finding;
use crate::file_name::{file_name, method_file_name};
use crate::judge::Observer;
use crate::judge::{Attempt, Drawn, Judge, NoPicture};
use crate::methods::ShadowMethod;
use crate::output;
use crate::record::Image;
use crate::record::pairs_to_text;
use crate::record::stress::{FAILURES_DIR, GAP_PX, Outcome, ROWS_FILE, StressRow};
use crate::reference::ReferenceMask;
use crate::scene::{Scene, export};
use crate::table::Table;
use anyhow::Context;
use std::path::Path;

/// What to try, and where results go.
pub struct StressRequest<'a> {
    /// Draws the pictures.
    pub judge: &'a Judge,
    /// The causes.
    pub causes: &'a [Cause],
    /// The methods.
    pub methods: &'a [Box<dyn ShadowMethod>],
    /// Seed of what is random in the scenes.
    pub seed: u64,
    /// The folder of results; it exists.
    pub out: &'a Path,
    /// Told of progress.
    pub observer: &'a dyn Observer,
}

/// Tries every value of every cause with every method; writes `stability.csv` row by row, and into the
/// folder `failures` the picture and the scene of each method's first failure of a cause, and of its first
/// undeclared one. Gives the rows, fewer if the user interrupted.
///
/// # Errors
/// When a file cannot be written.
pub fn sweep(request: &StressRequest<'_>) -> anyhow::Result<Vec<StressRow>> {
    let failures = request.out.join(FAILURES_DIR);
    output::create_dir_all(&failures)?;
    let path = request.out.join(ROWS_FILE);
    let mut table = Table::create(&path)?;
    let steps = request.causes.iter().map(|cause| cause.values.len() as u64);
    request.observer.begin(steps.sum());
    let mut rows = Vec::new();
    for cause in request.causes {
        request.observer.phase(&cause.id);
        let mut kept = vec![None; request.methods.len()];
        for &value in &cause.values {
            if request.observer.interrupted() {
                return Ok(rows);
            }
            let place = || format!("cause `{}` at {value}", cause.id);
            let found = try_value(request, cause, value, &mut kept).with_context(place)?;
            table.append(&found)?;
            rows.extend(found);
            request.observer.advance(1);
        }
    }
    Ok(rows)
}

/// A row a method; `kept` says of each what failure of this cause there is a picture of.
fn try_value(
    request: &StressRequest<'_>,
    cause: &Cause,
    value: f64,
    kept: &mut [Option<Outcome>],
) -> anyhow::Result<Vec<StressRow>> {
    let scene = cause.scene(value, request.seed);
    let trial = request.judge.trial(&scene, request.methods);
    let mut rows = Vec::with_capacity(request.methods.len());
    for ((method, attempt), kept) in request.methods.iter().zip(&trial.attempts).zip(kept) {
        let mut row = row(cause, value, method.as_ref(), attempt);
        let is_new = match row.outcome {
            Outcome::Right | Outcome::Unavailable | Outcome::Failed => false,
            Outcome::Declared => kept.is_none(),
            Outcome::Undeclared => *kept != Some(Outcome::Undeclared),
        };
        if let (Attempt::Drawn(drawn), Some(truth), true) = (attempt, &trial.truth, is_new) {
            *kept = Some(row.outcome);
            row.picture = keep(request, &scene, method.as_ref(), drawn, truth)?;
        }
        rows.push(row);
    }
    Ok(rows)
}

fn row(cause: &Cause, value: f64, method: &dyn ShadowMethod, attempt: &Attempt) -> StressRow {
    let empty = StressRow {
        cause: cause.id.clone(),
        value,
        method: method.info().id.to_owned(),
        variant: method.variant(),
        outcome: Outcome::Unavailable,
        artifact_px: 0,
        boundary_px: 0,
        false_lit: 0,
        false_shadowed: 0,
        ambiguous_px: 0,
        kinds: String::new(),
        reason: String::new(),
        picture: String::new(),
    };
    let drawn = match attempt {
        Attempt::Drawn(drawn) => drawn,
        Attempt::Missing(missing) => {
            return StressRow {
                outcome: match missing {
                    NoPicture::Unavailable(_) => Outcome::Unavailable,
                    NoPicture::Failed(_) => Outcome::Failed,
                },
                reason: missing.reason().to_owned(),
                ..empty
            };
        }
    };
    let (outcome, reason) = match Finding::of(method, Some((&cause.id, value)), drawn) {
        Finding::Right => (Outcome::Right, ""),
        Finding::Declared(limit) => (Outcome::Declared, limit.text),
        Finding::Undeclared => (Outcome::Undeclared, ""),
    };
    let error = drawn.judgement.error;
    StressRow {
        outcome,
        artifact_px: error.artifact_px,
        boundary_px: error.boundary_px,
        false_lit: error.false_lit,
        false_shadowed: error.false_shadowed,
        ambiguous_px: error.ambiguous_px,
        kinds: pairs_to_text(drawn.judgement.analysis.label_counts()),
        reason: reason.to_owned(),
        ..empty
    }
}

/// Writes truth, mask and errors side by side, and the scene for `svbench render`. Gives the picture's name.
fn keep(
    request: &StressRequest<'_>,
    scene: &Scene,
    method: &dyn ShadowMethod,
    drawn: &Drawn,
    truth: &ReferenceMask,
) -> anyhow::Result<String> {
    let folder = request.out.join(FAILURES_DIR);
    let stem = file_name(&scene.name);
    if !folder.join(format!("{stem}.toml")).exists() {
        export::write(scene, &folder, &stem)?;
    }
    let method = method_file_name(method.info().id, &method.variant());
    let name = format!("{stem}_{method}.png");
    let (width, height) = request.judge.size_px;
    let truth = truth.to_grey();
    let rgb = strip(width as usize, &truth, drawn);
    Image::rgb((3 * width + 2 * GAP_PX, height), &rgb).write_png(&folder.join(&name))?;
    Ok(name)
}

fn strip(width: usize, truth: &[u8], drawn: &Drawn) -> Vec<u8> {
    let grey = |row: &[u8]| {
        row.iter()
            .flat_map(|value| [*value; 3])
            .collect::<Vec<u8>>()
    };
    let gap = [255; 3 * GAP_PX as usize];
    let rows = truth.chunks(width).zip(drawn.mask.chunks(width));
    let rows = rows.zip(drawn.judgement.error_map.chunks(3 * width));
    rows.flat_map(|((truth, mask), errors)| {
        [&grey(truth), &gap[..], &grey(mask), &gap, errors].concat()
    })
    .collect()
}
