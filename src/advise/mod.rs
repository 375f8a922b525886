//! What a scene needs: what it is, what the plan draws of its shadow volumes, and what that saves.

mod overdraw;
mod text;

pub use overdraw::Overdraw;

use crate::frame::{DepthSetup, DrawnVolumes, GBUFFER_STAGE, SHADE_STAGE, SceneExtents};
use crate::geometry::EdgeCounts;
use crate::gpu::{FrameTimer, Gpu};
use crate::judge::{DeviceScene, NoPicture, ReadyMethod, Verifier};
use crate::methods::{Casters, Registry};
use crate::reference::ReferenceCache;
use crate::scene::Scene;
use overdraw::SideQuads;
use std::rc::Rc;

/// What is drawn without a plan, and held against all others.
pub const FULL: &str = "silhouette_gs";

/// What is measured beside it: exact methods with a plan, one with hardly any, and the map that reaches everywhere.
const CANDIDATES: [&str; 6] = [
    "silhouette_cpu,counting=auto",
    "silhouette_gs,plan=auto",
    "silhouette_ts,plan=auto",
    "silhouette_cpu,plan=auto",
    "silhouette_cs,plan=auto",
    "cube_shadow_map",
];

/// Frames that are compared with the truth.
const VERIFIED: usize = 3;

/// What is asked.
pub struct Request<'a> {
    /// The device.
    pub gpu: &'a Gpu,
    /// The scene; its flight is what counts.
    pub scene: &'a Scene,
    /// The methods that there are.
    pub registry: &'a Registry,
    /// Where known truths are.
    pub cache: &'a ReferenceCache,
    /// Width and height of the pictures.
    pub size_px: (u32, u32),
    /// Moments of the flight, evenly spaced.
    pub frames: usize,
}

/// What a scene is.
#[derive(Debug, Clone, PartialEq)]
pub struct Shape {
    /// Triangles that cast.
    pub triangles: usize,
    /// Objects that cast.
    pub objects: usize,
    /// Those of them that are closed and wound one way.
    pub closed_objects: usize,
    /// Their triangles.
    pub closed_triangles: usize,
    /// Triangles that the plan leaves out, where the light stands still: others occlude them.
    pub left_out: Option<usize>,
    /// Edges by the number of their triangles.
    pub edges: EdgeCounts,
    /// Edges at which windings do not cancel.
    pub open_edges: usize,
    /// Of the side quads, on average over the moments.
    pub overdraw: Overdraw,
}

/// What was measured of one method.
#[derive(Debug, Clone, PartialEq)]
pub struct Measured {
    /// Its name with parameters.
    pub method: String,
    /// Shadow time at each moment, or why there is none.
    pub shadow_ms: Result<Vec<f64>, String>,
    /// Wrong pixels of the verified frames, and those of them away from true boundaries.
    pub wrong_px: u64,
    /// See `wrong_px`.
    pub artifact_px: u64,
    /// What it drew of the volumes, summed over the moments.
    pub drawn: Option<DrawnVolumes>,
}

/// What is to be said of a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Advice {
    /// Its name.
    pub scene: String,
    /// What it is.
    pub shape: Shape,
    /// Moments of the flight.
    pub frames: usize,
    /// How many frames were compared with the truth.
    pub verified: usize,
    /// Width and height of the pictures.
    pub size_px: (u32, u32),
    /// The device's name.
    pub device: String,
    /// First [`FULL`], then the others.
    pub measured: Vec<Measured>,
}

/// Methods whose times differ by less may have changed places by chance.
const ALIKE: f64 = 1.1;

impl Measured {
    /// Quartiles of its shadow time.
    fn quartiles_ms(&self) -> Option<[f64; 3]> {
        quartiles(self.shadow_ms.clone().ok()?)
    }

