//! What a profile is of and where its numbers come from: `profile.json`.

use std::path::Path;

use serde::Serialize;

use super::INFO_FILE;
use super::day::Day;
use crate::gpu::{Gpu, shader};
use crate::output;
use crate::record::{DeviceRecord, HostRecord, provenance};
use crate::scene::{Scene, View};

/// The version of the directory's layout.
const FORMAT: u32 = 1;

/// Everything that the numbers of a profile depend on.
#[derive(Clone, Debug, Serialize)]
pub struct ProfileInfo {
    /// Version of the layout.
    pub format: u32,
    /// The scene's name.
    pub scene: String,
    /// Its name for people.
    pub title: String,
    /// Hash over the mesh.
    pub mesh_hash: String,
    /// Degrees north.
    pub latitude_deg: f64,
    /// Degrees east.
    pub longitude_deg: f64,
    /// North in world space.
    pub north: [f64; 3],
    /// Up in world space.
    pub up: [f64; 3],
    /// The date.
    pub date: String,
    /// The time zone, as written.
    pub zone: String,
    /// Local time of the first step.
    pub from: String,
    /// Local time of the last.
    pub to: String,
    /// From one step to the next.
    pub step_minutes: f64,
    /// Where the camera stands.
    pub eye: [f32; 3],
    /// Where it looks.
    pub target: [f32; 3],
    /// Width of the pictures, without what stands below them.
    pub width: u32,
    /// Their height.
    pub height: u32,
    /// The program.
    pub program_version: String,
    /// Its commit.
    pub program_git: String,
    /// Hash over all shaders.
    pub shader_hash: String,
    /// The command line.
    pub command: Vec<String>,
    /// When it began.
    pub started: String,
    /// How long it took.
    pub duration_s: f64,
    /// The device.
    pub device: DeviceRecord,
    /// The machine around it.
    pub host: HostRecord,
}

impl ProfileInfo {
    /// Of a profile that begins now.
    #[must_use]
    pub fn new(gpu: &Gpu, scene: &Scene, view: &View, day: &Day, size_px: (u32, u32)) -> Self {
        let request = &day.request;
        let clock = |step: Option<&super::Step>| step.map_or(String::new(), |step| day.clock(step));
        Self {
            format: FORMAT,
            scene: scene.name.clone(),
            title: scene.title.clone(),
            mesh_hash: scene.mesh_hash.clone(),
            latitude_deg: request.site.latitude_deg(),
            longitude_deg: request.site.longitude_deg(),
            north: request.compass.north().to_array(),
            up: request.compass.up().to_array(),
            date: request.day.date().to_string(),
            zone: request.day.zone_name().to_owned(),
            from: clock(day.steps.first()),
            to: clock(day.steps.last()),
            step_minutes: 60.0 * day.step_hours(),
            eye: view.eye.to_array(),
            target: view.target.to_array(),
            width: size_px.0,
            height: size_px.1,
            program_version: env!("CARGO_PKG_VERSION").to_owned(),
            program_git: provenance::program_git(),
            shader_hash: shader::hash(),
            command: provenance::command(),
            started: jiff::Timestamp::now().to_string(),
            duration_s: 0.0,
            device: DeviceRecord::of(gpu),
            host: HostRecord::here(),
        }
    }

    /// Writes it into the directory.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub fn write(&self, dir: &Path) -> anyhow::Result<()> {
        let text = serde_json::to_string_pretty(self)? + "\n";
        output::write_atomically(&dir.join(INFO_FILE), text)
    }
}
