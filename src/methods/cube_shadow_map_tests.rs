use super::*;
use proptest::prelude::*;

proptest! {
    /// A point is seen on the face that it goes farthest in the direction of, inside of its picture,
    /// and on no other face's inside; and that face keeps any box around it.
    #[test]
    fn every_point_has_its_face(
        light in [-5.0f32..5.0, -5.0f32..5.0, -5.0f32..5.0].prop_map(Vec3::from_array),
        offset in [-9.0f32..9.0, -9.0f32..9.0, -9.0f32..9.0].prop_map(Vec3::from_array),
        half in 0.0f64..2.0,
    ) {
        let largest = offset.abs().max_element();
        prop_assume!(largest > 0.1);
        let point = light + offset;
        for face in faces() {
            let along = face.forward.dot(offset);
            let clip = face.view_projection(1e-5) * (point - light).extend(1.0);
            let inside = clip.w > 0.0 && clip.x.abs().max(clip.y.abs()) <= clip.w * 1.001;
            if along == largest {
                prop_assert!(inside, "{clip}");
                let around = Bounds {
                    low: point.as_dvec3() - half,
                    high: point.as_dvec3() + half,
                };
                prop_assert!(face.may_see(around, light.as_dvec3()));
            } else if along < largest * 0.99 {
                prop_assert!(!inside, "{clip}");
            }
        }
    }
}

#[test]
fn a_face_leaves_out_what_is_behind_it() {
    let behind = Bounds {
        low: DVec3::new(-3.0, -1.0, -1.0),
        high: DVec3::new(-2.0, 1.0, 1.0),
    };
    let seeing = faces().map(|face| face.may_see(behind, DVec3::ZERO));
    assert_eq!(seeing, [false, true, false, false, false, false]);
}
