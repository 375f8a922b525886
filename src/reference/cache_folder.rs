//! The folder of the cache: which files in it are its own, and that they do not grow over a bound.

use crate::output::PARTIAL_PREFIX;
use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

/// Begins the name of every file that the cache writes.
pub(super) const PREFIX: &str = "reference-";
/// Ends the name of a mask.
pub(super) const MASK_SUFFIX: &str = ".png";

/// Hexadecimal digits of a key.
const KEY_DIGITS: usize = 64;

/// Writing a mask takes seconds at most: an unfinished file that is older was left by a killed process.
const LONGEST_WRITE: Duration = Duration::from_secs(3600);

/// What a file in the folder is, by its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Mask,
    /// A mask of version 0.4 or older, which nobody reads any more.
    OldMask,
    Unfinished,
    Foreign,
}

impl Kind {
    fn of(name: &str) -> Self {
        let is_key = |text: &str| {
            let is_digit = |c: u8| c.is_ascii_digit() || (b'a'..=b'f').contains(&c);
            text.len() == KEY_DIGITS && text.bytes().all(is_digit)
        };
        let ours = name.strip_prefix(PREFIX);
        if name.starts_with(PARTIAL_PREFIX) {
            Self::Unfinished
        } else if ours
            .and_then(|rest| rest.strip_suffix(MASK_SUFFIX))
            .is_some_and(is_key)
        {
            Self::Mask
        } else if name.strip_suffix(MASK_SUFFIX).is_some_and(is_key) {
            Self::OldMask
        } else {
            Self::Foreign
        }
    }
}

/// A mask in the folder, by the time of its last use.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Entry {
    used: SystemTime,
    path: PathBuf,
    bytes: u64,
}

/// The masks in the folder, the one whose last use is the longest ago on top. Other processes may add,
/// use and remove masks meanwhile.
#[derive(Debug, Default)]
pub(super) struct Contents {
    masks: BinaryHeap<Reverse<Entry>>,
    bytes: u64,
}

impl Contents {
    /// Looks through the folder; removes what processes that were killed left unfinished.
    pub(super) fn scan(dir: &Path) -> Self {
        let mut contents = Self::default();
        let now = SystemTime::now();
        for file in std::fs::read_dir(dir).into_iter().flatten().flatten() {
            let kind = file.file_name().to_str().map_or(Kind::Foreign, Kind::of);
            // Of a link this is the link itself.
            let Ok(data) = file.metadata() else { continue };
            let Ok(used) = data.modified() else { continue };
            if !data.is_file() {
                continue;
            }
            match kind {
                Kind::Mask => contents.push(file.path(), used, data.len()),
                Kind::OldMask => contents.push(file.path(), SystemTime::UNIX_EPOCH, data.len()),
                Kind::Unfinished if is_left_over(used, now) => remove(&file.path()),
                Kind::Unfinished | Kind::Foreign => {}
            }
        }
        contents
    }

    fn push(&mut self, path: PathBuf, used: SystemTime, bytes: u64) {
        self.bytes += bytes;
        self.masks.push(Reverse(Entry { used, path, bytes }));
    }

    /// Counts a mask that this process has just written.
    pub(super) fn add(&mut self, path: &Path) {
        if let Ok(data) = path.metadata() {
            let used = data.modified().unwrap_or(SystemTime::now());
            self.push(path.to_owned(), used, data.len());
        }
    }

    /// Removes masks, those first whose last use is the longest ago, until the rest is within `most_bytes`.
    pub(super) fn shrink_to(&mut self, most_bytes: u64) {
        while self.bytes > most_bytes {
            let Some(Reverse(oldest)) = self.masks.pop() else {
                return;
            };
            self.bytes -= oldest.bytes;
            let used = oldest.path.metadata().and_then(|data| data.modified());
            match used {
                // Used since, by this process or another one, or written anew. Bytes are counted once a file:
                // an entry that was overwritten is met here and counted as what it is now.
                Ok(used) if used > oldest.used && oldest.used != SystemTime::UNIX_EPOCH => {
                    self.add(&oldest.path);
                }
                Ok(_) => remove(&oldest.path),
                // Another process was faster.
                Err(_) => {}
            }
        }
    }
}

