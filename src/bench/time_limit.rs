//! How long the run may work on one cell.

use crate::judge::NoPicture;
use std::time::{Duration, Instant};

/// The time that a cell has, and what it has used of it.
#[derive(Debug, Default)]
pub(super) struct TimeLimit {
    /// `None` for as long as it takes.
    limit: Option<Duration>,
    used: Duration,
}

impl TimeLimit {
    pub(super) fn new(limit: Option<Duration>) -> Self {
        Self {
            limit,
            used: Duration::ZERO,
        }
    }

    /// Does `work`, which is told until when the device may be waited for. Work cannot be stopped: what comes back
    /// too late is thrown away.
    pub(super) fn spend<T>(
        &mut self,
        work: impl FnOnce(Option<Instant>) -> Result<T, NoPicture>,
    ) -> Result<T, NoPicture> {
        let started = Instant::now();
        let deadline = self
            .limit
            .map(|limit| started + limit.saturating_sub(self.used));
        let result = work(deadline);
        self.used += started.elapsed();
        match (result, self.limit) {
            (result @ Err(NoPicture::Unavailable(_)), _) => result,
            (result, Some(limit)) if self.used > limit => {
                let mut text = format!(
                    "it took longer than the {} s that a cell has (`cell_timeout_s`)",
                    limit.as_secs_f64()
                );
                if let Err(error) = result {
                    text = format!("{text}: {error}");
                }
                Err(NoPicture::Failed(text))
            }
            (result, _) => result,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sleep(ms: u64) -> Result<(), NoPicture> {
        std::thread::sleep(Duration::from_millis(ms));
        Ok(())
    }

    #[test]
    fn time_adds_up_until_there_is_none_left() {
        let mut limit = TimeLimit::new(Some(Duration::from_millis(200)));
        assert_eq!(limit.spend(|_| sleep(1)), Ok(()));
        let error = limit.spend(|deadline| {
            let left = deadline.unwrap() - Instant::now();
            assert!(left < Duration::from_millis(199), "{left:?}");
            sleep(220)
        });
        let text = "it took longer than the 0.2 s that a cell has (`cell_timeout_s`)";
        assert_eq!(error, Err(NoPicture::Failed(text.to_owned())));
        let lost = || Err::<(), _>(NoPicture::Failed("the device was lost".to_owned()));
        let error = limit.spend(|_| lost()).unwrap_err();
        assert_eq!(error.reason(), format!("{text}: the device was lost"));
    }

    #[test]
    fn without_a_limit_nothing_is_late() {
        let mut limit = TimeLimit::new(None);
        let result = limit.spend(|deadline| {
            assert!(deadline.is_none());
            sleep(5)
        });
        assert_eq!(result, Ok(()));
    }
}
