//! Whether a picture is a failure, and one that its method declares.

use super::trial::Drawn;
use crate::methods::{Limit, ShadowMethod};

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
        if let Some(limit) = cause.and_then(|(cause, value)| info.declared(&variant, cause, value))
        {
            return Self::Declared(limit);
        }
        let of_kinds = |limit: &&'static Limit| {
            let px = |kind: &&str| judgement.analysis.word_px(kind);
            is_right(artifact_px - limit.kinds.iter().map(px).sum::<u64>())
        };
        match info.limits_of(&variant).find(of_kinds) {
            Some(limit) => Self::Declared(limit),
            None => Self::Undeclared,
        }
    }

    /// Whether the picture is wrong.
    pub fn is_failure(self) -> bool {
        !matches!(self, Self::Right)
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
