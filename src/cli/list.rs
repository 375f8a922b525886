//! `svbench list [methods|scenes|causes|devices]`

use crate::config::{builtin_scenes, find_scene};
use crate::console;
use crate::gpu::{DeviceSummary, Gpu, GpuError, GpuOptions, list_devices};
use crate::methods::{Limit, MethodInfo, REGISTRY};
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
    /// Tell what this graphics adapter can run
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
struct MethodRow {
    #[serde(flatten)]
    info: &'static MethodInfo,
    available: bool,
    reason: String,
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
struct Listing {
    #[serde(skip_serializing_if = "Option::is_none")]
    methods: Option<Vec<MethodRow>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    scenes: Option<Vec<SceneRow>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    causes: Option<Vec<CauseRecord>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    devices: Option<Vec<DeviceSummary>>,
}

pub(super) fn execute(args: &ListArgs) -> anyhow::Result<()> {
    let asked = |what| args.what.is_none_or(|asked| asked == what);
    let listing = Listing {
        methods: asked(What::Methods)
            .then(|| methods(args.adapter.clone()))
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
        console::print(&text(&listing));
        if no_device {
            console::print(&format!("{}\n", GpuError::NoAdapter));
        }
    }
    console::check_printed()
}

fn methods(adapter: Option<String>) -> anyhow::Result<Vec<MethodRow>> {
    let named = adapter.is_some();
    let gpu = match Gpu::open(&GpuOptions {
        adapter,
        validation: false,
    }) {
        Ok(gpu) => Ok(gpu),
        // Without any device there is still something to list; a name that fits none is a mistake.
        Err(error) if !named => Err(error.to_string()),
        Err(error) => return Err(error.into()),
    };
    let row = |info: &'static MethodInfo| {
        let checked = gpu
            .as_ref()
            .map_err(Clone::clone)
            .and_then(|gpu| info.check(gpu));
        MethodRow {
            info,
            available: checked.is_ok(),
            reason: checked.err().unwrap_or_default(),
        }
    };
    Ok(REGISTRY
        .iter()
        .map(|registration| row(registration.info))
        .collect())
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

/// What a limit says besides its text: where it shows, as what, and how much of it there may be.
fn limit_details(limit: &Limit) -> Vec<String> {
    let fails = limit.fails.iter();
    let causes: Vec<_> = fails
        .map(|(cause, from)| format!("{cause} from {from}"))
        .collect();
    let kinds: Vec<_> = limit.kinds.iter().map(|kind| kind.word()).collect();
    let mut details = Vec::new();
    if !causes.is_empty() {
        details.push(format!("causes: {}", causes.join(", ")));
    }
    if !kinds.is_empty() {
        details.push(format!("kinds of error: {}", kinds.join(", ")));
    }
    if !details.is_empty() {
        details.push(format!("at most: {}", limit.at_most));
    }
    details
}

fn text(listing: &Listing) -> String {
    let mut text = String::new();
    let mut line = |indent: usize, words: &str| {
        text.push_str(&" ".repeat(indent));
        text.push_str(words);
        text.push('\n');
    };
    let availability = |available: bool, reason: &str| {
        if available {
            "available".to_owned()
        } else {
            format!("not available: {reason}")
        }
    };
    for method in listing.methods.iter().flatten() {
        let MethodRow {
            info,
            available,
            reason,
        } = method;
        line(0, &format!("{}  {}", info.id, info.title));
        line(4, &format!("from: {}", info.source));
        let needs: Vec<_> = info.needs.iter().map(|need| need.label()).collect();
        let needs = if needs.is_empty() {
            "nothing special".to_owned()
        } else {
            needs.join("; ")
        };
        line(4, &format!("needs: {needs}"));
        for limit in info.limits.iter().copied().flatten() {
            line(4, &format!("limit: {}", limit.text));
            for words in limit_details(limit) {
                line(8, &words);
            }
        }
        for (name, default, meaning) in info.parameters.concat() {
            line(4, &format!("parameter: {name} = {default}  ({meaning})"));
        }
        line(4, &availability(*available, reason));
    }
    for scene in listing.scenes.iter().flatten() {
        line(0, &format!("{}  {}", scene.name, scene.title));
        let count = |count: Option<u64>| count.map_or("?".to_owned(), |count| count.to_string());
        let (triangles, objects) = (count(scene.triangles), count(scene.objects));
        line(
            4,
            &format!("{}: {triangles} triangles, {objects} objects", scene.mesh),
        );
        line(4, &availability(scene.available, &scene.reason));
    }
    for cause in listing.causes.iter().flatten() {
        line(0, &format!("{}  {}", cause.id, cause.title));
        let values: Vec<_> = cause.values.iter().map(f64::to_string).collect();
        line(4, &format!("{}: {}", cause.number, values.join(", ")));
        line(4, &cause.why);
    }
    for device in listing.devices.iter().flatten() {
        line(
            0,
            &format!(
                "{}  {}, {}",
                device.name, device.device_type, device.backend
            ),
        );
        line(
            4,
            &format!("driver: {} {}", device.driver, device.driver_info),
        );
        let has = |has: bool| if has { "yes" } else { "no" };
        let (tessellation, geometry) = (has(device.tessellation), has(device.geometry));
        line(
            4,
            &format!("tessellation shaders: {tessellation}, geometry shaders: {geometry}"),
        );
        let unsuitable = device.unsuitable.as_deref();
        let reason = unsuitable
            .map(|missing| format!("lacks {missing}"))
            .unwrap_or_default();
        line(4, &availability(unsuitable.is_none(), &reason));
    }
    text
}
