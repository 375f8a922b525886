//! The edges and triangles of casters, 32 at a time.

use crate::geometry::Topology;
use crate::scene::Mesh;
use std::ops::Range;

/// Up to [`Blocks::SIZE`] edges or triangles of one caster: the first, and in a word how many (bits 0 to 5), whether they are
/// triangles (bit 6) and whose (above). Twin of `Block` in `shaders/methods/silhouette_cs/blocks.wgsl`.
type Block = [u32; 2];

const ARE_TRIANGLES: u32 = 1 << 6;
const CASTER_SHIFT: u32 = 7;

/// What an invocation of the device takes at a time: caster by caster, first its edges, then its triangles.
pub(super) struct Blocks {
    pub(super) blocks: Vec<Block>,
    /// The first block of each caster, and the end.
    pub(super) of_casters: Vec<u32>,
    /// Where an edge is marked: 32 times its block and its place there.
    pub(super) bits: Vec<u32>,
}

impl Blocks {
    /// So many at a time.
    pub(super) const SIZE: u32 = 32;

    pub(super) fn new(mesh: &Mesh, topology: &Topology) -> Self {
        let mut all = Self {
            blocks: Vec::new(),
            of_casters: vec![0],
            bits: Vec::with_capacity(topology.edges.len()),
        };
        let objects = mesh.objects.iter().zip(&topology.object_edges);
        let casters = objects.filter(|(object, _)| object.casts_shadow);
        for (caster, (object, edges)) in (0..).zip(casters) {
            let word = caster << CASTER_SHIFT;
            // No object that casts has edges before those of the last.
            debug_assert_eq!(edges.start as usize, all.bits.len());
            for block in in_blocks(edges.clone()) {
                let bit = Self::SIZE * all.blocks.len() as u32;
                all.bits.extend((bit..).take(block.len()));
                all.blocks.push([block.start, word | block.len() as u32]);
            }
            for block in in_blocks(object.triangles.clone()) {
                let word = word | ARE_TRIANGLES;
                all.blocks.push([block.start, word | block.len() as u32]);
            }
            all.of_casters.push(all.blocks.len() as u32);
        }
        all
    }
}

fn in_blocks(all: Range<u32>) -> impl Iterator<Item = Range<u32>> {
    let starts = all.clone().step_by(Blocks::SIZE as usize);
    starts.map(move |start| start..(start + Blocks::SIZE).min(all.end))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::SphereGrid;

    #[test]
    fn each_edge_and_triangle_of_a_caster_is_in_one_block() {
        let grid = SphereGrid {
            rows: 2,
            columns: 3,
            slices: 10,
            shells: 1,
        };
        let mesh = grid.mesh().unwrap();
        let topology = Topology::build(&mesh);
        let blocks = Blocks::new(&mesh, &topology);
        let (mut edges, mut triangles) = (Vec::new(), Vec::new());
        for (caster, range) in blocks.of_casters.windows(2).enumerate() {
            for &[first, word] in &blocks.blocks[range[0] as usize..range[1] as usize] {
                assert_eq!((word >> CASTER_SHIFT) as usize, caster);
                let own = first..first + (word & 0x3f);
                if word & ARE_TRIANGLES == 0 {
                    edges.extend(own);
                } else {
                    triangles.extend(own);
                }
            }
        }
        assert!(edges.into_iter().eq(0..topology.edges.len() as u32));
        let of_casters = mesh.casters().flat_map(|object| object.triangles.clone());
        assert!(triangles.into_iter().eq(of_casters));
        for edge in [0, 3, 40, 299] {
            let bit = blocks.bits[edge as usize];
            let [first, _] = blocks.blocks[(bit / 32) as usize];
            assert_eq!(first + bit % 32, edge);
        }
    }
}
