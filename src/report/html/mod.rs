//! The report page: one file that needs nothing else, neither a network nor the run directory.
//!
//! Everything that comes from a run (names, reasons, configuration) goes through maud's escaping;
//! the plots escape their own text. The page has no script.

use anyhow::Result;
use maud::{DOCTYPE, Markup, PreEscaped, html};

use super::LegendEntry;
use super::format::count;
use super::load::Run;
use super::paper::Paper;
use super::pareto::Cloud;
use super::plots::Plot;
use crate::record::DeviceRecord;

mod banners;
mod bias;
mod errors;
mod gallery;
mod ledger;
mod merged;
mod paper;
mod pareto;
mod pictures;
mod provenance;
mod results;
mod stability;

pub(super) use merged::page as merged_page;
pub(super) use stability::page as stability_page;

const STYLE: &str = concat!(
    include_str!("../report.css"),
    include_str!("../stability.css")
);

/// The page of a run. Pictures are read from the run directory; one that is missing is left out.
pub fn page(
    run: &Run,
    paper: Option<&Paper>,
    clouds: &[Cloud],
    plots: &[Plot],
    legend: &[LegendEntry],
) -> Result<String> {
    let title = if run.info.title.is_empty() {
        "Benchmark run"
    } else {
        &run.info.title
    };
    let gallery = gallery::section(run, clouds, legend)?;
    let (pareto, plots): (Vec<&Plot>, Vec<&Plot>) = plots.iter().partition(|plot| plot.is_pareto());
    let mut links = vec![("results", "Results")];
    links.extend((!clouds.is_empty()).then_some(("pareto", "Accuracy against speed")));
    links.extend(errors::has_any(run).then_some(("errors", "Errors")));
    links.extend((!run.biases.is_empty()).then_some(("bias", "Bias")));
    links.extend(links_to(paper, !plots.is_empty()));
    links.extend(gallery.is_some().then_some(("pictures", "Pictures")));
    links.push(("provenance", "Provenance"));
    let main = html! {
        (banners::section(run))
        (results::section(run))
        (pareto::section(run, clouds, &pareto))
        (errors::section(run, gallery.is_some()))
        (bias::section(run))
        (paper_sections(paper))
        (plots_section(&plots))
        @if let Some(gallery) = gallery { (gallery) }
        (provenance::section(run))
    };
    Ok(shell(title, &facts(run), &links, &main))
}

/// The links to the sections that pages of one run and of several have in common.
fn links_to(paper: Option<&Paper>, has_plots: bool) -> Vec<(&'static str, &'static str)> {
    let mut links = Vec::new();
    if paper.is_some() {
        links.extend([("paper", "The paper's tables"), ("ledger", "Its claims")]);
    }
    links.extend(has_plots.then_some(("plots", "Plots")));
    links
}

fn paper_sections(paper: Option<&Paper>) -> Markup {
    html! {
        @if let Some(paper) = paper {
            (paper::section(&paper.sheets))
            (ledger::section(&paper.ledger))
        }
    }
}

/// A page around its content: title, facts and links above `main`.
fn shell(title: &str, facts: &Markup, links: &[(&str, &str)], main: &Markup) -> String {
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
                    (facts)
                    nav aria-label="Sections" {
                        @for (id, name) in links { a href={ "#" (id) } { (name) } }
                    }
                }
                main { (main) }
            }
        }
    };
    page.into_string()
}

/// What every number on the page depends on.
fn facts(run: &Run) -> Markup {
    let info = &run.info;
    let [device, driver] = device_facts(&info.device);
    facts_list(&[
        device,
        driver,
        ("Measured", date(&info.started)),
        ("Program", program(&info.program_version, &info.program_git)),
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
    ])
}

/// A name, and what stands under it.
type Fact = (&'static str, String);

fn facts_list(facts: &[Fact]) -> Markup {
    html! {
        dl.facts {
            @for (name, value) in facts {
                div { dt { (name) } dd { (value) } }
            }
        }
    }
}

fn device_facts(device: &DeviceRecord) -> [Fact; 2] {
    let driver = format!("{} {}", device.driver, device.driver_info);
    [
        ("Device", device.name.clone()),
        ("Driver", format!("{} · {}", driver.trim(), device.backend)),
    ]
}

fn program(version: &str, git: &str) -> String {
    format!("svbench {version} {git}").trim_end().to_owned()
}

/// An RFC 3339 time as people read it; as it is, where it is none.
fn date(rfc_3339: &str) -> String {
    rfc_3339.parse::<jiff::Timestamp>().map_or_else(
        |_| rfc_3339.to_owned(),
        |time| time.strftime("%-d %B %Y, %H:%M UTC").to_string(),
    )
}

fn plots_section(plots: &[&Plot]) -> Markup {
    html! {
        @if !plots.is_empty() {
            section #plots {
                h2 { "Plots" }
                div.plots { (figures(plots)) }
            }
        }
    }
}

fn figures(plots: &[&Plot]) -> Markup {
    html! {
        @for plot in plots {
            figure.plot.large[plot.is_pareto()] {
                div.scroll tabindex="0" role="img" aria-label=(alt(plot)) {
                    (PreEscaped(&plot.svg))
                }
            }
        }
    }
}

/// A value, or what stands where there is none.
fn or_dash(value: Option<String>) -> String {
    value.unwrap_or_else(|| "–".to_owned())
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
