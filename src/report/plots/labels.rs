//! Places for the names of points, so that none lies over another or over a marker.
//!
//! Greedy, in the order given: each name tries places around its point, near ones first, and takes the
//! cheapest. Names that had to go far get a line back to their point.

use super::canvas::{Px, Rect};

/// From a point's middle to its name.
const MARGIN_PX: i32 = 8;
/// From one ring of places to the next.
const RING_PX: i32 = 9;
const RINGS: i32 = 36;
/// Half the side of the square that a marker keeps free.
const MARKER_PX: i32 = 6;
/// A name this far from its point still reads as the point's own, without a line.
const NEAR_PX: i32 = 14;
/// From one place at which a line is looked at to the next.
const STEP_PX: i32 = 6;
/// What it costs to lie over another name or a marker, in pixels of distance: nothing is worse.
const OVERLAP: i32 = 100_000;
/// What it costs to lie over a line, for each step of it.
const CROSSING: i32 = 8;
/// What it costs to have a name or marker under the line back to the point, which then seems to be theirs,
/// for each step.
const OVERRUN: i32 = 20;
/// What it costs to need that line.
const LEADER: i32 = 10;
/// A point that wants its name placed.
#[derive(Debug, Clone, Copy)]
pub(super) struct Anchor {
    pub(super) at: Px,
    /// Width and height of the name.
    pub(super) size: Px,
}

#[derive(Debug, Clone, Copy)]
pub(super) struct Placed {
    pub(super) rect: Rect,
    /// The line back to the point, if the name is far from it.
    pub(super) leader: Option<[Px; 2]>,
}

/// What names should keep off, and what it costs to lie over it.
type Obstacle = (Rect, i32);

impl Rect {
    fn around((x, y): Px, half: i32) -> Self {
        Self {
            left: x - half,
            top: y - half,
            right: x + half,
            bottom: y + half,
        }
    }

    fn overlaps(&self, other: &Self) -> bool {
        let across = self.left < other.right && other.left < self.right;
        across && self.top < other.bottom && other.top < self.bottom
    }

    fn contains(&self, other: &Self) -> bool {
        let across = self.left <= other.left && other.right <= self.right;
        across && self.top <= other.top && other.bottom <= self.bottom
    }
}

/// Places the names within `bounds`, with `lines` drawn under them; in the order of `anchors`.
pub(super) fn place(anchors: &[Anchor], bounds: Rect, lines: &[Vec<Px>]) -> Vec<Placed> {
    let markers = anchors
        .iter()
        .map(|anchor| Rect::around(anchor.at, MARKER_PX));
    let mut obstacles: Vec<Obstacle> = markers.map(|rect| (rect, OVERLAP)).collect();
    let ends = lines.iter().flat_map(|line| line.windows(2));
    obstacles.extend(ends.flat_map(|ends| obstacles_along(ends[0], ends[1])));
    let mut all = Vec::new();
    for anchor in anchors {
        // A name wider than the chart is placed all the same: left out, its point had no name.
        let mut best = (i32::MAX, placed_at(*anchor, (1.0, 0.0), 0));
        // No place farther out is cheaper than its distance.
        for far_px in (0..RINGS).map(|ring| ring * RING_PX) {
            if far_px >= best.0 {
                break;
            }
            for direction in directions() {
                let found = placed_at(*anchor, direction, far_px);
                if bounds.contains(&found.rect) {
                    let cost = cost(&found, anchor.at, &obstacles);
                    best = if cost < best.0 { (cost, found) } else { best };
                }
            }
        }
        let (_, placed) = best;
        obstacles.push((placed.rect, OVERLAP));
        obstacles.extend(
            placed
                .leader
                .into_iter()
                .flat_map(|[from, to]| obstacles_along(from, to)),
        );
        all.push(placed);
    }
    all
}

/// The sixteen directions, to the right and the left first, where one looks for a name.
fn directions() -> impl Iterator<Item = (f64, f64)> {
    let downs = [0.0_f64, -1.0, 1.0, -0.5, 0.5];
    let all = downs
        .into_iter()
        .flat_map(|y| [1.0_f64, -1.0, 0.0, 0.5, -0.5].map(|x| (x, y)));
    all.filter(|(x, y)| x.abs().max(y.abs()) == 1.0)
}

