//! Progress of a run: a bar with the remaining time on a terminal, plain lines otherwise.
#![allow(
    clippy::print_stderr,
    reason = "progress goes to standard error, results to files"
)]

use crate::bench::Observer;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Shows progress and carries Ctrl-C to the run.
pub(super) struct Progress {
    bar: ProgressBar,
    plain: bool,
    started: Instant,
    interrupted: Arc<AtomicBool>,
}

impl Progress {
    /// Starts listening for Ctrl-C: the first one asks the run to stop after what is under way, the second
    /// ends the program. `things` is what is counted.
    pub(super) fn counting(things: &str) -> anyhow::Result<Self> {
        let interrupted = Arc::new(AtomicBool::new(false));
        let flag = Arc::clone(&interrupted);
        ctrlc::set_handler(move || {
            if flag.swap(true, Ordering::Relaxed) {
                std::process::exit(i32::from(super::FAILED));
            }
            eprintln!("stopping soon; once more to end at once");
        })?;
        let plain = !std::io::stderr().is_terminal();
        let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::stderr());
        if plain {
            bar.set_draw_target(ProgressDrawTarget::hidden());
        }
        let style = format!("{{bar:30}} {{pos}}/{{len}} {things}, {{eta}} left  {{msg}}");
        bar.set_style(ProgressStyle::with_template(&style)?);
        Ok(Self {
            bar,
            plain,
            started: Instant::now(),
            interrupted,
        })
    }

    /// Clears the bar.
    pub(super) fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

impl Observer for Progress {
    fn begin(&self, steps: u64) {
        self.bar.set_length(steps);
        self.bar.enable_steady_tick(Duration::from_millis(500));
    }

    fn phase(&self, text: &str) {
        self.bar.set_message(text.to_owned());
        if self.plain {
            let (done, all) = (self.bar.position(), self.bar.length().unwrap_or(0));
            eprintln!(
                "[{:6.1} s] {done}/{all} {text}",
                self.started.elapsed().as_secs_f64()
            );
        }
    }

    fn advance(&self, steps: u64) {
        self.bar.inc(steps);
    }

    fn interrupted(&self) -> bool {
        self.interrupted.load(Ordering::Relaxed)
    }
}
