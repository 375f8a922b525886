//! Which pixels of a picture are in shadow, found by the processor: on all its cores.

use super::beam::{Beam, RAYS};
use super::packet::Pixel;
use super::picture::Picture;
use super::tree::RayTree;
use crate::scene::Mesh;
use fearless_simd::{Level, Simd, dispatch};
use rayon::prelude::*;

/// Rows that one core takes at a time, and the side of the squares whose pixels go together.
const BAND_PX: usize = 16;

/// What is dark in a shadow mask.
const DARK: u8 = 255;

/// A picture of triangles, and what their light meets.
#[derive(Clone, Copy)]
struct Scene<'a> {
    picture: &'a Picture,
    mesh: &'a Mesh,
    tree: &'a RayTree,
}

impl Picture {
    /// Adds to a mask, one byte a pixel by rows from the top, the pixels whose light is blocked; those that are not 0 are
    /// not asked. `triangle_ids` has a number for each pixel: that of its triangle plus 1, or 0.
    ///
    /// # Panics
    /// When the number of pixels is not that of the picture, it is wider than 65,536, or a triangle is none of the mesh.
    pub fn add_shadows(&self, mesh: &Mesh, tree: &RayTree, triangle_ids: &[u32], mask: &mut [u8]) {
        let [width, height] = self.size_px;
        assert_eq!(triangle_ids.len(), width * height, "a triangle a pixel");
        assert_eq!(mask.len(), width * height, "a byte a pixel");
        assert!(width <= 1 << 16, "columns are numbers of 16 bits");
        let scene = Scene {
            picture: self,
            mesh,
            tree,
        };
        let level = Level::new();
        let band_px = (BAND_PX * width).max(1);
        let bands = mask.par_chunks_mut(band_px);
        let bands = bands.zip(triangle_ids.par_chunks(band_px)).enumerate();
        bands.for_each(|(band, (mask, ids))| {
            let pixels = asked(ids, mask, width);
            let first_row = band * BAND_PX;
            dispatch!(level, simd => trace(simd, scene, &pixels, first_row, mask));
        });
    }
}

/// The pixels of a square, in the order in which they are taken: blocks of 2 × 2 of blocks of 2 × 2 and so on (a Z-order
/// curve), column and row.
const SQUARE: [[u8; 2]; BAND_PX * BAND_PX] = {
    let mut square = [[0; 2]; BAND_PX * BAND_PX];
    let mut place = 0;
    while place < square.len() {
        square[place] = [even_bits(place), even_bits(place >> 1)];
        place += 1;
    }
    square
};

/// The number made of the bits 0, 2, 4, 6 of another.
const fn even_bits(place: usize) -> u8 {
    ((place & 1) | (place >> 1 & 2) | (place >> 2 & 4) | (place >> 3 & 8)) as u8
}

/// The pixels of a band whose light is in question, neighbours together.
fn asked(ids: &[u32], mask: &[u8], width: usize) -> Vec<Pixel> {
    let mut pixels = Vec::with_capacity(ids.len());
    for left in (0..width).step_by(BAND_PX) {
        for [x, row] in SQUARE {
            let x = left + usize::from(x);
            let at = usize::from(row) * width + x;
            if x >= width || at >= ids.len() || mask[at] != 0 {
                continue;
            }
            if let Some(triangle) = ids[at].checked_sub(1) {
                pixels.push(Pixel {
                    x: x as u16,
                    row: u16::from(row),
                    triangle,
                });
            }
        }
    }
    pixels
}

#[inline(always)]
fn trace<S: Simd>(simd: S, scene: Scene<'_>, pixels: &[Pixel], first_row: usize, mask: &mut [u8]) {
    let Scene {
        picture,
        mesh,
        tree,
    } = scene;
    let mut waiting = vec![(0, 0); tree.stack + 1];
    let mut last_blocker = None;
    for pixels in pixels.chunks(RAYS) {
        let beam = Beam::new(simd, picture, mesh, pixels, first_row);
        let shadowed = beam.blocked(simd, tree, &mut waiting, &mut last_blocker);
        for (ray, pixel) in pixels.iter().enumerate() {
            if shadowed >> ray & 1 != 0 {
                mask[usize::from(pixel.row) * picture.size_px[0] + usize::from(pixel.x)] = DARK;
            }
        }
    }
}