/// Whether an unfinished file last written at `modified` is nobody's any more.
fn is_left_over(modified: SystemTime, now: SystemTime) -> bool {
    now.duration_since(modified)
        .is_ok_and(|age| age > LONGEST_WRITE)
}

/// Removes a file; one that is gone already, or that may not be removed, is no error.
fn remove(path: &Path) {
    if let Err(error) = std::fs::remove_file(path) {
        log::debug!("{} not removed: {error}", path.display());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs::File;

    fn write(dir: &Path, name: &str, bytes: usize, age_s: u64) -> PathBuf {
        let path = dir.join(name);
        std::fs::write(&path, vec![0; bytes]).unwrap();
        touch(&path, age_s);
        path
    }

    fn touch(path: &Path, age_s: u64) {
        let file = File::options().append(true).open(path).unwrap();
        file.set_modified(SystemTime::now() - Duration::from_secs(age_s))
            .unwrap();
    }

    fn mask(digit: char) -> String {
        format!(
            "{PREFIX}{}{MASK_SUFFIX}",
            digit.to_string().repeat(KEY_DIGITS)
        )
    }

    #[test]
    fn files_are_told_by_their_names() {
        let key = "0f".repeat(KEY_DIGITS / 2);
        for (name, kind) in [
            (format!("reference-{key}.png"), Kind::Mask),
            (format!("{key}.png"), Kind::OldMask),
            (".partial-x1Y2z3".to_owned(), Kind::Unfinished),
            (format!("reference-{key}.svg"), Kind::Foreign),
            (format!("reference-{}.png", &key[1..]), Kind::Foreign),
            (format!("{}.png", key.to_uppercase()), Kind::Foreign),
            ("truth.png".to_owned(), Kind::Foreign),
            (".tmpA1b2C3".to_owned(), Kind::Foreign),
        ] {
            assert_eq!(Kind::of(&name), kind, "{name}");
        }
    }

    #[test]
    fn what_was_not_used_for_longest_goes_first_and_nothing_foreign_ever() {
        let dir = tempfile::tempdir().unwrap();
        let dir = dir.path();
        let old_format = write(dir, &format!("{}.png", "a".repeat(KEY_DIGITS)), 100, 1);
        let ages = [('1', 300), ('2', 100), ('3', 200)];
        let [one, two, three] = ages.map(|(digit, age_s)| write(dir, &mask(digit), 100, age_s));
        let foreign = write(dir, "holiday.png", 1000, 100_000);
        let folder = dir.join(mask('4'));
        std::fs::create_dir(&folder).unwrap();
        let mut contents = Contents::scan(dir);
        let left = || [&old_format, &one, &two, &three].map(|path| path.exists());
        contents.shrink_to(400);
        assert_eq!(left(), [true, true, true, true]);
        contents.shrink_to(399);
        assert_eq!(left(), [false, true, true, true]);
        contents.shrink_to(250);
        assert_eq!(left(), [false, false, true, true]);
        contents.shrink_to(100);
        assert_eq!(left(), [false, false, true, false]);
        contents.shrink_to(0);
        assert_eq!(left(), [false; 4]);
        assert!(foreign.exists() && folder.exists());
    }

    #[test]
    fn what_another_process_uses_or_removes_meanwhile_is_heeded() {
        let dir = tempfile::tempdir().unwrap();
        let dir = dir.path();
        let [one, two, three] = [('1', 300), ('2', 200), ('3', 100)]
            .map(|(digit, age_s)| write(dir, &mask(digit), 100, age_s));
        let mut contents = Contents::scan(dir);
        touch(&one, 0);
        std::fs::remove_file(&two).unwrap();
        contents.shrink_to(100);
        assert!(one.exists() && !three.exists());
    }

    #[test]
    fn unfinished_files_of_killed_processes_go_and_those_under_way_stay() {
        let dir = tempfile::tempdir().unwrap();
        let left_over = write(dir.path(), ".partial-abc", 10, 7200);
        let under_way = write(dir.path(), ".partial-def", 10, 5);
        Contents::scan(dir.path());
        assert!(!left_over.exists() && under_way.exists());
    }
}
