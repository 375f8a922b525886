//! Triangles in objects: plain data, the same for every loader and every method.

use std::ops::Range;

use glam::Vec3;

/// As many triangles as a mesh may have: three half-edges each, counted in 32 bits.
pub const MAX_TRIANGLES: usize = (u32::MAX / 3) as usize;

/// The largest coordinate of a model. Which way a triangle faces a light is decided by a product of three lengths,
/// and this one's own size may come twice, the light's distance once; a light farther than 2²⁴ times the
/// scene's radius is a direction. So no product overflows 32 bits, in which case there would be no shadow.
pub const LARGEST_COORDINATE: f32 = (1u64 << 32) as f32;

/// All triangles of a scene, grouped in objects.
///
/// Each object owns one range of vertices and one of triangles; no vertex is shared between
/// objects. Positions are [`canonical`] and finite.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Vertex positions, y up, right-handed.
    pub positions: Vec<Vec3>,
    /// Indices into `positions`, counter-clockwise seen from outside where there is an outside.
    pub triangles: Vec<[u32; 3]>,
    /// The objects, in the order in which they are drawn.
    pub objects: Vec<Object>,
}

/// A part of a mesh that is drawn with one call.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Object {
    /// Its name in the model file; not necessarily unique.
    pub name: String,
    /// Its vertices: indices into [`Mesh::positions`].
    pub vertices: Range<u32>,
    /// Its triangles: indices into [`Mesh::triangles`].
    pub triangles: Range<u32>,
    /// False for what only receives shadows: it has no edges and no shadow volume.
    pub casts_shadow: bool,
}

impl Object {
    /// Its triangles, as a range that indexes [`Mesh::triangles`].
    pub fn triangle_range(&self) -> Range<usize> {
        self.triangles.start as usize..self.triangles.end as usize
    }

    /// Its vertices, as a range that indexes [`Mesh::positions`].
    pub fn vertex_range(&self) -> Range<usize> {
        self.vertices.start as usize..self.vertices.end as usize
    }
}

impl Mesh {
    /// The objects that cast a shadow.
    pub fn casters(&self) -> impl Iterator<Item = &Object> {
        self.objects.iter().filter(|object| object.casts_shadow)
    }

    /// How many triangles cast a shadow.
    pub fn caster_triangle_count(&self) -> usize {
        self.casters().map(|object| object.triangles.len()).sum()
    }

    /// How many objects cast a shadow.
    pub fn caster_object_count(&self) -> usize {
        self.casters().count()
    }

    /// The smallest and the largest corner of the box around all vertices, receivers included;
    /// twice the origin if there are none.
    pub fn bounds(&self) -> (Vec3, Vec3) {
        let Some(&first) = self.positions.first() else {
            return (Vec3::ZERO, Vec3::ZERO);
        };
        self.positions
            .iter()
            .fold((first, first), |(low, high), &p| (low.min(p), high.max(p)))
    }

    /// The same of what casts.
    pub fn caster_bounds(&self) -> (Vec3, Vec3) {
        let mut casting = self
            .casters()
            .flat_map(|object| &self.positions[object.vertex_range()]);
        let Some(&first) = casting.next() else {
            return (Vec3::ZERO, Vec3::ZERO);
        };
        casting.fold((first, first), |(low, high), &p| (low.min(p), high.max(p)))
    }

    /// Hexadecimal BLAKE3 of all that decides what is drawn and what casts: positions, triangles,
    /// and the ranges and casting of the objects; not of their names.
    pub fn hash(&self) -> String {
        let mut hasher = blake3::Hasher::new();
        let lengths = [
            self.positions.len(),
            self.triangles.len(),
            self.objects.len(),
        ];
        for length in lengths {
            hasher.update(&(length as u64).to_le_bytes());
        }
        // The bytes as they are in memory: every target that wgpu runs on is little-endian.
        hasher.update(bytemuck::cast_slice(&self.positions));
        hasher.update(bytemuck::cast_slice(&self.triangles));
        for Object {
            vertices,
            triangles,
            casts_shadow,
            ..
        } in &self.objects
        {
            let ranges = [vertices.start, vertices.end, triangles.start, triangles.end];
            hasher.update(bytemuck::cast_slice(&ranges));
            hasher.update(&[u8::from(*casts_shadow)]);
        }
        hasher.finalize().to_hex().to_string()
    }

