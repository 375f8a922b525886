//! `svbench profile SCENE`

use super::progress::Progress;
use super::run::default_out;
use super::shot::{load_scene, scene_files};
use super::{DeviceArgs, check_size, outputs, reference_cache, values};
use crate::config::ConfigError;
use crate::console;
use crate::methods::{Registry, ShadowMethod};
use crate::profile::{self, Day, DayRequest, MethodRow, Profile, ProfileInfo, ProfileRequest};
use crate::scene::sun::{Compass, LocalDay, Site, parse_date, parse_time};
use crate::scene::{LightPath, Scene, Sun, View};
use glam::DVec3;
use jiff::SignedDuration;
use jiff::civil::Time;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// The method that is held against the truth where none is named.
const USUAL_METHOD: &str = "silhouette_ts";

/// Arguments of `svbench profile`. Without them, place and day are those of the scene's own sun.
#[derive(Debug, clap::Args)]
pub(super) struct ProfileArgs {
    /// A scene: its TOML file, the name of one that comes with the program, or an OBJ file
    scene: PathBuf,
    /// Degrees north of the equator (default: of the scene's sun)
    #[arg(
        long,
        value_name = "DEG",
        allow_negative_numbers = true,
        requires = "longitude"
    )]
    latitude: Option<f64>,
    /// Degrees east of Greenwich (default: of the scene's sun)
    #[arg(
        long,
        value_name = "DEG",
        allow_negative_numbers = true,
        requires = "latitude"
    )]
    longitude: Option<f64>,
    /// The day (default: of the scene's sun)
    #[arg(long, value_name = "YYYY-MM-DD")]
    date: Option<String>,
    /// Local time of the first step (default: of the scene's sun)
    #[arg(long, value_name = "HH:MM")]
    from: Option<String>,
    /// Local time of the last step (default: of the scene's sun)
    #[arg(long, value_name = "HH:MM")]
    to: Option<String>,
    /// From one step to the next, such as 30m or 1h
    #[arg(
        long,
        value_name = "TIME",
        default_value = "30m",
        allow_hyphen_values = true
    )]
    step: String,
    /// The time zone: a name or an offset such as +01:00 (default: of the scene's sun, else UTC)
    #[arg(long, value_name = "ZONE", allow_hyphen_values = true)]
    zone: Option<String>,
    /// Which way is north in the scene (default: of the scene's sun, else 0,0,-1)
    #[arg(long, value_name = "X,Y,Z", value_parser = values::dvec3, allow_hyphen_values = true)]
    north: Option<DVec3>,
    /// Which way is up in the scene (default: of the scene's sun, else 0,1,0)
    #[arg(long, value_name = "X,Y,Z", value_parser = values::dvec3, allow_hyphen_values = true)]
    up: Option<DVec3>,
    /// Hold this method against the truth; may be repeated
    #[arg(long, value_name = "ID[,key=value...]", default_value = USUAL_METHOD)]
    method: Vec<String>,
    /// Also write the hours of sun of each triangle: triangles.csv and triangles.ply
    #[arg(long)]
    per_triangle: bool,
    /// Where on the scene's flight the camera stands
    #[arg(
        long,
        value_name = "SECONDS",
        default_value_t = 0.0,
        allow_negative_numbers = true
    )]
    time: f64,
    /// Size of the pictures
    #[arg(long, value_name = "WxH", value_parser = values::size, default_value = "1024x768")]
    size: (u32, u32),
    /// The directory to write, new or empty (default: results/<date>-<time>-profile-<scene>-<device>)
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    #[command(flatten)]
    device: DeviceArgs,
}

pub(super) fn execute(args: &ProfileArgs, registry: &Registry) -> anyhow::Result<()> {
    let methods = methods(args, registry)?;
    // What is wrong with the day is said before anything is loaded, if the scene has no say in it.
    let step = step(&args.step)?;
    let scene = load_scene(&args.scene)?;
    let day = Day::new(args.request(&scene, step)?).map_err(|error| usage(&error))?;
    let view = args.view(&scene)?;
    let gpu = args.device.open()?;
    check_size(&gpu, args.size, "--size")?;
    let out = match &args.out {
        Some(out) => out.clone(),
        None => default_out(Path::new(&format!("profile-{}", scene.name)), &gpu)?,
    };
    outputs::check(&scene_files(&args.scene)?, &[("--out", &out)])?;
    crate::record::new_directory(&out)?;
    let started = Instant::now();
    let mut info = ProfileInfo::new(&gpu, &scene, &view, &day, args.size);
    let progress = Progress::counting("steps")?;
    let profile = profile::draw(&ProfileRequest {
        gpu: &gpu,
        scene: &scene,
        view,
        day: &day,
        methods: &methods,
        size_px: args.size,
        per_triangle: args.per_triangle,
        cache: &reference_cache()?,
        out: &out,
        observer: &progress,
    })?;
    progress.finish();
    info.duration_s = started.elapsed().as_secs_f64();
    info.write(&out)?;
    let page = profile::write_page(&out, &info, &profile)?;
    console::print(&text(&day, &profile, &info));
    for note in &scene.notes {
        console::print(&format!("note: {note}\n"));
    }
    console::print(&format!("profile: {}\n", page.display()));
    args.device.check_validation()?;
    console::check_printed()?;
    match profile.methods.iter().find(|row| row.status == "failed") {
        Some(row) => anyhow::bail!("{} could not draw: {}", row.name(), row.reason),
        None => Ok(()),
    }
}

