//! Where the numbers come from, to the last setting.

use maud::{Markup, html};

use super::shell::{self, Section, details};
use crate::record::{RunInfo, SceneRecord};
use crate::report::format::{count, date};
use crate::report::load::Run;
use crate::report::table::{Cell, Column, Table};

/// What every number of a run depends on.
pub(super) fn run_facts(info: &RunInfo) -> Markup {
    let count = |frames: u32| count(frames.into());
    let frames = format!(
        "{} measured, {} verified, {} to warm up",
        count(info.frames),
        count(info.verified_frames),
        count(info.warmup_frames)
    );
    let measured = ("Measured", date(&info.started));
    facts(info, measured, ("Frames per cell", frames))
}

/// What runs of any kind depend on, with when it was and what they alone depend on.
pub(super) fn facts(info: &RunInfo, when: (&str, String), own: (&str, String)) -> Markup {
    let device = &info.device;
    let driver = format!("{} {}", device.driver, device.driver_info);
    let driver = format!("{} · {}", driver.trim(), device.backend);
    let program = format!("svbench {} {}", info.program_version, info.program_git);
    shell::facts(&[
        ("Device", device.name.clone()),
        ("Driver", driver),
        when,
        ("Program", program.trim_end().to_owned()),
        ("Picture", format!("{} × {} px", info.width, info.height)),
        own,
    ])
}

pub(super) fn section(run: &Run) -> Section {
    let methods = Table::of("Methods", &run.info.methods)
        .column(Column::heads("Method", ""), |of| Cell::code(&of.id))
        .text("Variant", |method| method.variant.as_str())
        .text("Name", |method| method.title.as_str())
        .text("Stages", |method| method.stages.join(" → "));
    let tables = html! {
        h3 { "Scenes" } (scenes(&run.info.scenes))
        h3 { "Methods" } (methods.html())
    };
    of(&run.info, &run.warnings, &tables)
}

/// Where the numbers of a run of any kind come from.
pub(super) fn of(info: &RunInfo, warnings: &[String], tables: &Markup) -> Section {
    let configuration = html! { "Configuration " code { (info.config_path) } };
    let text = html! { pre { code { (info.config_text) } } };
    let content = html! {
        @if !warnings.is_empty() { h3 { "Warnings" } }
        (self::warnings(warnings))
        (settings(info))
        (tables)
        @if !info.config_text.is_empty() { (details(&configuration, &text)) }
    };
    Section::new("provenance", "Provenance", content)
}

/// Program, device, machine and all else that a run was started with.
fn settings(info: &RunInfo) -> Markup {
    let has = |stage: bool| if stage { "yes" } else { "no" };
    let RunInfo { device, host, .. } = info;
    html! {
        dl.settings {
            dt { "Command" } dd { code { (info.command.join(" ")) } }
            dt { "Started" } dd { (info.started) }
            dt { "Program" } dd { "svbench " (info.program_version) " " code { (info.program_git) } }
            dt { "Device" } dd {
                (device.name) ", " (device.device_type) ", vendor " (format!("0x{:04x}", device.vendor_id))
                "; tessellation: " (has(device.tessellation)) ", geometry stage: " (has(device.geometry))
            }
            dt { "Driver" } dd { (device.driver) " " (device.driver_info) ", " (device.backend) }
            dt { "Host" } dd { (host.os) " " (host.arch) ", " (host.cores) " logical processors" }
            @if let Some(bytes) = info.peak_memory_bytes { dt { "Peak memory" } dd { (crate::memory::size_text(bytes)) } }
            dt { "Seed" } dd { (info.seed) }
            dt { "Shaders" } dd { code { (info.shader_hash) } } dt { "Run format" } dd { (info.format) }
        }
    }
}

/// What a reading of a run had to work around, and what the run itself warns of.
pub(super) fn warnings(warnings: &[String]) -> Markup {
    html! { @if !warnings.is_empty() { ul.warnings { @for warning in warnings { li { (warning) } } } } }
}

fn scenes(scenes: &[SceneRecord]) -> Markup {
    Table::of("Scenes", scenes)
        .column(Column::heads("Scene", ""), |of| Cell::code(&of.name))
        .number("Triangles", |scene| scene.triangles)
        .number("Objects", |scene| scene.objects)
        .number(("Boundary", "edges"), |s| s.edges.map(|e| e.boundary))
        .number(("Manifold", "edges"), |s| s.edges.map(|e| e.manifold))
        .number(("Non-manifold", "edges"), |scene| {
            scene.edges.map(|edges| edges.non_manifold)
        })
        .text("Light", light)
        .text("Mesh hash", |scene| Cell::code(&scene.mesh_hash))
        .html()
}

fn light(scene: &SceneRecord) -> String {
    let [x, y, z] = scene.light;
    let is_directional = scene.light_w == 0.0;
    let kind = if is_directional { "towards" } else { "at" };
    let moves = scene.light_moves.then_some(" at the start; it moves");
    format!("{kind} ({x}, {y}, {z}){}", moves.unwrap_or_default())
}
