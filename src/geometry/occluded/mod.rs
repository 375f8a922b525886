//! Triangles that the light does not reach at all: their shadow volumes lie in those of others.
//!
//! Whatever is behind a triangle that is wholly in shadow is in shadow without it, so it need not cast. Of all that lie
//! on a ray from the light the first is never left out. (Lloyd et al. 2004 leave out casters in the shadow of
//! others as a picture from the light shows them, to its resolution; here each triangle is proven, and one by one rather than
//! by objects.)
//!
//! The proof for a triangle T: let its cone be all points between it and the light. From a triangle before T, walk over all
//! edges that meet the cone. If each of them has two triangles, wound consistently, and all that is met is before T's
//! plane where it is in the cone, then what is met is a surface without a border there, and it goes around all rays from T to
//! the light the same number of times, counted by the signs of its windings. One ray counts it; if that is not 0, no ray
//! passes.

mod cone;
mod proof;

use super::disjoint_sets::DisjointSets;
use super::open_edges::winding;
use super::silhouette::Facings;
use super::{Bounds, Edge, EdgeTriangles, Topology};
use crate::scene::Mesh;
use glam::{DVec3, Vec4};
use proof::{Prover, Walks};
use rayon::prelude::*;
use std::ops::Range;

/// Fewer triangles are asked on one core: another takes a while to wake up.
const WORTH_A_CORE: usize = 256;

/// For each triangle of a mesh whether it is to be left out, because all of it is proven to be behind others, seen from the
/// light, and sides of shadow volumes become smaller. `are_closed` says of each object that casts whether it is closed
/// and wound consistently.
pub fn left_out(
    light: Vec4,
    of: (&Mesh, &Topology, &EdgeTriangles),
    are_closed: &[bool],
) -> Vec<bool> {
    let sides = Sides::new(light, of, are_closed);
    let mut occluded = occluded(light, of, sides.at_sides());
    sides.give_back(&mut occluded);
    occluded
}

/// Which triangles are proven to be occluded, of those asked: `first`, and further their neighbours as long as these are.
fn occluded(light: Vec4, of: (&Mesh, &Topology, &EdgeTriangles), first: Vec<u32>) -> Vec<bool> {
    let mesh = of.0;
    let prover = Prover::new(light, of);
    let mut is_asked = vec![false; mesh.triangles.len()];
    let mut is_occluded = is_asked.clone();
    let mut asked = Vec::new();
    let mut ask = |triangle: u32, asked: &mut Vec<u32>| {
        if !std::mem::replace(&mut is_asked[triangle as usize], true) {
            asked.push(triangle);
        }
    };
    for triangle in first {
        ask(triangle, &mut asked);
    }
    let mut walks = Walks::default();
    while !asked.is_empty() {
        let found: Vec<u32> = if asked.len() < WORTH_A_CORE {
            asked.retain(|triangle| prover.is_occluded(*triangle, &mut walks));
            std::mem::take(&mut asked)
        } else {
            let asked = std::mem::take(&mut asked);
            let tasks = asked.par_chunks(asked.len().div_ceil(4 * rayon::current_num_threads()));
            let ask = |walks: &mut Walks, task: &[u32]| -> Vec<u32> {
                let own = task.iter().copied();
                own.filter(|triangle| prover.is_occluded(*triangle, walks))
                    .collect()
            };
            tasks.map_init(Walks::default, ask).flatten().collect()
        };
        for triangle in found {
            is_occluded[triangle as usize] = true;
            for neighbour in prover.neighbours_of(triangle) {
                ask(neighbour, &mut asked);
            }
        }
    }
    is_occluded
}

/// What sides the shadow volumes have.
struct Sides<'a> {
    light: Vec4,
    mesh: &'a Mesh,
    topology: &'a Topology,
    triangles: &'a EdgeTriangles,
    are_closed: &'a [bool],
    /// Of all triangles.
    facings: Vec<i8>,
    /// Around the scene.
    bounds: Bounds,
}

