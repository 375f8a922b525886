//! Which objects' shadow volumes are hidden, found out by occlusion queries of boxes extruded from the light.

use super::PrepareContext;
use super::plan::FramePlan;
use super::volume_parameters::{Culling, VolumeParameters};
use crate::frame::occlusion::{BoxQueries, BoxTree, Coherence, Frontier, Sight};
use crate::frame::{Frame, FrameResources, FrameView};
use crate::geometry::{Bounds, NearVolume, VisibleFaces};
use crate::gpu::{Gpu, Ticket};
use bytemuck::pod_collect_to_vec;

/// Name of the stages that ask.
pub(super) const OCCLUSION_STAGE: &str = "occlusion";

/// Boxes are larger on every side by what so much of a pixel is at the farthest point of the scene: more than the
/// rasteriser moves the edges of either.
const MARGIN_PX: f64 = 1.0 / 16.0;

/// And by this part of the largest coordinate, more than rounding.
const ROUNDING: f64 = 1e-5;

/// What was asked about leaves that were drawn.
struct Late {
    nodes: Vec<u32>,
    tickets: Vec<Ticket>,
    answers: Vec<Vec<u8>>,
}

/// Finds out which volumes are hidden.
pub(super) struct Occlusion {
    tree: BoxTree,
    coherence: Coherence,
    queries: BoxQueries,
    /// What the frame under way waits for.
    now: Vec<u32>,
    tickets: Vec<Ticket>,
    late: Vec<Late>,
    /// Casters that the plan of the frame under way draws unless they are hidden.
    wanted: Vec<bool>,
    faces: VisibleFaces,
    /// Queries of the frame.
    asked: u32,
}

/// What a frame asks by.
pub(super) struct Look {
    view: FrameView,
    near: NearVolume,
    margin: f64,
}

impl Look {
    pub(super) fn new(resources: &FrameResources) -> Self {
        let view = resources.view();
        let scene = resources.extents.scene;
        let eye = view.eye.as_dvec3();
        let farthest = (scene.low - eye)
            .abs()
            .max((scene.high - eye).abs())
            .length();
        let height = f64::from(resources.targets.height);
        let half_height = view.clip_to_eye_ray.y_axis.as_dvec4().truncate().length();
        let largest = scene.low.abs().max(scene.high.abs()).max_element();
        Self {
            near: view.near_volume(),
            margin: MARGIN_PX * farthest * 2.0 * half_height / height + ROUNDING * largest,
            view,
        }
    }

    fn larger(&self, bounds: Bounds) -> Bounds {
        Bounds {
            low: bounds.low - self.margin,
            high: bounds.high + self.margin,
        }
    }

    /// Adds the volume of a box, as it is asked about.
    pub(super) fn push_volume(&self, faces: &mut VisibleFaces, bounds: Bounds) {
        let (light, eye) = (self.view.light.place.as_dvec4(), self.view.eye.as_dvec3());
        faces.push_volume(self.larger(bounds), light, &self.view.end_planes, eye);
    }

    /// What may be done with a box.
    pub(super) fn sight(&self, bounds: Bounds) -> Sight {
        if !self.view.may_see_shadow_of(bounds) {
            return Sight::Out;
        }
        let bounds = self.larger(bounds);
        // Inside of the volume, or around the light, no surface of it need be in view.
        if self.near.may_meet(bounds) || !self.view.is_outside_of_lamp(bounds) {
            return Sight::Around;
        }
        Sight::InView
    }
}

impl Occlusion {
    /// For volumes of these parameters; `None` if they do not ask for it.
    pub(super) fn wanted(
        context: &PrepareContext<'_>,
        parameters: VolumeParameters,
    ) -> Option<Self> {
        let is_wanted = parameters.culling == Culling::Occlusion;
        is_wanted.then(|| Self::new(context.gpu, context.resources))
    }

    fn new(gpu: &Gpu, resources: &FrameResources) -> Self {
        let tree = BoxTree::new(&resources.extents.casters);
        Self {
            coherence: Coherence::new(&tree),
            tree,
            queries: BoxQueries::new(gpu, resources),
            now: Vec::new(),
            tickets: Vec::new(),
            late: Vec::new(),
            wanted: Vec::new(),
            faces: VisibleFaces::default(),
            asked: 0,
        }
    }

    /// The next frame does not follow the one before.
    pub(super) fn forget(&mut self) {
        self.coherence.forget();
        self.late.clear();
    }

