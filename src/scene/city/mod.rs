//! A generated city: blocks of houses, courtyards, towers and parks between streets.
//!
//! Blocks follow each other in a spiral about the crossing at the origin, each drawn by random numbers of its own. So a
//! larger city is a smaller one with more around it, and a walk through the middle of one is a walk through all.

mod blocks;
mod shapes;
mod trees;

use super::mesh::Mesh;
use super::part::Part;
use crate::memory::{self, NotEnough};
use blocks::{BLOCK_M, Block};
use glam::Vec3;

/// From the middle of a street to the next, in metres: a block and a street.
const PITCH_M: f32 = BLOCK_M + 14.0;

/// How far the ground goes on beyond the last block, in metres.
const OUTSKIRTS_M: f32 = 150.0;

/// More are no city that any device draws an object at a time.
const MOST_OBJECTS: u32 = 1_000_000;
const MOST_LEDGES: u32 = 16;
const MOST_TREE_TRIANGLES: u32 = 10_000_000;

/// About the most that an object without its ledges and each ledge of a storey take, in bytes.
const OBJECT_BYTES: u64 = 60_000;

/// A city of so many objects, in metres, y up, above a ground at y = 0 that only receives shadows. Streets go along x and
/// z through every multiple of their distance; all houses are closed, and trees are not: each leaf is a triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct City {
    /// Houses, courtyards, towers and trees together.
    pub objects: u32,
    /// Of the random numbers.
    pub seed: u64,
    /// Ledges along the walls of each storey: detail that a silhouette follows.
    pub ledges: u32,
    /// Triangles of the tree on the square beside the crossing at the origin; without it if 0.
    pub tree_triangles: u32,
}

/// Why a city cannot be built.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CityError {
    /// A number out of its range.
    #[error("a city's `{key}` is {value}; it must be from {least} to {most}")]
    OutOfRange {
        /// Which number.
        key: &'static str,
        /// What it is.
        value: u32,
        /// The least that it may be.
        least: u32,
        /// The most that it may be.
        most: u32,
    },
    /// More than fits into memory.
    #[error("a city of {objects} objects {source}; use fewer objects or ledges")]
    Memory {
        /// The objects asked for.
        objects: u32,
        /// What there is.
        source: NotEnough,
    },
}

impl City {
    /// Says what is wrong with the numbers, if anything.
    ///
    /// # Errors
    /// Which is out of its range.
    pub fn validate(self) -> Result<(), CityError> {
        let ranges = [
            ("objects", self.objects, 1, MOST_OBJECTS),
            ("ledges", self.ledges, 0, MOST_LEDGES),
            (
                "tree_triangles",
                self.tree_triangles,
                0,
                MOST_TREE_TRIANGLES,
            ),
        ];
        for (key, value, least, most) in ranges {
            if !(least..=most).contains(&value) {
                return Err(CityError::OutOfRange {
                    key,
                    value,
                    least,
                    most,
                });
            }
        }
        Ok(())
    }

    /// Builds it; the ground is the last object.
    ///
    /// # Errors
    /// When the numbers are out of range, or there is no memory for it.
    pub fn mesh(self) -> Result<Mesh, CityError> {
        self.validate()?;
        let bytes = u64::from(self.objects) * OBJECT_BYTES * u64::from(1 + self.ledges) / 4;
        memory::check(bytes).map_err(|source| CityError::Memory {
            objects: self.objects,
            source,
        })?;
        let mut mesh = Mesh::default();
        let mut reach = PITCH_M;
        for (i, j) in spiral() {
            let block = Block::new(
                self.seed,
                [i, j].map(|n| (n as f32 + 0.5) * PITCH_M),
                [i, j],
            );
            let is_square = [i, j] == [0, 0] && self.tree_triangles > 0;
            let parts = match is_square {
                true => block.square(self.tree_triangles),
                false => block.parts(self.ledges),
            };
            let room = self.objects as usize - mesh.objects.len();
            parts.iter().take(room).for_each(|part| mesh.push(part));
            reach = reach.max((1 + i.abs().max(j.abs())) as f32 * PITCH_M);
            if mesh.objects.len() == self.objects as usize {
                break;
            }
        }
        mesh.push(&ground(reach + OUTSKIRTS_M));
        Ok(mesh)
    }
}

fn ground(reach: f32) -> Part {
    let corner = |x: f32, z: f32| Vec3::new(x * reach, 0.0, z * reach);
    let [a, b, c, d] = [
        corner(-1.0, 1.0),
        corner(1.0, 1.0),
        corner(1.0, -1.0),
        corner(-1.0, -1.0),
    ];
    Part::of_triangles("ground", &[[a, b, c], [a, c, d]]).receiver()
}

/// The blocks around the origin: from the four that meet there outwards, ring after ring.
fn spiral() -> impl Iterator<Item = (i32, i32)> {
    (0..).flat_map(|ring: i32| {
        let range = -1 - ring..=ring;
        let on_border = move |n: i32| n == ring || n == -1 - ring;
        let columns = range.clone().rev();
        let all = columns.flat_map(move |i| range.clone().rev().map(move |j| (i, j)));
        all.filter(move |&(i, j)| on_border(i) || on_border(j))
    })
}

#[cfg(test)]
#[path = "../city_tests.rs"]
mod tests;
