//! The shadow profile of a day (G. Wallner, *Geometry of Real Time Shadows*, 2006, section 8): where the shadows are
//! while the sun moves, and how many hours of sun each place has.
//!
//! A [`Day`] is cut into steps; [`draw`] draws each once by the truth and once by each method, with a camera that
//! stands still, and writes everything into a directory:
//!
//! - [`Overlay`](overlay::Overlay): the shadows of all steps over each other, coloured by time;
//! - [`heat_map`](heat_map::heat_map): hours in sun per pixel;
//! - [`Film`](film::Film): the day as an animated PNG;
//! - [`hours`]: the sums behind these, and how many minutes of sun a method is off;
//! - [`triangles`]: the same per triangle, by rays.

pub mod colour;
mod day;
mod draw;
pub mod film;
pub mod heat_map;
pub mod hours;
mod info;
pub mod overlay;
mod page;
pub mod picture;
mod rows;
pub mod triangles;

pub use day::{Day, DayError, DayRequest, Step};
pub use draw::{Profile, ProfileRequest, draw};
pub use info::ProfileInfo;
pub use page::write_page;
pub use rows::{HourRow, MethodRow};

/// The shadows of all steps.
pub const OVERLAY_FILE: &str = "overlay.png";
/// Hours of sun by the truth.
pub const HOURS_FILE: &str = "hours.png";
/// The film of the day.
pub const FILM_FILE: &str = "day.png";
/// A row a step.
pub const STEPS_TABLE: &str = "hours.csv";
/// A row a method.
pub const METHODS_TABLE: &str = "methods.csv";
/// A row a triangle.
pub const TRIANGLES_TABLE: &str = "triangles.csv";
/// The triangles, coloured.
pub const TRIANGLES_PLY: &str = "triangles.ply";
/// What all of it is of.
pub const INFO_FILE: &str = "profile.json";
/// Everything on one page.
pub const PAGE_FILE: &str = "profile.html";

#[cfg(test)]
mod box_tests;
