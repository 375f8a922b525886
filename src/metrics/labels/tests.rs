//! Planted errors, each of which must be known for what it is, and others that must not.

use glam::{DVec2, DVec3, Vec3, Vec4};
use std::sync::LazyLock;

use crate::metrics::Label;
use crate::metrics::shot::{CENTRE, HEIGHT, LIGHT, RADIUS, Shot, WIDTH};
use crate::metrics::{MaskError, Region, Sign};
use crate::reference::Verdict;
use crate::reference::fixtures::{Random, Scene, square};

static SHOT: LazyLock<Shot> = LazyLock::new(|| Shot::sphere(LIGHT));

fn errors(mask: &[u8]) -> MaskError {
    SHOT.compare(mask).error()
}

/// A lit part of the floor, far from the shadow: rows and columns.
fn on_lit_floor(x: usize, y: usize) -> bool {
    (20..70).contains(&x) && (150..200).contains(&y)
}

/// A pixel in the middle of the shadow on the floor.
fn middle_of_shadow(shot: &Shot) -> DVec2 {
    let pixels: Vec<usize> = (0..WIDTH * HEIGHT)
        .filter(|&p| shot.is_floor(p) && shot.truth.verdict(p) == Verdict::Shadowed)
        .collect();
    let place = |&p: &usize| DVec2::new((p % WIDTH) as f64, (p / WIDTH) as f64);
    pixels.iter().map(place).sum::<DVec2>() / pixels.len() as f64
}

/// A line of pixels through a place, turned by an angle from the line through the light.
fn line(shot: &Shot, middle: DVec2, half_px: f64, degrees: f64) -> impl Fn(usize, usize) -> bool {
    let radial = shot.probe().radial_px(middle).unwrap();
    let along = DVec2::from_angle(degrees.to_radians()).rotate(radial);
    move |x, y| {
        let offset = DVec2::new(x as f64 + 0.5, y as f64 + 0.5) - middle;
        offset.perp_dot(along).abs() < 0.7 && offset.dot(along).abs() < half_px
    }
}

#[test]
fn an_exact_mask_has_no_labels() {
    let analysis = SHOT.analyse(&SHOT.truth.to_grey(), None);
    assert!(analysis.regions.is_empty());
    assert_eq!(analysis.label_counts().count(), 0);
}

#[test]
fn a_mask_moved_by_a_pixel_is_an_offset() {
    for (dx, dy) in [(1, 0), (0, 1), (-1, 0), (1, -1), (-1, -1)] {
        let truth = SHOT.truth.to_grey();
        let moved = |pixel: usize| {
            let (x, y) = ((pixel % WIDTH) as i64 - dx, (pixel / WIDTH) as i64 - dy);
            SHOT.truth
                .get(x, y)
                .map_or(0, |_| truth[y as usize * WIDTH + x as usize])
        };
        let mask: Vec<u8> = (0..truth.len()).map(moved).collect();
        let analysis = SHOT.analyse(&mask, None);
        assert_eq!(analysis.label_px(Label::Offset), errors(&mask).wrong_px());
        assert_eq!(analysis.label_counts().count(), 1, "moved by {dx}, {dy}");
    }
}

#[test]
fn a_mask_moved_by_three_pixels_is_none() {
    let mut mask = SHOT.truth.to_grey();
    mask.rotate_right(3);
    assert_eq!(SHOT.analyse(&mask, None).label_px(Label::Offset), 0);
}

#[test]
fn an_inverted_mask_is_inverted() {
    let mask = SHOT.plant(|x, y| SHOT.truth.verdict(y * WIDTH + x).is_surface());
    let analysis = SHOT.analyse(&mask, None);
    assert_eq!(analysis.label_px(Label::Inverted), errors(&mask).wrong_px());
    let all_shadowed = SHOT.analyse(&[255; WIDTH * HEIGHT], None);
    assert_eq!(all_shadowed.label_px(Label::Inverted), 0);
}