    /// The three corners of a triangle.
    pub fn corners(&self, triangle: usize) -> [Vec3; 3] {
        self.triangles[triangle].map(|vertex| self.positions[vertex as usize])
    }
}

/// The position moved to the nearest multiple of 2⁻⁴⁰ in each coordinate, with -0 replaced by +0.
///
/// Coordinates of magnitude 2⁻¹⁷ and more are such multiples anyway. Equal positions then have equal
/// bits, and no arithmetic on them that [`facing`](fn@crate::geometry::facing) does meets a denormal number.
pub fn canonical(position: Vec3) -> Vec3 {
    Vec3::from_array(position.to_array().map(canonical_number))
}

/// One number of a [canonical](canonical) position.
pub(super) fn canonical_number(x: f32) -> f32 {
    const GRID_PER_UNIT: f32 = (1u64 << 40) as f32;
    const COARSE_ENOUGH: f32 = 1.0 / (1u32 << 16) as f32;
    if x.abs() >= COARSE_ENOUGH {
        return x;
    }
    // Adding +0 turns -0 into +0.
    (x * GRID_PER_UNIT).round_ties_even() / GRID_PER_UNIT + 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn object(triangles: Range<u32>, casts_shadow: bool) -> Object {
        Object {
            name: String::new(),
            vertices: 0..3,
            triangles,
            casts_shadow,
        }
    }

    #[test]
    fn counts_leave_receivers_out_and_bounds_do_not() {
        let mesh = Mesh {
            positions: vec![
                Vec3::new(-1.0, 2.0, 0.0),
                Vec3::X,
                Vec3::new(0.0, -3.0, 5.0),
            ],
            triangles: vec![[0, 1, 2]; 5],
            objects: vec![object(0..3, true), object(3..5, false)],
        };
        assert_eq!(
            (mesh.caster_triangle_count(), mesh.caster_object_count()),
            (3, 1)
        );
        assert_eq!(
            mesh.bounds(),
            (Vec3::new(-1.0, -3.0, 0.0), Vec3::new(1.0, 2.0, 5.0))
        );
        assert_eq!(mesh.corners(4)[1], Vec3::X);
        assert_eq!(Mesh::default().bounds(), (Vec3::ZERO, Vec3::ZERO));
    }

    #[test]
    fn the_hash_sees_everything_but_names() {
        let mesh = Mesh {
            positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y],
            triangles: vec![[0, 1, 2]; 2],
            objects: vec![object(0..1, true), object(1..2, true)],
        };
        let mut renamed = mesh.clone();
        renamed.objects[0].name.push('x');
        assert_eq!(mesh.hash(), renamed.hash());
        assert_eq!(mesh.hash().len(), 64);

        let mut others = [mesh.clone(), mesh.clone(), mesh.clone(), mesh.clone()];
        others[0].positions[1].z = 1e-30;
        others[1].triangles[1] = [0, 2, 1];
        others[2].objects[1].casts_shadow = false;
        others[3].objects[0].triangles = 0..2;
        assert!(others.iter().all(|other| other.hash() != mesh.hash()));
    }

    #[test]
    fn canonical_positions_have_one_zero_and_lie_on_the_grid() {
        let p = canonical(Vec3::new(-0.0, -1e-40, 1.5));
        assert_eq!(
            p.to_array().map(f32::to_bits),
            [0.0f32, 0.0, 1.5].map(f32::to_bits)
        );
        let grid = 2f32.powi(-40);
        let p = canonical(Vec3::new(2.6 * grid, -0.4 * grid, f32::MAX));
        assert_eq!(
            p.to_array().map(f32::to_bits),
            [3.0 * grid, 0.0, f32::MAX].map(f32::to_bits)
        );
        for x in [1e-5, -1.7e-5, 3.3e-7, 1e30] {
            let moved = (f64::from(canonical_number(x)) - f64::from(x)).abs();
            assert!(moved <= f64::from(grid) / 2.0, "{x}");
        }
    }
}
