//! Places for the names of points, so that none lies over another or over a marker.
//!
//! Greedy, in the order given: each name tries places around its point, near ones first, and takes the
//! cheapest that is free. Names that had to go far get a line back to their point.

use super::canvas::Px;

/// From a point's middle to its name.
const MARGIN_PX: i32 = 8;
/// From one ring of places to the next.
const RING_PX: i32 = 9;
const RINGS: i32 = 36;
/// Half the side of the square that a marker keeps free.
const MARKER_PX: i32 = 6;
/// A name this far from its point still reads as the point's own, without a line.
const NEAR_PX: i32 = 14;
/// What it costs to lie over a line, in pixels of distance.
const CROSSING: i32 = 40;
/// What it costs to have names or markers under the line back to the point: it then seems to be theirs.
const OVERRUN: i32 = 60;
/// The sixteen directions, to the right first, where one looks for a name.
const DIRECTIONS: [(f64, f64); 16] = [
    (1.0, 0.0),
    (-1.0, 0.0),
    (0.0, -1.0),
    (0.0, 1.0),
    (1.0, -1.0),
    (1.0, 1.0),
    (-1.0, -1.0),
    (-1.0, 1.0),
    (0.5, -1.0),
    (-0.5, -1.0),
    (0.5, 1.0),
    (-0.5, 1.0),
    (1.0, -0.5),
    (1.0, 0.5),
    (-1.0, -0.5),
    (-1.0, 0.5),
];

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Rect {
    pub(super) left: i32,
    pub(super) top: i32,
    pub(super) right: i32,
    pub(super) bottom: i32,
}

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

impl Rect {
    fn around((x, y): Px, half: i32) -> Self {
        Self {
            left: x - half,
            top: y - half,
            right: x + half,
            bottom: y + half,
        }
    }

    pub(super) fn overlaps(&self, other: &Self) -> bool {
        let across = self.left < other.right && other.left < self.right;
        across && self.top < other.bottom && other.top < self.bottom
    }

    fn contains(&self, other: &Self) -> bool {
        let across = self.left <= other.left && other.right <= self.right;
        across && self.top <= other.top && other.bottom <= self.bottom
    }

    /// The place in it that is nearest to `(x, y)`.
    fn nearest(&self, (x, y): Px) -> Px {
        (
            x.clamp(self.left, self.right),
            y.clamp(self.top, self.bottom),
        )
    }

    fn is_crossed_by(&self, [from, to]: [Px; 2]) -> bool {
        let (dx, dy) = (f64::from(to.0 - from.0), f64::from(to.1 - from.1));
        let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
        let sides = [
            (-dx, from.0 - self.left),
            (dx, self.right - from.0),
            (-dy, from.1 - self.top),
            (dy, self.bottom - from.1),
        ];
        for (slope, room) in sides {
            let room = f64::from(room);
            if slope == 0.0 {
                if room <= 0.0 {
                    return false;
                }
            } else if slope < 0.0 {
                enter = enter.max(room / slope);
            } else {
                leave = leave.min(room / slope);
            }
        }
        enter < leave
    }
}

/// Places the names within `bounds`, with `lines` drawn under them; in the order of `anchors`.
pub(super) fn place(anchors: &[Anchor], bounds: Rect, lines: &[[Px; 2]]) -> Vec<Placed> {
    let markers: Vec<Rect> = anchors
        .iter()
        .map(|anchor| Rect::around(anchor.at, MARKER_PX))
        .collect();
    let mut placed: Vec<Placed> = Vec::new();
    for anchor in anchors {
        let mut best: Option<(i32, Placed)> = None;
        for candidate in candidates(*anchor).filter(|rect| bounds.contains(rect)) {
            let found = with_leader(candidate, anchor.at);
            let cost = cost(&found, *anchor, &placed, &markers, lines);
            if best.as_ref().is_none_or(|(least, _)| cost < *least) {
                best = Some((cost, found));
            }
        }
        // A name wider than the chart is placed all the same: left out, its point had no name.
        let fallback = || with_leader(rect_at(*anchor, DIRECTIONS[0], 0), anchor.at);
        placed.push(best.map_or_else(fallback, |(_, found)| found));
    }
    placed
}