#[test]
fn speckle_and_stripes_on_a_lit_floor_are_acne() {
    let mut random = Random(7);
    let noise: Vec<bool> = (0..WIDTH * HEIGHT).map(|_| random.unit() < 0.2).collect();
    let speckle = SHOT.plant(|x, y| on_lit_floor(x, y) && noise[y * WIDTH + x]);
    let stripes = SHOT.plant(|x, y| on_lit_floor(x, y) && (x + 3 * y) % 7 < 3);
    let blobs = SHOT.plant(|x, y| on_lit_floor(x, y) && x % 10 < 6 && y % 10 < 6);
    for mask in [speckle, stripes, blobs] {
        let analysis = SHOT.analyse(&mask, None);
        assert_eq!(analysis.label_px(Label::Acne), errors(&mask).wrong_px());
        assert!(
            analysis
                .regions
                .iter()
                .all(|r| r.sign == Sign::FalseShadowed)
        );
    }
}

#[test]
fn a_streak_from_the_light_is_a_leak() {
    // Before the eye, behind it, and at infinity on either side.
    for light in [
        LIGHT,
        Vec4::new(5.0, 9.0, 9.0, 1.0),
        Vec4::new(0.4, 1.0, 0.3, 0.0),
        Vec4::new(-0.6, 1.0, -0.8, 0.0),
    ] {
        let shot = Shot::sphere(light);
        let lit = DVec2::new(45.0, 175.0);
        let streak = shot.plant(line(&shot, lit, 14.0, 0.0));
        assert_eq!(shot.only_label(&streak), Label::Leak, "{light}");
        let turned = shot.plant(line(&shot, lit, 14.0, 40.0));
        assert_eq!(shot.only_label(&turned), Label::Unlabelled, "{light}");
    }
}

#[test]
fn a_streak_of_light_or_of_dots_is_a_leak_too() {
    let shot = Shot::sphere(Vec4::new(2.0, 3.0, 1.0, 1.0));
    let middle = middle_of_shadow(&shot);
    let light = shot.plant(line(&shot, middle, 10.0, 0.0));
    let analysis = shot.analyse(&light, None);
    assert_eq!(analysis.regions[0].sign, Sign::FalseLit);
    assert_eq!(analysis.regions[0].label, Label::Leak, "{analysis:?}");
    let on_line = line(&shot, DVec2::new(45.0, 175.0), 24.0, 0.0);
    let dots = shot.plant(|x, y| on_line(x, y) && (7 * x + 13 * y).is_multiple_of(5));
    assert!(shot.analyse(&dots, None).regions.len() > 4);
    assert_eq!(shot.only_label(&dots), Label::Leak);
}

#[test]
fn a_blob_is_no_evidence() {
    let disc = |middle: DVec2| {
        move |x: usize, y: usize| DVec2::new(x as f64, y as f64).distance(middle) < 5.5
    };
    let in_light = SHOT.plant(disc(DVec2::new(45.0, 175.0)));
    assert_eq!(SHOT.only_label(&in_light), Label::Unlabelled);
    let in_shadow = SHOT.plant(disc(middle_of_shadow(&SHOT)));
    let analysis = SHOT.analyse(&in_shadow, None);
    assert_eq!(analysis.regions[0].sign, Sign::FalseLit);
    assert_eq!(
        analysis.label_px(Label::Unlabelled),
        errors(&in_shadow).artifact_px
    );
    // Few dots far apart are none either.
    let dots = SHOT.plant(|x, y| on_lit_floor(x, y) && x % 20 == 5 && y % 20 == 5);
    assert_eq!(SHOT.only_label(&dots), Label::Unlabelled);
}

#[test]
fn errors_of_several_kinds_are_told_apart() {
    let streak = line(&SHOT, DVec2::new(270.0, 190.0), 14.0, 0.0);
    let acne = |x: usize, y: usize| on_lit_floor(x, y) && (x * 7 + y * 13).is_multiple_of(5);
    let mask = SHOT.plant(|x, y| acne(x, y) || streak(x, y));
    let analysis = SHOT.analyse(&mask, None);
    let acne_px = errors(&SHOT.plant(acne)).wrong_px();
    let leak_px = errors(&SHOT.plant(&streak)).wrong_px();
    let found: Vec<_> = analysis.label_counts().collect();
    assert_eq!(found, [("acne", acne_px), ("leak", leak_px)]);
}

