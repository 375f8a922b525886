//! `svbench list [methods|scenes|causes|devices]`

mod text;

use crate::config::{builtin_scenes, find_scene};
use crate::console;
use crate::gpu::{DeviceSummary, Gpu, GpuError, GpuOptions, list_devices};
use crate::methods::{Clash, Effect, MethodInfo, Parameter, Registration, Registry};
use crate::record::stress::CauseRecord;
use crate::scene::file::MeshSource;
use crate::stress::corpus;
use serde::Serialize;
use std::path::Path;

/// Arguments of `svbench list`.
#[derive(Debug, clap::Args)]
pub(super) struct ListArgs {
    /// What to list; everything if left out
    what: Option<What>,
    /// Print JSON
    #[arg(long)]
    json: bool,
    /// Show what this graphics adapter can run
    #[arg(long, value_name = "NAME")]
    adapter: Option<String>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum What {
    Methods,
    Scenes,
    /// Causes of failure, for `svbench stress`.
    Causes,
    Devices,
}

/// A method, and whether this device can run it.
#[derive(Serialize)]
struct MethodRow<'a> {
    #[serde(flatten)]
    info: &'static MethodInfo,
    parameters: &'a [Parameter],
    clashes: Vec<ClashRow>,
    available: bool,
    reason: String,
}

/// Parameters of a method that do not go together.
#[derive(Serialize)]
struct ClashRow {
    beside: String,
    parameters: Vec<&'static str>,
    effect: Effect,
    why: &'static str,
}

impl ClashRow {
    fn all_of(info: &MethodInfo, parameters: &[Parameter]) -> Vec<Self> {
        let row = |clash: &Clash| {
            let (name, value) = clash.beside;
            Self {
                beside: format!("{name}={value}"),
                parameters: clash.of(parameters),
                effect: clash.effect,
                why: clash.why,
            }
        };
        let rows = info.clashes.iter().map(row);
        rows.filter(|row| !row.parameters.is_empty()).collect()
    }
}

#[derive(Serialize)]
struct SceneRow {
    name: String,
    title: String,
    mesh: String,
    triangles: Option<u64>,
    objects: Option<u64>,
    available: bool,
    reason: String,
}

/// What was asked for; the rest stays out of the JSON.
#[derive(Default, Serialize)]
struct Listing<'a> {
    #[serde(skip_serializing_if = "Option::is_none")]
    methods: Option<Vec<MethodRow<'a>>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    scenes: Option<Vec<SceneRow>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    causes: Option<Vec<CauseRecord>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    devices: Option<Vec<DeviceSummary>>,
}

pub(super) fn execute(args: &ListArgs, registry: &Registry) -> anyhow::Result<()> {
    let asked = |what| args.what.is_none_or(|asked| asked == what);
    let listing = Listing {
        methods: asked(What::Methods)
            .then(|| methods(args.adapter.clone(), registry))
            .transpose()?,
        scenes: asked(What::Scenes).then(scenes).transpose()?,
        causes: asked(What::Causes).then(|| corpus().iter().map(|cause| cause.record()).collect()),
        devices: asked(What::Devices).then(list_devices),
    };
    let no_device = listing.devices.as_ref().is_some_and(Vec::is_empty);
    if args.json {
        if no_device {
            console::say(&GpuError::NoAdapter.to_string());
        }
        console::print(&(serde_json::to_string_pretty(&listing)? + "\n"));
    } else {
        console::print(&text::of(&listing));
        if no_device {
            console::print(&format!("{}\n", GpuError::NoAdapter));
        }
    }
    console::check_printed()
}

fn methods<'a>(
    adapter: Option<String>,
    registry: &'a Registry,
) -> anyhow::Result<Vec<MethodRow<'a>>> {
    let named = adapter.is_some();
    let gpu = match Gpu::open(&GpuOptions {
        adapter,
        ..GpuOptions::default()
    }) {
        Ok(gpu) => Ok(gpu),
        // Without any device there is still something to list; a name that fits none is a mistake.
        Err(error) if !named => Err(error.to_string()),
        Err(error) => return Err(error.into()),
    };
    let row = |known: &'a Registration| {
        let info = known.info;
        let checked = gpu
            .as_ref()
            .map_err(Clone::clone)
            .and_then(|gpu| info.check(gpu));
        MethodRow {
            info,
            parameters: &known.parameters,
            clashes: ClashRow::all_of(info, &known.parameters),
            available: checked.is_ok(),
            reason: checked.err().unwrap_or_default(),
        }
    };
    Ok(registry.iter().map(row).collect())
}

fn scenes() -> anyhow::Result<Vec<SceneRow>> {
    let row = |name: &str| {
        let plan = find_scene(name, Path::new(""))?;
        let (mesh, missing) = match &plan.file.mesh {
            MeshSource::SphereGrid(grid) => {
                let text = format!(
                    "{} × {} spheres, {} slices",
                    grid.rows, grid.columns, grid.slices
                );
                (text, None)
            }
            MeshSource::City(city) => (format!("a city of {} objects", city.objects), None),
            MeshSource::Obj { file, .. } => {
                let missing = plan.search.find(file).is_none();
                let reason = format!("{} not found; set SVBENCH_MODELS", file.display());
                (file.display().to_string(), missing.then_some(reason))
            }
        };
        Ok(SceneRow {
            name: plan.file.name,
            title: plan.file.title,
            mesh,
            triangles: plan.file.expect.map(|expect| expect.triangles),
            objects: plan.file.expect.map(|expect| expect.objects),
            available: missing.is_none(),
            reason: missing.unwrap_or_default(),
        })
    };
    builtin_scenes().into_iter().map(row).collect()
}
