//! A box on the ground under the sun, of which everything is known.

use super::triangles::hours_of_triangles;
use super::{Day, DayRequest};
use crate::reference::{Reference, Visibility};
use crate::scene::sun::{Compass, LocalDay, Site, SunPosition, parse_date, parse_time};
use crate::scene::{Light, Mesh, Part};
use glam::{DVec3, Vec3};

const HEIGHT: f64 = 3.0;
/// Half its width and depth.
const HALF: f64 = 1.0;

/// The box, and small triangles on the ground around these points.
fn scene(points: &[(f64, f64)]) -> (Mesh, Reference) {
    let corner = |i: usize| {
        let side = |bit: usize, low: f64, high: f64| if i & bit == 0 { low } else { high };
        Vec3::new(
            side(1, -HALF, HALF) as f32,
            side(2, 0.0, HEIGHT) as f32,
            side(4, -HALF, HALF) as f32,
        )
    };
    let faces = [
        [0, 1, 3, 2],
        [4, 6, 7, 5],
        [0, 4, 5, 1],
        [2, 3, 7, 6],
        [0, 2, 6, 4],
        [1, 5, 7, 3],
    ];
    let triangles = faces.map(|[a, b, c, d]| [[a, b, c], [a, c, d]]);
    let triangles = triangles.as_flattened().iter().map(|t| t.map(corner));
    let body = Part::of_triangles("box", &triangles.collect::<Vec<_>>());
    let small = |&(x, z): &(f64, f64)| {
        let near = |dx: f64, dz: f64| Vec3::new((x + dx) as f32, 0.0, (z + dz) as f32);
        [near(0.0, -1e-4), near(-1e-4, 1e-4), near(1e-4, 1e-4)]
    };
    let ground: Vec<_> = points.iter().map(small).collect();
    let ground = Part::of_triangles("ground", &ground).receiver();
    let mesh: Mesh = [body, ground].into_iter().collect();
    let casts = mesh.objects[0].triangle_range();
    let reference = Reference::new(&mesh.positions, &mesh.triangles, |triangle| {
        casts.contains(&(triangle as usize))
    });
    (mesh, reference.unwrap())
}

fn day(from: &str, to: &str, step: &str) -> Day {
    Day::new(DayRequest {
        site: Site::new(48.2, 16.37).unwrap(),
        compass: Compass::default(),
        day: LocalDay::new(parse_date("2026-09-18").unwrap(), "Europe/Vienna").unwrap(),
        from: parse_time(from).unwrap(),
        to: parse_time(to).unwrap(),
        step: step.parse().unwrap(),
    })
    .unwrap()
}

/// Whether the sun reaches one point on the ground past the box.
fn is_lit(point: (f64, f64), light: Light) -> bool {
    let (_, reference) = scene(&[point]);
    let third = [DVec3::splat(1.0 / 3.0)];
    reference.light_on(light, 12, &third).unwrap()[0] == Visibility::FULL
}

#[test]
fn at_noon_the_shadow_points_north_and_is_as_long_as_the_sun_is_low() {
    let noon = day("12:48", "12:50", "1m");
    let step = noon.steps[0];
    let length = HEIGHT / step.position.elevation_deg.to_radians().tan();
    // 90° less the latitude, and 1.9° of declination: the sun is 43.7° high.
    assert!((length - 3.15).abs() < 0.04, "{length}");
    let light = step.light.unwrap();
    // North is −z, and the shadow begins at the northern wall.
    let north_of_wall = |d: f64| (0.0, -HALF - d);
    assert!(!is_lit(north_of_wall(length * 0.998), light));
    assert!(is_lit(north_of_wall(length * 1.002), light));
    assert!(
        is_lit((0.0, HALF + 0.1 * length), light),
        "the south is sunny"
    );
    let mirrored = SunPosition {
        azimuth_deg: 180.0 - step.position.azimuth_deg,
        ..step.position
    };
    let mirrored = noon.request.compass.light(mirrored);
    assert!(is_lit(north_of_wall(length * 0.5), mirrored));
}

#[test]
fn in_the_morning_the_shadow_is_in_the_west_and_in_the_evening_in_the_east() {
    let (morning, evening) = (day("08:00", "08:02", "1m"), day("17:30", "17:32", "1m"));
    let (west, east) = ((-HALF - 1.0, 0.0), (HALF + 1.0, 0.0));
    let lit = |day: &Day, point| is_lit(point, day.steps[0].light.unwrap());
    assert!(!lit(&morning, west) && lit(&morning, east));
    assert!(lit(&evening, west) && !lit(&evening, east));
}

/// Whether a ray from a point on the ground meets the box, by its slabs.
fn meets_box((x, z): (f64, f64), towards: DVec3) -> bool {
    let (mut near, mut far) = (0.0f64, f64::INFINITY);
    let slabs = [
        (x, towards.x, -HALF, HALF),
        (0.0, towards.y, 0.0, HEIGHT),
        (z, towards.z, -HALF, HALF),
    ];
    for (start, slope, low, high) in slabs {
        let (a, b) = ((low - start) / slope, (high - start) / slope);
        near = near.max(a.min(b));
        far = far.min(a.max(b));
    }
    near < far
}

#[test]
fn hours_are_those_of_the_rays_one_by_one() {
    let day = day("05:00", "20:00", "20m");
    let points: Vec<(f64, f64)> = (0..40)
        .map(|i| {
            let angle = f64::from(i) * 0.61;
            let distance = 1.5 + 0.11 * f64::from(i);
            (distance * angle.cos(), distance * angle.sin())
        })
        .collect();
    let (mesh, reference) = scene(&points);
    let rows = hours_of_triangles(&mesh, &reference, &day).unwrap();
    let rows = &rows[mesh.objects[1].triangle_range()];
    let all_h: f64 = day.daylight().map(|(_, step, _)| step.hours).sum();
    let mut shaded = 0;
    for (row, point) in rows.iter().zip(&points) {
        let sunny = day
            .daylight()
            .filter(|(_, _, light)| !meets_box(*point, light.place.truncate().as_dvec3()));
        let expected: f64 = sunny.map(|(_, step, _)| step.hours).sum();
        assert!(
            (row.sun_hours - expected).abs() < 1e-9,
            "{row:?}, {expected} h by slabs"
        );
        assert!((row.sun_hours + row.shade_hours - all_h).abs() < 1e-9);
        assert_eq!(row.object, "ground");
        shaded += u32::from(expected < all_h);
    }
    assert!(shaded > 10, "{shaded} points are in shadow at times");
}
