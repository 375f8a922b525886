use glam::Vec4Swizzles;
use proptest::prelude::*;

use super::*;

fn path(times_s: &[f64]) -> CameraPath {
    let key = |(i, &time_s): (usize, &f64)| {
        let i = i as f32;
        CameraKey {
            time_s,
            eye: Vec3::new(i, i * i, 5.0),
            target: Vec3::new(i, 0.0, -i * i * i),
        }
    };
    let keys = times_s.iter().enumerate().map(key).collect();
    CameraPath {
        keys,
        up: Vec3::Y,
        fov_y_rad: 1.0,
        near: 0.1,
    }
}

#[test]
fn the_path_passes_through_its_keys() {
    let path = path(&[0.0, 1.0, 1.5, 4.0]);
    assert_eq!(path.validate(), Ok(()));
    for key in &path.keys {
        let view = path.view_at(key.time_s);
        assert_eq!((view.eye, view.target), (key.eye, key.target));
    }
    assert_eq!(path.view_at(-1.0), path.view_at(0.0));
    assert_eq!(path.view_at(99.0), path.view_at(4.0));
}

#[test]
fn its_velocity_has_no_jumps() {
    let path = path(&[0.0, 1.0, 1.5, 4.0]);
    for key in &path.keys[1..3] {
        let at = |offset_s| path.view_at(key.time_s + offset_s).eye;
        let step_s = 1e-3;
        let [before, after] = [at(0.0) - at(-step_s), at(step_s) - at(0.0)];
        assert!(
            (before - after).length() / step_s as f32 <= 0.05,
            "{before} {after}"
        );
    }
}

#[test]
fn two_keys_make_a_line_and_one_a_still() {
    let line = path(&[0.0, 2.0]);
    assert!(line.view_at(0.5).eye.distance(Vec3::new(0.25, 0.25, 5.0)) < 1e-6);
    let still = path(&[0.0]);
    assert_eq!(
        (still.duration_s(), still.view_at(3.0)),
        (0.0, still.view_at(0.0))
    );
}

#[test]
fn an_impossible_path_says_why_and_where() {
    let error = |path: &CameraPath| path.validate().map_err(|e| (e.key, e.problem));
    assert_eq!(error(&path(&[])), Err((None, CameraError::NoKeys)));
    for (times_s, key) in [
        (vec![1.0], 0),
        (vec![0.0, 0.0], 1),
        (vec![0.0, f64::NAN], 1),
        (vec![0.0, 2.0, 1.0], 2),
    ] {
        assert_eq!(
            error(&path(&times_s)),
            Err((Some(key), CameraError::KeyTimes))
        );
    }
    let mut downwards = path(&[0.0, 1.0]);
    downwards.keys[1].target = downwards.keys[1].eye - Vec3::Y;
    assert_eq!(error(&downwards), Err((Some(1), CameraError::NoUp)));
}

#[test]
fn a_framed_box_is_in_the_picture() {
    let (low, high) = (Vec3::new(-1.0, -2.0, 5.0), Vec3::new(4.0, 3.0, 6.0));
    let path = CameraPath::framing(low, high);
    assert_eq!(path.validate(), Ok(()));
    let matrix = path.view_at(0.0).view_projection(1.0);
    for corner in [
        low,
        high,
        low.with_x(high.x),
        low.with_y(high.y),
        high.with_z(low.z),
    ] {
        let clip = matrix * corner.extend(1.0);
        assert!(clip.w > path.near && clip.xy().abs().max_element() <= clip.w);
    }
    assert_eq!(CameraPath::framing(low, low).validate(), Ok(()));
}

proptest! {
    #[test]
    fn the_path_stays_near_its_keys(fraction in 0f64..1.0) {
        let path = path(&[0.0, 1.0, 1.5, 4.0]);
        let eye = path.view_at(fraction * 4.0).eye;
        prop_assert!((-1.0..=4.0).contains(&eye.x) && (eye.z - 5.0).abs() < 1e-5);
    }
}