    /// Quartiles of its shadow time in that of another, moment by moment.
    fn quartiles_of_ratio(&self, other: &Self) -> Option<[f64; 3]> {
        let (own, others) = (
            self.shadow_ms.as_ref().ok()?,
            other.shadow_ms.as_ref().ok()?,
        );
        quartiles(
            own.iter()
                .zip(others)
                .map(|(own, other)| own / other)
                .collect(),
        )
    }
}

/// First, second (the median) and third; `None` of nothing.
fn quartiles(mut values: Vec<f64>) -> Option<[f64; 3]> {
    values.sort_by(f64::total_cmp);
    let last = values.len().checked_sub(1)? as f64;
    Some([0.25, 0.5, 0.75].map(|part| {
        let place = part * last;
        let (below, above) = (
            values[place.floor() as usize],
            values[place.ceil() as usize],
        );
        below + (above - below) * place.fract()
    }))
}

impl Advice {
    /// Whether a method is as right as exact methods are: one artifact pixel a frame at most, or no more than [`FULL`].
    fn is_exact(&self, method: &Measured) -> bool {
        let full = self.measured.iter().find(|method| method.method == FULL);
        let of_full = full.map_or(0, |full| full.artifact_px);
        method.artifact_px <= of_full.max(self.verified as u64)
    }

    /// The fastest of the methods that are as right as exact methods are, and those that are nearly as fast: first those with
    /// the fewest artifacts, then the fastest.
    pub fn picks(&self) -> Vec<&Measured> {
        let median_ms = |method: &&Measured| method.quartiles_ms().map(|[_, median, _]| median);
        let exact = self.measured.iter().filter(|method| self.is_exact(method));
        let mut exact: Vec<_> = exact
            .filter_map(|method| Some((method, median_ms(&method)?)))
            .collect();
        exact.sort_by(|one, other| one.1.total_cmp(&other.1));
        let Some(&(fastest, _)) = exact.first() else {
            return Vec::new();
        };
        let is_alike = |method: &&Measured| {
            let ratio = method.quartiles_of_ratio(fastest);
            ratio.is_some_and(|[_, median, _]| median < ALIKE)
        };
        let methods = exact.into_iter().map(|(method, _)| method);
        let mut picks: Vec<_> = methods.filter(is_alike).collect();
        picks.sort_by_key(|method| method.artifact_px);
        picks
    }
}

/// A method while it is measured.
struct Candidate {
    name: String,
    ready: Result<ReadyMethod, NoPicture>,
    shadow_ms: Vec<f64>,
    wrong_px: u64,
    artifact_px: u64,
    drawn: Option<DrawnVolumes>,
}

/// Measures a scene along its flight.
///
/// # Errors
/// When the device cannot hold the scene, or is lost.
pub fn advise(request: &Request<'_>) -> anyhow::Result<Advice> {
    let Request {
        gpu,
        scene,
        size_px,
        frames,
        ..
    } = *request;
    let device = DeviceScene::new(gpu, scene, size_px)?;
    let mut candidates = Vec::new();
    for name in std::iter::once(FULL).chain(CANDIDATES) {
        let method = request.registry.parse(name)?;
        candidates.push(Candidate {
            name: name.to_owned(),
            ready: device.prepare(method.as_ref()),
            shadow_ms: Vec::new(),
            wrong_px: 0,
            artifact_px: 0,
            drawn: None,
        });
    }
    let times_s = scene.flight.frame_times(frames);
    for (number, &time_s) in times_s.iter().enumerate() {
        // In turns, so that whatever else the machine does falls on all.
        for turn in 0..candidates.len() {
            let at = (turn + number) % candidates.len();
            candidates[at].measure(gpu, scene, time_s)?;
        }
    }
    let verified = VERIFIED.min(times_s.len());
    verify(request, &device, &mut candidates, verified)?;
    Ok(Advice {
        scene: scene.title.clone(),
        shape: shape(scene, device.casters(), &times_s, size_px),
        frames: times_s.len(),
        verified,
        size_px,
        device: gpu.info.name.clone(),
        measured: candidates.into_iter().map(Candidate::done).collect(),
    })
}

