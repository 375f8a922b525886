use super::*;
use proptest::prelude::*;

const BOX: Bounds = Bounds {
    low: DVec3::new(-1.0, 2.0, -1.5),
    high: DVec3::new(1.0, 4.0, 1.0),
};
const SCENE: Bounds = Bounds {
    low: DVec3::new(-20.0, 0.0, -20.0),
    high: DVec3::new(20.0, 12.0, 20.0),
};

/// Whether a ray meets the faces of the only box.
fn meets(faces: &VisibleFaces, eye: DVec3, along: DVec3) -> bool {
    let point = |corner: [f32; 4]| {
        let corner = DVec4::from_array(corner.map(f64::from));
        assert!(corner.w > 0.0, "these end in the scene");
        corner.truncate() / corner.w
    };
    faces.corners.chunks_exact(3).any(|corners| {
        let [a, b, c] = [0, 1, 2].map(|corner| point(corners[corner]) - eye);
        let sides = [a.cross(b), b.cross(c), c.cross(a)].map(|normal| normal.dot(along));
        let normal = (b - a).cross(c - a);
        let distance = normal.dot(a) / normal.dot(along);
        let same = sides.iter().all(|side| *side >= 0.0) || sides.iter().all(|side| *side <= 0.0);
        same && distance > 0.0
    })
}

fn is_in_shadow(point: DVec3, light: DVec4) -> bool {
    let towards = light.truncate() - point * light.w;
    let end = if light.w == 0.0 { f64::INFINITY } else { 1.0 };
    let (mut enter, mut leave) = (0.0f64, end);
    for axis in 0..3 {
        let at = |plane: f64| (plane - point[axis]) / towards[axis];
        let (one, other) = (at(BOX.low[axis]), at(BOX.high[axis]));
        enter = enter.max(one.min(other));
        leave = leave.min(one.max(other));
    }
    enter < leave
}

fn inside(bounds: Bounds) -> impl Strategy<Value = DVec3> {
    [0.0..1.0f64, 0.0..1.0, 0.0..1.0]
        .prop_map(move |share| bounds.low + DVec3::from_array(share) * (bounds.high - bounds.low))
}

proptest! {
    /// On the way from an eye in the light to any point in shadow, its surface is met.
    #[test]
    fn what_is_in_the_volume_is_behind_its_faces(
        eye in inside(SCENE),
        within in inside(BOX),
        down in 0.0..1.0f64,
        light in inside(Bounds { low: DVec3::new(-30.0, 5.0, -30.0), high: DVec3::new(30.0, 40.0, 30.0) }),
        is_lamp in any::<bool>(),
    ) {
        let light = if is_lamp { light.extend(1.0) } else { light.extend(0.0) };
        let lamp = Bounds { low: light.truncate(), high: light.truncate() };
        prop_assume!(!is_lamp || !BOX.may_meet(lamp));
        // From there away from the light, some of the way to the ground.
        let away = within * light.w - light.truncate();
        let point = within + away * (down * within.y / -away.y);
        let is_in_scene = point.cmpge(SCENE.low).all() && point.cmple(SCENE.high).all();
        prop_assume!(is_in_scene && !is_in_shadow(eye, light) && is_in_shadow(point, light));
        let planes = EndPlanes::new(SCENE, light.as_vec4(), &[eye]);
        prop_assume!(planes.of(BOX) != crate::geometry::EndPlane::INFINITY);
        let mut faces = VisibleFaces::default();
        faces.push_volume(BOX, light, &planes, eye);
        prop_assert!(meets(&faces, eye, point - eye));
        prop_assert_eq!(faces.ends, [faces.corners.len() as u32]);
    }

    /// And of the box itself.
    #[test]
    fn what_is_in_the_box_is_behind_its_faces(eye in inside(SCENE), point in inside(BOX)) {
        let here = Bounds { low: eye, high: eye };
        prop_assume!(!BOX.may_meet(here));
        let mut faces = VisibleFaces::default();
        faces.push_box(BOX, eye);
        prop_assert!(meets(&faces, eye, point - eye));
        prop_assert!(faces.corners.len() <= 18, "three faces at most");
    }
}

#[test]
fn faces_are_those_turned_to_the_eye() {
    let mut faces = VisibleFaces::default();
    faces.push_box(BOX, DVec3::new(0.0, 3.0, 9.0));
    assert_eq!(faces.corners.len(), 6);
    assert!(faces.corners.iter().all(|corner| corner[2] == 1.0));
    // From above, of the volume of a light above: the face under the light and no side.
    let light = DVec4::new(0.1, 30.0, 0.1, 1.0);
    let planes = EndPlanes::new(SCENE, light.as_vec4(), &[]);
    let mut faces = VisibleFaces::default();
    faces.push_volume(BOX, light, &planes, DVec3::new(0.1, 25.0, 0.1));
    assert_eq!(faces.corners.len(), 6);
    assert!(faces.corners.iter().all(|corner| corner[1] == 4.0));
}

#[test]
fn without_an_end_a_light_at_infinity_leaves_directions() {
    let light = DVec4::new(0.0, 0.0, 1.0, 0.0);
    let nowhere = EndPlanes::new(Bounds::EMPTY, light.as_vec4(), &[]);
    let mut faces = VisibleFaces::default();
    faces.push_volume(BOX, light, &nowhere, DVec3::new(0.0, 9.0, -5.0));
    assert!(faces.corners.iter().any(|corner| corner[3] == 0.0));
    for corner in &faces.corners {
        assert!(corner.iter().all(|x| x.is_finite()), "{corner:?}");
    }
}
