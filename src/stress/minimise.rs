//! Few triangles and round numbers that fail as a whole scene does.
//!
//! Triangles are taken away by delta debugging (A. Zeller, R. Hildebrandt: *Simplifying and Isolating
//! Failure-Inducing Input*, 2002), then numbers are rounded, and both again until neither helps. What failing
//! means is a question to the caller, so that all this needs no device.

use super::simpler::{effort, simpler};
use crate::judge::Observer;
use crate::scene::{Flight, Light, LightPath, Scene};
use glam::Vec3;
use std::collections::HashSet;
use std::sync::Arc;

/// What is left of a scene.
#[derive(Clone, Debug)]
pub struct Minimised {
    /// It fails, and is made of [`Part`](crate::scene::Part)s.
    pub scene: Scene,
    /// How many scenes were asked about.
    pub trials: usize,
    /// Whether nothing else could be taken away; false if it was stopped before.
    pub finished: bool,
}

/// Why a scene could not be minimised.
#[derive(Debug, thiserror::Error)]
pub enum MinimiseError {
    /// There is nothing to look for.
    #[error("the scene does not fail")]
    DoesNotFail,
    /// A scene could not be tried.
    #[error(transparent)]
    Trial(#[from] anyhow::Error),
}

/// Shrinks `scene`, of whose flight only the start counts, as long as `fails` says yes.
///
/// In the end, no single triangle can be left out, and no number of a vertex, the eye, its target or the light
/// made simpler, unless `observer` stops it. Names, up, the opening angle and the near plane stay.
///
/// # Errors
/// When the scene itself does not fail, or `fails` returns an error.
pub fn minimise(
    scene: &Scene,
    fails: &mut dyn FnMut(&Scene) -> anyhow::Result<bool>,
    observer: &dyn Observer,
) -> Result<Minimised, MinimiseError> {
    let still = Scene {
        flight: Flight::still(&scene.flight.at(0.0)),
        ..scene.clone()
    };
    let mut search = Search {
        best: with_triangles(&still, |_| true),
        fails,
        observer,
        asked: HashSet::new(),
    };
    observer.begin(search.best.mesh.triangles.len() as u64);
    if !(search.fails)(&search.best)? {
        return Err(MinimiseError::DoesNotFail);
    }
    search.asked.insert(fingerprint(&search.best));
    let finished = match search.run() {
        Ok(()) => true,
        Err(Halt::Stopped) => false,
        Err(Halt::Failed(error)) => return Err(error.into()),
    };
    Ok(Minimised {
        scene: search.best,
        trials: search.asked.len(),
        finished,
    })
}

/// Why the search ends before its end.
enum Halt {
    Stopped,
    Failed(anyhow::Error),
}

struct Search<'a> {
    /// The smallest scene so far that fails.
    best: Scene,
    fails: &'a mut dyn FnMut(&Scene) -> anyhow::Result<bool>,
    observer: &'a dyn Observer,
    /// Nothing is asked twice.
    asked: HashSet<Fingerprint>,
}

