//! Shadow rays of neighbouring pixels, which go through the tree together.
//!
//! All of them end at the light, so a box that encloses where they begin tells of most boxes that none of them meets
//! (ranged traversal, Wald, Boulos and Shirley 2007; with intervals instead of a frustum, Boulos, Wald and Shirley
//! 2006). Of the others, the first packet with a ray that does is found, and what is below is not asked for those before.

use super::blocks::Blocker;
use super::packet::{Packet, Pixel};
use super::picture::Picture;
use super::tree::{Node, RayTree};
use super::vectors::{LANES, LARGEST_INVERSE};
use crate::scene::Mesh;
use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x4};
use glam::Vec4;
use std::ops::Range;

/// Packets of a beam.
const PACKETS: usize = 4;

/// Rays of a beam.
pub(super) const RAYS: usize = PACKETS * LANES;

/// Up to sixty-four shadow rays.
pub(super) struct Beam<S: Simd> {
    packets: [Packet<S>; PACKETS],
    axes: [Axis; 3],
    end: f32,
    light: Vec4,
}

/// Of each packet, its rays that are not blocked so far.
type Open = [u32; PACKETS];

/// What waits to be looked at: a node, and the first packet with a ray that meets it.
pub(super) type Waiting = (u32, u32);

impl<S: Simd> Beam<S> {
    /// From what these pixels show, one at least; their rows are counted from `first_row`.
    #[inline(always)]
    pub(super) fn new(
        simd: S,
        picture: &Picture,
        mesh: &Mesh,
        pixels: &[Pixel],
        first_row: usize,
    ) -> Self {
        let part = |packet: usize| {
            let begin = (packet * LANES).min(pixels.len());
            &pixels[begin..(begin + LANES).min(pixels.len())]
        };
        let mut packets = [Packet::new(simd, picture, mesh, part(0), first_row); PACKETS];
        let (mut low, mut high) = packets[0].range();
        for (number, packet) in packets.iter_mut().enumerate().skip(1) {
            packet.lanes = 0;
            let pixels = part(number);
            if !pixels.is_empty() {
                *packet = Packet::new(simd, picture, mesh, pixels, first_row);
                let range = packet.range();
                (low, high) = (low.min(range.0), high.max(range.1));
            }
        }
        let light = picture.light;
        let axis = |axis: usize| Axis::new(low[axis], high[axis], light[axis], light.w);
        Self {
            packets,
            axes: [axis(0), axis(1), axis(2)],
            end: if light.w == 0.0 { f32::MAX } else { 1.0 },
            light,
        }
    }

    /// Which of its rays are blocked, one bit each. `waiting` has room for what the tree needs; `last_blocker` is the
    /// triangle that blocked a ray before.
    #[inline(always)]
    pub(super) fn blocked(
        &self,
        simd: S,
        tree: &RayTree,
        waiting: &mut [Waiting],
        last_blocker: &mut Option<usize>,
    ) -> u64 {
        let mut open = self.packets.map(|packet| packet.lanes);
        if let Some(triangle) = *last_blocker {
            self.block(simd, tree, triangle, open, &mut open);
        }
        let mut count = 1;
        waiting[0] = (0, 0);
        while count > 0 && open != [0; PACKETS] {
            count -= 1;
            let (node, first) = waiting[count];
            let node = &tree.nodes[node as usize];
            let mut meets = self.may_meet(simd, node);
            while meets != 0 {
                let slot = meets.trailing_zeros() as usize;
                meets &= meets - 1;
                let child = node.children[slot];
                if let Some(triangles) = Node::triangles(child) {
                    self.block_leaf(simd, tree, (node, slot), triangles, &mut open, last_blocker);
                } else if child != 0
                    && let Some(first) = self.first_met(simd, (node, slot), first, &open)
                {
                    waiting[count] = (child, first);
                    count += 1;
                }
            }
        }
        let blocked = |packet: usize| u64::from(self.packets[packet].lanes & !open[packet]);
        (0..PACKETS).fold(0, |all, packet| all | blocked(packet) << (packet * LANES))
    }

