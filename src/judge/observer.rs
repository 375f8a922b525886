//! Who watches a run.

/// Told of a run's progress; the command line shows it as a bar or as lines.
pub trait Observer {
    /// The run has so many steps, about equally long.
    fn begin(&self, steps: u64);
    /// What happens now.
    fn phase(&self, text: &str);
    /// So many steps are done.
    fn advance(&self, steps: u64);
    /// Whether the user wants the run to stop.
    fn interrupted(&self) -> bool;
}
