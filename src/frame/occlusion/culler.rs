//! A tree of boxes, what is known of it, and how the device is asked.

use super::{BoxQueries, BoxTree, Coherence, DepthBuffer, Frontier, Sight};
use crate::geometry::{Bounds, VisibleFaces};
use crate::gpu::{Gpu, Stage, Ticket};
use bytemuck::pod_collect_to_vec;
use glam::DVec3;

/// What a frame asks about boxes.
pub trait Look {
    /// Where it is seen from.
    fn eye(&self) -> DVec3;
    /// What may be done with a box.
    fn sight(&self, bounds: Bounds) -> Sight;
    /// Adds what is drawn to ask about it.
    fn push(&self, faces: &mut VisibleFaces, bounds: Bounds);
}

/// What was asked about leaves that were drawn.
struct Late {
    nodes: Vec<u32>,
    tickets: Vec<Ticket>,
    answers: Vec<Vec<u8>>,
}

/// Finds out which objects are hidden.
pub struct Culler {
    tree: BoxTree,
    coherence: Coherence,
    queries: BoxQueries,
    /// What the frame under way waits for.
    now: Vec<u32>,
    tickets: Vec<Ticket>,
    /// Leaves to be asked about once all is drawn.
    later: Vec<u32>,
    late: Vec<Late>,
    faces: VisibleFaces,
    /// Queries of the frame.
    asked: u32,
}

impl Culler {
    /// For objects in these boxes. Of leaves about which nothing is known, the nearest `unasked` are drawn.
    pub fn new(gpu: &Gpu, depth: &DepthBuffer<'_>, objects: &[Bounds], unasked: usize) -> Self {
        let tree = BoxTree::new(objects);
        Self {
            coherence: Coherence::new(&tree, unasked),
            tree,
            queries: BoxQueries::new(gpu, depth),
            now: Vec::new(),
            tickets: Vec::new(),
            later: Vec::new(),
            late: Vec::new(),
            faces: VisibleFaces::default(),
            asked: 0,
        }
    }

    /// The next frame does not follow the one before.
    pub fn forget(&mut self) {
        self.coherence.forget();
        self.late.clear();
    }

    /// How many boxes the frame has asked about.
    pub fn asked(&self) -> u32 {
        self.asked
    }

    /// Begins a frame: gives the objects that are taken to be visible, from front to back.
    ///
    /// # Errors
    /// When the device is lost.
    pub fn begin(
        &mut self,
        stage: &mut Stage<'_, '_>,
        look: &impl Look,
    ) -> anyhow::Result<Vec<u32>> {
        self.asked = 0;
        self.queries.begin();
        self.later.clear();
        self.learn_late(stage.gpu())?;
        let Self {
            tree, coherence, ..
        } = self;
        let sight = |bounds| look.sight(bounds);
        let found = stage.on_processor(|| coherence.begin(tree, look.eye(), sight));
        Ok(self.take(found))
    }

    /// Asks about what the last answer left open, against depth as it is now.
    ///
    /// # Errors
    /// When the device is lost.
    pub fn ask(
        &mut self,
        stage: &mut Stage<'_, '_>,
        depth: &DepthBuffer<'_>,
        look: &impl Look,
    ) -> anyhow::Result<()> {
        let nodes = std::mem::take(&mut self.now);
        self.tickets = self.ask_about(stage, depth, look, &nodes)?;
        self.now = nodes;
        Ok(())
    }

    /// Waits for what was asked, and gives the objects that turn out to be visible. `None` if nothing was.
    ///
    /// # Errors
    /// When the device is lost.
    pub fn go_on(
        &mut self,
        stage: &mut Stage<'_, '_>,
        look: &impl Look,
    ) -> anyhow::Result<Option<Vec<u32>>> {
        if self.now.is_empty() {
            return Ok(None);
        }
        let answers = stage.answer_now(std::mem::take(&mut self.tickets))?;
        let answers = visible(std::mem::take(&mut self.now), &answers);
        let Self {
            tree, coherence, ..
        } = self;
        let sight = |bounds| look.sight(bounds);
        let found = stage.on_processor(|| coherence.go_on(tree, look.eye(), answers, sight));
        Ok(Some(self.take(found)))
    }

    /// Asks for later frames about what was drawn without asking.
    ///
    /// # Errors
    /// When the device is lost.
    pub fn end(
        &mut self,
        stage: &mut Stage<'_, '_>,
        depth: &DepthBuffer<'_>,
        look: &impl Look,
    ) -> anyhow::Result<()> {
        let nodes = std::mem::take(&mut self.later);
        let tickets = self.ask_about(stage, depth, look, &nodes)?;
        if !nodes.is_empty() {
            self.late.push(Late {
                nodes,
                tickets,
                answers: Vec::new(),
            });
        }
        Ok(())
    }

    fn take(&mut self, found: Frontier) -> Vec<u32> {
        self.now = found.ask_now;
        self.later.extend(found.ask_later);
        found.drawn
    }

    fn ask_about(
        &mut self,
        stage: &mut Stage<'_, '_>,
        depth: &DepthBuffer<'_>,
        look: &impl Look,
        nodes: &[u32],
    ) -> anyhow::Result<Vec<Ticket>> {
        if nodes.is_empty() {
            return Ok(Vec::new());
        }
        let Self {
            tree,
            queries,
            faces,
            ..
        } = self;
        stage.on_processor(|| {
            faces.clear();
            for &node in nodes {
                look.push(faces, tree.nodes[node as usize].bounds);
            }
        });
        self.asked += nodes.len() as u32;
        queries.ask(stage, depth, faces)
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
