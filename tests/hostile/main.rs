//! The program where things go wrong around it: each module starts it in one situation and looks at its exit code,
//! its words, and the files that it leaves and their modes.
#![cfg(unix)]
#![allow(clippy::unwrap_used, reason = "tests")]

mod room;

mod device;
mod disk;
mod names;
mod outputs;
mod signals;
mod streams;
mod surroundings;
