//! Runs held against the tables and claims of papers.
//!
//! [`published`] reads papers as data, `numbers` the numbers of their tables, `measured` finds a run's rows that belong
//! beside them, and a [`Sheet`] holds both. `claims` are a paper's own sentences, `judge` holds them against the
//! `evidence` in the sheets, and the [`Ledger`] tells the verdicts.

use std::path::Path;

use anyhow::Result;

use super::groups::Group;
use crate::output::{self, remove_stale, write_atomically};
use published::Publication;

pub(crate) mod ledger;
pub(crate) mod published;
pub(crate) mod sheet;

mod claims;
mod evidence;
mod judge;
mod measured;
mod numbers;
mod tables;

pub(crate) use ledger::Ledger;
pub(crate) use sheet::Sheet;

pub(crate) const PAPER_DIR: &str = "paper";

#[derive(Debug)]
pub(crate) struct Paper {
    pub published: &'static Publication,
    pub sheets: Vec<Sheet>,
    pub ledger: Ledger,
}

/// Holds the groups against all papers; those of which they have no cell are left out.
pub(crate) fn compare(groups: &[Group<'_>]) -> Result<Vec<Paper>> {
    let papers = published::papers()?.iter();
    papers
        .filter_map(|paper| Paper::compare(paper, groups).transpose())
        .collect()
}

impl Paper {
    /// Holds the groups against the paper; `None` where they have no cell of its tables.
    pub(super) fn compare(
        paper: &'static Publication,
        groups: &[Group<'_>],
    ) -> Result<Option<Self>> {
        let mut sheets = numbers::sheets(paper)?;
        measured::fill(&mut sheets, groups);
        let ledger = Ledger::new(paper, &sheets, groups)?;
        sheets.retain(Sheet::is_measured);
        Ok((!sheets.is_empty()).then_some(Self {
            published: paper,
            sheets,
            ledger,
        }))
    }

    /// The files of the tables and of the ledger: names and contents.
    fn files(&self) -> Result<Vec<(String, String)>> {
        let mut files = Vec::new();
        let mut add = |name: String, csv: String, markdown: String| {
            files.extend([
                (format!("{name}.csv"), csv),
                (format!("{name}.md"), markdown),
            ]);
        };
        for sheet in &self.sheets {
            let name = self.published.table_name(sheet.spec);
            add(name, sheet.csv()?, sheet.markdown());
        }
        let name = ledger_name(self.published);
        add(name, self.ledger.csv()?, self.ledger.markdown());
        Ok(files)
    }
}

fn ledger_name(paper: &Publication) -> String {
    format!("{}ledger", paper.prefix)
}

/// The names of all figures of papers that a report may have.
pub(super) fn figure_names() -> Result<Vec<String>> {
    let figures =
        |paper: &'static Publication| paper.tables.iter().map(|spec| paper.figure_name(spec));
    Ok(published::papers()?.iter().flat_map(figures).collect())
}

/// Writes the tables and the ledgers into the folder `paper` of `dir`, and removes from there what an
/// earlier report wrote and this one does not.
pub(super) fn write(dir: &Path, papers: &[Paper]) -> Result<()> {
    let dir = dir.join(PAPER_DIR);
    let files = papers.iter().map(Paper::files);
    let files = files.collect::<Result<Vec<_>>>()?.concat();
    if !files.is_empty() {
        output::create_dir_all(&dir)?;
    }
    for (name, text) in &files {
        write_atomically(&dir.join(name), text)?;
    }
    for paper in published::papers()? {
        let tables = paper.tables.iter().map(|spec| paper.table_name(spec));
        let stems = tables.chain([ledger_name(paper)]);
        for name in stems.flat_map(|stem| [format!("{stem}.csv"), format!("{stem}.md")]) {
            if files.iter().all(|(known, _)| *known != name) {
                remove_stale(&dir.join(name))?;
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests;
