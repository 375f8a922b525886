//! What a report asks of a run.

use super::curve::Contender;
pub use crate::record::Run;
pub(super) use crate::record::unique;
use crate::record::{MethodRecord, Status, Summary, SweepRecord};

impl Run {
    /// The scene's name for people; its plain name where the run has no other.
    pub fn scene_title<'a>(&'a self, name: &'a str) -> &'a str {
        let record = self.info.scenes.iter().find(|scene| scene.name == name);
        record
            .map(|scene| scene.title.as_str())
            .filter(|title| !title.is_empty())
            .unwrap_or(name)
    }

    /// The method's name for people; its id where the run has no other.
    pub fn method_title<'a>(&'a self, contender: &'a Contender) -> &'a str {
        let record = self
            .info
            .methods
            .iter()
            .find(|method| method.id == contender.method);
        let title = record
            .map(|method| method.title.as_str())
            .filter(|title| !title.is_empty());
        title.unwrap_or(&contender.method)
    }

    /// Whom the run compares: in the run's order, then any that only the rows know.
    ///
    /// The place of its [`Curve`](super::curve::Curve) among all curves decides its colour in every plot.
    pub fn contenders(&self) -> Vec<Contender> {
        let listed = self.info.methods.iter().map(|method| Contender {
            method: method.id.clone(),
            variant: method.variant.to_string(),
        });
        unique(listed.chain(self.summaries.iter().map(|row| self.contender(row))))
    }

    /// Whom a row is about.
    pub fn contender(&self, row: &Summary) -> Contender {
        let Summary {
            method,
            variant,
            width,
            height,
            ..
        } = row;
        let own_size = (self.info.width, self.info.height) == (*width, *height);
        let size = if own_size {
            String::new()
        } else {
            format!(" {width}×{height}")
        };
        Contender {
            method: method.clone(),
            variant: format!("{variant}{size}").trim().to_owned(),
        }
    }

    /// The sweep that a contender is a point of.
    pub fn sweep_of(&self, contender: &Contender) -> Option<&SweepRecord> {
        let named = |record: &&MethodRecord| {
            record.id == contender.method && record.variant.as_str() == contender.variant
        };
        self.info
            .methods
            .iter()
            .filter(named)
            .find_map(|record| record.sweep.as_ref())
    }

    /// The rows of a scene, in the order of [`Self::contenders`].
    pub fn rows(&self, scene: &str) -> Vec<&Summary> {
        let contenders = self.contenders();
        let mut rows: Vec<&Summary> = self.summaries.iter().filter(|r| r.scene == scene).collect();
        rows.sort_by_key(|row| {
            let contender = self.contender(row);
            contenders.iter().position(|other| *other == contender)
        });
        rows
    }

    /// Why nothing of a scene was measured, if one reason says it for all methods: said once, not in every row.
    pub fn absence(&self, scene: &str) -> Option<(Status, &str)> {
        let mut rows = self.summaries.iter().filter(|row| row.scene == scene);
        let Some(first) = rows.next() else {
            let record = self
                .info
                .scenes
                .iter()
                .find(|record| record.name == scene)?;
            return Some((record.status, record.reason.as_str()));
        };
        let is_alike = |row: &Summary| (row.status, &row.reason) == (first.status, &first.reason);
        (first.is_absent() && rows.all(|row| row.is_absent() && is_alike(row)))
            .then_some((first.status, first.reason.as_str()))
    }

    /// The shortest median shadow time among a scene's rows of this row's size that have no
    /// artifacts: being fast and wrong is no merit.
    pub fn best_shadow_ms(&self, row: &Summary) -> Option<f64> {
        self.summaries
            .iter()
            .filter(|other| other.scene == row.scene && other.status == Status::Ok)
            .filter(|other| (other.width, other.height) == (row.width, row.height))
            .filter(|other| other.artifact_px == Some(0))
            .filter_map(|other| other.shadow_ms_median)
            .min_by(f64::total_cmp)
    }

    /// Whether this row is right and has the scene's best shadow time.
    pub fn is_best(&self, row: &Summary) -> bool {
        row.status == Status::Ok
            && row.artifact_px == Some(0)
            && row.shadow_ms_median.is_some()
            && row.shadow_ms_median == self.best_shadow_ms(row)
    }
}
