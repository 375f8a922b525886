//! `svbench metamorphic [SCENE ...]`

use super::progress::Progress;
use super::{DeviceArgs, check_size, values};
use crate::config::{ConfigError, find_scene};
use crate::console;
use crate::gpu::Capability;
use crate::judge::Observer;
use crate::judge::{Judge, NoPicture};
use crate::methods::{Registry, ShadowMethod};
use crate::scene::{Scene, SceneError};
use crate::stress::metamorphic::{self, Difference};
use crate::stress::{Change, damage, random};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// Scenes that are checked if none are named.
const SCENES: [&str; 2] = ["sphere_grid", "sponza"];
/// Share of the triangles of a damaged scene that are missing, turned or doubled.
const DAMAGED_SHARE: f64 = 0.02;

/// Arguments of `svbench metamorphic`.
#[derive(Debug, clap::Args)]
pub(super) struct MetamorphicArgs {
    /// Scenes, each checked as it is and damaged (default: sphere_grid, and sponza if its model is found)
    #[arg(value_name = "SCENE")]
    scenes: Vec<PathBuf>,
    /// A method, with parameters if any; may be given several times (default: all volume methods)
    #[arg(long = "method", value_name = "ID[,key=value...]")]
    methods: Vec<String>,
    /// Number of random scenes to check as well
    #[arg(long, value_name = "N", default_value_t = 100)]
    soups: u64,
    /// Number of the first random scene, and seed of everything that is random in the changes
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,
    /// Size of the pictures
    #[arg(long, value_name = "WxH", value_parser = values::size, default_value = "320x240")]
    size: (u32, u32),
    #[command(flatten)]
    device: DeviceArgs,
}

/// Sums over the methods and scenes of one row of the table, for each change: `None` where it applied to
/// no scene.
struct SceneChecks {
    name: String,
    /// Wrong pixels, and pixels that differ in any way.
    sums: [Option<(u64, u64)>; Change::ALL.len()],
}

/// What is the same for all scenes, and what came of them.
struct Checks {
    judge: Judge,
    methods: Vec<Box<dyn ShadowMethod>>,
    unavailable: BTreeSet<String>,
    /// Masks that changed and may not.
    wrong: usize,
    /// Masks and scenes of which nothing is known, because something broke.
    failed: usize,
    progress: Progress,
}

pub(super) fn execute(args: &MetamorphicArgs, registry: &Registry) -> anyhow::Result<()> {
    let methods = methods(args, registry)?;
    let scenes = scenes(args)?;
    let gpu = args.device.open()?;
    check_size(&gpu, args.size, "--size")?;
    let mut checks = Checks {
        judge: Judge::new(&gpu, args.size),
        methods,
        unavailable: BTreeSet::new(),
        wrong: 0,
        failed: 0,
        progress: Progress::counting("scenes")?,
    };
    let rows = checks.rows(&scenes, args);
    checks.progress.finish();
    for method in &checks.unavailable {
        console::print(&format!("not available: {method}\n"));
    }
    console::print(&table(&rows));
    args.device.check_validation()?;
    match (checks.wrong, checks.failed) {
        (0, 0) => {}
        (0, failed) => anyhow::bail!("{failed} comparisons broke, see above"),
        (wrong, _) => anyhow::bail!("{wrong} masks changed that may not"),
    }
    if checks.progress.interrupted() {
        anyhow::bail!("interrupted; the table is of what was checked by then");
    }
    console::check_printed()
}

impl Checks {
    /// Checks each scene as it is and damaged, then random ones; a row each, fewer if the user interrupts.
    fn rows(&mut self, scenes: &[Scene], args: &MetamorphicArgs) -> Vec<SceneChecks> {
        self.progress.begin(2 * scenes.len() as u64 + args.soups);
        let mut rows = Vec::new();
        for scene in scenes {
            let mut random = ChaCha8Rng::seed_from_u64(args.seed);
            for scene in [scene, &damage(scene, DAMAGED_SHARE, &mut random)] {
                if self.progress.interrupted() {
                    return rows;
                }
                self.progress.phase(&scene.name);
                let mut row = SceneChecks::new(scene.name.clone());
                self.check(&mut row, scene, args.seed);
                rows.push(row);
            }
        }
        if args.soups > 0 && !self.progress.interrupted() {
            self.progress.phase("random scenes");
            let mut checked = 0;
            let mut row = SceneChecks::new(String::new());
            for seed in (args.seed..).take(args.soups as usize) {
                if self.progress.interrupted() {
                    break;
                }
                self.check(&mut row, &random::case(seed), seed);
                checked += 1;
            }
            row.name = format!("{checked} random scenes");
            rows.push(row);
        }
        rows
    }

