//! Which side of each triangle of a mesh the light is on.

use super::lanes::{LANES, Lanes};
use crate::geometry::vertex_less;
use crate::scene::mesh::Mesh;
use glam::{Vec3, Vec4};
use rayon::prelude::*;

/// Triangles of one task.
const TRIANGLES_PER_TASK: usize = 4096;

/// Finds the facings of all triangles of a mesh, see [`facing`](fn@crate::geometry::facing): bit for bit its answers.
/// What of them does not depend on the light is found beforehand, and they are computed some at a time.
pub struct Facings {
    /// Vertices of each triangle in the vertex order.
    sorted: Vec<[u32; 3]>,
    /// 1 if that is the triangle's own winding, -1 if it is the other one, 0 if two vertices are equal.
    parity: Vec<i8>,
}

impl Facings {
    /// Sorts the vertices of all triangles.
    pub fn new(mesh: &Mesh) -> Self {
        let of_triangle = |&triangle: &[u32; 3]| sorted(mesh, triangle);
        let (sorted, parity) = mesh.triangles.par_iter().map(of_triangle).unzip();
        Self { sorted, parity }
    }

    /// Writes the facings for a light to `facings`, as many as there are triangles.
    pub fn find(&self, mesh: &Mesh, light: Vec4, facings: &mut [i8]) {
        let tasks = facings
            .par_chunks_mut(TRIANGLES_PER_TASK)
            .zip(self.sorted.par_chunks(TRIANGLES_PER_TASK))
            .zip(self.parity.par_chunks(TRIANGLES_PER_TASK));
        tasks.for_each(|((facings, sorted), parity)| {
            let groups = facings
                .chunks_mut(LANES)
                .zip(sorted.chunks(LANES))
                .zip(parity.chunks(LANES));
            for ((facings, sorted), parity) in groups {
                let sides = sides(mesh, sorted, light);
                for ((facing, side), parity) in facings.iter_mut().zip(sides).zip(parity) {
                    *facing = side * parity;
                }
            }
        });
    }
}

fn sorted(mesh: &Mesh, triangle: [u32; 3]) -> ([u32; 3], i8) {
    let at = |vertex: u32| mesh.positions[vertex as usize];
    let ([mut a, mut b, mut c], mut parity) = (triangle, 1);
    let mut order = |one: &mut u32, other: &mut u32| {
        if vertex_less(at(*other), at(*one)) {
            std::mem::swap(one, other);
            parity = -parity;
        }
    };
    order(&mut a, &mut b);
    order(&mut b, &mut c);
    order(&mut a, &mut b);
    if at(a) == at(b) || at(b) == at(c) {
        parity = 0;
    }
    ([a, b, c], parity)
}

/// The facings of up to eight triangles whose vertices are in the vertex order: on which side of the light plane through
/// the reference edge the middle vertex lies. Operation for operation as `light_plane_side` has it.
fn sides(mesh: &Mesh, sorted: &[[u32; 3]], light: Vec4) -> [i8; LANES] {
    let corner = |number: usize| {
        let mut xyz = [[0.0; LANES]; 3];
        for (lane, triangle) in sorted.iter().enumerate() {
            let Vec3 { x, y, z } = mesh.positions[triangle[number] as usize];
            (xyz[0][lane], xyz[1][lane], xyz[2][lane]) = (x, y, z);
        }
        xyz.map(Lanes::from_array)
    };
    let (a, b, c) = (corner(0), corner(1), corner(2));
    let minus = |p: [Lanes; 3], q: [Lanes; 3]| [p[0] - q[0], p[1] - q[1], p[2] - q[2]];
    let light_at = light.truncate().to_array().map(Lanes::splat);
    let (x, y, e) = (
        minus(c, a),
        minus(light_at, a.map(|axis| axis * light.w)),
        minus(b, a),
    );
    let n = [
        x[1] * y[2] - x[2] * y[1],
        x[2] * y[0] - x[0] * y[2],
        x[0] * y[1] - x[1] * y[0],
    ];
    let d = n[0] * e[0] + n[1] * e[1] + n[2] * e[2];
    let zero = Lanes::default();
    let (before, behind) = (d.above(zero), (-d).above(zero));
    std::array::from_fn(|lane| (before >> lane & 1) as i8 - (behind >> lane & 1) as i8)
}
