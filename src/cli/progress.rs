//! Progress: a bar with the remaining time on a terminal that can draw one, plain lines otherwise.

use super::interrupt;
use crate::console;
use crate::judge::Observer;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::cell::Cell;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Where there is no bar, a line at least so often.
const LINE_EVERY: Duration = Duration::from_secs(10);

/// Shows progress and carries requests to stop.
pub(super) struct Progress {
    bar: ProgressBar,
    /// Where no bar can be drawn: what is counted, and when the last line was.
    plain: Option<(String, Cell<Instant>)>,
    started: Instant,
    interrupted: Arc<AtomicBool>,
}

impl Progress {
    /// Starts listening for requests to stop. `things` is what is counted.
    pub(super) fn counting(things: &str) -> anyhow::Result<Self> {
        let interrupted = interrupt::listen()?;
        let target = ProgressDrawTarget::stderr();
        let plain = target.is_hidden() || is_dumb_terminal();
        let target = if plain {
            ProgressDrawTarget::hidden()
        } else {
            target
        };
        let bar = ProgressBar::with_draw_target(None, target);
        let style = format!("{{bar:30}} {{pos}}/{{len}} {things}, {{eta}} left  {{msg}}");
        bar.set_style(ProgressStyle::with_template(&style)?);
        let started = Instant::now();
        Ok(Self {
            bar,
            plain: plain.then(|| (things.to_owned(), Cell::new(started))),
            started,
            interrupted,
        })
    }

    /// A line, where there is no bar.
    fn line(&self, text: &str) {
        if let Some((_, last)) = &self.plain {
            last.set(Instant::now());
            let (done, all) = (self.bar.position(), self.bar.length().unwrap_or(0));
            let seconds = self.started.elapsed().as_secs_f64();
            let of_all = if all > 0 {
                format!("/{all}")
            } else {
                String::new()
            };
            console::say(&format!("[{seconds:6.1} s] {done}{of_all} {text}"));
        }
    }

    /// Clears the bar.
    pub(super) fn finish(&self) {
        self.bar.finish_and_clear();
    }

    /// Prints a line to standard output, which the bar makes room for.
    pub(super) fn print(&self, line: &str) {
        self.bar.suspend(|| console::print(line));
    }
}

/// Whether the terminal cannot draw over a line, or does not say what it is.
fn is_dumb_terminal() -> bool {
    match std::env::var_os("TERM") {
        Some(name) => name.is_empty() || name == "dumb",
        None => cfg!(unix),
    }
}

impl Observer for Progress {
    fn begin(&self, steps: u64) {
        self.bar.set_length(steps);
        match &self.plain {
            Some((things, _)) => self.line(things),
            None => self.bar.enable_steady_tick(Duration::from_millis(500)),
        }
    }

    fn phase(&self, text: &str) {
        self.bar.set_message(text.to_owned());
        self.line(text);
    }

    fn advance(&self, steps: u64) {
        self.bar.inc(steps);
        if let Some((things, last)) = &self.plain
            && last.get().elapsed() > LINE_EVERY
        {
            self.line(things);
        }
    }

    fn interrupted(&self) -> bool {
        self.interrupted.load(Ordering::Relaxed)
    }
}
