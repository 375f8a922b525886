//! Vertices at the same place become one.

use glam::Vec3;
use rayon::prelude::*;

const UNUSED: u32 = u32::MAX;

/// Merges the vertices whose canonical positions are equal and drops those that no triangle uses.
///
/// Rewrites the indices and returns the positions that are left, in the order in which the
/// triangles first use them. Positions must be [canonical](super::mesh::canonical): equality is
/// that of bits.
pub(super) fn weld(positions: &[Vec3], triangles: &mut [[u32; 3]]) -> Vec<Vec3> {
    let bits = |p: Vec3| p.to_array().map(f32::to_bits);
    let mut by_place: Vec<([u32; 3], u32)> = positions
        .iter()
        .zip(0..)
        .map(|(&p, vertex)| (bits(p), vertex))
        .collect();
    by_place.par_sort_unstable();

    // Of the vertices at one place, the first stands for all.
    let mut first_at = vec![UNUSED; positions.len()];
    for place in by_place.chunk_by(|left, right| left.0 == right.0) {
        for &(_, vertex) in place {
            first_at[vertex as usize] = place[0].1;
        }
    }

    let mut welded_index = vec![UNUSED; positions.len()];
    let mut welded = Vec::new();
    for corner in triangles.as_flattened_mut() {
        let first = first_at[*corner as usize] as usize;
        if welded_index[first] == UNUSED {
            welded_index[first] = welded.len() as u32;
            welded.push(positions[first]);
        }
        *corner = welded_index[first];
    }
    welded
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn equal_positions_become_one_vertex_in_order_of_use() {
        let positions = [Vec3::Z, Vec3::X, Vec3::Y, Vec3::X, Vec3::ONE];
        let mut triangles = [[3, 2, 4], [4, 1, 3]];
        assert_eq!(
            weld(&positions, &mut triangles),
            [Vec3::X, Vec3::Y, Vec3::ONE]
        );
        assert_eq!(triangles, [[0, 1, 2], [2, 0, 0]]);
    }

    proptest! {
        #[test]
        fn corners_stay_and_no_position_comes_twice(
            coordinates in prop::collection::vec([0u8..3, 0u8..3, 0u8..3], 1..40),
            corners in prop::collection::vec([any::<u32>(), any::<u32>(), any::<u32>()], 0..40),
        ) {
            let positions: Vec<_> =
                coordinates.iter().map(|p| Vec3::from_array(p.map(f32::from))).collect();
            let count = positions.len() as u32;
            let before: Vec<_> = corners.iter().map(|t| t.map(|v| v % count)).collect();
            let mut after = before.clone();
            let welded = weld(&positions, &mut after);
            for (b, a) in before.as_flattened().iter().zip(after.as_flattened()) {
                prop_assert_eq!(positions[*b as usize], welded[*a as usize]);
            }
            for (i, p) in welded.iter().enumerate() {
                prop_assert!(!welded[..i].contains(p));
                prop_assert!(after.as_flattened().contains(&(i as u32)));
            }
        }
    }
}
