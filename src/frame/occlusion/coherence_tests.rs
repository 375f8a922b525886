use super::*;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Boxes in a row along x.
fn row(count: u32) -> Vec<Bounds> {
    let at = |i: u32| Bounds {
        low: DVec3::new(f64::from(i), 0.0, 0.0),
        high: DVec3::new(f64::from(i) + 0.5, 1.0, 1.0),
    };
    (0..count).map(at).collect()
}

/// Frames of a world in which this much of a row is visible and in view.
struct World {
    boxes: Vec<Bounds>,
    tree: BoxTree,
    coherence: Coherence,
    /// Leaves to be answered about in the next frame.
    late: Vec<u32>,
}

/// What a frame took.
#[derive(Debug)]
struct Cost {
    drawn: Vec<u32>,
    asked: usize,
    rounds: usize,
}

impl World {
    fn new(count: u32) -> Self {
        let boxes = row(count);
        let tree = BoxTree::new(&boxes);
        let coherence = Coherence::new(&tree, 0);
        Self {
            boxes,
            tree,
            coherence,
            late: Vec::new(),
        }
    }

    fn frame(
        &mut self,
        is_visible: impl Fn(Bounds) -> bool,
        sight: impl Fn(Bounds) -> Sight,
    ) -> Cost {
        let Self {
            tree, coherence, ..
        } = self;
        let answer = |node: u32| (node, is_visible(tree.nodes[node as usize].bounds));
        coherence.learn_late(self.late.drain(..).map(answer));
        let eye = DVec3::ZERO;
        let mut found = coherence.begin(tree, eye, &sight);
        let mut cost = Cost {
            drawn: Vec::new(),
            asked: 0,
            rounds: 0,
        };
        loop {
            cost.drawn.extend(found.drawn);
            cost.asked += found.ask_now.len() + found.ask_later.len();
            self.late.extend(found.ask_later);
            if found.ask_now.is_empty() {
                break;
            }
            cost.rounds += 1;
            let answers: Vec<_> = found.ask_now.into_iter().map(answer).collect();
            found = coherence.go_on(tree, eye, answers, &sight);
        }
        cost.drawn.sort_unstable();
        cost
    }
}

fn in_view(_: Bounds) -> Sight {
    Sight::InView
}

#[test]
fn what_is_visible_is_drawn_whatever_was_before() {
    let mut world = World::new(300);
    let mut random = ChaCha8Rng::seed_from_u64(7);
    for frame in 0..200 {
        // A window that mostly stands still, moves a little, or jumps.
        let low: f64 = random.random_range(0.0..290.0);
        let high = low + random.random_range(0.0..40.0);
        let seen = |bounds: Bounds| bounds.high.x > low && bounds.low.x < high;
        let edge = random.random_range(0.0..400.0);
        let sight = |bounds: Bounds| match bounds.low.x > edge {
            true => Sight::Out,
            false if bounds.low.x < 3.0 => Sight::Around,
            false => Sight::InView,
        };
        for _ in 0..random.random_range(1..6) {
            let cost = world.frame(seen, sight);
            let must = (0..300).filter(|i| {
                let bounds = world.boxes[*i as usize];
                sight(bounds) != Sight::Out && seen(bounds)
            });
            for object in must {
                assert!(cost.drawn.contains(&object), "frame {frame}: {object}");
            }
            let mut once = cost.drawn.clone();
            once.dedup();
            assert_eq!(once, cost.drawn, "an object is drawn once");
            assert!(cost.rounds <= MOST_ROUNDS as usize);
        }
    }
}

#[test]
fn a_view_that_stands_still_asks_ever_less() {
    let mut world = World::new(1024);
    let seen = |bounds: Bounds| bounds.low.x < 16.0;
    let first = world.frame(seen, in_view);
    assert!(first.asked >= 256, "all leaves, of four at most");
    let costs: Vec<_> = (0..64).map(|_| world.frame(seen, in_view)).collect();
    let last = &costs[32..];
    let asked: usize = last.iter().map(|cost| cost.asked).sum();
    assert!(asked < 10 * last.len(), "{asked} in {} frames", last.len());
    assert!(last.iter().all(|cost| cost.drawn.len() <= 20));
}

#[test]
fn what_all_is_visible_is_drawn_without_waiting() {
    let mut world = World::new(1024);
    world.frame(|_| true, in_view);
    let costs: Vec<_> = (0..64).map(|_| world.frame(|_| true, in_view)).collect();
    assert!(
        costs
            .iter()
            .all(|cost| cost.rounds == 0 && cost.drawn.len() == 1024)
    );
    let asked: usize = costs.iter().map(|cost| cost.asked).sum();
    let leaves = world
        .tree
        .nodes
        .iter()
        .filter(|node| node.children.is_none());
    assert!(asked <= costs.len() * leaves.count() / TRUST_FRAMES as usize);
}

#[test]
fn what_was_forgotten_is_asked_about_again() {
    let mut world = World::new(64);
    let first = world.frame(|_| false, in_view);
    assert!(world.frame(|_| false, in_view).asked < first.asked);
    world.coherence.forget();
    assert_eq!(world.frame(|_| false, in_view).asked, first.asked);
}

#[test]
fn the_nearest_are_drawn_first() {
    let mut world = World::new(64);
    world.frame(|_| true, in_view);
    let found = world
        .coherence
        .begin(&world.tree, DVec3::new(-5.0, 0.0, 0.0), in_view);
    let leaves: Vec<_> = found.drawn.iter().map(|object| object / 8).collect();
    assert!(leaves.is_sorted(), "{leaves:?}");
}
