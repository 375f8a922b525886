//! How much memory this process may still use, so that what cannot fit is refused before it is tried: Linux
//! grants any allocation, and kills the process once it is filled.

/// Of what is available, the part that may be planned for, in per cent: others need memory too.
const USABLE_PERCENT: u64 = 90;

/// More memory is needed than there is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("needs {} of memory, and {} are free", size_text(*.needed_bytes), size_text(*.free_bytes))]
pub struct NotEnough {
    /// What is needed.
    pub needed_bytes: u64,
    /// What there is.
    pub free_bytes: u64,
}

/// Whether so many bytes can be had.
///
/// # Errors
/// When they cannot.
pub fn check(needed_bytes: u64) -> Result<(), NotEnough> {
    match available_bytes() {
        Some(available) => check_against(needed_bytes, available),
        None => Ok(()),
    }
}

/// Whether so many bytes can be had of `available`.
///
/// # Errors
/// When they cannot.
pub(crate) fn check_against(needed_bytes: u64, available: u64) -> Result<(), NotEnough> {
    let free_bytes = available / 100 * USABLE_PERCENT;
    if needed_bytes <= free_bytes {
        Ok(())
    } else {
        Err(NotEnough {
            needed_bytes,
            free_bytes,
        })
    }
}

/// The least of what the machine has left, what this process's group may use and what its own limit
/// leaves; `None` where nobody says.
pub(crate) fn available_bytes() -> Option<u64> {
    let read = |path: &str| std::fs::read_to_string(path).ok();
    let machine = read("/proc/meminfo").and_then(|text| kib(&text, "MemAvailable:"));
    let group = read("/proc/self/cgroup").and_then(|groups| {
        let path = groups.lines().find_map(|line| line.strip_prefix("0::"))?;
        let read = |name| read(&format!("/sys/fs/cgroup/{path}/{name}"));
        let max: u64 = read("memory.max")?.trim().parse().ok()?;
        let used: u64 = read("memory.current")?.trim().parse().ok()?;
        let files = read("memory.stat").map_or(0, |stat| cached_bytes(&stat));
        Some(max.saturating_sub(used.saturating_sub(files)))
    });
    let own = read("/proc/self/limits").and_then(|limits| {
        let line = limits
            .lines()
            .find(|l| l.starts_with("Max address space"))?;
        let most: u64 = line.split_whitespace().nth(3)?.parse().ok()?;
        let used = kib(&read("/proc/self/status")?, "VmSize:")?;
        Some(most.saturating_sub(used))
    });
    [machine, group, own].into_iter().flatten().min()
}

/// The most memory that this process has had at once, in bytes; `None` where nobody says. On a software rasteriser the
/// device's memory is in it.
pub(crate) fn peak_bytes() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    kib(&status, "VmHWM:")
}

/// What of a group's memory holds copies of files, and is given up when somebody needs it.
fn cached_bytes(stat: &str) -> u64 {
    let numbers = stat.lines().filter_map(|line| line.split_once(' '));
    let files = numbers.filter(|(name, _)| ["active_file", "inactive_file"].contains(name));
    files
        .filter_map(|(_, bytes)| bytes.parse::<u64>().ok())
        .sum()
}

/// The number of kibibytes behind `name` in a file of the kernel's, in bytes.
fn kib(text: &str, name: &str) -> Option<u64> {
    let rest = text.lines().find_map(|line| line.strip_prefix(name))?;
    let kib: u64 = rest.split_whitespace().next()?.parse().ok()?;
    Some(1024 * kib)
}

/// So many bytes, for people.
pub(crate) fn size_text(bytes: u64) -> String {
    let mib = bytes as f64 / f64::from(1 << 20);
    if mib < 1000.0 {
        format!("{mib:.0} MiB")
    } else {
        format!("{:.1} GiB", mib / 1024.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kernel_files_are_read() {
        let text = "MemTotal:       24601324 kB\nMemAvailable:   2048 kB\n";
        assert_eq!(kib(text, "MemAvailable:"), Some(2 << 20));
        assert_eq!(kib(text, "SwapFree:"), None);
        let peak = peak_bytes();
        assert!(!cfg!(target_os = "linux") || peak.is_some_and(|peak| peak > 1 << 20));
        let stat = "anon 7\nfile 9\ninactive_file 4\nactive_file 2\n";
        assert_eq!(cached_bytes(stat), 6);
    }

    #[test]
    fn what_is_more_than_there_is_is_refused_in_words() {
        assert_eq!(check_against(90, 100), Ok(()));
        let error = check_against(3 << 30, 1 << 30).unwrap_err().to_string();
        assert_eq!(error, "needs 3.0 GiB of memory, and 922 MiB are free");
        assert!(check(u64::MAX).is_err() || available_bytes().is_none());
    }
}
