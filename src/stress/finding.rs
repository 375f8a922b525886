//! Whether a picture is a failure, and one that its method declares.

use super::trial::Drawn;
use crate::methods::{Limit, ShadowMethod};
use crate::metrics::Region;

/// A value of a cause of the corpus.
pub(super) type CauseValue<'a> = (&'a str, f64);

/// How a picture is judged.
#[derive(Debug, Clone, Copy)]
pub enum Finding {
    /// As right as the method promises.
    Right,
    /// Wrong, by a limit that the method declares.
    Declared(&'static Limit),
    /// Wrong, and nothing said that it would be.
    Undeclared,
}

impl Finding {
    /// Judges a picture that `method` drew, for a cause or of any scene.
    pub fn of(method: &dyn ShadowMethod, cause: Option<CauseValue<'_>>, drawn: &Drawn) -> Self {
        let (info, variant) = (method.info(), method.variant());
        let judgement = &drawn.judgement;
        let tolerated_px = info.tolerated_share * drawn.mask.len() as f64;
        let is_right = |artifact_px: u64| artifact_px as f64 <= tolerated_px;
        let artifact_px = judgement.error.artifact_px;
        if is_right(artifact_px) {
            return Self::Right;
        }
        let limits = || {
            let limits = info.limits_of(&variant);
            limits.filter(|limit| artifact_px <= limit.most_px)
        };
        let for_cause = cause.and_then(|(cause, value)| {
            let covers = |limit: &&'static Limit| limit.covers(cause, value);
            limits().find(covers)
        });
        if let Some(limit) = for_cause {
            return Self::Declared(limit);
        }
        // By kind: all but what is tolerated must be of kinds that some limit names.
        let regions = &judgement.analysis.regions;
        let of_limit = |region: &Region| limits().find(|limit| limit.kinds.contains(&region.label));
        let left = regions.iter().filter(|region| of_limit(region).is_none());
        match regions.iter().find_map(of_limit) {
            Some(limit) if is_right(left.map(|region| region.size_px).sum()) => {
                Self::Declared(limit)
            }
            _ => Self::Undeclared,
        }
    }

    /// As it is written in results.
    pub fn word(self) -> &'static str {
        match self {
            Self::Right => "right",
            Self::Declared(_) => "declared",
            Self::Undeclared => "undeclared",
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::methods::REGISTRY;
    use crate::stress::corpus;

    #[test]
    fn limits_name_causes_that_there_are_at_values_that_are_tried() {
        let causes = corpus();
        let limits = REGISTRY
            .iter()
            .flat_map(|registration| registration.info.limits.iter().copied().flatten());
        for (name, from) in limits.flat_map(|limit| limit.fails) {
            let cause = causes.iter().find(|cause| cause.id == *name);
            let cause = cause.unwrap_or_else(|| panic!("no cause `{name}`"));
            assert!(
                cause.values.iter().any(|value| value >= from),
                "{name} from {from}"
            );
        }
    }

    #[test]
    fn a_limit_holds_with_its_parameter_alone() {
        let info = crate::methods::find("silhouette_gs").unwrap().info;
        let covered = |variant: &str, value: f64| {
            let mut limits = info.limits_of(variant);
            limits.any(|limit| limit.covers("eye_in_volume", value))
        };
        assert!(covered("counting=z_pass", 1.0));
        assert!(covered("counting=z_pass,reach=infinity", 0.5));
        assert!(!covered("counting=z_pass", 0.0));
        assert!(!covered("counting=auto", 1.0));
        assert!(!covered("", 1.0));
    }
}
