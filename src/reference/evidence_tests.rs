use super::super::fixtures::{Scene, square, view};
use super::*;
use glam::{Vec3, Vec4};

/// Looks straight down on a floor with five squares above it.
fn scene() -> (Scene, ReferenceView) {
    let roofs = (2..7).map(|i| square(1.0, i as f32));
    let scene = roofs
        .fold(Scene::default(), |scene, roof| scene.cast(&roof))
        .receive(&square(20.0, 0.0));
    (
        scene,
        view(Vec3::new(30.0, 20.0, 0.0), Vec3::ZERO, 200, 200),
    )
}

#[test]
fn blockers_are_counted_and_the_nearest_is_measured() {
    let (scene, view) = scene();
    let reference = scene.reference();
    let ids = reference.visible_ids(&view).unwrap();
    // Straight from above: the shadow is the square itself, and its diagonal passes the centre.
    let probe = reference.evidence(Light::at(Vec4::Y), &view, &ids).unwrap();
    let mut shadowed = 0;
    for pixel in 0..view.pixel_count() {
        let Some(evidence) = probe.at(pixel).filter(|e| e.triangle >= scene.casters) else {
            continue;
        };
        let inside = evidence.point.x.abs() < 1.0 && evidence.point.z.abs() < 1.0;
        shadowed += u32::from(inside);
        assert_eq!(evidence.blockers, if inside { 5 } else { 0 });
        let nearest = evidence.nearest_blocker.unwrap_or(2.0);
        assert!((nearest - 2.0).abs() < 1e-9, "{nearest}");
    }
    assert!(shadowed > 20, "{shadowed}");
}

#[test]
fn a_pixel_is_as_wide_as_the_picture_says() {
    let (scene, view) = scene();
    let reference = scene.reference();
    let ids = reference.visible_ids(&view).unwrap();
    let probe = reference.evidence(Light::at(Vec4::Y), &view, &ids).unwrap();
    let at = |x: usize| probe.point(150 * 200 + x).unwrap();
    // The floor does not recede along a row.
    let found = probe.px_size(at(100));
    let expected = at(100).distance(at(101));
    assert!(
        (found / expected - 1.0).abs() < 0.02,
        "{found} is not {expected}"
    );
}

#[test]
fn lines_through_the_light_stay_so_in_the_picture() {
    let (scene, view) = scene();
    let reference = scene.reference();
    let ids = reference.visible_ids(&view).unwrap();
    let projection = Projection::new(&view).unwrap();
    let point = DVec3::new(1.0, 0.0, 2.0);
    // Before the eye, behind it, and at infinity on either side.
    for light in [
        Vec4::new(0.0, 9.0, 1.0, 1.0),
        Vec4::new(90.0, 70.0, 11.0, 1.0),
        Vec4::new(1.0, 2.0, 0.5, 0.0),
        Vec4::new(-1.0, 0.2, 0.5, 0.0),
    ] {
        let probe = reference.evidence(Light::at(light), &view, &ids).unwrap();
        let [one, other] = [-0.1, 0.1].map(|step| {
            let moved = point + step * probe.towards_light(point);
            projection.place_px(moved).unwrap()
        });
        let middle = projection.place_px(point).unwrap();
        let radial = probe.radial_px(middle).unwrap();
        let sine = radial.perp_dot((other - one).normalize()).abs();
        assert!(sine < 1e-6, "{light}: {sine}");
    }
}