impl<'a> Sides<'a> {
    fn new(
        light: Vec4,
        (mesh, topology, triangles): (&'a Mesh, &'a Topology, &'a EdgeTriangles),
        are_closed: &'a [bool],
    ) -> Self {
        let mut facings = vec![0; mesh.triangles.len()];
        Facings::new(mesh).find(mesh, light, &mut facings);
        Self {
            light,
            mesh,
            topology,
            triangles,
            are_closed,
            facings,
            bounds: Bounds::of(&mesh.positions),
        }
    }

    /// The edges of each object that casts, and whether it is closed.
    fn casters(&self) -> impl Iterator<Item = (Range<usize>, bool)> {
        let objects = self.mesh.objects.iter().zip(&self.topology.object_edges);
        let casters = objects.filter(|(object, _)| object.casts_shadow);
        let edges = casters.map(|(_, edges)| edges.start as usize..edges.end as usize);
        edges.zip(self.are_closed.iter().copied())
    }

    /// How many side quads an edge has if these triangles cast: as [`super::Casting::LightFacing`] or
    /// [`super::Casting::EachSide`] has them.
    fn quads(&self, edge: Edge, is_closed: bool, casts: impl Fn(usize) -> bool) -> u32 {
        let (mut of_light_facing, mut open) = (0, 0);
        let own = self.triangles.of(edge).iter();
        for own in own.filter(|own| casts(own.triangle())) {
            let winding = winding(*own);
            open += winding;
            if self.facings[own.triangle()] == 1 {
                of_light_facing += winding;
            }
        }
        let open = if is_closed { 0 } else { open };
        i32::unsigned_abs(of_light_facing) + i32::unsigned_abs(open)
    }

    /// The triangles of edges with side quads: where one of them is not left out, nothing is gained.
    fn at_sides(&self) -> Vec<u32> {
        let of_caster = |(edges, is_closed): (Range<usize>, bool)| {
            let edges = self.topology.edges[edges].iter();
            edges.filter(move |edge| self.quads(**edge, is_closed, |_| true) != 0)
        };
        let edges = self.casters().flat_map(of_caster);
        let triangles = edges.flat_map(|edge| self.triangles.of(*edge));
        triangles.map(|own| own.triangle() as u32).collect()
    }

    /// Where triangles are left out, the volumes of their neighbours end. Of each connected part of them, gives those
    /// back at whose border sides would be larger than those that go with them.
    fn give_back(&self, left_out: &mut [bool]) {
        let mut parts = DisjointSets::new(left_out.len() as u32);
        let of_edge = |edge: Edge, left_out: &[bool]| {
            let own = self.triangles.of(edge).iter().map(|own| own.triangle());
            let mut own = own.filter(|own| left_out[*own]);
            Some((own.next()? as u32, own.next().map(|other| other as u32)))
        };
        for edge in &self.topology.edges {
            if let Some((one, Some(other))) = of_edge(*edge, left_out) {
                parts.join(one, other);
            }
        }
        let mut gains = vec![0.0; left_out.len()];
        for (edges, is_closed) in self.casters() {
            for edge in &self.topology.edges[edges] {
                let Some((one, _)) = of_edge(*edge, left_out) else {
                    continue;
                };
                let before = self.quads(*edge, is_closed, |_| true);
                let after = self.quads(*edge, is_closed, |triangle| !left_out[triangle]);
                let gain = (f64::from(before) - f64::from(after)) * self.quad_area(*edge);
                gains[parts.smallest(one) as usize] += gain;
            }
        }
        for (triangle, is_left_out) in (0..).zip(left_out) {
            *is_left_out &= gains[parts.smallest(triangle) as usize] > 0.0;
        }
    }

    /// The area of a side quad from an edge to where it leaves the box around the scene.
    fn quad_area(&self, edge: Edge) -> f64 {
        let [a, b] = [edge.a, edge.b].map(|vertex| self.mesh.positions[vertex as usize].as_dvec3());
        let light = self.light.as_dvec4();
        let from_light = |p: DVec3| p * light.w - light.truncate();
        let middle = (a + b) / 2.0;
        let away = from_light(middle).normalize_or(DVec3::NEG_Y);
        let side = DVec3::select(away.cmpgt(DVec3::ZERO), self.bounds.high, self.bounds.low);
        let exits = (side - middle) / away;
        let is_along = away.abs().cmpgt(DVec3::splat(1e-12));
        let reach = DVec3::select(is_along, exits, DVec3::INFINITY).min_element();
        let width = (b - a).cross(away).length();
        if light.w == 0.0 {
            return width * reach;
        }
        // It gets wider with the distance from the light.
        let distance = from_light(middle).length().max(f64::MIN_POSITIVE);
        width * reach * (1.0 + reach / (2.0 * distance))
    }
}

#[cfg(test)]
mod tests;
