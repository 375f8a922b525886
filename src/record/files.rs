//! What files a run left, so that a reader can tell one that was cut, emptied or exchanged since.

use anyhow::{Context, bail};
use serde::{Deserialize, Serialize};
use std::io::ErrorKind;
use std::path::Path;

/// A file of a run as it was when the run ended.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct FileRecord {
    /// Its path from the run's directory, with `/` between the parts.
    pub name: String,
    /// Its size.
    pub bytes: u64,
    /// Lines of a table, the header not counted; none for a picture.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rows: Option<u64>,
    /// Hash of its contents.
    pub blake3: String,
}

impl FileRecord {
    fn of(dir: &Path, name: String) -> anyhow::Result<Self> {
        let path = dir.join(&name);
        let bytes =
            std::fs::read(&path).with_context(|| format!("cannot read {}", path.display()))?;
        Ok(Self {
            rows: name.ends_with(TABLE).then(|| rows(&bytes)),
            name,
            bytes: bytes.len() as u64,
            blake3: blake3::hash(&bytes).to_hex().to_string(),
        })
    }

    /// What became of the file, if it is not as it was.
    fn damage(&self, dir: &Path) -> anyhow::Result<Option<String>> {
        let path = dir.join(&self.name);
        // A pipe would wait for a writer.
        if std::fs::metadata(&path).is_ok_and(|found| !found.is_file()) {
            return Ok(Some("is no file any more".to_owned()));
        }
        let bytes = match std::fs::read(&path) {
            Err(error) if error.kind() == ErrorKind::NotFound => {
                return Ok(Some("is missing".to_owned()));
            }
            bytes => bytes.with_context(|| format!("cannot read {}", path.display()))?,
        };
        let has = bytes.len() as u64;
        Ok(match self.rows {
            _ if blake3::hash(&bytes).to_hex().as_str() == self.blake3 => None,
            _ if has == 0 => Some("is empty".to_owned()),
            Some(rows_then) if rows(&bytes) != rows_then => Some(format!(
                "has {} rows where the run wrote {rows_then}",
                rows(&bytes)
            )),
            _ if has != self.bytes => Some(format!(
                "has {has} bytes where the run wrote {}",
                self.bytes
            )),
            _ => Some("is not what the run wrote".to_owned()),
        })
    }
}

const TABLE: &str = ".csv";

/// Lines but the header; names of scenes have no line breaks.
fn rows(table: &[u8]) -> u64 {
    let lines = table.iter().filter(|byte| **byte == b'\n').count() as u64;
    lines.saturating_sub(1)
}

/// The files of a run: its tables, if they are there, and all in its folders of pictures.
///
/// # Errors
/// When one cannot be read; the message names it.
pub fn file_records(dir: &Path, tables: &[&str], folder: &str) -> anyhow::Result<Vec<FileRecord>> {
    let tables = tables.iter().filter(|name| dir.join(name).is_file());
    let mut names: Vec<String> = tables.map(|name| (*name).to_owned()).collect();
    let pictures = dir.join(folder);
    let unreadable = || format!("cannot read {}", pictures.display());
    let mut found = Vec::new();
    for entry in pictures.read_dir().with_context(unreadable)? {
        let name = entry.with_context(unreadable)?.file_name();
        found.push(format!("{folder}/{}", name.to_string_lossy()));
    }
    found.sort();
    names.extend(found);
    let record = |name| FileRecord::of(dir, name);
    names.into_iter().map(record).collect()
}

/// Fails if a file is not as it was when the run ended; `head` is the file that says so. A picture may be missing: the
/// warning that comes back says so.
///
/// # Errors
/// When a table is missing, or a file was cut, emptied or exchanged; the message names it.
pub fn check_files(dir: &Path, head: &str, files: &[FileRecord]) -> anyhow::Result<Option<String>> {
    let mut missing = Vec::new();
    for file in files {
        let Some(damage) = file.damage(dir)? else {
            continue;
        };
        let is_table = file.rows.is_some();
        if !is_table && !dir.join(&file.name).exists() {
            missing.push(file.name.as_str());
            continue;
        }
        let way_out = if is_table {
            "restore the file or repeat the run"
        } else {
            "restore the file, or delete it to have a report without it"
        };
        bail!(
            "{} {damage}, as {head} says: {way_out}",
            dir.join(&file.name).display()
        );
    }
    Ok(missing.first().map(|first| match missing.len() {
        1 => format!("{first} is missing although the run wrote it"),
        all => format!(
            "{first} and {} more files are missing although the run wrote them",
            all - 1
        ),
    }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn every_damage_is_told_and_what_was_added_is_none() {
        let room = tempfile::tempdir().unwrap();
        let dir = room.path();
        fs::create_dir(dir.join("images")).unwrap();
        fs::write(dir.join("a.csv"), "x\n1\n2\n3\n").unwrap();
        fs::write(dir.join("images/b.png"), "picture").unwrap();
        let files = file_records(dir, &["a.csv", "not there.csv"], "images").unwrap();
        assert_eq!(files.len(), 2);
        assert_eq!((files[0].rows, files[1].rows), (Some(3), None));
        fs::write(dir.join("images/mine.png"), "added").unwrap();
        assert_eq!(check_files(dir, "run.json", &files).unwrap(), None);

        let error = |name: &str, text: &str| {
            let whole = fs::read(dir.join(name)).unwrap();
            fs::write(dir.join(name), text).unwrap();
            let error = check_files(dir, "run.json", &files)
                .unwrap_err()
                .to_string();
            fs::write(dir.join(name), whole).unwrap();
            assert!(error.contains(name), "{error}");
            error
        };
        assert!(error("a.csv", "x\n1\n").contains("1 rows where the run wrote 3"));
        assert!(error("a.csv", "").contains("is empty"));
        assert!(error("a.csv", "x\n1\n2\n4\n").contains("is not what the run wrote"));
        assert!(error("images/b.png", "").contains("is empty"));
        assert!(error("images/b.png", "pict").contains("4 bytes where the run wrote 7"));

        fs::remove_file(dir.join("images/b.png")).unwrap();
        let warning = check_files(dir, "run.json", &files).unwrap().unwrap();
        assert!(warning.contains("images/b.png is missing"), "{warning}");
        fs::remove_file(dir.join("a.csv")).unwrap();
        assert!(check_files(dir, "run.json", &files).is_err());
    }
}
