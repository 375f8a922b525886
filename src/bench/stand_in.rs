//! An executor without a device, which notes what it is asked for and breaks where it is told to. For tests.

use super::executor::{Executor, FoundBias, Prepared, Session, Verified};
use crate::frame::{DepthSetup, DrawnVolumes};
use crate::gpu::FrameTimes;
use crate::judge::{NoPicture, Observer};
use crate::methods::ShadowMethod;
use crate::record::{BiasRow, Cell, EdgeRecord, VerifiedFrame};
use crate::scene::Scene;
use std::cell::{Cell as Counter, RefCell};
use std::collections::VecDeque;
use std::time::{Duration, Instant};

/// What is to go wrong with something that the schedule asks for.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Trouble {
    /// It cannot run here.
    Unavailable,
    /// It breaks, and nothing else does.
    Breaks,
    /// The device is lost by it.
    Loses,
    /// It takes so many milliseconds.
    Sleeps(u64),
    /// The user interrupts while it is done.
    Interrupts,
}

/// Notes every request as a line of words; see [`Self::on`].
#[derive(Default)]
pub(super) struct StandIn {
    /// What was asked for, in order.
    pub log: RefCell<Vec<String>>,
    troubles: RefCell<Vec<(String, Trouble)>>,
    interrupted: Counter<bool>,
    steps: Counter<u64>,
    done: Counter<u64>,
}

impl StandIn {
    /// Lets the next request whose line begins with these words end so, once.
    pub(super) fn on(self, words: &str, trouble: Trouble) -> Self {
        self.troubles.borrow_mut().push((words.to_owned(), trouble));
        self
    }

    /// The requests whose lines begin with a word, without it.
    pub(super) fn logged(&self, word: &str) -> Vec<String> {
        let log = self.log.borrow();
        let lines = log.iter().filter_map(|line| line.strip_prefix(word));
        lines.map(|rest| rest.trim().to_owned()).collect()
    }

    /// Steps announced, and steps done.
    pub(super) fn progress(&self) -> (u64, u64) {
        (self.steps.get(), self.done.get())
    }

    fn ask(&self, line: String) -> Option<Trouble> {
        let mut troubles = self.troubles.borrow_mut();
        let found = troubles
            .iter()
            .position(|(words, _)| line.starts_with(words));
        self.log.borrow_mut().push(line);
        found.map(|found| troubles.remove(found).1)
    }
}

impl Observer for StandIn {
    fn begin(&self, steps: u64) {
        self.steps.set(steps);
    }

    fn phase(&self, _: &str) {}

    fn advance(&self, steps: u64) {
        self.done.set(self.done.get() + steps);
    }

    fn interrupted(&self) -> bool {
        self.interrupted.get()
    }
}

impl Executor for &StandIn {
    fn check_mesh(&self, _: u64) -> anyhow::Result<()> {
        Ok(())
    }

    fn open<'a>(
        &'a mut self,
        scene: &'a Scene,
        _size_px: (u32, u32),
    ) -> anyhow::Result<Box<dyn Session + 'a>> {
        let trouble = self.ask(format!("open {}", scene.name));
        anyhow::ensure!(trouble.is_none(), "it does not open");
        Ok(Box::new(StandInSession {
            stand_in: self,
            names: Vec::new(),
            under_way: VecDeque::new(),
            lost: false,
        }))
    }
}

struct StandInSession<'a> {
    stand_in: &'a StandIn,
    /// The methods that are ready, by cell.
    names: Vec<Option<String>>,
    /// Lines of the frames under way.
    under_way: VecDeque<String>,
    lost: bool,
}

impl StandInSession<'_> {
    fn ask(&mut self, line: String) -> Result<(), NoPicture> {
        assert!(!self.lost, "nothing is asked of a lost device: {line}");
        let failed = |text: &str| Err(NoPicture::Failed(text.to_owned()));
        match self.stand_in.ask(line) {
            None => Ok(()),
            Some(Trouble::Unavailable) => Err(NoPicture::Unavailable("not here".to_owned())),
            Some(Trouble::Breaks) => failed("it broke"),
            Some(Trouble::Loses) => {
                self.lost = true;
                failed("the device was lost")
            }
            Some(Trouble::Sleeps(ms)) => {
                std::thread::sleep(Duration::from_millis(ms));
                Ok(())
            }
            Some(Trouble::Interrupts) => {
                self.stand_in.interrupted.set(true);
                Ok(())
            }
        }
    }

    fn name(&self, cell: usize) -> String {
        self.names[cell].clone().expect("it is drawn only if ready")
    }
}

impl Session for StandInSession<'_> {
    fn find_bias(
        &mut self,
        cell: &Cell,
        _: &dyn ShadowMethod,
        observer: &dyn Observer,
        _: Option<Instant>,
    ) -> Result<Option<FoundBias>, NoPicture> {
        self.ask(format!("search {}", cell.method))?;
        let row = BiasRow {
            scene: cell.scene.clone(),
            method: cell.method.clone(),
            variant: cell.variant.clone(),
            resolution: 1,
            slope_bias: 2.5,
            acne_px_unbiased: 0.0,
            acne_px: 0.0,
            detached_px_unbiased: 0.0,
            detached_px: 0.0,
            tried: 1,
        };
        let slope_bias = row.slope_bias;
        Ok((!observer.interrupted()).then_some(FoundBias { slope_bias, row }))
    }

    fn prepare(
        &mut self,
        cell: usize,
        method: &dyn ShadowMethod,
        _: Option<Instant>,
    ) -> Result<Prepared, NoPicture> {
        self.ask(format!("prepare {}", method.name()))?;
        self.names.resize(self.names.len().max(cell + 1), None);
        self.names[cell] = Some(method.info().id.to_owned());
        Ok(Prepared::default())
    }

    fn trace(&mut self, _: DepthSetup, time_s: f64) -> Result<Vec<u8>, NoPicture> {
        self.ask(format!("trace {time_s:.2}"))?;
        Ok(vec![0; 4])
    }

    fn verify(
        &mut self,
        (index, cell): (usize, &Cell),
        frame: u32,
        _: Option<Instant>,
    ) -> Result<Verified, NoPicture> {
        self.ask(format!("verify {} {frame}", self.name(index)))?;
        Ok(Verified {
            frame: VerifiedFrame::of(cell, frame, 0.0),
            regions: Vec::new(),
            images: Vec::new(),
        })
    }

    fn frames_in_flight(&self) -> usize {
        2
    }

    fn draw(
        &mut self,
        cell: usize,
        times_s: &[f64],
        _: Option<Instant>,
    ) -> Result<Option<DrawnVolumes>, NoPicture> {
        assert!(self.under_way.len() < self.frames_in_flight());
        let times: Vec<_> = times_s.iter().map(|s| format!("{s:.2}")).collect();
        let line = format!("{} {}", self.name(cell), times.join(" "));
        self.ask(format!("draw {line}"))?;
        self.under_way.push_back(line);
        Ok(None)
    }

    fn wait_for_oldest(&mut self, _: Option<Instant>) -> Result<FrameTimes, NoPicture> {
        let line = self.under_way.pop_front().expect("a frame is under way");
        self.ask(format!("wait {line}"))?;
        Ok(FrameTimes::of_stages(&[
            ("gbuffer", 1.0),
            ("volumes", 2.0),
            ("shade", 0.5),
        ]))
    }

    fn lost(&self) -> Option<String> {
        self.lost.then(|| "the device was lost".to_owned())
    }

    fn edges(&self) -> Option<EdgeRecord> {
        None
    }

    fn close(self: Box<Self>) {}
}
