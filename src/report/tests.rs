//! The outputs as a whole, over made-up run directories.

use std::fs;

use tempfile::TempDir;

mod exporters;

use super::fixture::{
    HOSTILE, LEGEND, cell, counted, info, made_up_run, samples, swept_run, write_rows, write_run,
};
use super::*;
use crate::record::{
    IMAGES_DIR, ImageKind, METRICS_FILE, RUN_FILE, RunStatus, SAMPLES_FILE, SUMMARY_FILE, Status,
    Summary, VerifiedFrame, image_name, metric_rows,
};
use crate::variant::Variant;

/// The page alone: PNGs take most of a report's time, and few tests read them.
fn html_of(dir: &TempDir) -> String {
    let run = Run::read(dir.path()).unwrap();
    let clouds = pareto::clouds(&run);
    let mut plots = plots::draw_pareto(&run, &clouds).unwrap();
    plots.extend(plots::draw(&run).unwrap());
    html::page(&run, &[], &clouds, &plots, &LEGEND).unwrap()
}

#[test]
fn the_table_groups_by_scene_and_shows_times_errors_and_reasons() {
    let dir = made_up_run();
    let table = results::markdown(&Run::read(dir.path()).unwrap());
    let lines: Vec<&str> = table.lines().collect();
    assert!(
        lines[2].starts_with("| **grid_n10**, 1,000 tri, 4 obj"),
        "{table}"
    );
    let fields = |line: &str| {
        line.split('|')
            .map(|f| f.trim().to_owned())
            .collect::<Vec<_>>()
    };
    // 1237 false lit pixels in two frames, 1234 of them artifacts.
    assert_eq!(
        fields(lines[3])[1..12],
        [
            "fast", "307.7", "3.250", "2.008", "2.015", "1.000", "618.5", "0", "617.0", "8.5",
            "wrong"
        ]
    );
    assert_eq!(
        fields(lines[4])[4],
        "**5.008**",
        "only a method without artifacts is best: {table}"
    );
    assert_eq!(
        fields(lines[5])[11],
        "unavailable: the device has no geometry stage"
    );
    let widths: Vec<usize> = lines[..5].iter().map(|line| line.chars().count()).collect();
    assert!(widths.iter().all(|width| *width == widths[0]), "{table}");
}

/// A run of five methods, one with many parameters, for whose scene `sponza` there is no model.
fn run_without_a_model() -> (TempDir, &'static str) {
    let dir = tempfile::tempdir().unwrap();
    let mut info = info(&["grid_n10", "sponza"], &["silhouette_ts", "triangle_gs"]);
    info.methods[1].variant = "counting=z_pass,determinism=none".parse().unwrap();
    let reason = "the model crytek_sponza.obj is in none of the places searched: scenes/models";
    info.scenes[1].status = Status::Skipped;
    info.scenes[1].reason = reason.to_owned();
    let (mut all, mut summaries) = (Vec::new(), Vec::new());
    for method in &info.methods {
        let mut measured = cell(&info, "grid_n10", &method.id, 1000);
        measured.variant = method.variant.clone();
        let own = samples(&measured, 2.0);
        let errors = [counted(0, 0, 0, 0, 0)];
        summaries.push(Summary::from_samples(
            &measured,
            &own,
            &errors,
            Status::Ok,
            "",
        ));
        all.extend(own);
        let mut skipped = cell(&info, "sponza", &method.id, 0);
        skipped.variant = method.variant.clone();
        summaries.push(Summary::from_samples(
            &skipped,
            &[],
            &[],
            Status::Skipped,
            reason,
        ));
    }
    write_run(dir.path(), &info, &all, &summaries);
    (dir, reason)
}

#[test]
fn why_a_scene_was_skipped_is_said_once() {
    let (dir, reason) = run_without_a_model();
    let table = results::markdown(&Run::read(dir.path()).unwrap());
    let group = table
        .lines()
        .find(|line| line.contains("**sponza**"))
        .unwrap();
    assert!(
        group.ends_with(&format!("| skipped: {reason} |")),
        "{table}"
    );
    assert_eq!(table.matches(reason).count(), 1, "{table}");
    assert_eq!(table.matches("silhouette_ts").count(), 1, "{table}");
    let page = html_of(&dir);
    let (_, results) = page.split_once("<section id=\"results\"").unwrap();
    let (results, _) = results.split_once("</table>").unwrap();
    assert_eq!(results.matches(reason).count(), 1);
    assert_eq!(results.matches(">silhouette_ts<").count(), 1);
    // Variants break between parameters, names of methods nowhere.
    assert!(results.contains("counting=z_pass,<wbr>determinism=none<wbr>"));
}

