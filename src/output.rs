//! Writing files: whole or not at all, through what is at the path, and readable for whom the user's umask says.
//!
//! Every file that the program writes goes through here.

use anyhow::Context;
use std::fs::{self, File, Metadata, OpenOptions};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

/// Begins the name of a file that is not whole yet; one that stays was left by a process that was killed.
pub const PARTIAL_PREFIX: &str = ".partial-";

/// Writes `bytes` to `path`; see [`write_with`].
///
/// # Errors
/// When the file cannot be written; the message names it.
pub fn write_atomically(path: &Path, bytes: impl AsRef<[u8]>) -> anyhow::Result<()> {
    write_with(path, |file| Ok(file.write_all(bytes.as_ref())?))
}

/// Lets `write` write to `path`.
///
/// A new file, or one that takes the place of a file of the user's own, is written beside it and renamed, so that
/// nobody ever finds half of it; a symbolic link stays, and the file that it points to is replaced. What cannot be
/// replaced without loss (a device, a pipe, a file of another owner or with further names) is written to in place.
/// A file that was there keeps its mode.
///
/// # Errors
/// When the file cannot be written; the message names it. Where files are replaced, the old one is then as it was.
pub fn write_with(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> anyhow::Result<()>,
) -> anyhow::Result<()> {
    let attempt = || match Destination::of(path)? {
        Destination::New(path) => replace(&path, None, write),
        Destination::Replaced(path, old) => replace(&path, Some(&old), write),
        Destination::Through(file) => buffered(file, write),
    };
    attempt().with_context(|| format!("cannot write {}", path.display()))
}

/// Creates `path`, or empties it, for a file that grows.
///
/// # Errors
/// When it cannot be created; the message names it.
pub fn create(path: &Path) -> anyhow::Result<File> {
    File::create(path).with_context(|| format!("cannot create {}", path.display()))
}

/// Creates a directory and those above it.
///
/// # Errors
/// When it cannot be created; the message names it.
pub fn create_dir_all(path: &Path) -> anyhow::Result<()> {
    fs::create_dir_all(path).with_context(|| format!("cannot create {}", path.display()))
}

/// Removes a file that an earlier run of the program may have left.
///
/// # Errors
/// When it is there and cannot be removed; the message names it.
pub fn remove_stale(path: &Path) -> anyhow::Result<()> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => {
            Err(error).with_context(|| format!("cannot remove {}", path.display()))
        }
        _ => Ok(()),
    }
}

/// Whether two paths are one file, or would be if they were written.
///
/// What is no regular file, such as a device, may be written to twice and is never the same.
pub fn is_same_file(a: &Path, b: &Path) -> bool {
    match (fs::metadata(a), fs::metadata(b)) {
        (Ok(of_a), Ok(of_b)) if of_a.is_file() && of_b.is_file() => {
            #[cfg(unix)]
            return {
                use std::os::unix::fs::MetadataExt;
                (of_a.dev(), of_a.ino()) == (of_b.dev(), of_b.ino())
            };
            #[cfg(not(unix))]
            return fs::canonicalize(a).is_ok_and(|a| fs::canonicalize(b).is_ok_and(|b| a == b));
        }
        (Err(_), Err(_)) => match (future_path(a), future_path(b)) {
            (Some(a), Some(b)) => a == b,
            _ => false,
        },
        _ => false,
    }
}

/// What is at a path.
enum Destination {
    /// Nothing.
    New(PathBuf),
    /// A regular file that may be replaced by another.
    Replaced(PathBuf, Metadata),
    /// Something to write to, opened.
    Through(File),
}

impl Destination {
    fn of(path: &Path) -> io::Result<Self> {
        let in_place = || {
            OpenOptions::new()
                .write(true)
                .create(true)
                .truncate(true)
                .open(path)
                .map(Self::Through)
        };
        let old = match fs::metadata(path) {
            Ok(old) => old,
            // A link that points nowhere yet: its target is made.
            Err(_) if path.is_symlink() => return in_place(),
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                return Ok(Self::New(path.to_owned()));
            }
            Err(error) => return Err(error),
        };
        if !old.is_file() || is_descriptor(path) || has_other_names(&old) {
            return in_place();
        }
        // A file that the user may not write stays, even if the folder would let it be replaced.
        drop(OpenOptions::new().write(true).open(path)?);
        Ok(Self::Replaced(fs::canonicalize(path)?, old))
    }
}

/// Whether the path is the name of an open file (`/dev/stdout`), whose holder would not see another in its place.
fn is_descriptor(path: &Path) -> bool {
    cfg!(unix) && (path.starts_with("/dev") || path.starts_with("/proc"))
}

/// Whether another file in its place would cut other names of it off.
fn has_other_names(old: &Metadata) -> bool {
    #[cfg(unix)]
    return std::os::unix::fs::MetadataExt::nlink(old) > 1;
    #[cfg(not(unix))]
    return false;
}

fn is_of_another_owner(old: &Metadata, new: &Metadata) -> bool {
    #[cfg(unix)]
    return {
        use std::os::unix::fs::MetadataExt;
        (old.uid(), old.gid()) != (new.uid(), new.gid())
    };
    #[cfg(not(unix))]
    return false;
}

