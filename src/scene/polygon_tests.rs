use super::*;
use proptest::prelude::*;

type Triangle = [Vec3; 3];

fn cut(points: &[Vec3]) -> (Vec<Triangle>, Shape) {
    let points: Vec<_> = points
        .iter()
        .map(|p| crate::scene::mesh::canonical(*p))
        .collect();
    let corners: Vec<u32> = (0..points.len() as u32).collect();
    let mut triangles = Vec::new();
    let shape = triangulate(&corners, &points, &mut triangles);
    assert!(triangles.len() >= points.len() - 2);
    let at = |t: [u32; 3]| t.map(|corner| points[corner as usize]);
    (triangles.into_iter().map(at).collect(), shape)
}

/// On a slope, so that no coordinate is the same everywhere; whole numbers keep it flat to the last bit.
fn on_slope(points: &[[f32; 2]]) -> Vec<Vec3> {
    let at = |&[x, y]: &[f32; 2]| Vec3::new(x, y, 2.0 * x - y);
    points.iter().map(at).collect()
}

fn area(triangles: &[Triangle]) -> f64 {
    let twice = |[a, b, c]: &Triangle| (b - a).as_dvec3().cross((c - a).as_dvec3()).z;
    triangles.iter().map(twice).sum::<f64>() / 2.0
}

/// Areas without sign: more than [`area`] where triangles overlap.
fn covered(triangles: &[Triangle]) -> f64 {
    triangles.iter().map(|t| area(&[*t]).abs()).sum()
}

fn outline_area(outline: &[[f32; 2]]) -> f64 {
    let next = outline.iter().cycle().skip(1);
    let terms = outline
        .iter()
        .zip(next)
        .map(|(p, q)| p[0] * q[1] - q[0] * p[1]);
    terms.map(f64::from).sum::<f64>() / 2.0
}

const L: [[f32; 2]; 6] = [[0., 0.], [3., 0.], [3., 1.], [1., 1.], [1., 4.], [0., 4.]];
const ARROW: [[f32; 2]; 4] = [[0., 3.], [-2., -1.], [0., 0.], [2., -1.]];
const COMB: [[f32; 2]; 12] = [
    [0., 0.],
    [7., 0.],
    [7., 5.],
    [6., 5.],
    [6., 1.],
    [4., 1.],
    [4., 5.],
    [3., 5.],
    [3., 1.],
    [1., 1.],
    [1., 5.],
    [0., 5.],
];
/// A corner within a straight side, two at one place, and three within another side.
const WITH_NEEDLESS_CORNERS: [[f32; 2]; 10] = [
    [0., 0.],
    [2., 0.],
    [4., 0.],
    [4., 4.],
    [4., 4.],
    [3., 4.],
    [2., 4.],
    [1., 4.],
    [0., 4.],
    [0., 1.],
];
/// A square hole in a square, reached by a bridge that is walked twice.
const WITH_HOLE: [[f32; 2]; 10] = [
    [0., 0.],
    [6., 0.],
    [6., 6.],
    [0., 6.],
    [0., 0.],
    [2., 2.],
    [2., 4.],
    [4., 4.],
    [4., 2.],
    [2., 2.],
];
/// A spike without width to the outside.
const WITH_SPIKE: [[f32; 2]; 6] = [[0., 0.], [2., 0.], [2., 1.], [4., 1.], [2., 1.], [0., 2.]];

#[test]
fn every_spelling_of_a_polygon_covers_it_once() {
    let outlines: [&[[f32; 2]]; 6] = [
        &L,
        &ARROW,
        &COMB,
        &WITH_NEEDLESS_CORNERS,
        &WITH_HOLE,
        &WITH_SPIKE,
    ];
    for outline in outlines {
        let expected = outline_area(outline);
        let mut spelling = on_slope(outline);
        let (first, _) = cut(&spelling);
        for _ in 0..spelling.len() {
            spelling.rotate_left(1);
            let (triangles, shape) = cut(&spelling);
            assert_eq!(shape, Shape::Flat, "{outline:?}");
            assert_eq!(triangles, first, "{outline:?}");
            assert_eq!(triangles.len(), outline.len() - 2, "{outline:?}");
            assert!((area(&triangles) - expected).abs() < 1e-9, "{outline:?}");
            assert!(
                (covered(&triangles) - expected.abs()).abs() < 1e-9,
                "{outline:?}"
            );

            let mirrored: Vec<_> = spelling.iter().rev().copied().collect();
            let turned_over: Vec<_> = first.iter().map(|&[a, b, c]| [a, c, b]).collect();
            assert_eq!(cut(&mirrored).0, turned_over, "{outline:?}");
        }
    }
}

