//! The page of a profile: pictures and tables in one file that needs no other and no network.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::Context;
use base64::Engine;
use base64::engine::general_purpose::STANDARD as BASE64;
use maud::{Markup, html};

use super::draw::Profile;
use super::info::ProfileInfo;
use super::rows::{HourRow, MethodRow};
use super::{FILM_FILE, HOURS_FILE, OVERLAY_FILE, PAGE_FILE};
use crate::output;
use crate::report::html::shell::{self, Section};

/// A page holds pictures up to this size together; to those that do not fit it links.
const MAX_BYTES: u64 = 22 << 20;

/// Writes the page into the directory of a profile, and gives its path.
///
/// # Errors
/// When a picture is missing, or the page cannot be written.
pub fn write_page(dir: &Path, info: &ProfileInfo, profile: &Profile) -> anyhow::Result<PathBuf> {
    let mut left_bytes = MAX_BYTES;
    let mut picture = |file: &str, alt: &str| -> anyhow::Result<Markup> {
        let address = address(dir, file, &mut left_bytes)?;
        Ok(html! {
            figure { a href=(file) { img src=(address) alt=(alt) style="max-width:100%;height:auto"; } }
        })
    };
    let pictures = html! {
        h3 { "Shadows of the day" }
        (picture(OVERLAY_FILE, "The shadows of all steps over each other, coloured by time")?)
        h3 { "Hours in sun" }
        (picture(HOURS_FILE, "Hours in sun per pixel, by the ray-traced truth")?)
        h3 { "Film of the day" }
        (picture(FILM_FILE, "The scene under the sun, step by step")?)
    };
    let mut by_method = Vec::new();
    for (name, file) in &profile.method_pictures {
        by_method
            .push(html! { h3 { (name) } (picture(file, &format!("Hours in sun by {name}"))?) });
    }
    let mut sections = vec![Section::new("pictures", "Pictures", pictures)];
    if !profile.methods.is_empty() {
        let content =
            html! { (methods(info, &profile.methods)) @for part in &by_method { (part) } };
        sections.push(Section::new("methods", "Methods", content));
    }
    sections.push(Section::new("steps", "Steps", steps(&profile.steps)));
    let title = format!("Shadow profile of {}, {}", info.title, info.date);
    let page = shell::page(&title, &facts(info, profile), &html! {}, &sections);
    let path = dir.join(PAGE_FILE);
    output::write_atomically(&path, page)?;
    Ok(path)
}

/// The picture itself if it fits, else the file.
fn address(dir: &Path, file: &str, left_bytes: &mut u64) -> anyhow::Result<String> {
    let path = dir.join(file);
    let unreadable = || format!("cannot read {}", path.display());
    let size = fs::metadata(&path).with_context(unreadable)?.len();
    match left_bytes.checked_sub(size) {
        None => Ok(file.to_owned()),
        Some(left) => {
            *left_bytes = left;
            let png = fs::read(&path).with_context(unreadable)?;
            Ok(format!("data:image/png;base64,{}", BASE64.encode(png)))
        }
    }
}

fn facts(info: &ProfileInfo, profile: &Profile) -> Markup {
    let degrees = |value: f64, [positive, negative]: [&str; 2]| {
        let side = if value < 0.0 { negative } else { positive };
        format!("{}° {side}", value.abs())
    };
    let place = format!(
        "{}, {}",
        degrees(info.latitude_deg, ["N", "S"]),
        degrees(info.longitude_deg, ["E", "W"])
    );
    let time = format!(
        "{} from {} to {} ({})",
        info.date, info.from, info.to, info.zone
    );
    let steps = format!(
        "{} of {:.4} minutes",
        profile.steps.len(),
        info.step_minutes
    );
    let vector = |[x, y, z]: [f64; 3]| format!("({x}, {y}, {z})");
    let device = &info.device;
    let program = format!("svbench {} {}", info.program_version, info.program_git);
    shell::facts(&[
        ("Place", place),
        ("Time", time),
        ("Steps", steps.replace(".0000", "")),
        (
            "North and up",
            format!("{}, {}", vector(info.north), vector(info.up)),
        ),
        ("Device", device.name.clone()),
        (
            "Driver",
            format!("{} {}", device.driver, device.driver_info)
                .trim()
                .to_owned(),
        ),
        ("Picture", format!("{} × {} px", info.width, info.height)),
        ("Program", program.trim_end().to_owned()),
        ("Took", format!("{:.1} s", info.duration_s)),
    ])
}

fn methods(info: &ProfileInfo, rows: &[MethodRow]) -> Markup {
    let number = |value: Option<f64>, decimals: usize| {
        value.map_or("–".to_owned(), |value| format!("{value:.decimals$}"))
    };
    let count = |value: Option<u64>| value.map_or("–".to_owned(), |value| value.to_string());
    let percent = |share: Option<f64>| number(share.map(|share| 100.0 * share), 4);
    html! {
        p.note {
            "How many minutes of sun a method is off, against the ray-traced truth, over the pixels that show a "
            "surface. Steps that the truth cannot decide at a pixel are left out of that pixel's error; how many "
            "minutes that is stands in the last column."
        }
        div.scroll { table {
            thead { tr {
                th.method { "method" }
                th { "mean, minutes" } th { "95th percentile" } th { "worst" }
                th { "within " (format!("{:.4}", info.step_minutes).trim_end_matches('0').trim_end_matches('.')) " minutes, %" }
                th { "pixels" } th { "with an undecided step" } th { "undecided, mean minutes" }
            } }
            tbody { @for row in rows { tr {
                th.method { code { (row.name()) } @if !row.reason.is_empty() { small { (row.status) ": " (row.reason) } } }
                td { (number(row.error_minutes_mean, 4)) }
                td { (number(row.error_minutes_p95, 1)) }
                td { (number(row.error_minutes_worst, 1)) }
                td { (percent(row.within_step_share)) }
                td { (count(row.surface_px)) }
                td { (count(row.ambiguous_px)) }
                td { (number(row.ambiguous_minutes_mean, 4)) }
            } } }
        } }
    }
}

fn steps(rows: &[HourRow]) -> Markup {
    html! {
        div.scroll { table {
            thead { tr {
                th { "local time" } th { "stands for, minutes" } th { "azimuth" } th { "elevation" }
                th { "in sun, %" } th { "lit px" } th { "shadowed px" } th { "ambiguous px" }
            } }
            tbody { @for row in rows { tr {
                td { (row.local_time) }
                td { (format!("{:.1}", row.minutes)) }
                td { (format!("{:.2}°", row.sun_azimuth_deg)) }
                td { (format!("{:.2}°", row.sun_elevation_deg)) }
                td { (format!("{:.2}", 100.0 * row.lit_share)) }
                td { (row.lit_px) } td { (row.shadowed_px) } td { (row.ambiguous_px) }
            } } }
        } }
    }
}