fn replace(
    path: &Path,
    old: Option<&Metadata>,
    write: impl FnOnce(&mut dyn Write) -> anyhow::Result<()>,
) -> anyhow::Result<()> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(PARTIAL_PREFIX);
    // As any new file: the system takes from it what the umask says.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let partial = match builder.tempfile_in(folder(path)) {
        // The folder is closed, but the file in it is not.
        Err(error) if old.is_some() && error.kind() == io::ErrorKind::PermissionDenied => {
            return buffered(File::create(path)?, write);
        }
        partial => partial?,
    };
    if let Some(old) = old {
        if is_of_another_owner(old, &partial.as_file().metadata()?) {
            return buffered(File::create(path)?, write);
        }
        partial.as_file().set_permissions(old.permissions())?;
    }
    buffered(partial.as_file(), write)?;
    partial.persist(path)?;
    Ok(())
}

fn buffered(
    file: impl Write,
    write: impl FnOnce(&mut dyn Write) -> anyhow::Result<()>,
) -> anyhow::Result<()> {
    let mut file = BufWriter::new(file);
    write(&mut file)?;
    Ok(file.flush()?)
}

fn folder(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

/// As many symbolic links as Linux follows.
const LONGEST_CHAIN: usize = 40;

/// Where a file that is not there yet will be, without links on the way.
fn future_path(path: &Path) -> Option<PathBuf> {
    // A link that points nowhere yet makes its target, at the end of a chain of links.
    let mut path = path.to_owned();
    for _ in 0..LONGEST_CHAIN {
        match fs::read_link(&path) {
            Ok(target) => path = folder(&path).join(target),
            Err(_) => break,
        }
    }
    Some(
        fs::canonicalize(folder(&path))
            .ok()?
            .join(path.file_name()?),
    )
}

#[cfg(test)]
#[cfg(unix)]
mod tests {
    use super::*;
    use std::os::unix::fs::{PermissionsExt, symlink};

    fn mode(path: &Path) -> u32 {
        fs::metadata(path).unwrap().permissions().mode() & 0o777
    }

    fn names(dir: &Path) -> usize {
        dir.read_dir().unwrap().count()
    }

    #[test]
    fn a_new_file_has_the_mode_of_any_new_file_and_an_old_one_keeps_its_own() {
        let dir = tempfile::tempdir().unwrap();
        let (ours, any) = (dir.path().join("ours"), dir.path().join("any"));
        write_atomically(&ours, "1").unwrap();
        File::create(&any).unwrap();
        assert_eq!(mode(&ours), mode(&any));
        fs::set_permissions(&ours, fs::Permissions::from_mode(0o640)).unwrap();
        write_atomically(&ours, "2").unwrap();
        assert_eq!(
            (mode(&ours), fs::read(&ours).unwrap()),
            (0o640, b"2".to_vec())
        );
    }

    #[test]
    fn links_stay_and_their_targets_are_written() {
        let dir = tempfile::tempdir().unwrap();
        let path = |name: &str| dir.path().join(name);
        fs::write(path("target"), "old").unwrap();
        symlink("target", path("link")).unwrap();
        symlink("later", path("dangling")).unwrap();
        fs::hard_link(path("target"), path("other name")).unwrap();
        write_atomically(&path("link"), "new").unwrap();
        write_atomically(&path("dangling"), "made").unwrap();
        assert!(path("link").is_symlink() && path("dangling").is_symlink());
        assert_eq!(fs::read(path("other name")).unwrap(), b"new");
        assert_eq!(fs::read(path("later")).unwrap(), b"made");
        fs::remove_file(path("other name")).unwrap();
        write_atomically(&path("link"), "newer").unwrap();
        assert!(path("link").is_symlink());
        assert_eq!(fs::read(path("target")).unwrap(), b"newer");
    }

    #[test]
    fn what_fails_leaves_the_old_file_and_nothing_else() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("file");
        write_atomically(&path, "old").unwrap();
        let error = write_with(&path, |file| {
            file.write_all(b"half")?;
            anyhow::bail!("torn")
        });
        let words = format!("{:#}", error.unwrap_err());
        assert!(
            words.contains(&path.display().to_string()) && words.contains("torn"),
            "{words}"
        );
        assert_eq!(
            (fs::read(&path).unwrap(), names(dir.path())),
            (b"old".to_vec(), 1)
        );
        assert!(write_atomically(dir.path(), "a folder is no file").is_err());
    }

    #[test]
    fn a_device_is_written_to_and_stays() {
        let full = write_atomically(Path::new("/dev/full"), "too much").unwrap_err();
        assert!(format!("{full:#}").contains("/dev/full"), "{full:#}");
        use std::os::unix::fs::FileTypeExt;
        let device = fs::metadata("/dev/full").unwrap();
        assert!(device.file_type().is_char_device());
    }

    #[test]
    fn one_file_by_two_paths_is_told() {
        let dir = tempfile::tempdir().unwrap();
        let path = |name: &str| dir.path().join(name);
        fs::write(path("a"), "").unwrap();
        fs::hard_link(path("a"), path("b")).unwrap();
        symlink("new", path("link")).unwrap();
        assert!(is_same_file(&path("a"), &path("./b")));
        assert!(is_same_file(&path("new"), &path("link")));
        assert!(is_same_file(
            &path("new"),
            &path("../")
                .join(dir.path().file_name().unwrap())
                .join("new")
        ));
        assert!(!is_same_file(&path("a"), &path("new")));
        assert!(!is_same_file(
            Path::new("/dev/null"),
            Path::new("/dev/null")
        ));
    }

    #[test]
    fn links_to_one_file_to_be_are_the_same() {
        let dir = tempfile::tempdir().unwrap();
        let path = |name: &str| dir.path().join(name);
        symlink("one", path("two")).unwrap();
        symlink("two", path("three")).unwrap();
        symlink("loop", path("loop")).unwrap();
        assert!(is_same_file(&path("three"), &path("one")));
        assert!(!is_same_file(&path("three"), &path("loop")));
    }
}
