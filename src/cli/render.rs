//! `svbench render SCENE --method ID`

use super::shot::{ShotArgs, kinds_of_error, wrong_pixels};
use super::{DeviceArgs, check_size, outputs, reference_cache, values};
use crate::console;
use crate::frame::{FrameResources, PreparedMethod};
use crate::gpu::{FrameTimer, FrameTimes, Gpu};
use crate::judge::{DeviceScene, Judgement, Truth, Verifier};
use crate::methods::Registry;
use crate::metrics::MaskError;
use crate::record::Image;
use crate::variant::Variant;
use anyhow::Context;
use serde::Serialize;
use std::path::{Path, PathBuf};

/// Arguments of `svbench render`.
#[derive(Debug, clap::Args)]
pub(super) struct RenderArgs {
    #[command(flatten)]
    shot: ShotArgs,
    /// The method, with parameters if any
    #[arg(long, value_name = "ID[,key=value...]")]
    method: String,
    /// Size of the picture
    #[arg(long, value_name = "WxH", value_parser = values::size, default_value = "1024x768")]
    size: (u32, u32),
    /// Write the lit picture
    #[arg(long, value_name = "F.png")]
    out: Option<PathBuf>,
    /// Write the shadow mask: 0 lit or background, 255 in shadow
    #[arg(long, value_name = "F.png")]
    mask: Option<PathBuf>,
    /// Write the ray-traced truth: as the mask, and 128 where ambiguous
    #[arg(long, value_name = "F.png")]
    reference: Option<PathBuf>,
    /// Write the map of wrong pixels
    #[arg(long, value_name = "F.png")]
    error: Option<PathBuf>,
    /// Print error counts and stage times as JSON
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    device: DeviceArgs,
}

impl RenderArgs {
    /// What is written, by option.
    fn outputs(&self) -> Vec<(&'static str, &Path)> {
        let options = [
            ("--out", &self.out),
            ("--mask", &self.mask),
            ("--reference", &self.reference),
            ("--error", &self.error),
        ];
        let named = options.into_iter();
        named
            .filter_map(|(option, path)| Some((option, path.as_deref()?)))
            .collect()
    }

    fn write(
        &self,
        picture: &[u8],
        mask: &[u8],
        truth: &Truth,
        judgement: &Judgement,
    ) -> anyhow::Result<()> {
        let (size, reference) = (self.size, truth.mask.to_grey());
        let images = [
            (&self.out, Image::rgba(size, picture)),
            (&self.mask, Image::grey(size, mask)),
            (&self.reference, Image::grey(size, &reference)),
            (&self.error, Image::rgb(size, &judgement.error_map)),
        ];
        for (path, image) in images {
            if let Some(path) = path {
                image.write_png(path)?;
            }
        }
        Ok(())
    }
}

/// Numbers by name.
type NumbersByName = serde_json::Map<String, serde_json::Value>;

fn counts<'a>(counts: impl Iterator<Item = (&'a str, u64)>) -> NumbersByName {
    counts
        .map(|(name, count)| (name.to_owned(), count.into()))
        .collect()
}

/// What is printed.
#[derive(Serialize)]
struct Output<'a> {
    scene: &'a str,
    triangles: usize,
    objects: usize,
    method: &'a str,
    variant: Variant,
    width: u32,
    height: u32,
    errors: MaskError,
    /// Of the wrong pixels, those that no tie excuses.
    hard_px: usize,
    labels: NumbersByName,
    distances_px: NumbersByName,
    frame_ms: f64,
    cpu_ms: f64,
    record_ms: f64,
    draw_calls: u32,
    stages_ms: NumbersByName,
    warnings: Vec<String>,
}

pub(super) fn execute(args: &RenderArgs, registry: &Registry) -> anyhow::Result<()> {
    let method = registry.parse(&args.method)?;
    outputs::check(&args.shot.inputs()?, &args.outputs())?;
    let scene = args.shot.load()?;
    let moment = args.shot.moment(&scene)?;
    let gpu = args.device.open()?;
    let (width, height) = args.size;
    check_size(&gpu, args.size, "--size")?;
    let info = method.info();
    let device = DeviceScene::new(&gpu, &scene, args.size)?;
    let prepared = device.prepare(method.as_ref());
    let prepared = prepared.with_context(|| format!("method `{}`", info.id))?;
    let (mut prepared, resources) = (prepared.method, prepared.resources);

    let cache = reference_cache()?;
    let verifier = Verifier::new(&gpu, &scene, &resources, &cache)?;
    let truth = verifier.truth(&moment)?;
    let mask = verifier.draw_mask(prepared.as_mut(), &truth)?;
    let picture = verifier.read_picture()?;
    let judgement = verifier.compare(&mask, &truth, prepared.as_ref())?;
    args.write(&picture, &mask, &truth, &judgement)?;

    // The frame above was this method's first; the times are those of a second one.
    let times = times_of_next(&gpu, &resources, prepared.as_mut())?;
    let output = Output {
        scene: &scene.name,
        triangles: scene.mesh.caster_triangle_count(),
        objects: scene.mesh.caster_object_count(),
        method: info.id,
        variant: method.variant(),
        width,
        height,
        errors: judgement.error,
        labels: counts(judgement.analysis.label_counts()),
        distances_px: counts(judgement.distances.classes()),
        frame_ms: times.frame_ms(),
        cpu_ms: times.cpu_ms,
        record_ms: times.record_ms,
        draw_calls: times.draw_calls,
        stages_ms: stages(&times),
        hard_px: verifier.hard_errors(&mask, &truth)?.len(),
        warnings: scene
            .notes
            .iter()
            .cloned()
            .chain(prepared.warnings())
            .chain(judgement.error.undecided())
            .collect(),
    };
    if args.json {
        console::print(&(serde_json::to_string_pretty(&output)? + "\n"));
    } else {
        let kinds = kinds_of_error(judgement.analysis.label_counts());
        console::print(&text(&output, &kinds, &times));
    }
    args.device.check_validation()?;
    console::check_printed()
}

fn times_of_next(
    gpu: &Gpu,
    resources: &FrameResources,
    method: &mut dyn PreparedMethod,
) -> anyhow::Result<FrameTimes> {
    let mut timer = FrameTimer::new(gpu);
    resources.begin(method);
    timer.frame(gpu, |frame| resources.record(frame, method))?;
    timer
        .finish(gpu)?
        .pop()
        .context("the frame's times got lost")
}

fn stages(times: &FrameTimes) -> NumbersByName {
    times
        .stage_names()
        .into_iter()
        .map(|name| (name.to_owned(), times.stage_ms(name).into()))
        .collect()
}

fn text(output: &Output<'_>, kinds: &str, times: &FrameTimes) -> String {
    let mut text = format!(
        "{} {} on {}: {} triangles, {} objects, {} × {} pixels\n",
        output.method,
        output.variant,
        output.scene,
        output.triangles,
        output.objects,
        output.width,
        output.height,
    );
    text.push_str(&wrong_pixels(&output.errors));
    if output.hard_px > 0 {
        let hard_px = output.hard_px;
        text.push_str(&format!(
            "hard errors: {hard_px} (the truth is the same all around)\n"
        ));
    }
    text.push_str(kinds);
    let stages: Vec<_> = times
        .stage_names()
        .into_iter()
        .map(|name| format!("{name} {:.3}", times.stage_ms(name)))
        .collect();
    text.push_str(&format!(
        "{:.3} ms: {}\n",
        times.frame_ms(),
        stages.join(", ")
    ));
    for warning in &output.warnings {
        text.push_str(&format!("note: {warning}\n"));
    }
    text
}
