//! The sphere grid of Milet et al.: spheres in rows and columns above a ground.

use std::f64::consts::{PI, TAU};

use glam::Vec3;
use rayon::prelude::*;

use super::mesh::{MAX_TRIANGLES, Mesh, Object, canonical};
use crate::memory::{self, NotEnough};

/// What the longer side of the grid spans, so that the picture stays alike for every grid.
const SPAN: f32 = 25.0;
/// Centre to centre, and centre to ground, as multiples of the radius.
const SPACING_RADII: f32 = 2.5;
const HEIGHT_RADII: f32 = 1.25;
/// The ground reaches this far from the origin along x and z.
const GROUND_REACH: f32 = 40.0;
const GROUND_VERTICES: usize = 4;
const GROUND_TRIANGLES: usize = 2;

/// A grid of equal spheres, `columns` along x and `rows` along z, centred above the origin.
///
/// A sphere has n = `slices` slices and n/2 + 1 stacks: n/2 rings of n vertices between two poles,
/// hence exactly n² triangles, closed and 2-manifold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SphereGrid {
    /// Spheres along z.
    pub rows: u32,
    /// Spheres along x.
    pub columns: u32,
    /// Slices of a sphere, around its axis; even.
    pub slices: u32,
    /// Spheres about each centre, from the largest inwards, by equal steps: 1 for the spheres of the paper. A ray through the
    /// middle meets twice as many surfaces.
    pub shells: u32,
}

/// Why a sphere grid cannot be built.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SphereGridError {
    /// No rows, no columns or no shells.
    #[error(
        "a sphere grid needs at least one row, one column and one shell, not {rows} × {columns} with {shells}"
    )]
    NoSpheres {
        /// The rows asked for.
        rows: u32,
        /// The columns asked for.
        columns: u32,
        /// The shells asked for.
        shells: u32,
    },
    /// An odd number of slices, or fewer than four.
    #[error("a sphere needs an even number of slices, at least 4, not {slices}")]
    Slices {
        /// The slices asked for.
        slices: u32,
    },
    /// More than 32-bit indices reach.
    #[error(
        "{rows} × {columns} × {shells} spheres of {slices}² triangles are more than {MAX_TRIANGLES}; \
         use fewer spheres or slices"
    )]
    TooLarge {
        /// The rows asked for.
        rows: u32,
        /// The columns asked for.
        columns: u32,
        /// The slices asked for.
        slices: u32,
        /// The shells asked for.
        shells: u32,
    },
    /// More than fits into memory.
    #[error("a sphere grid of {triangles} triangles {source}; use fewer spheres or slices")]
    Memory {
        /// The triangles asked for.
        triangles: u64,
        /// What there is.
        source: NotEnough,
    },
}

/// What a triangle of a closed mesh takes until it is drawn: its three indices and half a vertex here, and as
/// much again, with vertices of four numbers, on the way to the device.
const TRIANGLE_BYTES: u64 = 2 * (12 + 8);

impl SphereGrid {
    /// How many triangles the spheres have together; the ground is not counted.
    /// More than fit are as many as fit.
    pub fn triangle_count(self) -> u64 {
        u64::from(self.slices)
            .pow(2)
            .saturating_mul(self.sphere_count())
    }

    /// How many spheres there are.
    pub fn sphere_count(self) -> u64 {
        (u64::from(self.rows) * u64::from(self.columns)).saturating_mul(self.shells.into())
    }

    /// Says what is wrong with the numbers, if anything.
    pub fn validate(self) -> Result<(), SphereGridError> {
        let Self {
            rows,
            columns,
            slices,
            shells,
        } = self;
        if rows == 0 || columns == 0 || shells == 0 {
            return Err(SphereGridError::NoSpheres {
                rows,
                columns,
                shells,
            });
        }
        if slices < 4 || !slices.is_multiple_of(2) {
            return Err(SphereGridError::Slices { slices });
        }
        // A closed mesh has fewer vertices than triangles, so this bounds both.
        if self.triangle_count() > (MAX_TRIANGLES - GROUND_TRIANGLES) as u64 {
            return Err(SphereGridError::TooLarge {
                rows,
                columns,
                slices,
                shells,
            });
        }
        Ok(())
    }

