//! Whether a picture is a failure, and one that its method declares.

use crate::judge::Drawn;
use crate::methods::{Bound, Limit, ShadowMethod};
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

/// What a picture is judged by.
struct Picture<'a> {
    px: u64,
    artifact_px: u64,
    regions: &'a [Region],
}

impl Finding {
    /// Judges a picture that `method` drew, for a cause or of any scene.
    pub fn of(method: &dyn ShadowMethod, cause: Option<CauseValue<'_>>, drawn: &Drawn) -> Self {
        let (info, judgement) = (method.info(), &drawn.judgement);
        let limits: Vec<_> = info.limits_of(&method.variant()).collect();
        let picture = Picture {
            px: drawn.mask.len() as u64,
            artifact_px: judgement.error.artifact_px,
            regions: &judgement.analysis.regions,
        };
        Self::judge(&picture, info.tolerated_share, &limits, cause)
    }

    fn judge(
        picture: &Picture<'_>,
        tolerated_share: f64,
        limits: &[&'static Limit],
        cause: Option<CauseValue<'_>>,
    ) -> Self {
        let tolerated = Bound::Share(tolerated_share);
        if tolerated.holds(picture.artifact_px, picture.px) {
            return Self::Right;
        }
        let for_cause = cause.and_then(|(cause, value)| {
            let covers = |limit: &&&Limit| {
                limit.covers(cause, value) && limit.at_most.holds(picture.artifact_px, picture.px)
            };
            limits.iter().find(covers)
        });
        if let Some(limit) = for_cause {
            return Self::Declared(limit);
        }
        // By kind: all but what is tolerated must be of kinds that limits name, and within their bounds.
        let mut left: Vec<&Region> = picture.regions.iter().collect();
        let mut first = None;
        for &limit in limits {
            let is_of_it = |region: &&Region| limit.kinds.contains(&region.label);
            let (of_it, others) = left.iter().copied().partition::<Vec<_>, _>(is_of_it);
            if !of_it.is_empty() && limit.at_most.holds(size_px(&of_it), picture.px) {
                first = first.or(Some(limit));
                left = others;
            }
        }
        match first {
            Some(limit) if tolerated.holds(size_px(&left), picture.px) => Self::Declared(limit),
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

/// Pixels of some regions together.
fn size_px(regions: &[&Region]) -> u64 {
    regions.iter().map(|region| region.size_px).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::methods::Registry;
    use crate::metrics::{Label, Sign};
    use crate::stress::corpus;

    const PICTURE_PX: u64 = 10_000;
    const SPECKS: Limit = Limit {
        text: "specks",
        with: &[],
        unless: &[],
        fails: &[("fan", 3.0)],
        kinds: &[Label::Seam],
        at_most: Bound::Px(5),
    };
    const SHARE: Limit = Limit {
        text: "a share",
        with: &[],
        unless: &[],
        fails: &[],
        kinds: &[Label::Acne, Label::Staircase],
        at_most: Bound::Share(0.01),
    };
    const EVERYTHING: Limit = Limit {
        text: "everything",
        with: &[],
        unless: &[],
        fails: &[],
        kinds: &[Label::Overflow],
        at_most: Bound::All,
    };

    /// The limit that declares such errors; `Err` with the word where there is none.
    fn verdict(
        errors: &[(Label, u64)],
        tolerated_share: f64,
        cause: Option<CauseValue<'_>>,
    ) -> Result<&'static str, &'static str> {
        let region = |&(label, size_px): &(Label, u64)| Region {
            sign: Sign::FalseShadowed,
            label,
            size_px,
            left: 0,
            top: 0,
            right: 0,
            bottom: 0,
        };
        let regions: Vec<_> = errors.iter().map(region).collect();
        let picture = Picture {
            px: PICTURE_PX,
            artifact_px: errors.iter().map(|(_, px)| px).sum(),
            regions: &regions,
        };
        let limits = [&SPECKS, &SHARE, &EVERYTHING];
        match Finding::judge(&picture, tolerated_share, &limits, cause) {
            Finding::Declared(limit) => Ok(limit.text),
            other => Err(other.word()),
        }
    }

    #[test]
    fn a_limit_accounts_for_its_kinds_up_to_its_bound() {
        let of = |errors: &[(Label, u64)]| verdict(errors, 0.0, None);
        assert_eq!(of(&[]), Err("right"));
        assert_eq!(of(&[(Label::Seam, 5)]), Ok("specks"));
        assert_eq!(of(&[(Label::Seam, 3), (Label::Seam, 3)]), Err("undeclared"));
        assert_eq!(
            of(&[(Label::Acne, 60), (Label::Staircase, 40)]),
            Ok("a share")
        );
        assert_eq!(
            of(&[(Label::Acne, 60), (Label::Staircase, 41)]),
            Err("undeclared")
        );
        assert_eq!(of(&[(Label::Overflow, PICTURE_PX)]), Ok("everything"));
        assert_eq!(of(&[(Label::Unlabelled, 1)]), Err("undeclared"));
    }

    #[test]
    fn limits_account_for_a_picture_together() {
        let of = |errors: &[(Label, u64)]| verdict(errors, 0.0, None);
        assert_eq!(
            of(&[(Label::Overflow, 900), (Label::Seam, 5)]),
            Ok("specks")
        );
        assert_eq!(
            of(&[(Label::Overflow, 900), (Label::Seam, 6)]),
            Err("undeclared")
        );
    }

    #[test]
    fn what_is_tolerated_may_be_of_any_kind() {
        let of = |errors: &[(Label, u64)]| verdict(errors, 0.002, None);
        assert_eq!(of(&[(Label::Unlabelled, 20)]), Err("right"));
        assert_eq!(
            of(&[(Label::Unlabelled, 20), (Label::Acne, 100)]),
            Ok("a share")
        );
        assert_eq!(
            of(&[(Label::Unlabelled, 21), (Label::Acne, 100)]),
            Err("undeclared")
        );
    }

    #[test]
    fn a_limit_accounts_for_its_causes_up_to_its_bound() {
        let of = |errors: &[(Label, u64)], value| verdict(errors, 0.0, Some(("fan", value)));
        assert_eq!(of(&[(Label::Unlabelled, 5)], 3.0), Ok("specks"));
        assert_eq!(of(&[(Label::Unlabelled, 6)], 3.0), Err("undeclared"));
        assert_eq!(of(&[(Label::Unlabelled, 5)], 2.0), Err("undeclared"));
    }

    #[test]
    fn limits_name_causes_that_there_are_at_values_that_are_tried() {
        let causes = corpus();
        let registry = Registry::builtin();
        let limits = registry
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
        let info = Registry::builtin().get("silhouette_gs").unwrap().info;
        let covered = |variant: &str, value: f64| {
            let variant = variant.parse().unwrap();
            let mut limits = info.limits_of(&variant);
            limits.any(|limit| limit.covers("eye_in_volume", value))
        };
        assert!(covered("counting=z_pass", 1.0));
        assert!(covered("counting=z_pass,reach=infinity", 0.5));
        assert!(!covered("counting=z_pass", 0.0));
        assert!(!covered("counting=auto", 1.0));
        assert!(!covered("", 1.0));
    }
}
