//! The report page: one file that needs nothing else, neither a network nor the run directory.
//!
//! Everything that comes from a run (names, reasons, configuration) goes through maud's escaping;
//! the plots escape their own text. The page has no script. Longer prose is in `notes`.

use anyhow::Result;

use super::LegendEntry;
use super::load::Run;
use super::paper::Paper;
use super::pareto::Cloud;
use super::plots::Plot;

mod banners;
mod errors;
mod gallery;
mod merged;
mod paper;
mod pareto;
mod pictures;
mod provenance;
mod results;
pub(crate) mod shell;
mod stability;

pub(super) use merged::page as merged_page;
pub(super) use stability::page as stability_page;

/// The page of a run. Pictures are read from the run directory; one that is missing is left out.
pub(crate) fn page(
    run: &Run,
    papers: &[Paper],
    clouds: &[Cloud],
    plots: &[Plot],
    legend: &[LegendEntry],
) -> Result<String> {
    let title = match run.info.title.as_str() {
        "" => "Benchmark run",
        title => title,
    };
    let gallery = gallery::section(run, clouds, legend)?;
    let (pareto, plots): (Vec<&Plot>, Vec<&Plot>) = plots.iter().partition(|plot| plot.is_pareto);
    let mut sections = vec![results::section(run)];
    sections.extend(pareto::section(run, clouds, &pareto));
    sections.extend(errors::section(run, gallery.is_some()));
    sections.extend(errors::biases(run));
    sections.extend(papers.iter().flat_map(paper::sections));
    sections.extend(shell::plots(&plots));
    sections.extend(gallery);
    sections.push(provenance::section(run));
    let facts = provenance::run_facts(&run.info);
    Ok(shell::page(title, &facts, &banners::of(run), &sections))
}
