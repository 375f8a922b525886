//! Making the cells of a scene ready on one device.

use super::cell::{CellRun, State};
use super::{RunRequest, bias_search};
use crate::frame::FrameResources;
use crate::judge::Truth;
use crate::judge::Verifier;
use crate::methods::{self, BiasSearch, MethodError, PrepareContext};
use crate::record::Status;
use crate::record::run_dir::RunDir;
use crate::record::{RunDirError, in_one_line};
use anyhow::Context;
use std::rc::Rc;

/// Makes cells ready on one device: finds biases, and keeps what is true at the views where they are tried.
pub(super) struct Preparation<'a> {
    pub request: &'a RunRequest<'a>,
    pub context: &'a PrepareContext<'a>,
    /// One for each depth buffer that cells are drawn with.
    pub stages: &'a [FrameResources],
    /// One for each stage, if anything is verified or searched.
    pub verifiers: &'a [Verifier<'a>],
    /// Of each stage, once somebody searches on it.
    pub truths: Vec<Option<Rc<[Truth]>>>,
    pub dir: &'a mut RunDir,
}

impl Preparation<'_> {
    /// Makes a cell ready, or notes why it cannot be.
    pub(super) fn prepare(&mut self, run: &mut CellRun<'_>) -> Result<(), RunDirError> {
        let setup = run.plan.method.depth_setup();
        match self.stages.iter().position(|stage| stage.depth == setup) {
            Some(stage) => {
                run.stage = stage;
                self.prepare_on(stage, run)?;
            }
            None => {
                let reason = match setup.check(self.context.gpu) {
                    Err(reason) => reason,
                    Ok(()) => {
                        unreachable!("there is a stage for each setup that the device can draw")
                    }
                };
                run.end(Status::Unavailable, reason);
            }
        }
        if let State::Not(..) = run.state {
            self.request
                .observer
                .advance(self.request.plan.steps_per_cell());
        }
        Ok(())
    }

    fn prepare_on(&mut self, stage: usize, run: &mut CellRun<'_>) -> Result<(), RunDirError> {
        let method = run.plan.method.as_ref();
        let info = method.info();
        let context = self.context.on(&self.stages[stage]);
        if let Err(reason) = info.check(context.gpu) {
            run.end(Status::Unavailable, reason);
            return Ok(());
        }
        let Some(search) = method.bias_search() else {
            let text = format!("{}: preparing {}", context.scene.name, info.id);
            self.request.observer.phase(&text);
            run.ready(methods::prepare(method, &context));
            return Ok(());
        };
        if run.bias.is_none() {
            match self.find(run, &search, &context, stage) {
                Ok(Some(found)) => {
                    run.bias = Some(found.slope_bias);
                    self.dir.append_bias(&found.row)?;
                }
                Ok(None) => run.end(Status::Skipped, "interrupted".to_owned()),
                Err(error) => match error.downcast::<MethodError>() {
                    Ok(error) => run.ready(Err(error)),
                    Err(error) => run.fail(&in_one_line(&error)),
                },
            }
        }
        if let (Some(bias), true) = (run.bias, run.is_open()) {
            run.ready(methods::prepare(
                (search.with_bias)(bias).as_ref(),
                &context,
            ));
        }
        Ok(())
    }

    fn find(
        &mut self,
        run: &CellRun<'_>,
        search: &BiasSearch<'_>,
        context: &PrepareContext<'_>,
        stage: usize,
    ) -> anyhow::Result<Option<bias_search::FoundBias>> {
        let (request, scene, cell) = (self.request, context.scene, &run.cell);
        let text = format!("{}: finding the bias of {}", cell.scene, cell.method);
        request.observer.phase(&text);
        let verifier = &self.verifiers[stage];
        let truths = match &self.truths[stage] {
            Some(truths) => Rc::clone(truths),
            None => {
                let times_s = bias_search::times(request.plan, &scene.flight).into_iter();
                let truths = times_s.map(|s| verifier.truth(&scene.flight.at(s)));
                let truths: Rc<[Truth]> = truths.collect::<anyhow::Result<_>>()?;
                Rc::clone(self.truths[stage].insert(truths))
            }
        };
        let on = (verifier, &*truths);
        bias_search::find(cell, search, context, on, request.observer)
            .context("while its bias was looked for")
    }
}
