//! The side quads that edges may have, whatever the light.

use crate::geometry::Casting;
use crate::methods::counter::Counter;
use crate::methods::{Casters, MethodError};
use std::ops::Range;

const CORNERS_OF_QUAD: u32 = 6;
const CORNERS_OF_CAP: u32 = 3;

/// The side quads of all casters, and the numbers of their corners and of those of caps: see face.wgsl.
pub(super) struct Quads {
    /// Of each its edge, and which of the edge's it is.
    pub(super) quads: Vec<[u32; 2]>,
    pub(super) first_open: u32,
    pub(super) first_front: u32,
    pub(super) first_back: u32,
    /// Of each caster those that suffice where triangles cast that face the light, and those that come on top where all do.
    light_facing: Vec<Range<u32>>,
    rest: Vec<Range<u32>>,
    open: Vec<Range<u32>>,
    /// The triangles of each caster.
    triangles: Vec<Range<u32>>,
}

impl Quads {
    /// Where the counter takes weights, an edge has one.
    ///
    /// # Errors
    /// When there are more corners than numbers.
    pub(super) fn new(casters: &Casters, counter: Counter) -> Result<Self, MethodError> {
        let (topology, triangles) = (casters.topology(), casters.edge_triangles());
        let most = |times: usize| match counter.takes_weights() {
            true => times.min(1) as u32,
            false => times as u32,
        };
        let most_of = |edge: u32| {
            let own = triangles.of(topology.edges[edge as usize]);
            let along = own.iter().filter(|own| own.is_along()).count();
            (most(along.max(own.len() - along)), most(own.len()))
        };
        let objects = casters.mesh.objects.iter().zip(&topology.object_edges);
        let of_casters = objects.filter(|(object, _)| object.casts_shadow);
        let of_casters: Vec<_> = of_casters.map(|(_, edges)| edges.clone()).collect();
        let mut quads = Vec::new();
        let mut part = |of_edge: &dyn Fn(u32) -> Range<u32>| {
            let of_caster = |edges: &Range<u32>| {
                let start = quads.len() as u32;
                for edge in edges.clone() {
                    quads.extend(of_edge(edge).map(|copy| [edge, copy]));
                }
                start..quads.len() as u32
            };
            of_casters.iter().map(of_caster).collect::<Vec<_>>()
        };
        let light_facing = part(&|edge| 0..most_of(edge).0);
        let rest = part(&|edge| most_of(edge).0..most_of(edge).1);
        let first_open = quads.len() as u32;
        let mut open = Vec::new();
        for caster in 0..of_casters.len() {
            let start = quads.len() as u32;
            for found in casters.open_edges().of(caster) {
                let copies = most(found.multiplicity.unsigned_abs() as usize);
                quads.extend((0..copies).map(|copy| [found.edge, copy]));
            }
            open.push(start..quads.len() as u32);
        }
        let caps = u64::from(CORNERS_OF_CAP) * casters.mesh.triangles.len() as u64;
        let sides = u64::from(CORNERS_OF_QUAD) * quads.len() as u64;
        if sides + 2 * caps > u64::from(u32::MAX) {
            let message = "the scene has more edges and triangles than it can number corners of";
            return Err(MethodError::Unavailable(message.to_owned()));
        }
        // A buffer cannot be empty.
        quads.resize(quads.len().max(1), [0; 2]);
        Ok(Self {
            quads,
            first_open,
            first_front: sides as u32,
            first_back: (sides + caps) as u32,
            light_facing,
            rest,
            open,
            triangles: casters.triangles(),
        })
    }

    /// The corners of a caster's side quads, of which those of some triangles cast.
    pub(super) fn sides(&self, caster: usize, casting: Casting) -> [Range<u32>; 2] {
        let (first, rest) = (&self.light_facing[caster], &self.rest[caster]);
        match casting {
            Casting::All => [first, rest].map(of_quads),
            Casting::LightFacing | Casting::EachSide => [of_quads(first), 0..0],
        }
    }

    /// Those of its open edges' quads.
    pub(super) fn open(&self, caster: usize) -> Range<u32> {
        of_quads(&self.open[caster])
    }

    /// Those of its front caps.
    pub(super) fn fronts(&self, caster: usize) -> Range<u32> {
        self.caps(caster, self.first_front)
    }

    /// Those of its back caps.
    pub(super) fn backs(&self, caster: usize) -> Range<u32> {
        self.caps(caster, self.first_back)
    }

    fn caps(&self, caster: usize, first: u32) -> Range<u32> {
        let Range { start, end } = self.triangles[caster];
        first + CORNERS_OF_CAP * start..first + CORNERS_OF_CAP * end
    }
}

/// Joins neighbours, and leaves out what is empty.
pub(super) fn joined(ranges: impl IntoIterator<Item = Range<u32>>) -> Vec<Range<u32>> {
    let mut joined: Vec<Range<u32>> = Vec::new();
    for range in ranges.into_iter().filter(|range| !range.is_empty()) {
        match joined.last_mut() {
            Some(last) if last.end == range.start => last.end = range.end,
            _ => joined.push(range),
        }
    }
    joined
}

fn of_quads(quads: &Range<u32>) -> Range<u32> {
    CORNERS_OF_QUAD * quads.start..CORNERS_OF_QUAD * quads.end
}