#[test]
fn corners_that_others_share_stay_corners_of_triangles() {
    let points = on_slope(&WITH_NEEDLESS_CORNERS);
    let (triangles, _) = cut(&points);
    for p in points {
        let uses = |t: &&Triangle| t.contains(&p) && covered(&[**t]) > 0.0;
        assert!(triangles.iter().find(uses).is_some(), "{p}");
    }
}

#[test]
fn what_crosses_itself_is_said() {
    let bow_tie = [[0., 0.], [2., 2.], [2., 0.], [0., 2.]];
    let lopsided = [[0., 0.], [3., 3.], [2., 0.], [0., 1.]];
    let star = [[0., 5.], [3., -4.], [-5., 2.], [5., 2.], [-3., -4.]];
    let twice_around = [[0., 0.], [1., 0.], [0., 1.], [0., 0.], [1., 0.], [0., 1.]];
    let outlines: [&[[f32; 2]]; 4] = [&bow_tie, &lopsided, &star, &twice_around];
    for outline in outlines {
        assert_eq!(cut(&on_slope(outline)).1, Shape::Crossing, "{outline:?}");
    }
}

#[test]
fn what_has_no_area_is_no_trouble() {
    let line = [[0., 0.], [3., 0.], [1., 0.], [2., 0.], [5., 0.]];
    let place = [[1., 1.]; 5];
    for outline in [line, place] {
        let (triangles, shape) = cut(&on_slope(&outline));
        assert_eq!((covered(&triangles), shape), (0.0, Shape::Flat));
    }
}

/// The tolerance is a part of the polygon's size, wherever it is and however large.
#[test]
fn what_is_bent_is_said_at_any_scale_and_place() {
    let bent = |by: f32, scale: f32, shift: f32| {
        let corners =
            [[0., 0., 0.], [1., 0., 0.], [1., 1., by], [0., 1., 0.]].map(Vec3::from_array);
        cut(&corners.map(|p| p * scale + shift * scale)).1
    };
    for scale in [1e-5, 1.0, 1e7, 1e30] {
        for shift in [0.0, 300.0] {
            assert_eq!(bent(0.0, scale, shift), Shape::Flat, "{scale} {shift}");
            let Shape::Bent(by) = bent(0.1, scale, shift) else {
                panic!("{scale} {shift}")
            };
            assert!((0.01..0.05).contains(&by), "{by}");
        }
        assert_eq!(bent(1e-4, scale, 0.0), Shape::Flat, "{scale}");
    }
    // So far away that coordinates are steps of 1/16: no corner is where it was meant.
    let far = [
        [0.3, 0.1, 0.],
        [1.7, 0.2, 0.1],
        [1.6, 1.9, 0.],
        [0.2, 1.8, 0.1],
    ]
    .map(Vec3::from_array);
    assert_eq!(cut(&far.map(|p| p + 1e6)).1, Shape::Flat);
}

#[test]
fn a_bent_quad_has_one_shape_however_it_is_told() {
    let mut quad = [[0., 0., 0.], [2., 0., 1.], [3., 2., 0.], [0., 1., 1.]].map(Vec3::from_array);
    let (first, _) = cut(&quad);
    for _ in 0..4 {
        quad.rotate_left(1);
        assert_eq!(cut(&quad).0, first);
    }
    let shorter = [quad[0], quad[2]];
    let ends = if quad[0].distance(quad[2]) < quad[1].distance(quad[3]) {
        shorter
    } else {
        [quad[1], quad[3]]
    };
    assert!(first.iter().all(|t| ends.iter().all(|end| t.contains(end))));
}

