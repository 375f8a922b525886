//! Sixteen shadow rays that are held against boxes and triangles together.

use super::blocks::{Blocker, OF_POINT};
use super::picture::Picture;
use super::sight::nearest_on_edges;
use super::tree::Node;
use super::triangle::RayTriangle;
use super::vectors::{LANES, Vectors};
use crate::scene::Mesh;
use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x16};
use glam::{Vec3, Vec4};

/// A pixel that shows a triangle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pixel {
    /// Column.
    pub(super) x: u16,
    /// Row, from the first of a band.
    pub(super) row: u16,
    /// Which triangle of the scene.
    pub(super) triangle: u32,
}

/// Shadow rays of up to sixteen pixels. A ray leaves its point at 0.
#[derive(Clone, Copy)]
pub(super) struct Packet<S: Simd> {
    /// The points, each as in [`SurfacePoint`](super::SurfacePoint).
    corners: Vectors<S>,
    ways: Vectors<S>,
    uncertainty: f32x16<S>,
    /// One by their directions.
    inverse: Vectors<S>,
    /// The points, times these.
    start: Vectors<S>,
    /// Where they end.
    end: f32x16<S>,
    /// One bit for each that is there.
    pub(super) lanes: u32,
}

impl<S: Simd> Packet<S> {
    /// From what these pixels show; their rows are counted from `first_row`. Without pixels, none of its rays is there.
    #[inline(always)]
    pub(super) fn new(
        simd: S,
        picture: &Picture,
        mesh: &Mesh,
        pixels: &[Pixel],
        first_row: usize,
    ) -> Self {
        let (corners, ways, uncertainty) = points_seen(simd, picture, mesh, pixels, first_row);
        let points = corners.add(ways);
        let light = picture.light;
        let towards =
            Vectors::splat(simd, light.truncate()).plus(f32x16::splat(simd, -light.w), points);
        let inverse = towards.inverse(simd);
        Self {
            corners,
            ways,
            uncertainty,
            inverse,
            start: points.times(inverse),
            end: f32x16::splat(simd, if light.w == 0.0 { f32::MAX } else { 1.0 }),
            lanes: (1 << pixels.len()) - 1,
        }
    }

    /// The box around the points.
    #[inline(always)]
    pub(super) fn range(&self) -> (Vec3, Vec3) {
        self.corners.add(self.ways).range()
    }

    /// Which rays meet a box of a node, also of those that are not there.
    #[inline(always)]
    pub(super) fn meet(&self, simd: S, node: &Node, slot: usize) -> u32 {
        let (inverse, start) = (self.inverse, self.start);
        let (low, high) = (&node.low, &node.high);
        let (x_in, x_out) = slab(simd, low[0][slot], high[0][slot], inverse.x, start.x);
        let (y_in, y_out) = slab(simd, low[1][slot], high[1][slot], inverse.y, start.y);
        let (z_in, z_out) = slab(simd, low[2][slot], high[2][slot], inverse.z, start.z);
        let enter = x_in.max(y_in).max(z_in.max(f32x16::splat(simd, 0.0)));
        let leave = x_out.min(y_out).min(z_out.min(self.end));
        enter.simd_le(leave).to_bitmask() as u32
    }

    /// The twin of [`Blocker::blocks`] for all rays, also those that are not there.
    #[inline(always)]
    pub(super) fn blocked_by(&self, simd: S, triangle: &RayTriangle, blocker: &Blocker) -> u32 {
        let from_a = self.from(simd, blocker.a);
        let zero = f32x16::splat(simd, 0.0);
        let within = from_a.along(simd, blocker.ab).simd_le(zero)
            & from_a.along(simd, blocker.ac).simd_le(zero);
        // Mostly none is.
        if within.all_false() {
            return 0;
        }
        let from_b = self.from(simd, blocker.b);
        let within = within & from_b.along(simd, blocker.bc()).simd_le(zero);
        let contact = self.uncertainty * triangle.double_area + triangle.contact;
        let beyond = from_a.along(simd, blocker.own()).simd_lt(-contact);
        (within & beyond).to_bitmask() as u32
    }

    /// The vectors to the points from one that has no rounding.
    #[inline(always)]
    fn from(&self, simd: S, point: Vec3) -> Vectors<S> {
        self.corners
            .minus(Vectors::splat(simd, point))
            .add(self.ways)
    }
}