    /// The first packet from `first` on with a ray that meets a box.
    #[inline(always)]
    fn first_met(
        &self,
        simd: S,
        (node, slot): (&Node, usize),
        first: u32,
        open: &Open,
    ) -> Option<u32> {
        for packet in first..PACKETS as u32 {
            let open = open[packet as usize];
            if open != 0 && self.packets[packet as usize].meet(simd, node, slot) & open != 0 {
                return Some(packet);
            }
        }
        None
    }

    /// Closes the rays that meet a box and are blocked by what is in it.
    #[inline(always)]
    fn block_leaf(
        &self,
        simd: S,
        tree: &RayTree,
        (node, slot): (&Node, usize),
        triangles: Range<usize>,
        open: &mut Open,
        last_blocker: &mut Option<usize>,
    ) {
        let mut meet = [0; PACKETS];
        for packet in 0..PACKETS {
            if open[packet] != 0 {
                meet[packet] = self.packets[packet].meet(simd, node, slot) & open[packet];
            }
        }
        if meet == [0; PACKETS] {
            return;
        }
        for triangle in triangles {
            if self.block(simd, tree, triangle, meet, open) {
                *last_blocker = Some(triangle);
            }
        }
    }

    /// Closes those of the rays `of` that a triangle blocks; gives whether there was one.
    #[inline(always)]
    fn block(&self, simd: S, tree: &RayTree, triangle: usize, of: Open, open: &mut Open) -> bool {
        let triangle = &tree.triangles[triangle];
        let Some(blocker) = Blocker::new(triangle, self.light) else {
            return false;
        };
        let mut any = 0;
        for packet in 0..PACKETS {
            if of[packet] & open[packet] != 0 {
                let blocked =
                    self.packets[packet].blocked_by(simd, triangle, &blocker) & open[packet];
                open[packet] &= !blocked;
                any |= blocked;
            }
        }
        any != 0
    }

    /// The boxes of a node that some ray may meet, one bit each.
    #[inline(always)]
    fn may_meet(&self, simd: S, node: &Node) -> u64 {
        let zero = f32x4::splat(simd, 0.0);
        let end = f32x4::splat(simd, self.end);
        let (x_in, x_out) = self.axes[0].crossed(simd, &node.low[0], &node.high[0]);
        let (y_in, y_out) = self.axes[1].crossed(simd, &node.low[1], &node.high[1]);
        let (z_in, z_out) = self.axes[2].crossed(simd, &node.low[2], &node.high[2]);
        let enter = x_in.max(y_in).max(z_in.max(zero));
        let leave = x_out.min(y_out).min(z_out.min(end));
        enter.simd_le(leave).to_bitmask()
    }
}

/// Where rays begin and go along an axis.
#[derive(Clone, Copy)]
struct Axis {
    /// From where to where they begin.
    low: f32,
    high: f32,
    /// The smallest and the largest of one by their directions; of different signs if these are.
    inverse: [f32; 2],
}

impl Axis {
    #[inline(always)]
    fn new(low: f32, high: f32, light: f32, light_w: f32) -> Self {
        let towards = [light - high * light_w, light - low * light_w];
        let inverse = towards.map(|x| (1.0 / x).clamp(-LARGEST_INVERSE, LARGEST_INVERSE));
        let is_one_way = towards[0] > 0.0 || towards[1] < 0.0;
        Self {
            low,
            high,
            inverse: if is_one_way {
                [inverse[1], inverse[0]]
            } else {
                [-1.0, 1.0]
            },
        }
    }

    /// Where the first ray may enter the spaces between two planes across this axis, and the last one leave.
    #[inline(always)]
    fn crossed<S: Simd>(&self, simd: S, low: &[f32; 4], high: &[f32; 4]) -> (f32x4<S>, f32x4<S>) {
        let low = f32x4::from_slice(simd, low) - self.high;
        let high = f32x4::from_slice(simd, high) - self.low;
        let [least, most] = self.inverse;
        let far = f32x4::splat(simd, f32::MAX);
        if least > 0.0 {
            (
                (low * least).min(low * most),
                (high * least).max(high * most),
            )
        } else if most < 0.0 {
            (
                (high * least).min(high * most),
                (low * least).max(low * most),
            )
        } else {
            // They go either way, or across: nothing is known.
            (-far, far)
        }
    }
}
