//! Where the numbers come from, to the last setting.

use maud::{Markup, html};

use super::shell::{Section, details};
use crate::record::{DeviceRecord, HostRecord, SceneRecord};
use crate::report::format::count;
use crate::report::load::Run;
use crate::report::table::{Cell, Column, Table};

/// The provenance section.
pub(super) fn section(run: &Run) -> Section {
    let info = &run.info;
    let origin = Origin {
        warnings: &run.warnings,
        command: &info.command,
        started: &info.started,
        program_version: &info.program_version,
        program_git: &info.program_git,
        device: &info.device,
        host: &info.host,
        seed: info.seed,
        shader_hash: &info.shader_hash,
        format: info.format,
        config_path: &info.config_path,
        config_text: &info.config_text,
    };
    origin.section(&html! {
        h3 { "Scenes" }
        (scenes(&info.scenes).html())
        h3 { "Methods" }
        (methods(run).html())
    })
}

/// Where the numbers of a run of any kind come from.
pub(super) struct Origin<'a> {
    pub warnings: &'a [String],
    pub command: &'a [String],
    pub started: &'a str,
    pub program_version: &'a str,
    pub program_git: &'a str,
    pub device: &'a DeviceRecord,
    pub host: &'a HostRecord,
    pub seed: u64,
    pub shader_hash: &'a str,
    pub format: u32,
    pub config_path: &'a str,
    pub config_text: &'a str,
}

impl Origin<'_> {
    /// The section, with the tables of what was run.
    pub(super) fn section(&self, tables: &Markup) -> Section {
        let configuration = html! { "Configuration " code { (self.config_path) } };
        let text = html! { pre { code { (self.config_text) } } };
        let content = html! {
            @if !self.warnings.is_empty() {
                h3 { "Warnings" }
                (warnings(self.warnings))
            }
            (self.settings())
            (tables)
            @if !self.config_text.is_empty() { (details(&configuration, &text)) }
        };
        Section::new("provenance", "Provenance", content)
    }

    /// Program, device, machine and all else that a run was started with.
    fn settings(&self) -> Markup {
        let has = |stage: bool| if stage { "yes" } else { "no" };
        let Self { device, host, .. } = self;
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
                dt { "Command" } dd { code { (self.command.join(" ")) } }
                dt { "Started" } dd { (self.started) }
                dt { "Program" } dd { "svbench " (self.program_version) " " code { (self.program_git) } }
                dt { "Device" } dd { (device_text) }
                dt { "Driver" } dd { (device.driver) " " (device.driver_info) ", " (device.backend) }
                dt { "Host" } dd { (host) }
                dt { "Seed" } dd { (self.seed) }
                dt { "Shaders" } dd { code { (self.shader_hash) } }
                dt { "Run format" } dd { (self.format) }
            }
        }
    }
}

/// What a reading of a run had to work around, and what the run itself warns of.
pub(super) fn warnings(warnings: &[String]) -> Markup {
    html! { ul.warnings { @for warning in warnings { li { (warning) } } } }
}

fn scenes(scenes: &[SceneRecord]) -> Table {
    let columns = [
        Column::heads("Scene", "text"),
        Column::number("Triangles"),
        Column::number("Objects"),
        Column::number("Boundary").unit("edges"),
        Column::number("Manifold").unit("edges"),
        Column::number("Non-manifold").unit("edges"),
        Column::text("Light"),
        Column::text("Mesh hash"),
    ];
    let rows = scenes.iter().map(|scene| {
        [
            Cell::code(&scene.name),
            scene.triangles.map(count).into(),
            scene.objects.map(count).into(),
            scene.edges.map(|edges| count(edges.boundary)).into(),
            scene.edges.map(|edges| count(edges.manifold)).into(),
            scene.edges.map(|edges| count(edges.non_manifold)).into(),
            light(scene).into(),
            Cell::code(&scene.mesh_hash),
        ]
    });
    Table::new("Scenes", columns).extend(rows)
}

fn light(scene: &SceneRecord) -> String {
    let [x, y, z] = scene.light;
    let is_directional = scene.light_w == 0.0;
    let kind = if is_directional { "towards" } else { "at" };
    let moves = if scene.light_moves {
        " at the start; it moves"
    } else {
        ""
    };
    format!("{kind} ({x}, {y}, {z}){moves}")
}

fn methods(run: &Run) -> Table {
    let columns = [
        Column::heads("Method", "text"),
        Column::text("Variant"),
        Column::text("Name"),
        Column::text("Stages"),
    ];
    let rows = run.info.methods.iter().map(|method| {
        [
            Cell::code(&method.id),
            method.variant.as_str().into(),
            method.title.as_str().into(),
            method.stages.join(" → ").into(),
        ]
    });
    Table::new("Methods", columns).extend(rows)
}