/// A wall on the floor, lit from behind, its shadow towards the eye.
fn wall() -> Shot {
    let at = |x: f32, y: f32| Vec3::new(x, y, 0.0);
    let [a, b, c, d] = [at(-1.0, 0.0), at(1.0, 0.0), at(1.0, 1.0), at(-1.0, 1.0)];
    let scene = Scene::default()
        .cast(&[[a, b, c], [a, c, d]])
        .receive(&square(8.0, 0.0));
    Shot::new(
        scene,
        Vec4::new(0.3, 2.0, -3.0, 0.0),
        Vec3::new(0.5, 3.0, 4.0),
    )
}

#[test]
fn light_under_a_wall_detaches_its_shadow() {
    let shot = wall();
    let probe = shot.probe();
    let band = |from: f64, to: f64| {
        shot.plant(|x, y| {
            let pixel = y * WIDTH + x;
            let point = probe.point(pixel).unwrap_or(DVec3::INFINITY);
            shot.is_floor(pixel)
                && shot.truth.verdict(pixel) == Verdict::Shadowed
                && (from..to).contains(&point.z)
        })
    };
    // A pixel is about 0.02 wide.
    let contact = shot.analyse(&band(0.0, 0.1), None);
    assert_eq!(
        contact.regions[0].label,
        Label::DetachedShadow,
        "{contact:?}"
    );
    let farther = shot.analyse(&band(0.5, 0.6), None);
    assert_eq!(farther.regions[0].label, Label::Unlabelled, "{farther:?}");
    let all_lit = shot.analyse(&[0; WIDTH * HEIGHT], None);
    assert_eq!(all_lit.label_px(Label::DetachedShadow), 0);
    // A map with large texels opens a wider gap by the same bias.
    let grid = |point: DVec3| {
        Some([
            0,
            (point.x / 0.1).floor() as i64,
            (point.z / 0.1).floor() as i64,
        ])
    };
    let wide = band(0.0, 0.4);
    assert_eq!(shot.analyse(&wide, None).label_px(Label::DetachedShadow), 0);
    let with_texels = shot.analyse(&wide, Some(&grid));
    assert_eq!(with_texels.regions[0].label, Label::DetachedShadow);
}

/// The texel of a grid on the floor.
fn texel(point: DVec3, side: f64) -> [i64; 3] {
    [
        0,
        (point.x / side).floor() as i64,
        (point.z / side).floor() as i64,
    ]
}

/// The mask of a map that answers for the centre of the texel.
fn map_mask(side: f64) -> Vec<u8> {
    let probe = SHOT.probe();
    let light = LIGHT.as_dvec4().truncate();
    let grey = SHOT.truth.to_grey();
    let look_up = |pixel: usize| {
        if !SHOT.is_floor(pixel) {
            return grey[pixel];
        }
        let [_, x, z] = texel(probe.point(pixel).unwrap(), side);
        let point = DVec3::new((x as f64 + 0.5) * side, 0.0, (z as f64 + 0.5) * side);
        let way = light - point;
        let nearest = point + (CENTRE - point).dot(way) / way.length_squared() * way;
        if nearest.distance(CENTRE) < RADIUS {
            255
        } else {
            0
        }
    };
    (0..WIDTH * HEIGHT).map(look_up).collect()
}

#[test]
fn steps_of_texels_are_a_staircase() {
    for side in [0.08, 0.3] {
        let mask = map_mask(side);
        let grid = move |point: DVec3| Some(texel(point, side));
        let analysis = SHOT.analyse(&mask, Some(&grid));
        let wrong_px = errors(&mask).wrong_px();
        let found = analysis.label_px(Label::Staircase);
        assert!(
            found * 20 >= wrong_px * 19,
            "{found} of {wrong_px}, texels of {side}"
        );
        // Without a grid, or with another, there is no evidence.
        assert_eq!(SHOT.analyse(&mask, None).label_px(Label::Staircase), 0);
        let other = move |point: DVec3| Some(texel(point + 0.37 * side, 1.3 * side));
        assert_eq!(
            SHOT.analyse(&mask, Some(&other)).label_px(Label::Staircase),
            0
        );
    }
}