impl Search<'_> {
    fn run(&mut self) -> Result<(), Halt> {
        loop {
            let before = fingerprint(&self.best);
            self.leave_out_triangles()?;
            self.round_numbers()?;
            if fingerprint(&self.best) == before {
                return Ok(());
            }
        }
    }

    /// Whether the candidate fails; if so, it is the best from now on.
    fn try_out(&mut self, candidate: Scene) -> Result<bool, Halt> {
        if self.observer.interrupted() {
            return Err(Halt::Stopped);
        }
        // One that was asked about before did not fail: else it would be the best, or greater than that.
        if !self.asked.insert(fingerprint(&candidate)) {
            return Ok(false);
        }
        if !(self.fails)(&candidate).map_err(Halt::Failed)? {
            return Ok(false);
        }
        let fewer = self.best.mesh.triangles.len() - candidate.mesh.triangles.len();
        self.observer.advance(fewer as u64);
        self.best = candidate;
        Ok(true)
    }

    /// Delta debugging: of ever more and smaller chunks, keeps one alone or leaves one out.
    ///
    /// Unlike in the paper, a pass over the chunks goes on behind one that was left out, instead of from the
    /// start: where the triangles that matter lie far apart, that asks far less.
    fn leave_out_triangles(&mut self) -> Result<(), Halt> {
        // Beyond so many, one chunk alone has little chance.
        const MAX_ALONE: usize = 8;
        let mut chunks = 2;
        loop {
            let count = self.best.mesh.triangles.len().max(1);
            let size = count.div_ceil(chunks.min(count));
            self.report(&format!("leaving out {size} at a time"));
            if chunks <= MAX_ALONE && size < count && self.keep_one_chunk(size)? {
                chunks = 2;
                continue;
            }
            let left_out = self.leave_out_chunks(size)?;
            match (size, left_out) {
                (1, false) => return Ok(()),
                (1, true) => {}
                _ => chunks = 2 * self.best.mesh.triangles.len().div_ceil(size),
            }
        }
    }

    fn keep_one_chunk(&mut self, size: usize) -> Result<bool, Halt> {
        let count = self.best.mesh.triangles.len();
        for from in (0..count).step_by(size) {
            let chunk = from..(from + size).min(count);
            if self.try_out(with_triangles(&self.best, |i| chunk.contains(&i)))? {
                return Ok(true);
            }
        }
        Ok(false)
    }

    fn leave_out_chunks(&mut self, size: usize) -> Result<bool, Halt> {
        let before = self.best.mesh.triangles.len();
        let mut from = 0;
        while from < self.best.mesh.triangles.len() {
            let chunk = from..from + size;
            // A scene without triangles has no picture to be wrong.
            let all = from == 0 && size >= self.best.mesh.triangles.len();
            if all || !self.try_out(with_triangles(&self.best, |i| !chunk.contains(&i)))? {
                from += size;
            }
        }
        Ok(self.best.mesh.triangles.len() < before)
    }

    /// Makes numbers simpler: all of them, then those of each point, then each.
    fn round_numbers(&mut self) -> Result<(), Halt> {
        self.report("rounding numbers");
        let places = |scene: &Scene| {
            let vertices = 0..scene.mesh.positions.len();
            let points = [ScenePoint::Light, ScenePoint::Eye, ScenePoint::Target];
            points.into_iter().chain(vertices.map(ScenePoint::Vertex))
        };
        self.round_all(&places(&self.best).collect::<Vec<_>>())?;
        let mut number = 0;
        // Vertices may fall together on the way, and then there are fewer.
        while let Some(place) = places(&self.best).nth(number) {
            self.round_all(&[place])?;
            for axis in 0..3 {
                if places(&self.best).nth(number).is_some() {
                    self.round_one(place, axis)?;
                }
            }
            number += 1;
        }
        Ok(())
    }

    /// Rounds all numbers of these points alike, as coarsely as may be.
    fn round_all(&mut self, places: &[ScenePoint]) -> Result<(), Halt> {
        const MAX_DECIMALS: i32 = 4;
        let roundings = (0..=MAX_DECIMALS).map(|decimals| 10f64.powi(decimals));
        for per_unit in [1.0, 2.0].into_iter().chain(roundings.skip(1)) {
            let round = |x: f32| {
                let rounded = ((f64::from(x) * per_unit).round() / per_unit) as f32;
                if effort(rounded) < effort(x) {
                    rounded
                } else {
                    x
                }
            };
            let mut scene = self.best.clone();
            for place in places {
                let point = place.get(&scene).to_array().map(round);
                place.set(&mut scene, Vec3::from_array(point));
            }
            let candidate = remade(&scene).filter(|scene| *scene != self.best);
            if let Some(candidate) = candidate
                && self.try_out(candidate)?
            {
                break;
            }
        }
        Ok(())
    }

    fn round_one(&mut self, place: ScenePoint, axis: usize) -> Result<(), Halt> {
        let point = place.get(&self.best);
        for number in simpler(point[axis]) {
            let mut scene = self.best.clone();
            let mut point = point;
            point[axis] = number;
            place.set(&mut scene, point);
            if let Some(candidate) = remade(&scene)
                && self.try_out(candidate)?
            {
                break;
            }
        }
        Ok(())
    }

    fn report(&self, what: &str) {
        let mesh = &self.best.mesh;
        self.observer.phase(&format!(
            "{what}: {} triangles, {} vertices, {} trials",
            mesh.triangles.len(),
            mesh.positions.len(),
            self.asked.len()
        ));
    }
}

/// A point that may be moved.
#[derive(Clone, Copy)]
enum ScenePoint {
    Light,
    Eye,
    Target,
    Vertex(usize),
}

impl ScenePoint {
    fn get(self, scene: &Scene) -> Vec3 {
        match self {
            Self::Light => scene.flight.light.light_at(0.0).place.truncate(),
            Self::Eye => scene.flight.camera.keys[0].eye,
            Self::Target => scene.flight.camera.keys[0].target,
            Self::Vertex(number) => scene.mesh.positions[number],
        }
    }

    fn set(self, scene: &mut Scene, point: Vec3) {
        match self {
            Self::Light => scene.flight.light = moved(&scene.flight.light, point),
            Self::Eye => scene.flight.camera.keys[0].eye = point,
            Self::Target => scene.flight.camera.keys[0].target = point,
            Self::Vertex(number) => Arc::make_mut(&mut scene.mesh).positions[number] = point,
        }
    }
}

/// A light that stands still, at another place.
fn moved(light: &LightPath, point: Vec3) -> LightPath {
    let Light { place, radius } = light.light_at(0.0);
    LightPath::still(Light {
        place: point.extend(place.w),
        radius,
    })
}

fn with_triangles(scene: &Scene, keep: impl Fn(usize) -> bool) -> Scene {
    let (name, title) = (scene.name.clone(), scene.title.clone());
    let mesh = scene.mesh.filtered(keep);
    Scene::new(name, title, mesh, scene.flight.clone())
}

/// The scene made anew of its points, if it still is one.
fn remade(scene: &Scene) -> Option<Scene> {
    let scene = with_triangles(scene, |_| true);
    let Flight { camera, light } = &scene.flight;
    let mesh = scene.mesh.positions.iter().all(|p| p.is_finite());
    (mesh && light.validate().is_ok() && camera.validate().is_ok()).then_some(scene)
}

/// What tells scenes apart here: the mesh, the light and the eye.
type Fingerprint = (String, [u32; 10]);

fn fingerprint(scene: &Scene) -> Fingerprint {
    let Flight { camera, light } = &scene.flight;
    let (key, light) = (camera.keys[0], light.light_at(0.0).place);
    let numbers = [light.truncate(), key.eye, key.target].map(|v| v.to_array().map(f32::to_bits));
    let mut all = [light.w.to_bits(); 10];
    all[1..].copy_from_slice(numbers.as_flattened());
    (scene.mesh_hash.clone(), all)
}

#[cfg(test)]
#[path = "minimise_tests.rs"]
mod tests;
