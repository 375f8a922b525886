use super::*;
use crate::geometry::EdgeCounts;

fn measured(method: &str, shadow_ms: f64, artifact_px: u64) -> Measured {
    Measured {
        method: method.to_owned(),
        shadow_ms: Ok(vec![shadow_ms, 2.0 * shadow_ms]),
        wrong_px: artifact_px + 1,
        artifact_px,
        drawn: method.starts_with("silhouette").then_some(DrawnVolumes {
            z_pass: 16,
            light_facing: 16,
            ..DrawnVolumes::default()
        }),
    }
}

fn advice(measured: Vec<Measured>) -> Advice {
    Advice {
        scene: "Spheres".to_owned(),
        shape: Shape {
            triangles: 100,
            objects: 2,
            closed_objects: 2,
            left_out: Some(7),
            closed_triangles: 100,
            edges: EdgeCounts {
                boundary: 0,
                manifold: 150,
                non_manifold: 0,
            },
            open_edges: 0,
            overdraw: Overdraw {
                infinity: 9.0,
                scene: 4.0,
                object: 2.0,
            },
        },
        frames: 8,
        verified: 2,
        size_px: (320, 240),
        measured,
        device: "a device".to_owned(),
    }
}

#[test]
fn the_fastest_exact_method_is_advised_and_a_faster_wrong_one_is_named() {
    let advice = advice(vec![
        measured(FULL, 40.0, 0),
        measured("silhouette_ts,plan=auto", 9.0, 30),
        measured("silhouette_gs,plan=auto", 10.0, 2),
        measured("cube_shadow_map", 20.0, 900),
    ]);
    let text = advice.to_string();
    assert!(
        text.contains("advice: silhouette_gs,plan=auto, 4.0 times as fast as silhouette_gs"),
        "{text}"
    );
    assert!(
        text.contains("100 % of the volumes drawn need no caps"),
        "{text}"
    );
    assert!(text.contains("cover 50 % less"), "{text}");
    let wrong = "faster, if some 16 wrong pixels a frame do not matter: silhouette_ts,plan=auto";
    assert!(text.contains(wrong), "{text}");
}

#[test]
fn where_all_are_wrong_none_is_advised_but_what_is_as_right_as_the_full_volumes() {
    let wrong = advice(vec![measured("cube_shadow_map", 20.0, 900)]);
    assert!(wrong.to_string().contains("advice: none"), "{wrong}");
    let alike = advice(vec![measured(FULL, 40.0, 7), measured("other", 20.0, 7)]);
    let picks: Vec<_> = alike.picks().iter().map(|method| &*method.method).collect();
    assert_eq!(picks, ["other"]);
}

#[test]
fn without_whole_volumes_or_a_plan_nothing_is_said_of_them() {
    let mut full = measured(FULL, 40.0, 0);
    full.shadow_ms = Err("needs geometry shaders".to_owned());
    let advice = advice(vec![full, measured("silhouette_cpu,counting=auto", 9.0, 0)]);
    let text = advice.to_string();
    assert!(
        text.ends_with("\nadvice: silhouette_cpu,counting=auto\n"),
        "{text}"
    );
}

#[test]
fn a_tie_has_no_winner_but_by_its_artifacts() {
    let tie = advice(vec![
        measured(FULL, 40.0, 0),
        measured("silhouette_cpu,plan=auto", 10.0, 2),
        measured("silhouette_gs,plan=auto", 10.8, 0),
        measured("silhouette_ts,plan=auto", 11.2, 0),
    ]);
    let text = tie.to_string();
    assert!(
        text.contains("advice: silhouette_gs,plan=auto, 3.7 times"),
        "{text}"
    );
    assert!(
        text.contains("as fast within a tenth: silhouette_cpu,plan=auto\n"),
        "{text}"
    );
    let none = advice(vec![
        measured(FULL, 40.0, 0),
        measured("silhouette_cpu,plan=auto", 38.0, 0),
    ]);
    let text = none.to_string();
    assert!(
        text.contains("none is clearly faster than silhouette_gs"),
        "{text}"
    );
    assert!(!text.contains("need no caps"), "{text}");
}
