//! Making the cells of a scene ready: first the biases that must be found, then the methods.

use super::Watched;
use super::cell::{CellRun, State};
use super::executor::Session;
use crate::record::run_dir::RunDir;
use crate::record::{RunDirError, Status};

/// Finds the bias of each cell whose parameters ask for it, unless it was found on a device that has been lost
/// since. A cell whose search breaks ends; where the device is lost, all ends.
pub(super) fn find_biases(
    watched: Watched<'_>,
    session: &mut dyn Session,
    cells: &mut [CellRun<'_>],
    dir: &mut RunDir,
) -> Result<(), RunDirError> {
    for run in cells.iter_mut().filter(|run| run.is_open()) {
        let method = run.plan.method.as_ref();
        if run.bias.is_some() || method.bias_search().is_none() {
            continue;
        }
        if session.lost().is_some() {
            return Ok(());
        }
        let (cell, observer) = (&run.cell, watched.observer);
        observer.phase(&format!(
            "{}: finding the bias of {}",
            cell.scene, cell.method
        ));
        let found = run
            .time
            .spend(|deadline| session.find_bias(cell, method, observer, deadline));
        match found {
            Ok(Some(found)) => {
                run.bias = Some(found.slope_bias);
                dir.append_bias(&found.row)?;
            }
            Ok(None) => run.end(Status::Skipped, "interrupted".to_owned()),
            Err(error) => run.refuse(error.at("while its bias was looked for")),
        }
        advance_if_ended(watched, run);
    }
    Ok(())
}

/// Makes each cell ready that has not ended. A cell that breaks ends; where the device is lost, all ends.
pub(super) fn prepare(watched: Watched<'_>, session: &mut dyn Session, cells: &mut [CellRun<'_>]) {
    for (index, run) in cells.iter_mut().enumerate() {
        if !run.is_open() {
            continue;
        }
        if session.lost().is_some() {
            return;
        }
        let (cell, method) = (&run.cell, run.plan.method.as_ref());
        let text = format!("{}: preparing {}", cell.scene, cell.method);
        watched.observer.phase(&text);
        let search = method.bias_search();
        let with_bias = search.as_ref().zip(run.bias);
        let with_bias = with_bias.map(|(search, bias)| (search.with_bias)(bias));
        let method = with_bias.as_deref().unwrap_or(method);
        let prepared = run
            .time
            .spend(|deadline| session.prepare(index, method, deadline));
        match prepared {
            Ok(prepared) => run.ready(prepared),
            Err(error) => run.refuse(error),
        }
        advance_if_ended(watched, run);
    }
}

/// What will not be drawn of a cell counts as done.
fn advance_if_ended(watched: Watched<'_>, run: &CellRun<'_>) {
    if let State::Not(..) = run.state {
        watched.observer.advance(watched.plan.steps_per_cell());
    }
}
