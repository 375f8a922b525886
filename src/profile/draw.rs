//! Draws a day: of each step the truth, and each method's mask.
//!
//! The scene is prepared once. What is kept from step to step is one picture's worth of hours for the truth and for
//! each method, and the overlay; the film goes to disk frame by frame.

use std::path::Path;
use std::rc::Rc;

use anyhow::bail;

use super::day::{Day, Step};
use super::film::{Film, caption, night};
use super::heat_map::heat_map;
use super::hours::{MethodHours, TrueHours};
use super::overlay::{self, Overlay};
use super::picture::Picture;
use super::rows::{HourRow, MethodRow};
use super::triangles::{hours_of_triangles, write_ply};
use super::{
    FILM_FILE, HOURS_FILE, METHODS_TABLE, OVERLAY_FILE, STEPS_TABLE, TRIANGLES_PLY, TRIANGLES_TABLE,
};
use crate::file_name::method_file_name;
use crate::frame::DepthSetup;
use crate::gpu::Gpu;
use crate::judge::{DeviceScene, NoPicture, Observer, ReadyMethod, Truth, Verifier, contain};
use crate::methods::ShadowMethod;
use crate::reference::{Reference, ReferenceCache};
use crate::scene::{Light, Moment, Scene, View};
use crate::{output, table};

/// What to draw, and with what.
pub struct ProfileRequest<'a> {
    /// The device.
    pub gpu: &'a Gpu,
    /// The scene.
    pub scene: &'a Scene,
    /// Where the camera stands.
    pub view: View,
    /// The day.
    pub day: &'a Day,
    /// The methods that are held against the truth.
    pub methods: &'a [Box<dyn ShadowMethod>],
    /// Width and height of the pictures.
    pub size_px: (u32, u32),
    /// Whether the hours of each triangle are asked for.
    pub per_triangle: bool,
    /// Where truths are kept.
    pub cache: &'a ReferenceCache,
    /// The directory to write into, which is there.
    pub out: &'a Path,
    /// Who watches.
    pub observer: &'a dyn Observer,
}

/// What became of it, besides the files.
#[derive(Clone, Debug)]
pub struct Profile {
    /// One for each step.
    pub steps: Vec<HourRow>,
    /// One for each method.
    pub methods: Vec<MethodRow>,
    /// The names of the methods' pictures of hours, of those that drew.
    pub method_pictures: Vec<(String, String)>,
}

/// A method on its way through the day.
struct Contender<'a> {
    method: &'a dyn ShadowMethod,
    drawing: Result<(ReadyMethod, Option<MethodHours>), NoPicture>,
}

/// What all steps share.
struct Stage<'a> {
    request: &'a ProfileRequest<'a>,
    device: &'a DeviceScene<'a>,
    reference: Rc<Reference>,
}

/// Draws the day and writes its pictures and tables.
///
/// # Errors
/// When the scene cannot be traced or drawn, a file cannot be written, or the observer asks to stop. A method that
/// cannot draw ends nothing: its row says why.
pub fn draw(request: &ProfileRequest<'_>) -> anyhow::Result<Profile> {
    let ProfileRequest {
        gpu, scene, day, ..
    } = *request;
    let device = DeviceScene::new(gpu, scene, request.size_px)?;
    let stage = Stage {
        request,
        device: &device,
        reference: Verifier::reference_of(scene)?,
    };
    let methods = request.methods.iter();
    let mut contenders: Vec<_> = methods
        .map(|method| stage.contender(method.as_ref()))
        .collect();
    request.observer.begin(day.steps.len() as u64);
    let (hours, steps) = stage.draw_steps(&mut contenders)?;

    let size_px = request.size_px;
    let map = heat_map(size_px, hours.hours(), day, "by the truth")?;
    map.write_png(&request.out.join(HOURS_FILE))?;
    let mut profile = Profile {
        steps,
        methods: Vec::with_capacity(contenders.len()),
        method_pictures: Vec::new(),
    };
    for contender in contenders {
        profile.add(contender, request)?;
    }
    let write = |name: &str, text: Vec<u8>| output::write_atomically(&request.out.join(name), text);
    write(STEPS_TABLE, table::text(&profile.steps)?)?;
    write(METHODS_TABLE, table::text(&profile.methods)?)?;
    if request.per_triangle {
        request.observer.phase("hours of each triangle");
        let rows = hours_of_triangles(&scene.mesh, &stage.reference, day)?;
        write(TRIANGLES_TABLE, table::text(&rows)?)?;
        write_ply(&request.out.join(TRIANGLES_PLY), &scene.mesh, &rows, day)?;
    }
    Ok(profile)
}

impl Profile {
    fn add(
        &mut self,
        contender: Contender<'_>,
        request: &ProfileRequest<'_>,
    ) -> anyhow::Result<()> {
        let Contender { method, drawing } = contender;
        let nothing = || NoPicture::Failed("it drew nothing".to_owned());
        let hours = drawing.and_then(|(_, hours)| hours.ok_or_else(nothing));
        let day = request.day;
        let error = hours.as_ref().map(|hours| hours.error(day.step_hours()));
        let row = MethodRow::new(method, error.map_err(Clone::clone));
        if let Ok(hours) = &hours {
            let file = method_file_name(&row.method, &row.variant);
            let file = format!("hours-{file}.png");
            let of_whom = format!("by {}", row.name());
            let map = heat_map(request.size_px, hours.hours(), day, &of_whom)?;
            map.write_png(&request.out.join(&file))?;
            self.method_pictures.push((row.name(), file));
        }
        self.methods.push(row);
        Ok(())
    }
}