fn placed_at(Anchor { at, size }: Anchor, (dx, dy): (f64, f64), far_px: i32) -> Placed {
    // Beyond the first ring, round about the point rather than wide about a wide name.
    let out =
        |size: i32, part: f64| (f64::from(size / 2 + MARGIN_PX + far_px) * part).round() as i32;
    let left = at.0 + out(size.0, dx) - size.0 / 2;
    let top = at.1 + out(size.1, dy) - size.1 / 2;
    let rect = Rect {
        left,
        top,
        right: left + size.0,
        bottom: top + size.1,
    };
    let end = nearest(rect, at);
    let leader = (distance_px(at, end) > NEAR_PX).then_some([at, end]);
    Placed { rect, leader }
}

/// The place in `rect` that is nearest to `(x, y)`.
fn nearest(rect: Rect, (x, y): Px) -> Px {
    (
        x.clamp(rect.left, rect.right),
        y.clamp(rect.top, rect.bottom),
    )
}

fn distance_px(from: Px, to: Px) -> i32 {
    f64::from(from.0 - to.0)
        .hypot(f64::from(from.1 - to.1))
        .round() as i32
}

/// A line as obstacles: a small one at every step.
fn obstacles_along(from: Px, to: Px) -> impl Iterator<Item = Obstacle> {
    let steps = distance_px(from, to) / STEP_PX + 1;
    let between = move |from: i32, to: i32, step: i32| from + (to - from) * step / steps;
    let at = move |step| (between(from.0, to.0, step), between(from.1, to.1, step));
    (0..=steps).map(move |step| (Rect::around(at(step), 1), CROSSING))
}

fn cost(found: &Placed, at: Px, obstacles: &[Obstacle]) -> i32 {
    let under = obstacles
        .iter()
        .filter(|(rect, _)| found.rect.overlaps(rect));
    let distance = distance_px(at, nearest(found.rect, at));
    let cost = distance + under.map(|(_, cost)| cost).sum::<i32>();
    let Some([from, to]) = found.leader else {
        return cost;
    };
    let point = Rect::around(at, 1);
    let in_the_way = |(rect, cost): &&Obstacle| *cost == OVERLAP && !rect.overlaps(&point);
    let in_the_way: Vec<&Obstacle> = obstacles.iter().filter(in_the_way).collect();
    let is_over = |(step, _): &Obstacle| in_the_way.iter().any(|(rect, _)| rect.overlaps(step));
    let overrun = obstacles_along(from, to).filter(is_over).count();
    cost + LEADER + overrun as i32 * OVERRUN
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOUNDS: Rect = Rect {
        left: 0,
        top: 0,
        right: 1100,
        bottom: 700,
    };
    const ALONE: Anchor = Anchor {
        at: (500, 300),
        size: (80, 16),
    };

    fn check(anchors: &[Anchor]) -> Vec<Placed> {
        let placed = place(anchors, BOUNDS, &[]);
        assert_eq!(placed.len(), anchors.len());
        let markers = anchors
            .iter()
            .map(|anchor| Rect::around(anchor.at, MARKER_PX));
        let markers: Vec<Rect> = markers.collect();
        for (index, one) in placed.iter().enumerate() {
            assert!(BOUNDS.contains(&one.rect), "{one:?}");
            let others = placed[..index].iter().map(|other| &other.rect);
            for other in others.chain(&markers) {
                assert!(!one.rect.overlaps(other), "{one:?} {other:?}");
            }
        }
        placed
    }

    #[test]
    fn a_name_alone_stands_right_of_its_point() {
        let placed = check(&[ALONE]);
        assert!(
            placed[0].rect.left > 500 && placed[0].leader.is_none(),
            "{placed:?}"
        );
    }

    #[test]
    fn names_of_a_crowd_do_not_lie_over_each_other_or_a_marker() {
        // Forty-five points in a corner, some at one place, all with long names.
        let at = |index: i32| (1000 - (index * 37) % 160, 640 - (index * 11) % 60);
        let anchors: Vec<Anchor> = (0..45)
            .map(|index| Anchor {
                at: at(index - index % 3),
                size: (60 + (index * 53) % 140, 16),
            })
            .collect();
        let placed = check(&anchors);
        assert!(placed.iter().any(|one| one.leader.is_some()));
    }

    #[test]
    fn a_name_keeps_off_lines_where_it_can() {
        let (from, to) = ((500, 300), (1000, 300));
        let placed = place(&[ALONE], BOUNDS, &[vec![from, to]]);
        let under = obstacles_along(from, to).filter(|(at, _)| placed[0].rect.overlaps(at));
        assert_eq!(under.count(), 0, "{placed:?}");
    }
}
