//! Being asked to stop: Ctrl-C, and the signals by which batch queues, service managers and closed terminals ask.

use crate::console;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Starts listening, and gives the flag that the first request sets: what is under way is to end soon.
///
/// A second Ctrl-C ends the program at once. Other signals only ever ask: who sends them sends them twice at times,
/// and kills the program if it takes too long.
pub(super) fn listen() -> anyhow::Result<Arc<AtomicBool>> {
    let asked = Arc::new(AtomicBool::new(false));
    let flag = Arc::clone(&asked);
    on_request(move |is_typed| {
        let is_second = flag.swap(true, Ordering::Relaxed);
        if is_second && is_typed {
            std::process::exit(i32::from(super::FAILED));
        }
        if !is_second {
            console::say("stopping soon; Ctrl-C once more ends at once");
        }
    })?;
    Ok(asked)
}

/// Calls `request` whenever the program is asked to stop, with whether it was by Ctrl-C.
#[cfg(unix)]
fn on_request(request: impl Fn(bool) + Send + 'static) -> anyhow::Result<()> {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    let heeded = [SIGHUP, SIGINT, SIGTERM]
        .into_iter()
        .filter(|signal| !is_ignored(*signal));
    let mut signals = signal_hook::iterator::Signals::new(heeded)?;
    let thread = std::thread::Builder::new().name("signals".to_owned());
    thread.spawn(move || {
        for signal in signals.forever() {
            request(signal == SIGINT);
        }
    })?;
    Ok(())
}

/// Whether who started the program wants it to go on in spite of a signal, as `nohup` does of SIGHUP.
#[cfg(unix)]
fn is_ignored(signal: i32) -> bool {
    match std::fs::read_to_string("/proc/self/status") {
        Ok(status) => ignored_signals(&status).is_some_and(|mask| mask >> (signal - 1) & 1 == 1),
        // Where the system cannot be asked, a run under `nohup` matters more than one whose terminal closes.
        Err(_) => signal == signal_hook::consts::SIGHUP,
    }
}

#[cfg(unix)]
fn ignored_signals(status: &str) -> Option<u64> {
    let mask = status
        .lines()
        .find_map(|line| line.strip_prefix("SigIgn:"))?;
    u64::from_str_radix(mask.trim(), 16).ok()
}

#[cfg(not(unix))]
fn on_request(request: impl Fn(bool) + Send + 'static) -> anyhow::Result<()> {
    Ok(ctrlc::set_handler(move || request(true))?)
}

#[cfg(test)]
#[cfg(unix)]
mod tests {
    use super::*;

    #[test]
    fn ignored_signals_are_read() {
        let status = "Name:\tx\nSigBlk:\t0000000000000001\nSigIgn:\t0000000000001001\n";
        assert_eq!(ignored_signals(status), Some(0x1001));
        assert_eq!(ignored_signals("Name:\tx\n"), None);
    }
}
