use super::*;
use crate::scene::Part;
use glam::Vec4;
use proptest::prelude::*;

fn triangle(size: f32) -> Mesh {
    let corners = [Vec3::ZERO, Vec3::X, Vec3::Y].map(|p| p * size);
    [Part::of_triangles("", &[corners])].into_iter().collect()
}

fn path(w: f32, keys: &[(f64, [f32; 3])]) -> LightKeys {
    let key = |&(time_s, place): &(f64, [f32; 3])| LightKey {
        time_s,
        place: place.into(),
    };
    LightKeys {
        keys: keys.iter().map(key).collect(),
        w,
        radius: 0.0,
    }
}

#[test]
fn one_key_is_a_light_that_stands_still() {
    for light in [
        Vec4::new(0.3, -1e-39, 7.0, 1.0),
        Vec4::new(0.3, 1.0, 0.1, 0.0),
    ] {
        let still = LightKeys::still(Light::at(light));
        assert_eq!((still.duration_s(), still.validate()), (0.0, Ok(())));
        for time_s in [-1.0, 0.0, 0.5, 9.0] {
            let found = still.light_at(time_s).place.to_array().map(f32::to_bits);
            assert_eq!(found, light.to_array().map(f32::to_bits));
        }
    }
}

#[test]
fn a_point_moves_as_a_camera_does() {
    let line = path(1.0, &[(0.0, [0.0, 4.0, 0.0]), (2.0, [8.0, 4.0, -2.0])]);
    assert_eq!(line.duration_s(), 2.0);
    let middle = line.light_at(0.5).place;
    assert_eq!(middle, Vec4::new(2.0, 4.0, -0.5, 1.0));
    assert_eq!(line.light_at(99.0).place, Vec4::new(8.0, 4.0, -2.0, 1.0));
    // What is between keys lies on the grid of positions too, where no number is denormal.
    let near = path(1.0, &[(0.0, [0.0, 1.0, 0.0]), (3.0, [1e-12, 1.0, -1e-12])]);
    let place = near.light_at(1.0).place.truncate();
    assert_eq!(place, canonical(place));
}

#[test]
fn a_direction_turns_evenly() {
    let quarter = path(0.0, &[(0.0, [1.0, 0.0, 0.0]), (1.0, [0.0, 0.5, 0.0])]);
    let middle = quarter.light_at(0.5);
    assert_eq!(middle.place, Vec4::new(1.0, 1.0, 0.0, 0.0));
    assert_eq!(middle.validate(), Ok(()));
    // There and back through the origin: no direction half-way.
    let over = path(0.0, &[(0.0, [0.0, 1.0, 0.0]), (1.0, [0.0, -1.0, 0.0])]);
    assert_eq!(over.validate(), Ok(()), "its keys are good");
    assert_eq!(over.light_at(0.25).place, Vec4::Y);
    assert_eq!(over.light_at(0.5).validate(), Err(LightError::NoDirection));
}

#[test]
fn an_impossible_path_says_why_and_where() {
    let error = |path: LightKeys| path.validate().map_err(|e| (e.key, e.problem));
    let place = [1.0, 2.0, 3.0];
    assert_eq!(error(path(1.0, &[])), Err((None, LightError::NoKeys)));
    for (times_s, key) in [
        (vec![1.0], 0),
        (vec![0.0, 0.0], 1),
        (vec![0.0, f64::INFINITY], 1),
        (vec![0.0, 2.0, 1.0], 2),
    ] {
        let keys: Vec<_> = times_s.iter().map(|&time_s| (time_s, place)).collect();
        assert_eq!(
            error(path(1.0, &keys)),
            Err((Some(key), LightError::KeyTimes))
        );
    }
    let blind = path(0.0, &[(0.0, place), (1.0, [0.0; 3])]);
    assert_eq!(error(blind), Err((Some(1), LightError::NoDirection)));
    let half = path(0.5, &[(0.0, place)]);
    assert_eq!(error(half), Err((Some(0), LightError::Weight(0.5))));
}

#[test]
fn a_light_beyond_what_a_scene_can_tell_is_a_direction() {
    for size in [1e-3, 1.0, 1e6] {
        let towards = |distance: f32| Vec3::new(0.3, 1.0, -0.2) * distance * size;
        let placed = |distances: &[f32]| {
            let keys = distances.iter().enumerate();
            let keys: Vec<_> = keys
                .map(|(i, distance)| (i as f64, towards(*distance).to_array()))
                .collect();
            path(1.0, &keys).of_scene(&triangle(size))
        };
        assert_eq!(placed(&[1e7]).light_at(0.0).place, towards(1e7).extend(1.0));
        for distance in [1e9, 1e20, 1e30] {
            let expected = Vec3::new(0.3, 1.0, -0.2);
            let found = placed(&[distance]).light_at(0.0).place;
            assert_eq!(found.w, 0.0);
            assert!((found.truncate() - expected).length() < 1e-6, "{found}");
        }
        // One path is of one kind.
        let both = placed(&[1e7, 1e9]);
        assert_eq!(both.light_at(1.0).place, towards(1e9).extend(1.0));
        assert_eq!(placed(&[1e9, 2e9]).w, 0.0);
    }
    // Without a size nothing is far.
    let still = LightKeys::still(Light::at(Vec4::ONE));
    assert_eq!(still.clone().of_scene(&Mesh::default()), still);
}

proptest! {
    #[test]
    fn the_path_passes_through_its_keys(
        places in prop::collection::vec(prop::array::uniform3(-9.0f32..9.0), 1..6),
        w in 0u8..2,
    ) {
        prop_assume!(places.iter().all(|p| Vec3::from_array(*p).length() > 1e-3));
        let mut time_s = 0.0;
        let keys: Vec<_> = places
            .iter()
            .map(|place| {
                let key = (time_s, *place);
                time_s += 0.1 + f64::from(place[0].abs());
                key
            })
            .collect();
        let path = path(f32::from(w), &keys).of_scene(&triangle(1.0));
        prop_assert_eq!(path.validate(), Ok(()));
        prop_assert_eq!(path.clone().of_scene(&triangle(1.0)), path.clone());
        for key in &path.keys {
            let found = path.light_at(key.time_s).place;
            prop_assert_eq!(found.to_array().map(f32::to_bits), key.place.extend(f32::from(w)).to_array().map(f32::to_bits));
            // Neither does the path jump there.
            let beside = path.light_at(key.time_s + 1e-6).place;
            prop_assert!((beside - found).length() < 1e-2, "{} {}", beside, found);
        }
    }
}
