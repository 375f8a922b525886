use super::*;

fn sample(frame_ms: f64, shadow_ms: f64) -> Sample {
    Sample {
        frame_ms,
        shadow_ms,
        gbuffer_ms: 1.0,
        cpu_ms: 0.5,
        ..Sample::default()
    }
}

#[test]
fn a_summary_is_the_statistics_of_its_samples() {
    let cell = Cell {
        scene: "s".into(),
        triangles: Some(12),
        ..Cell::default()
    };
    let frame = |metrics: &[(&str, f64)]| VerifiedFrame {
        metrics: metrics.iter().copied().collect(),
        ..VerifiedFrame::default()
    };
    let errors = [
        frame(&[("false_lit", 0.0), ("false_shadowed", 0.0)]),
        frame(&[
            ("false_lit", 3.0),
            ("false_shadowed", 0.0),
            ("label.leak", 3.0),
            ("distance_px_max", 7.5),
            ("flip", 0.5),
        ]),
    ];
    let samples = [sample(10.0, 4.0), sample(20.0, 8.0), sample(30.0, 6.0)];
    let summary = Summary::from_samples(&cell, &samples, &errors, Status::Ok, "");
    assert_eq!(summary.frames, 3);
    assert_eq!(summary.fps, Some(50.0));
    assert_eq!(summary.frame_ms_median, Some(20.0));
    assert_eq!(summary.frame_ms_mean, Some(20.0));
    assert_eq!(summary.shadow_ms_median, Some(6.0));
    assert_eq!(summary.shadow_ms_p95, Some(7.8));
    assert_eq!(summary.gbuffer_ms_median, Some(1.0));
    assert_eq!(
        (summary.false_lit, summary.false_shadowed),
        (Some(3), Some(0))
    );
    assert_eq!(summary.verified_frames, 2);
    assert_eq!(summary.metrics.px("label.leak"), Some(3));
    assert_eq!(summary.metrics.get("distance_px_max"), Some(7.5));
    assert_eq!(summary.metrics.get("flip"), Some(0.5));
    assert_eq!(summary.metrics.get("flicker_px"), None);
}

#[test]
fn nothing_measured_leaves_empty_fields() {
    let summary =
        Summary::from_samples(&Cell::default(), &[], &[], Status::Unavailable, "no stage");
    assert_eq!(summary.fps, None);
    let records = summary_records(std::slice::from_ref(&summary)).unwrap();
    let text = String::from_utf8(table::text_of_records(&records).unwrap()).unwrap();
    let (header, row) = text.trim_end().split_once('\n').unwrap();
    assert_eq!(
        header,
        "scene,triangles,objects,method,variant,width,height,frames,fps,frame_ms_median,\
         shadow_ms_median,shadow_ms_p95,gbuffer_ms_median,false_lit,false_shadowed,\
         artifact_px,ambiguous_px,status,reason,boundary_px,verified_frames,frame_ms_p95,\
         cpu_ms_median,frame_ms_mean,record_ms_median,draw_calls,\
         compared_px,distance_px_max,regions,largest_region_px,followed_px,flicker_px,flip_mean"
    );
    assert_eq!(
        row,
        ",,,,,0,0,0,,,,,,,,,,unavailable,no stage,,0,,,,,,,,,,,,"
    );
    let back: Summary = csv::Reader::from_reader(text.as_bytes())
        .deserialize()
        .next()
        .unwrap()
        .unwrap();
    assert_eq!(back, summary);
}