#[test]
fn the_page_holds_every_figure_of_the_summary() {
    let dir = made_up_run();
    let page = html_of(&dir);
    let mut reader = csv::Reader::from_path(dir.path().join(SUMMARY_FILE)).unwrap();
    let (_, figures) = page.split_once("All figures, unrounded").unwrap();
    for record in reader.records().map(|record| record.unwrap()) {
        for field in record.iter().filter(|field| !field.is_empty()) {
            assert!(
                figures.contains(&format!(">{field}<")),
                "{field} is missing"
            );
        }
    }
}

#[test]
fn the_page_needs_nothing_else() {
    let dir = made_up_run();
    let images = dir.path().join(IMAGES_DIR);
    fs::create_dir(&images).unwrap();
    fs::write(
        images.join(image_name(
            "grid_n10",
            "fast",
            &Variant::default(),
            ImageKind::Mask,
        )),
        b"png",
    )
    .unwrap();
    let page = html_of(&dir);
    assert!(page.contains("src=\"data:image/png;base64,cG5n\""));
    assert!(page.contains("alt=\"grid_n10, fast: shadow mask\""));
    assert!(page.contains("background:rgb(230,60,40)"));
    let foreign = page.replace("http://www.w3.org/2000/svg", "");
    for request in ["http:", "https:", "<script", "<link", "@import", "url("] {
        assert!(!foreign.contains(request), "{request}");
    }
}

#[test]
fn names_cannot_break_out_of_the_outputs() {
    let dir = tempfile::tempdir().unwrap();
    let info = info(&[HOSTILE], &[HOSTILE]);
    let cell = cell(&info, HOSTILE, HOSTILE, 10);
    let own = samples(&cell, 2.0);
    let summary = Summary::from_samples(&cell, &own, &[], Status::Unverified, "a|b\n<img src=x>");
    write_run(dir.path(), &info, &own, &[summary]);
    let page = html_of(&dir);
    assert!(
        !page.contains("<script") && !page.contains("<img src=x"),
        "not escaped"
    );
    assert!(page.contains("&lt;script&gt;"));
    let table = results::markdown(&Run::read(dir.path()).unwrap());
    assert!(table.contains("a\\|b \\<img src=x>"), "{table}");
}

#[test]
fn banners_say_what_spoils_the_run() {
    let dir = made_up_run();
    let page = html_of(&dir);
    assert!(page.contains("2 cells are wrong."));
    assert!(!page.contains("This run was interrupted") && !page.contains("Software device"));

    let mut info = Run::read(dir.path()).unwrap().info;
    info.status = RunStatus::Interrupted;
    info.device.device_type = "Cpu".to_owned();
    fs::write(
        dir.path().join(RUN_FILE),
        serde_json::to_string(&info).unwrap(),
    )
    .unwrap();
    let page = html_of(&dir);
    assert!(page.contains("This run was interrupted.") && page.contains("Software device."));
}

#[test]
fn every_plot_is_written_as_svg_and_png_and_nothing_half_written_stays() {
    let dir = made_up_run();
    write_all(dir.path(), &LEGEND).unwrap();
    let plots = dir.path().join(plots::PLOTS_DIR);
    let names = [
        "pareto_all",
        "pareto_grid_n10",
        "pareto_grid_n20",
        "shadow_time_by_triangles",
        "shadow_time_by_scene",
        "flight_grid_n10",
        "flight_grid_n20",
    ];
    for name in names {
        let svg = fs::read_to_string(plots.join(format!("{name}.svg"))).unwrap();
        assert!(
            svg.contains("slow") && svg.trim_end().ends_with("</svg>"),
            "{name}"
        );
        let png = fs::read(plots.join(format!("{name}.png"))).unwrap();
        assert!(
            png.starts_with(b"\x89PNG") && png.len() > 5000,
            "{name}: {} bytes",
            png.len()
        );
    }
    assert_eq!(fs::read_dir(&plots).unwrap().count(), 2 * names.len());
    let files = fs::read_dir(dir.path()).unwrap();
    assert!(
        files
            .flatten()
            .all(|file| !file.file_name().to_string_lossy().contains("partial"))
    );
}

#[test]
fn a_run_without_samples_still_has_a_report() {
    let dir = tempfile::tempdir().unwrap();
    write_run(dir.path(), &info(&["grid"], &["fast"]), &[], &[]);
    let page = fs::read_to_string(write_all(dir.path(), &LEGEND).unwrap()).unwrap();
    assert!(page.contains("Nothing was measured."));
    let table = fs::read_to_string(dir.path().join(TABLE_FILE)).unwrap();
    assert_eq!(table, "Nothing was measured.\n");
}