/// Where rays enter and leave the space between two planes across an axis.
#[inline(always)]
fn slab<S: Simd>(
    simd: S,
    low: f32,
    high: f32,
    inverse: f32x16<S>,
    start: f32x16<S>,
) -> (f32x16<S>, f32x16<S>) {
    let low = f32x16::splat(simd, low).mul_sub(inverse, start);
    let high = f32x16::splat(simd, high).mul_sub(inverse, start);
    (low.min(high), low.max(high))
}

/// The points that are seen at the centres of pixels: where the lines of sight meet the pixels' triangles, or come nearest
/// to those that they miss. As corners, ways from there, and what rounding may have moved them by.
#[inline(always)]
fn points_seen<S: Simd>(
    simd: S,
    picture: &Picture,
    mesh: &Mesh,
    pixels: &[Pixel],
    first_row: usize,
) -> (Vectors<S>, Vectors<S>, f32x16<S>) {
    let mut place = [[0.0; LANES]; 2];
    let mut corners = [[[0.0; LANES]; 3]; 3];
    for (lane, pixel) in pixels.iter().enumerate() {
        place[0][lane] = f32::from(pixel.x) + 0.5;
        place[1][lane] = (first_row + usize::from(pixel.row)) as f32 + 0.5;
        let vertices = mesh.triangles[pixel.triangle as usize];
        for (corner, vertex) in corners.iter_mut().zip(vertices) {
            let position = mesh.positions[vertex as usize];
            corner[0][lane] = position.x;
            corner[1][lane] = position.y;
            corner[2][lane] = position.z;
        }
    }
    // What is not there does as the first.
    for lane in pixels.len()..LANES {
        for of in place.iter_mut().chain(corners.iter_mut().flatten()) {
            of[lane] = of[0];
        }
    }
    let [[a_x, a_y, a_z], [b_x, b_y, b_z], [c_x, c_y, c_z]] = &corners;
    let a = Vectors::new(simd, [a_x, a_y, a_z]);
    let b = Vectors::new(simd, [b_x, b_y, b_z]);
    let c = Vectors::new(simd, [c_x, c_y, c_z]);
    let sight = sight(simd, picture, &place);
    let eye = Vectors::splat(simd, picture.eye);
    let of_a = sight_volume(b, c, eye, sight);
    let of_b = sight_volume(c, a, eye, sight);
    let of_c = sight_volume(a, b, eye, sight);
    let (zero, one) = (f32x16::splat(simd, 0.0), f32x16::splat(simd, 1.0));
    let side = one.copysign(of_a + of_b + of_c);
    let (of_a, of_b, of_c) = (side * of_a, side * of_b, side * of_c);
    let share = one / (of_a + of_b + of_c).max(f32x16::splat(simd, f32::MIN_POSITIVE));
    let (mut part_b, mut part_c) = (of_b * share, of_c * share);
    let mut missed = of_a.min(of_b).min(of_c).simd_lt(zero).to_bitmask();
    while missed != 0 {
        let lane = missed.trailing_zeros() as usize;
        missed &= missed - 1;
        let corners = [a.lane(lane), b.lane(lane), c.lane(lane)];
        let parts = nearest_on_edges(corners, picture.eye, sight.lane(lane));
        [part_b[lane], part_c[lane]] = parts;
    }
    let (to_b, to_c) = (b.minus(a), c.minus(a));
    let ways = to_b.times_each(part_b).plus(part_c, to_c);
    let uncertainty = to_b.dot(to_b).max(to_c.dot(to_c)).sqrt() * OF_POINT;
    (a, ways, uncertainty)
}

/// From the eye through places in the picture, columns and rows.
#[inline(always)]
fn sight<S: Simd>(simd: S, picture: &Picture, place: &[[f32; LANES]; 2]) -> Vectors<S> {
    let [width, height] = picture.size_px.map(|px| px as f32);
    let matrix = picture.clip_to_eye_ray;
    let [right, up, ahead] = [matrix.x_axis, matrix.y_axis, matrix.w_axis].map(Vec4::truncate);
    let x = f32x16::from_slice(simd, &place[0]) * (2.0 / width) - 1.0;
    let y = 1.0 - f32x16::from_slice(simd, &place[1]) * (2.0 / height);
    Vectors::splat(simd, ahead)
        .plus(x, Vectors::splat(simd, right))
        .plus(y, Vectors::splat(simd, up))
}

/// Six times the volumes of the tetrahedra of an edge, the eye, and a piece of the line of sight.
#[inline(always)]
fn sight_volume<S: Simd>(
    p: Vectors<S>,
    q: Vectors<S>,
    eye: Vectors<S>,
    sight: Vectors<S>,
) -> f32x16<S> {
    q.minus(p).cross(eye.minus(p)).dot(sight)
}
