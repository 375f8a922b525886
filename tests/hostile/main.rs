//! The program in situations that it does not choose.
#![allow(clippy::unwrap_used, reason = "tests")]

mod device;