fn usage(error: &impl ToString) -> ConfigError {
    ConfigError(error.to_string())
}

fn at<T, E: std::fmt::Display>(option: &str, result: Result<T, E>) -> Result<T, ConfigError> {
    result.map_err(|error| ConfigError(format!("{option}: {error}")))
}

fn methods(args: &ProfileArgs, registry: &Registry) -> anyhow::Result<Vec<Box<dyn ShadowMethod>>> {
    let methods = args.method.iter().map(|text| registry.parse(text));
    let methods: Vec<_> = methods.collect::<Result<_, _>>()?;
    let names: Vec<_> = methods
        .iter()
        .map(|method| (method.info().id, method.variant()))
        .collect();
    let is_double = |i: usize| names[..i].contains(&names[i]);
    if let Some(double) = (0..names.len()).find(|i| is_double(*i)) {
        let message = format!("--method: `{}` is given twice", args.method[double]);
        return Err(ConfigError(message).into());
    }
    Ok(methods)
}

/// `30m`, `1h`, `1h30m`.
fn step(text: &str) -> Result<SignedDuration, ConfigError> {
    text.parse().map_err(|_| {
        ConfigError(format!(
            "--step: `{text}` is not a length of time like 30m, 1h or 90s"
        ))
    })
}

impl ProfileArgs {
    /// The day that is meant, with what the arguments do not say from the scene's own sun.
    fn request(&self, scene: &Scene, step: SignedDuration) -> Result<DayRequest, ConfigError> {
        let own = match &scene.flight.light {
            LightPath::Sun(sun) => Some(&**sun),
            LightPath::Keys(_) => None,
        };
        let missing = |option: &str| {
            ConfigError(format!(
                "{option}: the scene has no sun of its own, so it must be given"
            ))
        };
        let course = own.map(Sun::course);
        let time = |option: &str, text: &Option<String>, own: Option<Time>| match text {
            Some(text) => at(option, parse_time(text)),
            None => own.ok_or_else(|| missing(option)),
        };
        let from = time("--from", &self.from, course.map(|course| course.from))?;
        let to = time("--to", &self.to, course.map(|course| course.to))?;
        let date = match &self.date {
            Some(text) => at("--date", parse_date(text))?,
            None => course.ok_or_else(|| missing("--date"))?.day.date(),
        };
        let zone = match (&self.zone, course) {
            (Some(zone), _) => zone,
            (None, Some(course)) => course.day.zone_name(),
            (None, None) => "UTC",
        };
        Ok(DayRequest {
            site: self.site(own)?.ok_or_else(|| missing("--latitude"))?,
            compass: self.compass(own)?,
            day: at("--zone", LocalDay::new(date, zone))?,
            from,
            to,
            step,
        })
    }

    fn site(&self, own: Option<&Sun>) -> Result<Option<Site>, ConfigError> {
        match (self.latitude, self.longitude) {
            (Some(latitude), Some(longitude)) => {
                at("--latitude, --longitude", Site::new(latitude, longitude)).map(Some)
            }
            _ => Ok(own.map(Sun::site)),
        }
    }

    fn compass(&self, own: Option<&Sun>) -> Result<Compass, ConfigError> {
        let usual = own.map(Sun::compass).unwrap_or_default();
        let north = self.north.unwrap_or(usual.north());
        at(
            "--north, --up",
            Compass::new(north, self.up.unwrap_or(usual.up())),
        )
    }

    fn view(&self, scene: &Scene) -> Result<View, ConfigError> {
        let duration_s = scene.flight.duration_s();
        if !(0.0..=duration_s).contains(&self.time) {
            let time_s = self.time;
            return Err(ConfigError(format!(
                "--time: the flight lasts from 0 to {duration_s} s, not to {time_s}"
            )));
        }
        let view = scene.flight.camera.view_at(self.time);
        view.validate().map_err(|error| usage(&error))?;
        Ok(view)
    }
}

fn text(day: &Day, profile: &Profile, info: &ProfileInfo) -> String {
    let lit: Vec<_> = day.daylight().collect();
    let mut text = format!(
        "{}, {} from {} to {} ({}): {} steps, the sun is up at {}\n",
        info.title,
        info.date,
        info.from,
        info.to,
        info.zone,
        day.steps.len(),
        lit.len(),
    );
    let width = profile.methods.iter().map(|row| row.name().len()).max();
    let width = width.unwrap_or_default().max("minutes of sun off".len());
    if !profile.methods.is_empty() {
        text.push_str(&format!(
            "{:<width$}  {:>9} {:>7} {:>7}  {:>13}  {:>12}\n",
            "minutes of sun off", "mean", "95 %", "worst", "within a step", "undecided px"
        ));
    }
    for row in &profile.methods {
        text.push_str(&method_line(row, width));
    }
    text
}

fn method_line(row: &MethodRow, width: usize) -> String {
    let name = row.name();
    match (
        row.error_minutes_mean,
        row.error_minutes_p95,
        row.error_minutes_worst,
        row.within_step_share,
        row.ambiguous_px,
    ) {
        (Some(mean), Some(p95), Some(worst), Some(within), Some(ambiguous)) => format!(
            "{name:<width$}  {mean:>9.4} {p95:>7.1} {worst:>7.1}  {:>11.4} %  {ambiguous:>12}\n",
            100.0 * within
        ),
        _ => format!("{name:<width$}  {}: {}\n", row.status, row.reason),
    }
}
