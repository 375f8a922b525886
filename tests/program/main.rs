//! The program and its scripts, as their users run them.

mod bad_input;
mod cli;
mod profile;
mod report;
mod scripts;