fn candidates(anchor: Anchor) -> impl Iterator<Item = Rect> {
    (0..RINGS).flat_map(move |ring| {
        DIRECTIONS
            .into_iter()
            .map(move |direction| rect_at(anchor, direction, ring * RING_PX))
    })
}

fn rect_at(Anchor { at, size }: Anchor, (dx, dy): (f64, f64), far_px: i32) -> Rect {
    // Beyond the first ring, round about the point rather than wide about a wide name.
    let out = |half: i32, part: f64| ((f64::from(half + MARGIN_PX + far_px)) * part).round() as i32;
    let middle = (at.0 + out(size.0 / 2, dx), at.1 + out(size.1 / 2, dy));
    Rect {
        left: middle.0 - size.0 / 2,
        top: middle.1 - size.1 / 2,
        right: middle.0 - size.0 / 2 + size.0,
        bottom: middle.1 - size.1 / 2 + size.1,
    }
}

fn distance_px(from: Px, to: Px) -> i32 {
    f64::from(from.0 - to.0)
        .hypot(f64::from(from.1 - to.1))
        .round() as i32
}

fn with_leader(rect: Rect, at: Px) -> Placed {
    let end = rect.nearest(at);
    let leader = (distance_px(at, end) > NEAR_PX).then_some([at, end]);
    Placed { rect, leader }
}

/// What a place costs: nothing is worse than to lie over another name or a marker.
fn cost(
    found: &Placed,
    anchor: Anchor,
    placed: &[Placed],
    markers: &[Rect],
    lines: &[[Px; 2]],
) -> i32 {
    let own_marker = Rect::around(anchor.at, MARKER_PX);
    let names = placed.iter().map(|other| &other.rect);
    let taken = names
        .clone()
        .chain(markers)
        .filter(|other| found.rect.overlaps(other));
    let leaders = placed.iter().filter_map(|other| other.leader.as_ref());
    let under = lines
        .iter()
        .chain(leaders)
        .filter(|line| found.rect.is_crossed_by(**line));
    let overrun = found.leader.map_or(0, |leader| {
        let in_the_way = names.chain(markers.iter().filter(|marker| **marker != own_marker));
        in_the_way
            .filter(|other| other.is_crossed_by(leader))
            .count()
    });
    let distance = distance_px(anchor.at, found.rect.nearest(anchor.at));
    let leader = if found.leader.is_some() { 10 } else { 0 };
    let counted = |count: usize, each: i32| i32::try_from(count).unwrap_or(1000).min(1000) * each;
    distance
        + leader
        + counted(under.count(), CROSSING)
        + counted(overrun, OVERRUN)
        + counted(taken.count(), 100_000)
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

    fn check(anchors: &[Anchor]) -> Vec<Placed> {
        let placed = place(anchors, BOUNDS, &[]);
        assert_eq!(placed.len(), anchors.len());
        for (index, one) in placed.iter().enumerate() {
            assert!(BOUNDS.contains(&one.rect), "{one:?}");
            for other in &placed[..index] {
                assert!(!one.rect.overlaps(&other.rect), "{one:?} {other:?}");
            }
            for anchor in anchors {
                assert!(
                    !one.rect.overlaps(&Rect::around(anchor.at, MARKER_PX)),
                    "{one:?}"
                );
            }
        }
        placed
    }

    #[test]
    fn a_name_alone_stands_right_of_its_point() {
        let anchor = Anchor {
            at: (500, 300),
            size: (80, 16),
        };
        let placed = check(&[anchor]);
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
        let anchor = Anchor {
            at: (500, 300),
            size: (80, 16),
        };
        let line = [(500, 300), (1000, 300)];
        let placed = place(&[anchor], BOUNDS, &[line]);
        assert!(!placed[0].rect.is_crossed_by(line), "{placed:?}");
    }
}
