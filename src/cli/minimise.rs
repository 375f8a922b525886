//! `svbench minimise SCENE --method ID`

use super::progress::Progress;
use super::shot::{ShotArgs, kinds_of_error, wrong_pixels};
use super::{DeviceArgs, check_size, earlier, outputs, values};
use crate::console;
use crate::file_name::file_name;
use crate::judge::Observer;
use crate::judge::{Attempt, Drawn, Judge, NoPicture};
use crate::methods::{Registry, ShadowMethod};
use crate::scene::{Flight, ModelSearch, Moment, Scene, SceneFile, export};
use crate::stress::minimise::{MinimiseError, Minimised, minimise};
use anyhow::Context;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Arguments of `svbench minimise`.
#[derive(Debug, clap::Args)]
pub(super) struct MinimiseArgs {
    #[command(flatten)]
    shot: ShotArgs,
    /// The method that draws it wrong, with parameters if any
    #[arg(long, value_name = "ID[,key=value...]")]
    method: String,
    /// Size of the picture
    #[arg(long, value_name = "WxH", value_parser = values::size, default_value = "160x120")]
    size: (u32, u32),
    /// Directory for the reduced scene, `<scene>_minimal.toml` and `.obj`
    #[arg(long, value_name = "DIR", default_value = ".")]
    out: PathBuf,
    /// Time limit; the smallest scene found by then is kept
    #[arg(long, value_name = "BUDGET", default_value = "60")]
    seconds: u32,
    #[command(flatten)]
    device: DeviceArgs,
}

/// Progress that also ends when the time is up.
struct Limited<'a> {
    progress: &'a Progress,
    deadline: Instant,
}

impl Observer for Limited<'_> {
    fn begin(&self, steps: u64) {
        self.progress.begin(steps);
    }

    fn phase(&self, text: &str) {
        self.progress.phase(text);
    }

    fn advance(&self, steps: u64) {
        self.progress.advance(steps);
    }

    fn interrupted(&self) -> bool {
        self.progress.interrupted() || Instant::now() >= self.deadline
    }
}

pub(super) fn execute(args: &MinimiseArgs, registry: &Registry) -> anyhow::Result<()> {
    let methods = [registry.parse(&args.method)?];
    let scene = args.shot.load()?;
    let moment = args.shot.moment(&scene)?;
    let scene = still(scene, &moment, &args.method);
    let stem = format!("{}_minimal", file_name(&scene.name));
    let path = args.out.join(format!("{stem}.toml"));
    let model = path.with_extension("obj");
    outputs::check(&args.shot.inputs()?, &[("--out", &path), ("--out", &model)])?;
    let earlier = earlier::read(&path, &scene)?;
    let gpu = args.device.open()?;
    check_size(&gpu, args.size, "--size")?;
    let judge = Judge::new(&gpu, args.size);
    let progress = Progress::counting("triangles left out")?;
    let started = Instant::now();
    let watch = Limited {
        progress: &progress,
        deadline: started + Duration::from_secs(args.seconds.into()),
    };
    let minimised = search(&scene, &judge, &methods, args, &watch);
    progress.finish();
    let minimised = minimised?;
    for note in &scene.notes {
        console::print(&format!("note: {note}\n"));
    }

    let mut text = what_is_left(&minimised, &scene, started.elapsed());
    let best = match earlier {
        Some(earlier) if is_better(&earlier, &minimised, &judge, &methods)? => {
            text.push_str(&format!(
                "{} stays: an earlier search has left {} triangles there\n",
                path.display(),
                earlier.mesh.triangles.len()
            ));
            earlier
        }
        _ => {
            export::write(&minimised.scene, &args.out, &stem)?;
            minimised.scene
        }
    };
    let judgement = judge_again(&judge, &path, &best, &methods)?.judgement;
    text.push_str(&wrong_pixels(&judgement.error));
    text.push_str(&kinds_of_error(judgement.analysis.label_counts()));
    text.push_str(&format!("look at it: {}\n", look_at_it(&path, args)));
    console::print(&text);
    args.device.check_validation()?;
    if progress.interrupted() {
        anyhow::bail!(
            "interrupted; what was left by then is in {}",
            path.display()
        );
    }
    Ok(())
}

fn what_is_left(minimised: &Minimised, scene: &Scene, time: Duration) -> String {
    let (left, all) = (&minimised.scene.mesh, &scene.mesh);
    format!(
        "{} of {} triangles are left, {} of {} vertices, after {} trials in {:.1} s{}\n",
        left.triangles.len(),
        all.triangles.len(),
        left.positions.len(),
        all.positions.len(),
        minimised.trials,
        time.as_secs_f64(),
        if minimised.finished {
            ""
        } else {
            "; stopped before the end"
        },
    )
}

