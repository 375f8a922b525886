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
        let by_kind = |word: &str| {
            info.limits_of(&variant)
                .find(|limit| limit.kinds.contains(&word))
        };
        let kinds = judgement.analysis.label_counts();
        let declared: Vec<_> = kinds
            .filter_map(|(word, px)| Some((px, by_kind(word)?)))
            .collect();
        let declared_px: u64 = declared.iter().map(|(px, _)| px).sum();
        // Boundary pixels may have a kind too.
        let most = declared.into_iter().max_by_key(|(px, _)| *px);
        match most.filter(|_| is_right(artifact_px.saturating_sub(declared_px))) {
            Some((_, limit)) => Self::Declared(limit),
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