#[test]
fn a_folder_that_is_no_run_is_named_as_such() {
    let dir = tempfile::tempdir().unwrap();
    let error = format!("{:#}", write_all(dir.path(), &LEGEND).unwrap_err());
    assert!(
        error.contains("not a run directory") && error.contains(RUN_FILE),
        "{error}"
    );

    write_run(dir.path(), &info(&[], &[]), &[], &[]);
    fs::remove_file(dir.path().join(SAMPLES_FILE)).unwrap();
    let error = format!("{:#}", write_all(dir.path(), &LEGEND).unwrap_err());
    assert!(
        error.contains(SAMPLES_FILE) && error.contains("missing"),
        "{error}"
    );
}

#[test]
fn a_newer_format_is_refused_by_its_number() {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join(RUN_FILE), r#"{"format": 99}"#).unwrap();
    let error = format!("{:#}", write_all(dir.path(), &LEGEND).unwrap_err());
    assert!(error.contains("format 99"), "{error}");
}

#[test]
fn a_malformed_row_is_reported_with_file_and_line() {
    let dir = made_up_run();
    let path = dir.path().join(SAMPLES_FILE);
    let text = fs::read_to_string(&path).unwrap();
    fs::write(&path, text.replacen("grid_n10,1000", "grid_n10,many", 2)).unwrap();
    let error = format!("{:#}", write_all(dir.path(), &LEGEND).unwrap_err());
    assert!(
        error.contains("samples.csv, line 2") && error.contains("invalid digit"),
        "{error}"
    );

    fs::write(&path, format!("{text}only,three,fields\n")).unwrap();
    let error = format!("{:#}", write_all(dir.path(), &LEGEND).unwrap_err());
    assert!(
        error.contains("line 14") && error.contains("3 fields"),
        "{error}"
    );
}

#[test]
fn a_run_that_was_cut_off_is_read_as_far_as_it_goes() {
    let dir = made_up_run();
    let mut info = Run::read(dir.path()).unwrap().info;
    info.status = RunStatus::Running;
    fs::write(
        dir.path().join(RUN_FILE),
        serde_json::to_string(&info).unwrap(),
    )
    .unwrap();
    fs::remove_file(dir.path().join(SUMMARY_FILE)).unwrap();
    let path = dir.path().join(SAMPLES_FILE);
    let text = fs::read_to_string(&path).unwrap();
    fs::write(&path, &text[..text.len() - 20]).unwrap();

    let run = Run::read(dir.path()).unwrap();
    assert_eq!(run.samples.len(), 11);
    assert_eq!(run.summaries.len(), 4);
    assert!(
        run.summaries
            .iter()
            .all(|row| row.status == Status::Unverified)
    );
    assert_eq!(run.summaries[3].frames, 2);
    assert_eq!(
        run.warnings,
        ["the last row of samples.csv is torn and was left out"]
    );
}

#[test]
fn the_chart_names_every_point_and_marks_zero() {
    let dir = swept_run();
    let run = Run::read(dir.path()).unwrap();
    let clouds = pareto::clouds(&run);
    let plots = plots::draw_pareto(&run, &clouds).unwrap();
    let names: Vec<&str> = plots.iter().map(|plot| plot.name.as_str()).collect();
    assert_eq!(
        names,
        [
            "pareto_all",
            "pareto_grid_n10",
            "pareto_grid_n20",
            "pareto_sponza",
            "errors_by_resolution_grid_n10",
            "errors_by_pcf_grid_n10",
            "errors_by_resolution_grid_n20",
            "errors_by_pcf_grid_n20",
            "errors_by_resolution_sponza",
            "errors_by_pcf_sponza",
        ]
    );
    let by_pcf: Vec<&str> = plots[9].svg.lines().map(str::trim).collect();
    for name in [
        "pcf (log scale)",
        "cube_shadow_map",
        "slope_bias=2",
        "artifacts",
    ] {
        assert!(by_pcf.contains(&name), "{name}");
    }
    for (plot, cloud) in plots.iter().zip(&clouds) {
        let texts: Vec<&str> = plot.svg.lines().map(str::trim).collect();
        for point in &cloud.points {
            let name = match &point.sweep {
                Some(sweep) if sweep.parameter == "pcf" => format!("pcf {}", sweep.value),
                Some(sweep) => sweep.value.to_string(),
                None => point.contender.label(),
            };
            assert!(texts.contains(&&*name), "{name} in {}", plot.name);
        }
        for name in ["by resolution", "slope_bias=2 by pcf", "0"] {
            assert!(texts.contains(&name), "{name} in {}", plot.name);
        }
    }
}

