//! `svbench advise SCENE`

use super::shot::load_scene;
use super::{DeviceArgs, check_size, reference_cache, values};
use crate::advise::{self, Request};
use crate::console;
use crate::methods::Registry;
use std::path::PathBuf;

/// Arguments of `svbench advise`.
#[derive(Debug, clap::Args)]
pub(super) struct AdviseArgs {
    /// A scene: its TOML file, the name of one that comes with the program, or an OBJ file
    scene: PathBuf,
    /// Size of the pictures
    #[arg(long, value_name = "WxH", value_parser = values::size, default_value = "1024x768")]
    size: (u32, u32),
    /// Moments of the flight
    #[arg(long, value_name = "N", default_value_t = 8, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    frames: u32,
    #[command(flatten)]
    device: DeviceArgs,
}

pub(super) fn execute(args: &AdviseArgs, registry: &Registry) -> anyhow::Result<()> {
    let scene = load_scene(&args.scene)?;
    let gpu = args.device.open()?;
    check_size(&gpu, args.size, "--size")?;
    let advice = advise::advise(&Request {
        gpu: &gpu,
        scene: &scene,
        registry,
        cache: &reference_cache()?,
        size_px: args.size,
        frames: args.frames as usize,
    })?;
    console::print(&advice.to_string());
    args.device.check_validation()?;
    console::check_printed()
}