impl<'a> Stage<'a> {
    fn contender(&self, method: &'a dyn ShadowMethod) -> Contender<'a> {
        let gpu = &self.device.gpu;
        let ready = contain(gpu, None, || Ok(self.device.prepare(method)?));
        Contender {
            method,
            drawing: ready.map(|ready| (ready, None)),
        }
    }

    fn moment(&self, light: Light) -> Moment {
        Moment {
            view: self.request.view,
            light,
        }
    }

    fn draw_steps(
        &self,
        contenders: &mut [Contender<'_>],
    ) -> anyhow::Result<(TrueHours, Vec<HourRow>)> {
        let ProfileRequest {
            gpu,
            scene,
            day,
            cache,
            observer,
            ..
        } = *self.request;
        let resources = self.device.resources(DepthSetup::default())?;
        let verifier = Verifier::sharing(gpu, scene, &resources, cache, &self.reference);
        let Some((first, _, light)) = day.daylight().next() else {
            bail!("it is night at all steps");
        };
        let mut first_truth = Some((first, verifier.truth(&self.moment(light))?));
        let mut hours = match &first_truth {
            Some((_, truth)) => TrueHours::new(&truth.mask),
            None => bail!("it is night at all steps"),
        };
        let dark = verifier.dark_picture(&self.moment(light))?;
        let dark = Picture::of_rgba(self.request.size_px, &dark);
        let mut overlay = Overlay::new(dark.clone());
        let (mut film, mut rows) = (None, Vec::with_capacity(day.steps.len()));
        let lights = day.daylight().count();
        let mut lit_steps = 0;
        for (i, step) in day.steps.iter().enumerate() {
            if observer.interrupted() {
                bail!("interrupted");
            }
            observer.phase(&day.clock(step));
            let (frame, counts) = match step.light {
                None => (night(&dark), hours.night()),
                Some(light) => {
                    let truth = match first_truth.take_if(|(first, _)| *first == i) {
                        Some((_, truth)) => truth,
                        None => verifier.truth(&self.moment(light))?,
                    };
                    let picture = verifier.true_picture(&truth)?;
                    let counts = hours.add(step.hours, &truth.mask);
                    overlay.add(&truth.mask, overlay::colour_of(lit_steps, lights));
                    lit_steps += 1;
                    self.draw_methods(contenders, step, truth)?;
                    (Picture::of_rgba(self.request.size_px, &picture), counts)
                }
            };
            self.add_frame(&mut film, &frame.over_line(&caption(day, step))?)?;
            rows.push(HourRow::new(day, step, counts));
            observer.advance(1);
        }
        if let Some(film) = film {
            film.finish()?;
        }
        let overlay = overlay.finish(day)?;
        overlay.write_png(&self.request.out.join(OVERLAY_FILE))?;
        Ok((hours, rows))
    }

    fn add_frame(&self, film: &mut Option<Film>, frame: &Picture) -> anyhow::Result<()> {
        let film = match film {
            Some(film) => film,
            None => {
                let path = self.request.out.join(FILM_FILE);
                let frames = self.request.day.steps.len() as u32;
                film.insert(Film::create(&path, frame.size_px, frames)?)
            }
        };
        film.add(frame)
    }

    /// Lets every method draw a step, and holds it against the truth of the depth buffer that it draws with.
    fn draw_methods(
        &self,
        contenders: &mut [Contender<'_>],
        step: &Step,
        usual: Truth,
    ) -> anyhow::Result<()> {
        let ProfileRequest {
            gpu, scene, cache, ..
        } = *self.request;
        let mut truths = vec![(DepthSetup::default(), usual)];
        for contender in contenders {
            let Ok((ready, hours)) = &mut contender.drawing else {
                continue;
            };
            let resources = Rc::clone(&ready.resources);
            let verifier = Verifier::sharing(gpu, scene, &resources, cache, &self.reference);
            let depth = resources.depth;
            let known = truths.iter().position(|(known, _)| *known == depth);
            let known = match (known, step.light) {
                (Some(known), _) => known,
                (None, Some(light)) => {
                    truths.push((depth, verifier.truth(&self.moment(light))?));
                    truths.len() - 1
                }
                (None, None) => continue,
            };
            let truth = &truths[known].1;
            match contain(gpu, None, || {
                verifier.draw_mask(ready.method.as_mut(), truth)
            }) {
                Ok(mask) => hours
                    .get_or_insert_with(|| MethodHours::new(&truth.mask))
                    .add(step.hours, &mask, &truth.mask),
                Err(reason) => contender.drawing = Err(reason),
            }
            if let Some(reason) = gpu.lost() {
                bail!("the device was lost: {reason}");
            }
        }
        Ok(())
    }
}