    /// Builds the spheres, one object each, row after row, shells of a place together, and the ground as the last object.
    pub fn mesh(self) -> Result<Mesh, SphereGridError> {
        self.validate()?;
        let triangles = self.triangle_count();
        memory::check(TRIANGLE_BYTES * triangles)
            .map_err(|source| SphereGridError::Memory { triangles, source })?;
        let directions = sphere_directions(self.slices);
        let sphere = sphere_triangles(self.slices);
        let count = self.sphere_count() as usize;

        let mut positions = vec![Vec3::ZERO; count * directions.len() + GROUND_VERTICES];
        let mut triangles = vec![[0; 3]; count * sphere.len() + GROUND_TRIANGLES];
        let (sphere_positions, ground_positions) = positions.split_at_mut(count * directions.len());
        let (sphere_indices, ground_indices) = triangles.split_at_mut(count * sphere.len());

        sphere_positions
            .par_chunks_mut(directions.len())
            .enumerate()
            .for_each(|(i, positions)| {
                let (centre, radius) = (self.centre(i), self.radius_of(i));
                for (position, &direction) in positions.iter_mut().zip(&directions) {
                    *position = canonical(centre + radius * direction);
                }
            });
        sphere_indices
            .par_chunks_mut(sphere.len())
            .enumerate()
            .for_each(|(i, indices)| {
                let first = (i * directions.len()) as u32;
                for (index, triangle) in indices.iter_mut().zip(&sphere) {
                    *index = triangle.map(|vertex| first + vertex);
                }
            });

        // Counter-clockwise seen from above.
        ground_positions.copy_from_slice(
            &[[-1.0, 1.0], [1.0, 1.0], [1.0, -1.0], [-1.0, -1.0]]
                .map(|[x, z]| Vec3::new(x * GROUND_REACH, 0.0, z * GROUND_REACH)),
        );
        let g = (count * directions.len()) as u32;
        ground_indices.copy_from_slice(&[[g, g + 1, g + 2], [g, g + 2, g + 3]]);

        let objects = self.objects(directions.len() as u32, sphere.len() as u32);
        Ok(Mesh {
            positions,
            triangles,
            objects,
        })
    }

    fn objects(self, sphere_vertices: u32, sphere_triangles: u32) -> Vec<Object> {
        let count = self.sphere_count() as u32;
        let sphere = |i| Object {
            name: self.name_of(i),
            vertices: i * sphere_vertices..(i + 1) * sphere_vertices,
            triangles: i * sphere_triangles..(i + 1) * sphere_triangles,
            casts_shadow: true,
        };
        let (vertices, triangles) = (count * sphere_vertices, count * sphere_triangles);
        let ground = Object {
            name: "ground".to_owned(),
            vertices: vertices..vertices + GROUND_VERTICES as u32,
            triangles: triangles..triangles + GROUND_TRIANGLES as u32,
            casts_shadow: false,
        };
        (0..count).map(sphere).chain([ground]).collect()
    }

    fn spacing(self) -> f32 {
        SPAN / self.rows.max(self.columns) as f32
    }

    fn radius(self) -> f32 {
        self.spacing() / SPACING_RADII
    }

    fn name_of(self, i: u32) -> String {
        let (place, shell) = (i / self.shells, i % self.shells);
        let name = format!("sphere r{} c{}", place / self.columns, place % self.columns);
        match self.shells {
            1 => name,
            _ => format!("{name} s{shell}"),
        }
    }

    /// The radius of sphere `i`: the first of a place is the largest.
    fn radius_of(self, i: usize) -> f32 {
        let within = self.shells - i as u32 % self.shells;
        self.radius() * within as f32 / self.shells as f32
    }

    /// The centre of sphere `i`, counted row after row, all shells of a place together.
    fn centre(self, i: usize) -> Vec3 {
        let i = i / self.shells as usize;
        let columns = self.columns as usize;
        let from_middle = |i: usize, n: u32| (i as f32 - (n - 1) as f32 / 2.0) * self.spacing();
        Vec3::new(
            from_middle(i % columns, self.columns),
            HEIGHT_RADII * self.radius(),
            from_middle(i / columns, self.rows),
        )
    }
}

/// The vertices of the unit sphere: the pole above, the rings from above to below, the pole below.
/// A ring runs counter-clockwise seen from above.
fn sphere_directions(slices: u32) -> Vec<Vec3> {
    let rings = slices / 2;
    let ring_vertices = (1..=rings).flat_map(|ring| {
        let (ring_radius, y) = (PI * f64::from(ring) / f64::from(rings + 1)).sin_cos();
        (0..slices).map(move |slice| {
            let (sin, cos) = (TAU * f64::from(slice) / f64::from(slices)).sin_cos();
            Vec3::new(
                (ring_radius * cos) as f32,
                y as f32,
                (-ring_radius * sin) as f32,
            )
        })
    });
    [Vec3::Y]
        .into_iter()
        .chain(ring_vertices)
        .chain([Vec3::NEG_Y])
        .collect()
}

/// The triangles over [`sphere_directions`], counter-clockwise seen from outside.
fn sphere_triangles(slices: u32) -> Vec<[u32; 3]> {
    let rings = slices / 2;
    let (above, below) = (0, 1 + rings * slices);
    let at = |ring: u32, slice: u32| 1 + ring * slices + slice % slices;

    let mut triangles = Vec::with_capacity((slices * slices) as usize);
    triangles.extend((0..slices).map(|s| [above, at(0, s), at(0, s + 1)]));
    for (ring, s) in (0..rings - 1).flat_map(|ring| (0..slices).map(move |s| (ring, s))) {
        let upper = [at(ring, s), at(ring, s + 1)];
        let lower = [at(ring + 1, s), at(ring + 1, s + 1)];
        triangles.push([lower[0], lower[1], upper[1]]);
        triangles.push([lower[0], upper[1], upper[0]]);
    }
    triangles.extend((0..slices).map(|s| [below, at(rings - 1, s + 1), at(rings - 1, s)]));
    triangles
}

#[cfg(test)]
#[path = "sphere_grid_tests.rs"]
mod tests;
