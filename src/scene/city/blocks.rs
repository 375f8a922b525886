//! What stands on a block.

use super::shapes::{STOREY_M, courtyard, house, polygon, rectangle, tower};
use super::trees::tree;
use crate::scene::part::Part;
use glam::Vec2;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Side of a block in metres.
pub(super) const BLOCK_M: f32 = 60.0;

/// Between a block's border and its buildings, and between neighbours, in metres.
const PAVEMENT_M: f32 = 2.0;
const GAP_M: f32 = 0.4;

/// Triangles of a tree in a street or yard.
const TREE_TRIANGLES: u32 = 150;

/// A block and its random numbers.
pub(super) struct Block {
    middle: Vec2,
    /// 1 in the middle of a city, 0 far from there.
    centrality: f32,
    random: ChaCha8Rng,
}

impl Block {
    /// The block of this number along x and z, with its middle.
    pub(super) fn new(seed: u64, middle: [f32; 2], number: [i32; 2]) -> Self {
        let mut key = [0; 32];
        key[..8].copy_from_slice(&seed.to_le_bytes());
        key[8..12].copy_from_slice(&number[0].to_le_bytes());
        key[12..16].copy_from_slice(&number[1].to_le_bytes());
        let middle = Vec2::from(middle);
        Self {
            middle,
            centrality: 1.0 / (1.0 + (middle.length() / 600.0).powi(2)),
            random: ChaCha8Rng::from_seed(key),
        }
    }

    /// Its buildings and trees.
    pub(super) fn parts(mut self, ledges: u32) -> Vec<Part> {
        match self.random.random_range(0..100) {
            0..40 => self.rows(ledges),
            40..65 => self.court(ledges),
            65..85 => self.towers(ledges),
            _ => self.park(),
        }
    }

    /// A square with a large tree in its middle.
    pub(super) fn square(mut self, triangles: u32) -> Vec<Part> {
        vec![tree(&mut self.random, self.middle, 35.0, triangles)]
    }

    fn height(&mut self, storeys: std::ops::Range<u32>) -> f32 {
        STOREY_M * self.random.random_range(storeys) as f32
    }

    /// Two rows of houses back to back with yards between them.
    fn rows(&mut self, ledges: u32) -> Vec<Part> {
        let mut parts = Vec::new();
        let long = BLOCK_M - 2.0 * PAVEMENT_M;
        for side in [-1.0, 1.0] {
            let count = self.random.random_range(3..=6);
            let width = long / count as f32;
            for number in 0..count {
                let depth = self.random.random_range(11.0..16.0f32);
                let along = (number as f32 + 0.5) * width - long / 2.0;
                let across = side * (BLOCK_M / 2.0 - PAVEMENT_M - depth / 2.0);
                let outline = rectangle(
                    self.middle + Vec2::new(along, across),
                    Vec2::new(width - GAP_M, depth),
                );
                let height = self.height(3..7);
                let roof = self.random.random_range(2.5..5.0);
                parts.push(house("house", &outline, height, roof, ledges));
            }
        }
        let trees = self.random.random_range(0..3);
        parts.extend((0..trees).map(|_| self.tree_within(8.0)));
        parts
    }

    fn court(&mut self, ledges: u32) -> Vec<Part> {
        let outer = rectangle(self.middle, Vec2::splat(BLOCK_M - 2.0 * PAVEMENT_M));
        let yard = self.random.random_range(22.0..34.0f32);
        let inner = rectangle(self.middle, Vec2::splat(yard));
        let height = self.height(4..8);
        let mut parts = vec![courtyard("courtyard", [&outer, &inner], height, ledges)];
        let trees = self.random.random_range(1..4);
        parts.extend((0..trees).map(|_| self.tree_within(yard / 2.0 - 5.0)));
        parts
    }

    fn towers(&mut self, ledges: u32) -> Vec<Part> {
        let quarter = BLOCK_M / 4.0;
        let places = [(-1.0, -1.0), (1.0, 1.0), (-1.0, 1.0), (1.0, -1.0)];
        let count = self.random.random_range(1..=4);
        let place = |&(x, z): &(f32, f32)| self.middle + quarter * Vec2::new(x, z);
        let middles: Vec<Vec2> = match count {
            1 => vec![self.middle],
            _ => places[..count].iter().map(place).collect(),
        };
        let radius = if count == 1 {
            24.0
        } else {
            quarter - PAVEMENT_M
        };
        let tall = 6 + (24.0 * self.centrality) as u32;
        let mut parts = Vec::new();
        for middle in middles {
            let sides = self.random.random_range(4..13);
            let turn = self.random.random_range(0.0..1.0f32);
            let radius = radius * self.random.random_range(0.7..1.0f32);
            let first = self.height(5..tall);
            let second = first + self.height(1..tall / 2);
            let part = self.random.random_range(0.5..0.9f32);
            let tiers = [[first, 1.0], [second, part]];
            let outline = polygon(middle, radius, sides, turn);
            parts.push(tower("tower", &outline, &tiers, ledges));
        }
        parts
    }

    fn park(&mut self) -> Vec<Part> {
        let trees = self.random.random_range(6..15);
        let reach = BLOCK_M / 2.0 - 5.0;
        (0..trees).map(|_| self.tree_within(reach)).collect()
    }

    /// A tree no farther from the middle than so, along x and along z.
    fn tree_within(&mut self, reach: f32) -> Part {
        let mut along = || self.random.random_range(-reach..reach);
        let foot = self.middle + Vec2::new(along(), along());
        let height = self.random.random_range(7.0..13.0);
        tree(&mut self.random, foot, height, TREE_TRIANGLES)
    }
}