/// Whether an earlier result still fails and has fewer triangles than the new one, or as few as one that is not
/// final.
fn is_better(
    earlier: &Scene,
    new: &Minimised,
    judge: &Judge,
    methods: &[Box<dyn ShadowMethod>; 1],
) -> anyhow::Result<bool> {
    let [earlier_count, new_count] = [earlier, &new.scene].map(|scene| scene.mesh.triangles.len());
    let may_stay = earlier_count < new_count || (earlier_count == new_count && !new.finished);
    Ok(may_stay && attempt(judge, earlier, methods)?.artifact_px() > 0)
}

/// The scene as small as can be, or in words why not.
fn search(
    scene: &Scene,
    judge: &Judge,
    methods: &[Box<dyn ShadowMethod>; 1],
    args: &MinimiseArgs,
    watch: &Limited<'_>,
) -> anyhow::Result<Minimised> {
    let mut unavailable = None;
    let mut fails = |scene: &Scene| {
        let attempt = attempt(judge, scene, methods)?;
        if let Attempt::Missing(NoPicture::Unavailable(reason)) = &attempt {
            unavailable.get_or_insert_with(|| reason.clone());
        }
        Ok(attempt.artifact_px() > 0)
    };
    match (minimise(scene, &mut fails, watch), unavailable) {
        (Ok(minimised), _) => Ok(minimised),
        (Err(MinimiseError::DoesNotFail), Some(reason)) => {
            anyhow::bail!("method `{}`: {reason}", args.method)
        }
        (Err(error @ MinimiseError::DoesNotFail), None) => {
            Err(error).with_context(|| nothing_to_shrink(scene, args))
        }
        (Err(error), _) => Err(error.into()),
    }
}

/// The scene at one moment, in which nothing moves.
fn still(scene: Scene, moment: &Moment, method: &str) -> Scene {
    Scene {
        title: format!("{}, what is left where {method} fails", scene.title),
        flight: Flight::still(moment),
        ..scene
    }
}

fn attempt(
    judge: &Judge,
    scene: &Scene,
    methods: &[Box<dyn ShadowMethod>; 1],
) -> anyhow::Result<Attempt> {
    let attempts = judge.trial(scene, methods).attempts;
    let attempt = attempts.into_iter().next();
    match attempt.context("a method has an attempt")? {
        Attempt::Missing(NoPicture::Failed(reason)) => {
            anyhow::bail!("method `{}`: {reason}", methods[0].name())
        }
        attempt => Ok(attempt),
    }
}

fn nothing_to_shrink(scene: &Scene, args: &MinimiseArgs) -> String {
    let (width, height) = args.size;
    format!(
        "no artifact pixel of {} on {} at this view and light in {width} × {height} pixels; \
         try another --time, --eye, --light or a larger --size",
        args.method, scene.name
    )
}

/// Reads what was written and draws it.
fn judge_again(
    judge: &Judge,
    path: &Path,
    written: &Scene,
    methods: &[Box<dyn ShadowMethod>; 1],
) -> anyhow::Result<Box<Drawn>> {
    let scene = SceneFile::read(path)?.load(&ModelSearch::for_scene_file(path))?;
    let same = (&scene.mesh_hash, &scene.flight) == (&written.mesh_hash, &written.flight);
    anyhow::ensure!(
        same,
        "{} reads as another scene; is there another model of that name in the working directory?",
        path.display()
    );
    match attempt(judge, &scene, methods)? {
        Attempt::Drawn(drawn) if drawn.judgement.error.artifact_px > 0 => Ok(drawn),
        Attempt::Drawn(_) => anyhow::bail!("{}: failed, but does not now", path.display()),
        Attempt::Missing(missing) => anyhow::bail!("{}: {}", path.display(), missing.reason()),
    }
}

/// The command that shows what is left.
fn look_at_it(path: &Path, args: &MinimiseArgs) -> String {
    let (width, height) = args.size;
    let path = shell_path(path);
    let method = shell_word(&args.method);
    format!("svbench render {path} --method {method} --size {width}x{height} --error error.png")
}

/// A path for a shell, to the byte.
fn shell_path(path: &Path) -> String {
    match path.to_str() {
        Some(text) => shell_word(text),
        None => {
            let bytes = path.as_os_str().as_encoded_bytes();
            let byte = |byte: &u8| format!("\\x{byte:02x}");
            format!("$'{}'", bytes.iter().map(byte).collect::<String>())
        }
    }
}

/// Quoted where a shell would see more than letters.
fn shell_word(text: &str) -> String {
    let plain = |c: char| c.is_alphanumeric() || "_-./,=:".contains(c);
    if !text.is_empty() && text.chars().all(plain) {
        text.to_owned()
    } else {
        format!("'{}'", text.replace('\'', "'\\''"))
    }
}

#[cfg(test)]
#[path = "minimise_tests.rs"]
mod tests;
