use glam::Vec4Swizzles;

use super::*;

fn view() -> View {
    View {
        eye: Vec3::new(3.0, 2.0, -7.0),
        target: Vec3::new(-1.0, 0.5, 4.0),
        up: Vec3::Y,
        fov_y_rad: 1.0,
        near: 0.1,
    }
}

#[test]
fn whole_degrees_are_the_radians_that_32_bits_make_of_them() {
    for degrees in [30u8, 45, 50, 60, 90] {
        let narrow = f32::from(degrees).to_radians();
        assert_eq!(radians(f64::from(degrees)), narrow, "{degrees}");
    }
}

#[test]
fn the_z_row_is_exact_and_depth_is_reversed() {
    let view = view();
    for matrix in [view.projection(1.6), view.view_projection(1.6)] {
        assert_eq!(matrix.row(2), Vec4::new(0.0, 0.0, 0.0, 0.1));
    }
    let depth = |p: Vec3| {
        let clip = view.view_projection(1.6) * p.extend(1.0);
        clip.z / clip.w
    };
    let forward = (view.target - view.eye).normalize();
    assert!((depth(view.eye + view.near * forward) - 1.0).abs() < 1e-4);
    assert!(depth(view.eye + 1e6 * forward) < 1e-6);
}

#[test]
fn right_is_right_and_up_is_up() {
    let view = View {
        eye: Vec3::Z * 5.0,
        target: Vec3::ZERO,
        ..view()
    };
    let clip = |p: Vec3| view.view_projection(2.0) * p.extend(1.0);
    assert_eq!(clip(Vec3::ZERO).xyw(), Vec3::new(0.0, 0.0, 5.0));
    assert!(clip(Vec3::X).x > 0.0 && clip(Vec3::Y).y > 0.0);
    // A point on the upper edge of the picture, and one on its right edge.
    let half_height = 5.0 * 0.5f32.tan();
    assert!((clip(Vec3::Y * half_height).y - 5.0).abs() < 1e-5);
    assert!((clip(Vec3::X * half_height * 2.0).x - 5.0).abs() < 1e-5);
}

#[test]
fn an_impossible_view_says_why() {
    let view = view();
    let check = |view: View, error| assert_eq!(view.validate(), Err(error));
    assert_eq!(view.validate(), Ok(()));
    check(
        View {
            target: view.eye,
            ..view
        },
        CameraError::NoDirection,
    );
    check(
        View {
            up: view.eye - view.target,
            ..view
        },
        CameraError::NoUp,
    );
    check(
        View {
            up: Vec3::ZERO,
            ..view
        },
        CameraError::NoUp,
    );
    check(View { near: 0.0, ..view }, CameraError::Near);
    check(
        View {
            fov_y_rad: 0.0,
            ..view
        },
        CameraError::FieldOfView,
    );
    check(
        View {
            fov_y_rad: 3.15,
            ..view
        },
        CameraError::FieldOfView,
    );
    check(
        View {
            near: f32::NAN,
            ..view
        },
        CameraError::NotFinite,
    );
    check(
        View {
            eye: Vec3::INFINITY,
            ..view
        },
        CameraError::NotFinite,
    );
}

#[test]
fn numbers_that_overflow_make_no_picture() {
    let view = view();
    let extreme =
        |view: View| assert_eq!(view.validate(), Err(CameraError::TooExtreme), "{view:?}");
    extreme(View {
        eye: Vec3::X * 3e38,
        target: Vec3::X * -3e38,
        ..view
    });
    extreme(View {
        fov_y_rad: 1e-42,
        ..view
    });
    extreme(View {
        eye: Vec3::new(2e38, 0.0, 5.0),
        target: Vec3::new(2e38, 0.0, 0.0),
        ..view
    });
}

#[test]
fn the_lengths_of_up_and_of_the_line_of_sight_do_not_matter() {
    let view = |up: f32, sight: f32| View {
        eye: Vec3::ZERO,
        target: Vec3::new(-3.0, 1.0, -2.0) * sight,
        up: Vec3::new(0.1, 1.0, 0.2) * up,
        fov_y_rad: 1.0,
        near: 0.1,
    };
    let expected = view(1.0, 1.0).view_projection(1.5);
    for scale in [
        2f32.powi(-120),
        2f32.powi(-70),
        2f32.powi(60),
        2f32.powi(120),
    ] {
        for view in [view(scale, 1.0), view(1.0, scale), view(scale, scale)] {
            assert_eq!(view.validate(), Ok(()), "{scale}");
            assert_eq!(view.view_projection(1.5), expected, "{scale}");
        }
    }
}