#[test]
fn acne_beside_a_staircase_is_still_acne() {
    let side = 0.3;
    let acne = |pixel: usize| {
        let (x, y) = (pixel % WIDTH, pixel / WIDTH);
        on_lit_floor(x, y) && (x + 2 * y) % 9 < 4
    };
    let mut mask = map_mask(side);
    let stairs_px = errors(&mask).wrong_px();
    for pixel in (0..mask.len()).filter(|&pixel| acne(pixel)) {
        mask[pixel] = 255;
    }
    let acne_px = errors(&mask).wrong_px() - stairs_px;
    let grid = move |point: DVec3| Some(texel(point, side));
    let analysis = SHOT.analyse(&mask, Some(&grid));
    assert_eq!(analysis.label_px(Label::Acne), acne_px);
    assert!(analysis.label_px(Label::Staircase) * 20 >= stairs_px * 19);
}

#[test]
fn more_shadows_than_a_counter_holds_overflow() {
    let stack = |triangles: usize| {
        let one = |i: usize| square(1.0, 0.8 + 0.001 * i as f32)[0];
        let casters: Vec<[Vec3; 3]> = (0..triangles).map(one).collect();
        let scene = Scene::default().cast(&casters).receive(&square(8.0, 0.0));
        let shot = Shot::new(
            scene,
            Vec4::new(0.5, 1.0, 0.2, 0.0),
            Vec3::new(2.0, 3.0, 4.0),
        );
        let mask = shot.plant(|x, y| {
            let pixel = y * WIDTH + x;
            shot.is_floor(pixel) && shot.truth.verdict(pixel) == Verdict::Shadowed
        });
        let Region { label, sign, .. } = shot.analyse(&mask, None).regions[0];
        assert_eq!(sign, Sign::FalseLit);
        label
    };
    assert_eq!(stack(300), Label::Overflow);
    assert_eq!(stack(200), Label::Unlabelled);
}

#[test]
fn with_texels_a_lone_shadow_in_the_light_is_acne() {
    let dots = SHOT.plant(|x, y| on_lit_floor(x, y) && x % 20 == 5 && y % 20 == 5);
    let grid = |point: DVec3| Some(texel(point, 0.08));
    let analysis = SHOT.analyse(&dots, Some(&grid));
    assert_eq!(analysis.label_px(Label::Acne), errors(&dots).wrong_px());
}

#[test]
fn words_are_what_results_say() {
    let words = Label::ALL.map(Label::word).join(" ");
    assert_eq!(
        words,
        "acne detached_shadow leak staircase overflow uncovered seam grazing inverted offset unlabelled"
    );
    assert!(
        Label::ALL
            .iter()
            .enumerate()
            .all(|(i, &label)| label as usize == i)
    );
}

#[test]
fn what_a_map_does_not_cover_is_told_from_a_detached_shadow() {
    // All of the shadow is missing; the map covers the left half of the picture, or all of it.
    let mask = vec![0; WIDTH * HEIGHT];
    let middle = middle_of_shadow(&SHOT);
    let seam = SHOT
        .probe()
        .point(middle.y as usize * WIDTH + middle.x as usize);
    let seam = seam.unwrap();
    let half = |point: DVec3| (point.x < seam.x).then_some([0, 0, 0]);
    let none = |_: DVec3| None;
    let uncovered = |texel: &super::TexelLookup<'_>| {
        let analysis = SHOT.analyse(&mask, Some(texel));
        analysis.label_px(Label::Uncovered)
    };
    let wrong = errors(&mask);
    assert_eq!(uncovered(&none), wrong.artifact_px);
    assert_eq!(uncovered(&half), 0, "the region is covered in part");
    let analysis = SHOT.analyse(&mask, None);
    assert_eq!(analysis.label_px(Label::Uncovered), 0);
}
