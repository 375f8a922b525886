//! Hours of sun per triangle: how many hours a facade is in shade.
//!
//! Each triangle is cut into sixteen alike; a ray from the middle of each to the sun says whether the sun reaches
//! it. It does on the side that faces it, see [`Reference::light_on`].

use std::fmt::Write as _;
use std::path::Path;

use glam::DVec3;
use rayon::prelude::*;
use serde::Serialize;

use super::day::Day;
use super::heat_map;
use crate::output;
use crate::reference::{Reference, ReferenceError};
use crate::scene::Mesh;

/// Parts of a triangle along each side.
const PARTS: u32 = 4;

/// A row of `triangles.csv`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TriangleRow {
    /// The object's name.
    pub object: String,
    /// The triangle's number in the mesh, from 0.
    pub triangle: u32,
    /// Hours of sun, on average over the triangle.
    pub sun_hours: f64,
    /// Hours in shade while the sun is up.
    pub shade_hours: f64,
    /// How far each of them may be off, because rays meet edges.
    pub doubt_hours: f64,
    /// Area in square units of the scene.
    pub area: f64,
}

/// The hours of every triangle of a mesh.
///
/// # Errors
/// When the sun is no light.
pub fn hours_of_triangles(
    mesh: &Mesh,
    reference: &Reference,
    day: &Day,
) -> Result<Vec<TriangleRow>, ReferenceError> {
    let weights = middles();
    let row = |object: &str, triangle: usize| {
        let (mut sun, mut shade, mut doubt) = (0.0, 0.0, 0.0);
        for (_, step, light) in day.daylight() {
            let seen = reference.light_on(light, triangle as u32, &weights)?;
            let count = seen.len() as f64;
            let lit = seen
                .iter()
                .map(|visibility| visibility.value())
                .sum::<f64>()
                / count;
            sun += step.hours * lit;
            shade += step.hours * (1.0 - lit);
            doubt += step.hours * seen.iter().map(|v| v.doubt()).sum::<f64>() / count;
        }
        let [a, b, c] = mesh.corners(triangle).map(|corner| corner.as_dvec3());
        Ok(TriangleRow {
            object: object.to_owned(),
            triangle: triangle as u32,
            sun_hours: sun,
            shade_hours: shade,
            doubt_hours: doubt,
            area: (b - a).cross(c - a).length() / 2.0,
        })
    };
    let of_object = |object: &crate::scene::Object| {
        let triangles = object.triangle_range().into_par_iter();
        triangles
            .map(|triangle| row(&object.name, triangle))
            .collect::<Result<Vec<_>, _>>()
    };
    let rows: Result<Vec<_>, _> = mesh.objects.par_iter().map(of_object).collect();
    Ok(rows?.concat())
}

/// The middles of the parts of a triangle, by the weights of its corners.
fn middles() -> Vec<DVec3> {
    let n = PARTS;
    let mut middles = Vec::with_capacity((n * n) as usize);
    for i in 0..n {
        for j in 0..n - i {
            // In thirds of a part: the part that points as the triangle does, and the one turned over beside it.
            let whole = f64::from(3 * n);
            let (u, v) = (f64::from(3 * i + 1) / whole, f64::from(3 * j + 1) / whole);
            middles.push(DVec3::new(1.0 - u - v, u, v));
            if i + j + 1 < n {
                let (u, v) = (f64::from(3 * i + 2) / whole, f64::from(3 * j + 2) / whole);
                middles.push(DVec3::new(1.0 - u - v, u, v));
            }
        }
    }
    middles
}

/// Writes the mesh with a colour for the hours of each triangle as a PLY file. Each triangle has corners of its own,
/// because programs read colours of corners more often than those of faces.
///
/// # Errors
/// When the file cannot be written.
pub fn write_ply(path: &Path, mesh: &Mesh, rows: &[TriangleRow], day: &Day) -> anyhow::Result<()> {
    let (corners, faces) = (3 * rows.len(), rows.len());
    output::write_with(path, |file| {
        write!(
            file,
            "ply\nformat ascii 1.0\ncomment hours of sun, {} from {} to {} {}\n\
             element vertex {corners}\nproperty float x\nproperty float y\nproperty float z\n\
             property uchar red\nproperty uchar green\nproperty uchar blue\n\
             element face {faces}\nproperty list uchar int vertex_indices\n\
             property float sun_hours\nend_header\n",
            day.request.day.date(),
            day.request.from,
            day.request.to,
            day.request.day.zone_name(),
        )?;
        for row in rows {
            let [r, g, b] = heat_map::of_hours(row.sun_hours as f32, day.hours());
            let mut lines = String::new();
            for corner in mesh.corners(row.triangle as usize) {
                // Writing to a String does not fail.
                let _ = writeln!(lines, "{} {} {} {r} {g} {b}", corner.x, corner.y, corner.z);
            }
            file.write_all(lines.as_bytes())?;
        }
        for (i, row) in rows.iter().enumerate() {
            let first = 3 * i;
            writeln!(
                file,
                "3 {first} {} {} {}",
                first + 1,
                first + 2,
                row.sun_hours as f32
            )?;
        }
        Ok(())
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_parts_of_a_triangle_are_alike_and_cover_it() {
        let middles = middles();
        assert_eq!(middles.len(), (PARTS * PARTS) as usize);
        let mean = middles.iter().sum::<DVec3>() / middles.len() as f64;
        assert!(mean.distance(DVec3::splat(1.0 / 3.0)) < 1e-12);
        for weights in &middles {
            assert!(weights.min_element() > 0.0 && (weights.element_sum() - 1.0).abs() < 1e-12);
        }
    }
}