#[test]
fn the_page_shows_charts_errors_regions_and_biases() {
    let dir = swept_run();
    let page = html_of(&dir);
    let places: Vec<usize> = ["results", "pareto", "errors", "bias", "plots", "provenance"]
        .iter()
        .map(|name| page.find(&format!("<section id=\"{name}\">")).unwrap())
        .collect();
    assert!(places.is_sorted(), "{places:?}");
    let (_, errors) = page.split_once("<section id=\"errors\">").unwrap();
    let (errors, rest) = errors.split_once("</section>").unwrap();
    // The map of 512 texels on Sponza: 27,000 and 29,700 wrong pixels in its frames, a quarter of
    // them artifacts; a tenth of them flickers.
    for text in [
        ">28,350.0<",
        ">7,087.5<",
        ">75 %<",
        ">100 %<",
        ">acne 7,087.5, leak 3,150.0<",
        ">2,835.0<",
    ] {
        assert!(errors.contains(text), "{text}: {errors}");
    }
    // Three regions in each of two frames of the twelve cells with artifacts there.
    assert!(errors.contains("(1 of 72)") && errors.contains(">1,234<") && errors.contains("10–40"));
    let (_, bias) = rest.split_once("<section id=\"bias\">").unwrap();
    for text in [">2.25<", ">4321.5<", ">77.2<"] {
        assert!(bias.contains(text), "{text}");
    }
}

#[test]
fn what_an_earlier_report_said_of_accuracy_and_speed_goes_with_its_points() {
    let dir = made_up_run();
    write_all(dir.path(), &LEGEND).unwrap();
    let plots = dir.path().join(plots::PLOTS_DIR);
    let (csv, all) = (dir.path().join("pareto.csv"), plots.join("pareto_all.png"));
    assert!(csv.is_file() && all.is_file());
    fs::write(
        plots.join("pareto_renamed_scene.svg"),
        "an earlier report's",
    )
    .unwrap();
    write_all(dir.path(), &LEGEND).unwrap();
    assert!(!plots.join("pareto_renamed_scene.svg").exists() && all.is_file());

    let text = fs::read_to_string(dir.path().join(SUMMARY_FILE)).unwrap();
    let unverified = text.replace(",ok,", ",unverified,");
    fs::write(dir.path().join(SUMMARY_FILE), unverified).unwrap();
    write_all(dir.path(), &LEGEND).unwrap();
    assert!(!csv.exists() && !all.exists());
}

#[test]
fn a_verified_scene_with_a_hostile_name_is_escaped_in_chart_and_tables() {
    let dir = tempfile::tempdir().unwrap();
    let info = info(&[HOSTILE], &[HOSTILE]);
    let cell = cell(&info, HOSTILE, HOSTILE, 10);
    let own = samples(&cell, 2.0);
    let found = [(format!("label.{HOSTILE}"), 5.0)];
    let counts = counted(5, 0, 0, 0, 0);
    let counts = counts
        .metrics
        .iter()
        .map(|(name, value)| (name.to_owned(), value));
    let wrong = VerifiedFrame {
        scene: cell.scene.clone(),
        method: cell.method.clone(),
        width: cell.width,
        height: cell.height,
        metrics: counts.chain(found).collect(),
        ..VerifiedFrame::default()
    };
    let rows = metric_rows([&wrong]);
    let summary = Summary::from_samples(&cell, &own, &[wrong], Status::Ok, "");
    write_run(dir.path(), &info, &own, &[summary]);
    write_rows(dir.path(), METRICS_FILE, &rows);
    let page = html_of(&dir);
    assert!(page.contains("id=\"pareto\"") && page.contains("id=\"errors\""));
    assert!(!page.contains("<script"), "not escaped");
}

#[test]
fn a_page_of_too_many_pictures_links_to_those_of_lesser_cells() {
    let dir = swept_run();
    let images = dir.path().join(IMAGES_DIR);
    fs::create_dir(&images).unwrap();
    let picture = |method: &str, variant: &str, bytes: usize| {
        let name = image_name(
            "sponza",
            method,
            &variant.parse().unwrap(),
            ImageKind::Error,
        );
        fs::write(images.join(&name), vec![0; bytes]).unwrap();
        name
    };
    let front = picture("shadow_map", "resolution=512", 12 << 20);
    let dominated = picture("triangle_ts", "", 12 << 20);
    let page = html_of(&dir);
    let link = |name: &str| format!("href=\"images/{name}\"");
    assert!(page.contains(&link(&dominated)) && !page.contains(&link(&front)));
    assert!(page.contains("too many for one page"));
    assert!(page.len() < 30 << 20, "{} bytes", page.len());

    picture("triangle_ts", "", 1000);
    let page = html_of(&dir);
    assert!(!page.contains("too many for one page") && !page.contains("href=\"images/"));
}