impl Candidate {
    fn measure(&mut self, gpu: &Gpu, scene: &Scene, time_s: f64) -> anyhow::Result<()> {
        let Ok(ready) = &mut self.ready else {
            return Ok(());
        };
        let moment = scene.flight.at(time_s);
        // Nobody times the first frame after another method's.
        ready.begin(gpu, &[moment])?;
        ready.resources.set_view(gpu, &moment);
        let mut timer = FrameTimer::new(gpu);
        let (resources, method) = (&ready.resources, &mut ready.method);
        timer.frame(gpu, |frame| resources.record(frame, method.as_mut()))?;
        for times in timer.finish(gpu)? {
            let others_ms = times.stage_ms(GBUFFER_STAGE) + times.stage_ms(SHADE_STAGE);
            self.shadow_ms.push(times.frame_ms() - others_ms);
        }
        if let Some(drawn) = ready.method.drawn_volumes() {
            *self.drawn.get_or_insert_default() += drawn;
        }
        Ok(())
    }

    fn done(self) -> Measured {
        Measured {
            method: self.name,
            shadow_ms: match self.ready {
                Ok(_) => Ok(self.shadow_ms),
                Err(no_picture) => Err(no_picture.reason().to_owned()),
            },
            wrong_px: self.wrong_px,
            artifact_px: self.artifact_px,
            drawn: self.drawn,
        }
    }
}

fn verify(
    request: &Request<'_>,
    device: &DeviceScene<'_>,
    candidates: &mut [Candidate],
    frames: usize,
) -> anyhow::Result<()> {
    let usual = device
        .resources(DepthSetup::default())
        .map_err(anyhow::Error::from)?;
    let verifier = Verifier::new(request.gpu, request.scene, &usual, request.cache)?;
    for time_s in request.scene.flight.frame_times(frames) {
        let truth = verifier.truth(&request.scene.flight.at(time_s))?;
        for candidate in &mut *candidates {
            let Ok(ready) = &mut candidate.ready else {
                continue;
            };
            let mask = verifier.draw_mask(ready.method.as_mut(), &truth)?;
            let judgement = verifier.compare(&mask, &truth, ready.method.as_ref())?;
            candidate.wrong_px += judgement.error.wrong_px();
            candidate.artifact_px += judgement.error.artifact_px;
        }
    }
    Ok(())
}

fn shape(scene: &Scene, casters: &Rc<Casters>, times_s: &[f64], size_px: (u32, u32)) -> Shape {
    let mesh = &casters.mesh;
    let (topology, open, closed) = (
        casters.topology(),
        casters.open_edges(),
        casters.are_closed(),
    );
    let left_out = |left: Rc<Casters>| mesh.triangles.len() - left.mesh.triangles.len();
    let closed_sizes = mesh.casters().zip(&**closed).filter(|(_, closed)| **closed);
    let closed_sizes: Vec<_> = closed_sizes
        .map(|(object, _)| object.triangles.len())
        .collect();
    let extents = SceneExtents::new(mesh);
    let mut quads = SideQuads::new(mesh, topology, &extents);
    let mut overdraw = Overdraw::default();
    let share = 1.0 / times_s.len() as f64;
    for &time_s in times_s {
        let of_moment = quads.overdraw(&scene.flight.at(time_s), size_px);
        overdraw.infinity += share * of_moment.infinity;
        overdraw.scene += share * of_moment.scene;
        overdraw.object += share * of_moment.object;
    }
    Shape {
        triangles: mesh.caster_triangle_count(),
        objects: mesh.caster_object_count(),
        closed_objects: closed_sizes.len(),
        closed_triangles: closed_sizes.iter().sum(),
        left_out: casters.unoccluded().map(left_out),
        edges: topology.counts(),
        open_edges: (0..closed.len()).map(|caster| open.of(caster).len()).sum(),
        overdraw,
    }
}
