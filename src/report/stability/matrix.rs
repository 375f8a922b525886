//! Causes against methods: where each method begins to fail.

use super::StressRun;
use crate::record::stress::{CauseRecord, DeclaredCause, Outcome, StressMethod, StressRow};

/// A row a cause, a column a method.
#[derive(Debug, Clone)]
pub(crate) struct Matrix<'a> {
    /// The methods, one a column.
    pub methods: &'a [StressMethod],
    pub lines: Vec<Line<'a>>,
}

#[derive(Debug, Clone)]
pub(crate) struct Line<'a> {
    pub cause: &'a CauseRecord,
    pub cells: Vec<Cell<'a>>,
}

/// How a method bears a cause.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Cell<'a> {
    /// The run was interrupted before.
    Untried,
    /// It can draw no scene of the cause.
    Unavailable {
        /// Why.
        reason: &'a str,
    },
    /// It is right wherever it was tried.
    Right {
        /// Values at which it is unavailable.
        unavailable: usize,
        /// Whether the run was interrupted before the last value.
        cut_off: bool,
    },
    Fails(Failure<'a>),
}

#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Failure<'a> {
    pub first: &'a StressRow,
    /// Where it has the most artifact pixels.
    pub worst: &'a StressRow,
    /// The first failure that no limit declares.
    pub undeclared: Option<&'a StressRow>,
}

/// A failure that a method declares and that did not come: the picture at the first value tried from there on
/// is right.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Unseen<'a> {
    pub method: &'a StressMethod,
    pub declared: &'a DeclaredCause,
    /// The value tried at which it is right.
    pub value: f64,
    /// The first larger value at which it does fail, if at any.
    pub seen_at: Option<f64>,
}

impl<'a> Failure<'a> {
    /// The failures that are shown: the first, and the first undeclared one if that is another.
    pub(crate) fn shown(&self) -> impl Iterator<Item = &'a StressRow> + use<'a> {
        let later = self.undeclared.filter(|row| row.value != self.first.value);
        [self.first].into_iter().chain(later)
    }

    /// Whether no limit declares the very first failure.
    pub(crate) fn begins_undeclared(&self) -> bool {
        is_undeclared(self.first)
    }
}

impl<'a> Cell<'a> {
    pub(crate) fn failure(&self) -> Option<&Failure<'a>> {
        match self {
            Self::Fails(failure) => Some(failure),
            _ => None,
        }
    }

    fn of(cause: &CauseRecord, rows: &[&'a StressRow]) -> Self {
        let is = |outcome: Outcome| move |row: &&&'a StressRow| row.outcome == outcome;
        let failures = || rows.iter().copied().filter(|row| is_failure(row));
        if let Some(first) = failures().next() {
            // Of equals, the first.
            let worst = failures().rev().max_by_key(|row| row.artifact_px);
            return Self::Fails(Failure {
                first,
                worst: worst.unwrap_or(first),
                undeclared: rows.iter().copied().find(|row| is_undeclared(row)),
            });
        }
        let unavailable = rows.iter().filter(is(Outcome::Unavailable)).count();
        match rows.first() {
            None => Self::Untried,
            Some(row) if unavailable == rows.len() => Self::Unavailable {
                reason: &row.reason,
            },
            Some(_) => Self::Right {
                unavailable,
                cut_off: rows.len() < cause.values.len(),
            },
        }
    }
}

/// Whether a picture is wrong or missing, and nothing said that it would be.
fn is_undeclared(row: &StressRow) -> bool {
    matches!(row.outcome, Outcome::Undeclared | Outcome::Failed)
}

/// Whether a picture is wrong, or broke.
pub(in crate::report) fn is_failure(row: &StressRow) -> bool {
    row.outcome == Outcome::Declared || is_undeclared(row)
}

impl StressRun {
    /// Where each method begins to fail.
    pub(crate) fn matrix(&self) -> Matrix<'_> {
        let line = |cause| {
            let cell = |method| Cell::of(cause, &self.rows_of(cause, method));
            Line {
                cause,
                cells: self.info.methods.iter().map(cell).collect(),
            }
        };
        Matrix {
            methods: &self.info.methods,
            lines: self.info.causes.iter().map(line).collect(),
        }
    }

    /// The pictures of a cause by a method, values ascending.
    pub(crate) fn rows_of(&self, cause: &CauseRecord, method: &StressMethod) -> Vec<&StressRow> {
        let is_of = |row: &&StressRow| {
            row.cause == cause.id && row.method == method.id && row.variant == method.variant
        };
        let mut rows: Vec<&StressRow> = self.rows.iter().filter(is_of).collect();
        rows.sort_by(|one, other| one.value.total_cmp(&other.value));
        rows
    }

    /// What methods declare and this run has not seen where they say: the limit may be gone, or begin later.
    pub(crate) fn unseen(&self) -> Vec<Unseen<'_>> {
        let mut unseen = Vec::new();
        for method in &self.info.methods {
            let declared = method.declared.iter();
            unseen.extend(declared.filter_map(|declared| self.unseen_by(method, declared)));
        }
        unseen
    }

    fn unseen_by<'a>(
        &'a self,
        method: &'a StressMethod,
        declared: &'a DeclaredCause,
    ) -> Option<Unseen<'a>> {
        let mut causes = self.info.causes.iter();
        let cause = causes.find(|cause| cause.id == declared.cause)?;
        let rows = self.rows_of(cause, method);
        let mut rows = rows.iter().filter(|row| row.value >= declared.from);
        let first = rows.next()?;
        (first.outcome == Outcome::Right).then(|| Unseen {
            method,
            declared,
            value: first.value,
            seen_at: rows.find(|row| is_failure(row)).map(|row| row.value),
        })
    }

    /// How many pictures came out so.
    pub(crate) fn count(&self, outcome: Outcome) -> usize {
        let rows = self.rows.iter();
        rows.filter(|row| row.outcome == outcome).count()
    }
}
