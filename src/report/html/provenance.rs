//! Where the numbers come from, to the last setting.

use maud::{Markup, html};

use crate::record::{DeviceRecord, HostRecord, SceneRecord};
use crate::report::format::count;
use crate::report::load::Run;

/// The provenance section.
pub(super) fn section(run: &Run) -> Markup {
    let info = &run.info;
    let origin = Origin {
        command: &info.command,
        started: &info.started,
        program_version: &info.program_version,
        program_git: &info.program_git,
        device: &info.device,
        host: &info.host,
        seed: info.seed,
        shader_hash: &info.shader_hash,
        format: info.format,
    };
    html! {
        section #provenance {
            h2 { "Provenance" }
            (warnings(&run.warnings))
            (settings(&origin))
            h3 { "Scenes" }
            (scenes(&info.scenes))
            h3 { "Methods" }
            (methods(run))
            (configuration(&info.config_path, &info.config_text))
        }
    }
}

/// Where the numbers of a run of any kind come from.
pub(super) struct Origin<'a> {
    pub command: &'a [String],
    pub started: &'a str,
    pub program_version: &'a str,
    pub program_git: &'a str,
    pub device: &'a DeviceRecord,
    pub host: &'a HostRecord,
    pub seed: u64,
    pub shader_hash: &'a str,
    pub format: u32,
}

/// Program, device, machine and all else that a run was started with.
pub(super) fn settings(origin: &Origin<'_>) -> Markup {
    let has = |stage: bool| if stage { "yes" } else { "no" };
    let Origin { device, host, .. } = origin;
    let device_text = format!(
        "{}, {}, vendor 0x{:04x}; tessellation: {}, geometry stage: {}",
        device.name,
        device.device_type,
        device.vendor_id,
        has(device.tessellation),
        has(device.geometry)
    );
    let host = format!(
        "{} {}, {} logical processors",
        host.os, host.arch, host.cores
    );
    html! {
        dl.settings {
            dt { "Command" } dd { code { (origin.command.join(" ")) } }
            dt { "Started" } dd { (origin.started) }
            dt { "Program" } dd { "svbench " (origin.program_version) " " code { (origin.program_git) } }
            dt { "Device" } dd { (device_text) }
            dt { "Driver" } dd { (device.driver) " " (device.driver_info) ", " (device.backend) }
            dt { "Host" } dd { (host) }
            dt { "Seed" } dd { (origin.seed) }
            dt { "Shaders" } dd { code { (origin.shader_hash) } }
            dt { "Run format" } dd { (origin.format) }
        }
    }
}

/// What a reading of a run had to work around, and what the run itself warns of.
pub(super) fn warnings(warnings: &[String]) -> Markup {
    html! {
        @if !warnings.is_empty() {
            h3 { "Warnings" }
            ul.warnings { @for warning in warnings { li { (warning) } } }
        }
    }
}

/// The configuration, word for word.
pub(super) fn configuration(path: &str, text: &str) -> Markup {
    html! {
        @if !text.is_empty() {
            details {
                summary { "Configuration " code { (path) } }
                pre { code { (text) } }
            }
        }
    }
}

fn scenes(scenes: &[SceneRecord]) -> Markup {
    html! {
        div.scroll tabindex="0" role="region" aria-label="Scenes" {
            table {
                thead {
                    tr {
                        th.text scope="col" { "Scene" }
                        th scope="col" { "Triangles" }
                        th scope="col" { "Objects" }
                        th scope="col" { "Boundary" small { "edges" } }
                        th scope="col" { "Manifold" small { "edges" } }
                        th scope="col" { "Non-manifold" small { "edges" } }
                        th.text scope="col" { "Light" }
                        th.text scope="col" { "Mesh hash" }
                    }
                }
                tbody {
                    @for scene in scenes {
                        tr {
                            th.text scope="row" { code { (scene.name) } }
                            (count_cell(scene.triangles))
                            (count_cell(scene.objects))
                            (count_cell(scene.edges.map(|edges| edges.boundary)))
                            (count_cell(scene.edges.map(|edges| edges.manifold)))
                            (count_cell(scene.edges.map(|edges| edges.non_manifold)))
                            td.text { (light(scene)) }
                            td.text { code { (scene.mesh_hash) } }
                        }
                    }
                }
            }
        }
    }
}

fn count_cell(value: Option<u64>) -> Markup {
    html! { td { (value.map_or_else(|| "–".to_owned(), count)) } }
}

fn light(scene: &SceneRecord) -> String {
    let [x, y, z] = scene.light;
    let kind = if scene.light_w == 0.0 {
        "towards"
    } else {
        "at"
    };
    let moves = if scene.light_moves {
        " at the start; it moves"
    } else {
        ""
    };
    format!("{kind} ({x}, {y}, {z}){moves}")
}

fn methods(run: &Run) -> Markup {
    html! {
        div.scroll tabindex="0" role="region" aria-label="Methods" {
            table {
                thead {
                    tr {
                        th.text scope="col" { "Method" }
                        th.text scope="col" { "Variant" }
                        th.text scope="col" { "Name" }
                        th.text scope="col" { "Stages" }
                    }
                }
                tbody {
                    @for method in &run.info.methods {
                        tr {
                            th.text scope="row" { code { (method.id) } }
                            td.text { (method.variant) }
                            td.text { (method.title) }
                            td.text { (method.stages.join(" → ")) }
                        }
                    }
                }
            }
        }
    }
}
