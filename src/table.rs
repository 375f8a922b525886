//! CSV files: rows as people's programs may open them.
//!
//! A spreadsheet takes text that begins with `=`, `+`, `-`, `@` or a control character for a formula and runs it, and
//! names of scenes and reasons come from files that others wrote. Such text gets a `'` before it, by which
//! spreadsheets know text; reading takes it away again.

use crate::output;
use anyhow::Context;
use csv::StringRecord;
use serde::Serialize;
use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};

/// What makes a spreadsheet leave text alone.
const GUARD: char = '\'';

/// A file that grows row by row.
pub struct Table {
    path: PathBuf,
    file: File,
    is_empty: bool,
}

impl Table {
    /// Creates the file, without any row.
    ///
    /// # Errors
    /// When it cannot be created; the message names it.
    pub fn create(path: &Path) -> anyhow::Result<Self> {
        Ok(Self {
            path: path.to_owned(),
            file: output::create(path)?,
            is_empty: true,
        })
    }

    /// Appends rows, the first ones with their header, and makes sure that they are there.
    ///
    /// # Errors
    /// When they cannot be written; the message names the file.
    pub fn append<T: Serialize>(&mut self, rows: &[T]) -> anyhow::Result<()> {
        let text = text_of(rows, self.is_empty)?;
        self.is_empty &= rows.is_empty();
        self.file
            .write_all(&text)
            .with_context(|| format!("cannot write {}", self.path.display()))
    }
}

/// All of a file: a header and rows.
///
/// # Errors
/// When a row is none.
pub fn text<T: Serialize>(rows: &[T]) -> anyhow::Result<Vec<u8>> {
    text_of(rows, true)
}

/// All of a file whose rows do not name their columns.
///
/// # Errors
/// When a row is none, or has another number of cells than the header.
pub fn text_under<T: Serialize>(header: StringRecord, rows: &[T]) -> anyhow::Result<Vec<u8>> {
    let mut all = vec![header];
    all.extend(records_of(rows, false)?);
    text_of_records(&all)
}

/// Rows as records, the header first.
///
/// # Errors
/// When a row is none.
pub fn records<T: Serialize>(rows: &[T]) -> anyhow::Result<Vec<StringRecord>> {
    records_of(rows, true)
}

/// All of a file.
///
/// # Errors
/// When the records differ in length.
pub fn text_of_records(records: &[StringRecord]) -> anyhow::Result<Vec<u8>> {
    let mut guarded = csv::Writer::from_writer(Vec::new());
    for record in records {
        guarded.write_record(record.iter().map(guard))?;
    }
    Ok(guarded
        .into_inner()
        .map_err(csv::IntoInnerError::into_error)?)
}

fn text_of<T: Serialize>(rows: &[T], with_header: bool) -> anyhow::Result<Vec<u8>> {
    text_of_records(&records_of(rows, with_header)?)
}

fn records_of<T: Serialize>(rows: &[T], with_header: bool) -> anyhow::Result<Vec<StringRecord>> {
    let mut plain = csv::WriterBuilder::new()
        .has_headers(with_header)
        .from_writer(Vec::new());
    rows.iter().try_for_each(|row| plain.serialize(row))?;
    let plain = plain
        .into_inner()
        .map_err(csv::IntoInnerError::into_error)?;
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .from_reader(&*plain);
    Ok(reader.records().collect::<Result<_, _>>()?)
}

fn guard(cell: &str) -> String {
    match is_formula(cell) {
        true => format!("{GUARD}{cell}"),
        false => cell.to_owned(),
    }
}

/// A row as it was before it was written.
pub fn unguarded(record: &StringRecord) -> StringRecord {
    let cells = record.iter().map(|cell| match cell.strip_prefix(GUARD) {
        Some(text) if is_formula(text) => text,
        _ => cell,
    });
    let mut unguarded: StringRecord = cells.collect();
    unguarded.set_position(record.position().cloned());
    unguarded
}

/// Whether a spreadsheet might run the text, guarded or not: guards are counted in, so that one can always be taken
/// away that was put there.
fn is_formula(cell: &str) -> bool {
    let text = cell.trim_start_matches([GUARD, ' ']);
    let is_number = || text.ends_with(|c: char| c.is_ascii_digit()) && text.parse::<f64>().is_ok();
    text.starts_with(['=', '+', '-', '@', '\t', '\r', '\n']) && !is_number()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use serde::Deserialize;

    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
    struct Row {
        name: String,
        number: f64,
    }

    fn row(name: &str, number: f64) -> Row {
        let name = name.to_owned();
        Row { name, number }
    }

    fn read(text: &[u8]) -> Vec<Row> {
        let mut reader = csv::Reader::from_reader(text);
        let header = reader.headers().unwrap().clone();
        let record = |record: csv::Result<StringRecord>| {
            unguarded(&record.unwrap())
                .deserialize(Some(&header))
                .unwrap()
        };
        reader.records().map(record).collect()
    }

    #[test]
    fn text_that_would_run_is_guarded_and_numbers_are_not() {
        let rows = [
            row("=cmd()", -1.5),
            row("  @SUM(1)", 1e-9),
            row("\t=1", 0.0),
            row("-2+3", 0.0),
            row("-inf", 0.0),
            row("sponza", 2.0),
            row("-5", 1.0),
            row("'=1", 1.0),
        ];
        let text = String::from_utf8(text(&rows).unwrap()).unwrap();
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(
            lines,
            [
                "name,number",
                "'=cmd(),-1.5",
                "'  @SUM(1),1e-9",
                "'\t=1,0.0",
                "'-2+3,0.0",
                "'-inf,0.0",
                "sponza,2.0",
                "-5,1.0",
                "''=1,1.0"
            ]
        );
        assert_eq!(read(text.as_bytes()), rows);
    }

    #[test]
    fn a_table_grows_and_has_one_header() {
        let room = tempfile::tempdir().unwrap();
        let path = room.path().join("t.csv");
        let mut table = Table::create(&path).unwrap();
        table.append::<Row>(&[]).unwrap();
        assert_eq!(std::fs::read(&path).unwrap(), b"");
        table.append(&[row("a", 1.0)]).unwrap();
        table.append(&[row("=b", 2.0)]).unwrap();
        assert_eq!(
            std::fs::read(&path).unwrap(),
            b"name,number\na,1.0\n'=b,2.0\n"
        );
    }

    proptest! {
        #[test]
        fn any_text_comes_back_and_none_runs(name in "['=+@ \t\r\n-]{0,4}\\PC{0,6}") {
            let rows = [row(&name, 1.0)];
            let text = text(&rows).unwrap();
            prop_assert_eq!(read(&text), rows);
            let mut raw = csv::Reader::from_reader(&*text);
            let raw = raw.records().next().unwrap().unwrap();
            let first = raw[0].trim_start().chars().next().unwrap_or('x');
            prop_assert!(!"=+-@".contains(first) || raw[0].trim().parse::<f64>().is_ok());
        }
    }
}
