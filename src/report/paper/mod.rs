//! Runs held against the tables and claims of Milet, Kobrtek, Zemčík and Pečiva, *Fast and Robust
//! Tessellation-Based Silhouette Shadows*, 2014.
//!
//! [`spec`] says what the tables are made of, `published` reads the paper's numbers, `measured` finds
//! a run's rows that belong beside them, and a [`Sheet`] holds both. [`claims`] are the paper's own
//! sentences, [`check`] holds them against the sheets, and the [`Ledger`] tells the verdicts.

use std::path::Path;

use anyhow::Result;

use super::groups::Group;
use crate::output::{self, remove_stale, write_atomically};

pub mod check;
pub mod claims;
pub mod ledger;
pub mod sheet;
pub mod spec;
pub mod tables;

mod evidence;
mod judge;
mod measured;
mod published;

pub use ledger::Ledger;
pub use sheet::Sheet;

/// Name of the folder of the paper's tables in a report.
pub const PAPER_DIR: &str = "paper";
const LEDGER: &str = "ledger";

/// Runs beside the paper.
#[derive(Debug)]
pub struct Paper {
    /// The tables for which anything was measured.
    pub sheets: Vec<Sheet>,
    /// The paper's claims and what became of them.
    pub ledger: Ledger,
}

impl Paper {
    /// Holds the groups against the paper; `None` where they have no cell of its tables.
    pub fn compare(groups: &[Group<'_>]) -> Result<Option<Self>> {
        let mut sheets = published::sheets()?;
        measured::fill(&mut sheets, groups);
        let ledger = Ledger::new(&sheets, groups)?;
        sheets.retain(Sheet::is_measured);
        Ok((!sheets.is_empty()).then_some(Self { sheets, ledger }))
    }
}

/// The names of all figures of the paper that a report may have.
pub(super) fn figure_names() -> impl Iterator<Item = String> {
    spec::SPECS.iter().map(spec::Spec::figure_name)
}

/// Writes the tables and the ledger into the folder `paper` of `dir`, and removes from there what an
/// earlier report wrote and this one does not; so does `None`, which writes nothing.
pub(super) fn write(dir: &Path, paper: Option<&Paper>) -> Result<()> {
    let dir = dir.join(PAPER_DIR);
    let mut files: Vec<(String, [String; 2])> = Vec::new();
    if let Some(Paper { sheets, ledger }) = paper {
        output::create_dir_all(&dir)?;
        for sheet in sheets {
            files.push((sheet.spec.table_name(), [sheet.csv()?, sheet.markdown()]));
        }
        files.push((LEDGER.to_owned(), [ledger.csv()?, ledger.markdown()]));
    }
    let stems = spec::SPECS
        .iter()
        .map(spec::Spec::table_name)
        .chain([LEDGER.to_owned()]);
    for stem in stems {
        let texts = files.iter().find(|(known, _)| *known == stem);
        for (index, extension) in ["csv", "md"].into_iter().enumerate() {
            let path = dir.join(format!("{stem}.{extension}"));
            match texts {
                Some((_, texts)) => write_atomically(&path, &texts[index])?,
                None => remove_stale(&path)?,
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests;