    /// Begins a frame: leaves those of the plan that are taken to be visible, and asks about the others.
    pub(super) fn begin(
        &mut self,
        frame: &mut Frame<'_>,
        plan: &mut FramePlan,
    ) -> anyhow::Result<()> {
        let resources = frame.resources();
        let look = Look::new(resources);
        self.asked = 0;
        self.queries.begin();
        self.learn_late(frame.gpu())?;
        self.wanted.clear();
        for caster in &mut plan.casters {
            self.wanted.push(std::mem::take(&mut caster.is_drawn));
        }
        let Self {
            tree, coherence, ..
        } = self;
        let eye = look.view.eye.as_dvec3();
        let found = frame.stage(OCCLUSION_STAGE, |stage| {
            stage.on_processor(|| coherence.begin(tree, eye, |bounds| look.sight(bounds)))
        });
        for &caster in &found.drawn {
            let caster = caster as usize;
            plan.casters[caster].is_drawn = self.wanted[caster];
        }
        self.ask(frame, &look, found)
    }

    /// Waits for what was asked; gives the casters that turn out to be visible, and asks about more. `None` once nothing is
    /// open any more.
    pub(super) fn go_on(&mut self, frame: &mut Frame<'_>) -> anyhow::Result<Option<Vec<u32>>> {
        if self.now.is_empty() {
            return Ok(None);
        }
        let look = Look::new(frame.resources());
        let tickets = std::mem::take(&mut self.tickets);
        let answers = frame.stage(OCCLUSION_STAGE, |stage| stage.answer_now(tickets))?;
        let answers = visible(std::mem::take(&mut self.now), &answers);
        let Self {
            tree, coherence, ..
        } = self;
        let eye = look.view.eye.as_dvec3();
        let mut found = frame.stage(OCCLUSION_STAGE, |stage| {
            stage.on_processor(|| coherence.go_on(tree, eye, answers, |bounds| look.sight(bounds)))
        });
        let mut drawn = std::mem::take(&mut found.drawn);
        drawn.retain(|caster| self.wanted[*caster as usize]);
        self.ask(frame, &look, found)?;
        Ok(Some(drawn))
    }

    /// All that a frame asks about, answered before anything is drawn.
    pub(super) fn cull(
        &mut self,
        frame: &mut Frame<'_>,
        plan: &mut FramePlan,
    ) -> anyhow::Result<()> {
        self.begin(frame, plan)?;
        while let Some(visible) = self.go_on(frame)? {
            for caster in visible {
                plan.casters[caster as usize].is_drawn = true;
            }
        }
        self.end(plan);
        Ok(())
    }

    /// Once all is known: what was asked and hidden.
    pub(super) fn end(&self, plan: &mut FramePlan) {
        plan.queries = self.asked;
        let casters = plan.casters.iter().zip(&self.wanted);
        let hidden = casters.filter(|(caster, is_wanted)| **is_wanted && !caster.is_drawn);
        plan.hidden = hidden.count() as u32;
    }

    fn ask(&mut self, frame: &mut Frame<'_>, look: &Look, found: Frontier) -> anyhow::Result<()> {
        let resources = frame.resources();
        let Self {
            tree,
            queries,
            faces,
            ..
        } = self;
        let mut record = |nodes: &[u32]| {
            if nodes.is_empty() {
                return Ok(Vec::new());
            }
            frame.stage(OCCLUSION_STAGE, |stage| {
                stage.on_processor(|| {
                    faces.corners.clear();
                    faces.ends.clear();
                    for &node in nodes {
                        look.push_volume(faces, tree.nodes[node as usize].bounds);
                    }
                });
                queries.ask(stage, resources, faces)
            })
        };
        self.tickets = record(&found.ask_now)?;
        let tickets = record(&found.ask_later)?;
        self.asked += (found.ask_now.len() + found.ask_later.len()) as u32;
        self.now = found.ask_now;
        if !found.ask_later.is_empty() {
            self.late.push(Late {
                nodes: found.ask_later,
                tickets,
                answers: Vec::new(),
            });
        }
        Ok(())
    }

    /// Takes the answers that are there.
    fn learn_late(&mut self, gpu: &Gpu) -> anyhow::Result<()> {
        let mut open = Vec::new();
        for mut late in std::mem::take(&mut self.late) {
            while let Some(ticket) = late.tickets.first_mut() {
                let Some(answer) = ticket.poll(gpu)? else {
                    break;
                };
                late.answers.push(answer);
                late.tickets.remove(0);
            }
            if late.tickets.is_empty() {
                self.coherence
                    .learn_late(visible(late.nodes, &late.answers));
            } else {
                open.push(late);
            }
        }
        self.late = open;
        Ok(())
    }
}

/// Nodes with their answers.
fn visible(nodes: Vec<u32>, answers: &[Vec<u8>]) -> Vec<(u32, bool)> {
    let samples = answers
        .iter()
        .flat_map(|bytes| pod_collect_to_vec::<u8, u64>(bytes));
    nodes
        .into_iter()
        .zip(samples.map(|count| count > 0))
        .collect()
}
