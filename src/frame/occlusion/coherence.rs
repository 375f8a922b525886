//! Which boxes of a tree are asked about in a frame, given what was seen in those before.

use super::BoxTree;
use crate::geometry::Bounds;
use glam::DVec3;

/// Frames for which a leaf that was visible is drawn before it is asked about again, and an inner node that was is looked
/// into before it may be asked about as a whole: so many, and up to twice as many by the number of the node, so that not
/// all are due at once.
const TRUST_FRAMES: u32 = 8;

/// How often answers are waited for in a frame. What is still open then is drawn.
const MOST_ROUNDS: u32 = 4;

/// What may be done with a box without asking the device.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sight {
    /// It is out of view: nothing.
    Out,
    /// It is around the eye or the light, and cannot be asked about.
    Around,
    /// It may be asked about.
    InView,
}

/// What is known of a node.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum State {
    /// Nothing; inner nodes are looked into, and leaves asked about.
    Unknown,
    /// It was visible, and is trusted to be until a frame.
    Visible { until: u32 },
    /// It was not.
    Hidden,
}

/// What to do in a round of a frame.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Frontier {
    /// Objects to be drawn, from front to back.
    pub drawn: Vec<u32>,
    /// Nodes whose objects are drawn or not as the device answers now.
    pub ask_now: Vec<u32>,
    /// Leaves that are drawn, and about which the device may answer in later frames.
    pub ask_later: Vec<u32>,
}

/// What is known of the boxes of a tree from frame to frame.
#[derive(Debug, Clone)]
pub struct Coherence {
    states: Vec<State>,
    frame: u32,
    round: u32,
    /// Nodes looked into in this frame, parents first.
    looked_into: Vec<u32>,
    /// Leaves about which nothing is known and that are drawn in each frame: so many.
    unasked: usize,
    /// For each node the frame in which it was last found to be out of view.
    out: Vec<u32>,
}

impl Coherence {
    /// Nothing is known of the boxes of this tree. The nearest `unasked` leaves of these are drawn in a frame, before others
    /// are asked about: what they hide depends on what there is.
    pub fn new(tree: &BoxTree, unasked: usize) -> Self {
        Self {
            unasked,
            states: vec![State::Unknown; tree.nodes.len()],
            frame: 0,
            round: 0,
            looked_into: Vec::new(),
            out: vec![0; tree.nodes.len()],
        }
    }

    /// Forgets all.
    pub fn forget(&mut self) {
        self.states.fill(State::Unknown);
    }

    /// Begins a frame seen from `eye`: what to draw and what to ask about.
    pub fn begin(
        &mut self,
        tree: &BoxTree,
        eye: DVec3,
        sight: impl Fn(Bounds) -> Sight,
    ) -> Frontier {
        self.close_hidden(tree);
        self.frame += 1;
        self.round = 1;
        self.looked_into.clear();
        let root = (!tree.nodes.is_empty()).then_some(0);
        self.look(tree, root.into_iter().collect(), eye, sight)
    }

    /// Goes on with the answers about what was asked now, in its order: whether anything of it was visible.
    pub fn go_on(
        &mut self,
        tree: &BoxTree,
        eye: DVec3,
        answers: impl IntoIterator<Item = (u32, bool)>,
        sight: impl Fn(Bounds) -> Sight,
    ) -> Frontier {
        self.round += 1;
        let mut open = Vec::new();
        for (node, is_visible) in answers {
            self.learn(node, is_visible);
            if is_visible {
                open.push(node);
            }
        }
        // The first is looked at last.
        open.reverse();
        self.look(tree, open, eye, sight)
    }

    /// Takes answers about leaves that were drawn in an earlier frame.
    pub fn learn_late(&mut self, answers: impl IntoIterator<Item = (u32, bool)>) {
        for (node, is_visible) in answers {
            self.learn(node, is_visible);
        }
    }

    fn learn(&mut self, node: u32, is_visible: bool) {
        self.states[node as usize] = if is_visible {
            let until = self.frame + TRUST_FRAMES + node % TRUST_FRAMES;
            State::Visible { until }
        } else {
            State::Hidden
        };
    }

    fn look(
        &mut self,
        tree: &BoxTree,
        mut open: Vec<u32>,
        eye: DVec3,
        sight: impl Fn(Bounds) -> Sight,
    ) -> Frontier {
        let mut found = Frontier::default();
        let mut unasked = if self.round == 1 { self.unasked } else { 0 };
        while let Some(number) = open.pop() {
            let node = &tree.nodes[number as usize];
            let sight = sight(node.bounds);
            if sight == Sight::Out {
                self.out[number as usize] = self.frame;
                continue;
            }
            let state = self.states[number as usize];
            let is_asked = sight == Sight::InView && self.round <= MOST_ROUNDS;
            match node.children {
                _ if is_asked && state == State::Hidden => found.ask_now.push(number),
                Some(children) => {
                    self.looked_into.push(number);
                    let distance = |child: u32| distance(tree.nodes[child as usize].bounds, eye);
                    let [one, other] = children;
                    // The nearer one is looked at first.
                    open.extend(match distance(one) <= distance(other) {
                        true => [other, one],
                        false => [one, other],
                    });
                }
                None if is_asked && state == State::Unknown && unasked == 0 => {
                    found.ask_now.push(number);
                }
                None => {
                    unasked -= usize::from(is_asked && state == State::Unknown);
                    found.drawn.extend_from_slice(tree.objects(number));
                    match state {
                        State::Visible { until } if self.frame < until => {}
                        _ if sight == Sight::InView => {
                            // Asked about once; until there is an answer, it is trusted.
                            self.learn(number, true);
                            found.ask_later.push(number);
                        }
                        _ => {}
                    }
                }
            }
        }
        found
    }

    /// Inner nodes below which nothing was visible in the last frame are asked about as a whole from now on.
    fn close_hidden(&mut self, tree: &BoxTree) {
        while let Some(number) = self.looked_into.pop() {
            let is_trusted = match self.states[number as usize] {
                State::Visible { until } => self.frame < until,
                State::Unknown | State::Hidden => false,
            };
            let is_hidden = |child: u32| {
                self.states[child as usize] == State::Hidden
                    || self.out[child as usize] == self.frame
            };
            let children = tree.nodes[number as usize].children;
            if !is_trusted && children.is_some_and(|children| children.into_iter().all(is_hidden)) {
                self.states[number as usize] = State::Hidden;
            }
        }
    }
}

/// From a point to a box.
fn distance(bounds: Bounds, point: DVec3) -> f64 {
    point.distance_squared(point.clamp(bounds.low, bounds.high))
}

#[cfg(test)]
#[path = "coherence_tests.rs"]
mod tests;
