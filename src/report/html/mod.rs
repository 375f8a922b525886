//! The report page: one file that needs nothing else, neither a network nor the run directory.
//!
//! Everything that comes from a run (names, reasons, configuration) goes through maud's escaping;
//! the plots escape their own text. The page has no script.

use anyhow::Result;
use maud::{DOCTYPE, Markup, PreEscaped, html};

use super::LegendEntry;
use super::format::count;
use super::load::Run;
use super::plots::Plot;

mod banners;
mod gallery;
mod provenance;
mod results;

const STYLE: &str = include_str!("../report.css");

/// The page of a run. Pictures are read from the run directory; one that is missing is left out.
pub fn page(run: &Run, plots: &[Plot], legend: &[LegendEntry]) -> Result<String> {
    let title = if run.info.title.is_empty() {
        "Benchmark run"
    } else {
        &run.info.title
    };
    let gallery = gallery::section(run, legend)?;
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="color-scheme" content="light dark";
                title { (title) " · svbench" }
                style { (PreEscaped(STYLE)) }
            }
            body {
                header {
                    p.kicker { "svbench · hard-shadow benchmark" }
                    h1 { (title) }
                    (facts(run))
                    nav aria-label="Sections" {
                        a href="#results" { "Results" }
                        @if !plots.is_empty() { a href="#plots" { "Plots" } }
                        @if gallery.is_some() { a href="#pictures" { "Pictures" } }
                        a href="#provenance" { "Provenance" }
                    }
                }
                main {
                    (banners::section(run))
                    (results::section(run))
                    (plots_section(plots))
                    @if let Some(gallery) = gallery { (gallery) }
                    (provenance::section(run))
                }
            }
        }
    };
    Ok(page.into_string())
}

/// What every number on the page depends on.
fn facts(run: &Run) -> Markup {
    let info = &run.info;
    let driver = format!("{} {}", info.device.driver, info.device.driver_info);
    let program = format!("{} {}", info.program_version, info.program_git);
    let facts = [
        ("Device", info.device.name.clone()),
        (
            "Driver",
            format!("{} · {}", driver.trim(), info.device.backend),
        ),
        ("Measured", date(&info.started)),
        ("Program", format!("svbench {}", program.trim())),
        ("Picture", format!("{} × {} px", info.width, info.height)),
        (
            "Frames per cell",
            format!(
                "{} measured, {} verified, {} to warm up",
                count(info.frames.into()),
                count(info.verified_frames.into()),
                count(info.warmup_frames.into())
            ),
        ),
    ];
    html! {
        dl.facts {
            @for (name, value) in &facts {
                div { dt { (name) } dd { (value) } }
            }
        }
    }
}

/// An RFC 3339 time as people read it; as it is, where it is none.
fn date(rfc_3339: &str) -> String {
    rfc_3339.parse::<jiff::Timestamp>().map_or_else(
        |_| rfc_3339.to_owned(),
        |time| time.strftime("%-d %B %Y, %H:%M UTC").to_string(),
    )
}

fn plots_section(plots: &[Plot]) -> Markup {
    html! {
        @if !plots.is_empty() {
            section #plots {
                h2 { "Plots" }
                div.plots {
                    @for plot in plots {
                        figure.plot {
                            div.scroll tabindex="0" role="img" aria-label=(alt(plot)) {
                                (PreEscaped(&plot.svg))
                            }
                        }
                    }
                }
            }
        }
    }
}

fn alt(plot: &Plot) -> String {
    format!("Plot: {}. The same figures are in the tables.", plot.title)
}

#[cfg(test)]
mod tests {
    use super::date;

    #[test]
    fn dates_are_for_people_and_nonsense_is_left_alone() {
        assert_eq!(date("2026-03-09T14:05:06+01:00"), "9 March 2026, 13:05 UTC");
        assert_eq!(date("yesterday"), "yesterday");
    }
}