    fn check(&mut self, row: &mut SceneChecks, scene: &Scene, seed: u64) {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let checked = metamorphic::check(&self.judge, scene, &self.methods, &mut random);
        let differences = checked.unwrap_or_else(|error| {
            self.failed += 1;
            self.progress.print(&format!("{}: {error:#}\n", scene.name));
            Vec::new()
        });
        for difference in &differences {
            let (method, change) = (&difference.method, difference.change.id());
            match &difference.pixels {
                Ok(_) => {}
                Err(NoPicture::Unavailable(reason)) => {
                    self.unavailable.insert(format!("{method}: {reason}"));
                }
                Err(NoPicture::Failed(reason)) => {
                    self.failed += 1;
                    self.progress
                        .print(&format!("{}, {change}, {method}: {reason}\n", scene.name));
                }
            }
            if difference.wrong_px() > 0 {
                self.wrong += 1;
                let line = line(scene, difference) + "\n";
                self.progress.print(&line);
            }
            row.add(difference);
        }
        self.progress.advance(1);
    }
}

fn methods(
    args: &MetamorphicArgs,
    registry: &Registry,
) -> anyhow::Result<Vec<Box<dyn ShadowMethod>>> {
    let is_volume_method = |needs: &[Capability]| needs.contains(&Capability::StencilBuffer);
    let default = registry
        .iter()
        .filter(|registration| is_volume_method(registration.info.needs))
        .map(|registration| registration.info.id);
    let named = args.methods.iter().map(String::as_str);
    let ids: Vec<_> = if args.methods.is_empty() {
        default.collect()
    } else {
        named.collect()
    };
    let parse = |id| Ok(registry.parse(id)?);
    ids.into_iter().map(parse).collect()
}

/// The scenes named; of the default ones, those whose models are there.
fn scenes(args: &MetamorphicArgs) -> anyhow::Result<Vec<Scene>> {
    let load = |name: &Path| {
        let plan = find_scene(name, Path::new(""))?;
        Ok::<_, ConfigError>(plan.file.load(&plan.search))
    };
    let mut scenes = Vec::new();
    let (names, may_be_missing) = match args.scenes.is_empty() {
        true => (SCENES.map(PathBuf::from).to_vec(), true),
        false => (args.scenes.clone(), false),
    };
    for name in names {
        match load(&name)? {
            Err(error @ SceneError::MissingModel { .. }) if may_be_missing => {
                console::print(&format!("{} is left out: {error}\n", name.display()));
            }
            scene => scenes.push(scene?),
        }
    }
    for scene in &scenes {
        for note in &scene.notes {
            console::print(&format!("note: {note}\n"));
        }
    }
    Ok(scenes)
}

fn line(scene: &Scene, difference: &Difference) -> String {
    let Difference {
        change,
        method,
        pixels,
    } = difference;
    let pixels = pixels.as_ref().copied().unwrap_or_default();
    let example = pixels
        .example
        .map_or(String::new(), |(x, y)| format!(", first at {x}, {y}"));
    format!(
        "{}, {}, {method}: {} pixels differ, {} of them decided, {} beyond the boundary{example}",
        scene.name,
        change.id(),
        pixels.differing_px,
        pixels.decided_px,
        pixels.beyond_boundary_px,
    )
}

impl SceneChecks {
    fn new(name: String) -> Self {
        Self {
            name,
            sums: [None; Change::ALL.len()],
        }
    }

    fn add(&mut self, difference: &Difference) {
        let Ok(pixels) = &difference.pixels else {
            return;
        };
        let sums = Change::ALL.iter().zip(&mut self.sums);
        for (_, sum) in sums.filter(|(change, _)| **change == difference.change) {
            let (wrong_px, differing_px) = sum.unwrap_or_default();
            *sum = Some((
                wrong_px + difference.wrong_px(),
                differing_px + pixels.differing_px,
            ));
        }
    }
}

/// Changes down, scenes across: pixels that may not differ, and in brackets all that do.
fn table(rows: &[SceneChecks]) -> String {
    const FIRST: usize = 20;
    let width = |row: &SceneChecks| row.name.chars().count().max(10) + 2;
    let mut text = format!("{:FIRST$}", "");
    for row in rows {
        text.push_str(&format!("{:>1$}", row.name, width(row)));
    }
    for (i, change) in Change::ALL.iter().enumerate() {
        text.push_str(&format!("\n{:FIRST$}", change.id()));
        for row in rows {
            let cell = match row.sums[i] {
                None => "-".to_owned(),
                Some((0, 0)) => "0".to_owned(),
                Some((wrong_px, differing_px)) => format!("{wrong_px} ({differing_px})"),
            };
            text.push_str(&format!("{cell:>0$}", width(row)));
        }
    }
    text.push('\n');
    text
}
