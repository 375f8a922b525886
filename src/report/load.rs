//! What a report asks of a run.

use super::curve::Contender;
pub(crate) use crate::record::Run;
pub(super) use crate::record::unique;
use crate::record::{MethodRecord, Status, Summary, SweepRecord};

impl Run {
    /// The method's name for people; its id where the run has no other.
    pub(crate) fn method_title<'a>(&'a self, contender: &'a Contender) -> &'a str {
        let mut methods = self.info.methods.iter();
        match methods.find(|method| method.id == contender.method) {
            Some(MethodRecord { title, .. }) if !title.is_empty() => title,
            _ => &contender.method,
        }
    }

    /// Whom the run compares: in the run's order, then any that only the rows know.
    ///
    /// The place of its [`Curve`](super::curve::Curve) among all curves decides its colour in every plot.
    pub(crate) fn contenders(&self) -> Vec<Contender> {
        let methods = self.info.methods.iter();
        let listed = methods.map(|method| Contender::new(&method.id, method.variant.as_str()));
        unique(listed.chain(self.summaries.iter().map(|row| self.contender(row))))
    }

    pub(crate) fn contender(&self, row: &Summary) -> Contender {
        let size = match self.is_of_own_size(row) {
            true => String::new(),
            false => format!(" {}×{}", row.width, row.height),
        };
        Contender::new(&row.method, format!("{}{size}", row.variant).trim())
    }

    pub(crate) fn sweep_of(&self, contender: &Contender) -> Option<&SweepRecord> {
        let Contender { method, variant } = contender;
        let methods = self.info.methods.iter();
        let mut named = methods.filter(|own| own.id == *method && own.variant.as_str() == variant);
        named.find_map(|record| record.sweep.as_ref())
    }

    /// The rows of a scene, in the order of [`Self::contenders`].
    pub(crate) fn rows(&self, scene: &str) -> Vec<&Summary> {
        let contenders = self.contenders();
        let mut rows: Vec<&Summary> = self.summaries.iter().filter(|r| r.scene == scene).collect();
        rows.sort_by_key(|row| {
            let contender = self.contender(row);
            contenders.iter().position(|other| *other == contender)
        });
        rows
    }

    /// Whether this row has no artifacts, and the shortest median shadow time among its scene's rows of its size
    /// that have none: being fast and wrong is no merit.
    pub(crate) fn is_best(&self, row: &Summary) -> bool {
        let is_right = |row: &Summary| row.status == Status::Ok && row.artifact_px == Some(0);
        let place = |row: &Summary| (row.scene.clone(), row.width, row.height);
        let rows = self.summaries.iter();
        let rivals = rows.filter(|other| is_right(other) && place(other) == place(row));
        let times = rivals.filter_map(|other| other.shadow_ms_median);
        let best = times.min_by(f64::total_cmp);
        is_right(row) && best.is_some() && row.shadow_ms_median == best
    }
}
