//! Runs held against the tables and claims of papers.
//!
//! [`published`] reads papers as data, `numbers` the numbers of their tables, `measured` finds a run's rows that belong
//! beside them, and a [`Sheet`] holds both. [`claims`] are a paper's own sentences, `judge` holds them against the
//! sheets, and the [`Ledger`] tells the verdicts.

use std::path::Path;

use anyhow::Result;

use super::groups::Group;
use crate::output::{self, remove_stale, write_atomically};
use published::Publication;

pub mod claims;
pub mod finding;
pub mod ledger;
pub mod published;
pub mod series;
pub mod sheet;
pub mod tables;
pub mod value;

mod evidence;
mod judge;
mod measured;
mod numbers;
mod rules;

pub use ledger::Ledger;
pub use sheet::Sheet;

/// Name of the folder of the papers' tables in a report.
pub const PAPER_DIR: &str = "paper";

/// Runs beside a paper.
#[derive(Debug)]
pub struct Paper {
    /// The paper.
    pub published: &'static Publication,
    /// The tables for which anything was measured.
    pub sheets: Vec<Sheet>,
    /// The paper's claims and what became of them.
    pub ledger: Ledger,
}

/// Holds the groups against all papers; those of which they have no cell are left out.
pub fn compare(groups: &[Group<'_>]) -> Result<Vec<Paper>> {
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
        for sheet in &self.sheets {
            let name = self.published.table_name(sheet.spec);
            files.push((format!("{name}.csv"), sheet.csv()?));
            files.push((format!("{name}.md"), sheet.markdown()));
        }
        let name = ledger_name(self.published);
        files.push((format!("{name}.csv"), self.ledger.csv()?));
        files.push((format!("{name}.md"), self.ledger.markdown()));
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
    let files = papers
        .iter()
        .map(Paper::files)
        .collect::<Result<Vec<_>>>()?
        .concat();
    if !files.is_empty() {
        output::create_dir_all(&dir)?;
    }
    for (name, text) in &files {
        write_atomically(&dir.join(name), text)?;
    }
    for paper in published::papers()? {
        let tables = paper.tables.iter().map(|spec| paper.table_name(spec));
        for stem in tables.chain([ledger_name(paper)]) {
            for name in ["csv", "md"].map(|extension| format!("{stem}.{extension}")) {
                if files.iter().all(|(known, _)| *known != name) {
                    remove_stale(&dir.join(name))?;
                }
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests;
