//! Where the numbers come from, to the last setting.

use maud::{Markup, html};

use crate::bench::record::SceneRecord;
use crate::report::format::count;
use crate::report::load::Run;

/// The provenance section.
pub(super) fn section(run: &Run) -> Markup {
    html! {
        section #provenance {
            h2 { "Provenance" }
            @if !run.warnings.is_empty() {
                h3 { "Warnings" }
                ul.warnings { @for warning in &run.warnings { li { (warning) } } }
            }
            (settings(run))
            h3 { "Scenes" }
            (scenes(&run.info.scenes))
            h3 { "Methods" }
            (methods(run))
            @if !run.info.config_text.is_empty() {
                details {
                    summary { "Configuration " code { (run.info.config_path) } }
                    pre { code { (run.info.config_text) } }
                }
            }
        }
    }
}

fn settings(run: &Run) -> Markup {
    let info = &run.info;
    let has = |stage: bool| if stage { "yes" } else { "no" };
    let device = &info.device;
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
        info.host.os, info.host.arch, info.host.cores
    );
    html! {
        dl.settings {
            dt { "Command" } dd { code { (info.command.join(" ")) } }
            dt { "Started" } dd { (info.started) }
            dt { "Program" } dd { "svbench " (info.program_version) " " code { (info.program_git) } }
            dt { "Device" } dd { (device_text) }
            dt { "Driver" } dd { (device.driver) " " (device.driver_info) ", " (device.backend) }
            dt { "Host" } dd { (host) }
            dt { "Seed" } dd { (info.seed) }
            dt { "Shaders" } dd { code { (info.shader_hash) } }
            dt { "Run format" } dd { (info.format) }
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
    format!("{kind} ({x}, {y}, {z})")
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