#[test]
fn a_polygon_of_a_hundred_thousand_corners_takes_no_time() {
    let circle = |i: u32| {
        let (sin, cos) = (f64::from(i) / 1e5 * std::f64::consts::TAU).sin_cos();
        let radius = if i.is_multiple_of(2) { 1.0 } else { 0.9 };
        Vec3::new((radius * cos) as f32, (radius * sin) as f32, 0.0)
    };
    let start = std::time::Instant::now();
    let (triangles, shape) = cut(&(0..100_000).map(circle).collect::<Vec<_>>());
    assert_eq!(shape, Shape::Flat);
    assert!((covered(&triangles) - area(&triangles).abs()).abs() < 1e-6);
    cut(&vec![Vec3::ONE; 100_000]);
    // Two rows: at first all corners are on one line.
    let there = (0..50_000).map(|i| Vec3::new(i as f32, 0.0, 0.0));
    let back = (0..50_000).map(|i| Vec3::new(50_000.0 - i as f32, 1.0, 0.0));
    assert_eq!(cut(&there.chain(back).collect::<Vec<_>>()).1, Shape::Flat);
    assert!(
        start.elapsed().as_secs_f64() < 20.0,
        "{:?}",
        start.elapsed()
    );
}

/// A polygon that goes around the origin, each corner seen from there: it cannot cross itself.
fn star_shaped() -> impl Strategy<Value = Vec<[f32; 2]>> {
    prop::collection::vec(1u32..200, 3..40).prop_map(|radii| {
        let step = std::f64::consts::TAU / radii.len() as f64;
        let corner = |(i, r): (usize, &u32)| {
            let (sin, cos) = (i as f64 * step).sin_cos();
            [cos, sin].map(|x| (x * 64.0 * f64::from(*r)).round() as f32)
        };
        radii.iter().enumerate().map(corner).collect()
    })
}

/// Corners that lie on each other, on lines, and cross as they like.
fn wild() -> impl Strategy<Value = Vec<[f32; 2]>> {
    prop::collection::vec([0u8..5, 0u8..5].prop_map(|p| p.map(f32::from)), 3..24)
}

#[test]
fn a_polygon_far_away_has_its_shape_if_its_corners_have() {
    // Across the far axis nothing is rounded.
    for x in [0.0, 3e6, 1e9] {
        let arrow = ARROW.map(|[y, z]| Vec3::new(x, y, z));
        let (triangles, shape) = cut(&arrow);
        assert_eq!(shape, Shape::Flat);
        let area: f32 = triangles
            .iter()
            .map(|[a, b, c]| (b - a).cross(c - a).length() / 2.0)
            .sum();
        assert_eq!(area, outline_area(&ARROW).abs() as f32, "at {x}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn what_is_flat_is_covered_once(outline in prop_oneof![star_shaped(), wild()]) {
        let (triangles, shape) = cut(&on_slope(&outline));
        prop_assume!(shape == Shape::Flat);
        let expected = outline_area(&outline);
        // Lobes that touch in a corner may run around opposite ways: their areas then differ in sign.
        prop_assert!((area(&triangles) - expected).abs() <= 1e-6 * (1.0 + expected.abs()));
    }

    #[test]
    fn stars_do_not_cross_themselves(outline in star_shaped()) {
        prop_assume!(outline.len() > 4);
        let (triangles, shape) = cut(&on_slope(&outline));
        prop_assert_eq!(shape, Shape::Flat);
        prop_assert!((covered(&triangles) - area(&triangles).abs()).abs() <= 1e-3);
    }

    #[test]
    fn the_first_corner_does_not_matter(outline in wild(), heights in prop::collection::vec(0u8..3, 24), by in 0usize..24) {
        let mut points: Vec<Vec3> = outline
            .iter()
            .zip(&heights)
            .map(|(&[x, y], &z)| Vec3::new(x, y, f32::from(z)))
            .collect();
        let before = cut(&points);
        let count = points.len();
        points.rotate_left(by % count);
        let after = cut(&points);
        if count > 3 {
            prop_assert_eq!(before, after);
        }
    }

    #[test]
    fn no_corners_make_it_panic(points in prop::collection::vec(any::<[f32; 3]>(), 3..12)) {
        let points: Vec<_> = points.into_iter().map(Vec3::from_array).filter(|p| p.is_finite()).collect();
        if points.len() >= 3 {
            cut(&points);
        }
    }
}
