//! What a paper claims, and how that is held against numbers.

use serde::Deserialize;

/// A claim of a paper.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Claim {
    /// A short name, unique.
    pub id: String,
    /// What is claimed, in a sentence.
    pub text: String,
    /// The numbers claimed, as the paper has them.
    pub claimed: String,
    /// What to know about the paper's own numbers; may be empty.
    #[serde(default)]
    pub note: String,
    /// How the claim is held against numbers.
    pub check: Check,
}

/// How a claim is held against numbers. Tables go by their numbers, series and scenes by their ids.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum Check {
    /// A series is faster than another by so many percent: speed over speed, less one.
    SpeedUp {
        /// The faster series.
        series: String,
        /// The slower one.
        over: String,
        /// The tables that have both. The claim's mean is held against the first.
        tables: Vec<u8>,
        /// The mean claimed.
        mean_percent: f64,
        /// The highest value claimed.
        max_percent: f64,
    },
    /// A series is faster than others.
    Faster {
        /// Number of the table.
        table: u8,
        /// The faster series.
        series: String,
        /// The slower ones.
        than: Vec<String>,
        /// Where.
        scenes: Vec<String>,
    },
    /// A series is faster than another up to a number of triangles.
    Crossover {
        /// Number of the table.
        table: u8,
        /// The series that is faster at first.
        series: String,
        /// The one that is faster in the end.
        than: String,
        /// The number of triangles claimed.
        triangles: u64,
    },
    /// A series reaches a share of another's speed.
    Share {
        /// Number of the table.
        table: u8,
        /// Where.
        scene: String,
        /// The slower series.
        series: String,
        /// The faster one.
        of: String,
        /// The shares claimed, one a device.
        percent: Vec<f64>,
    },
    /// A series gains on another from a small scene to a large one.
    Grows {
        /// Number of the table.
        table: u8,
        /// The scene of less geometry.
        small: String,
        /// The scene of more geometry.
        large: String,
        /// Who gains on whom.
        pairs: Vec<Pair>,
    },
}

/// Two series compared.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Pair {
    /// The series that gains.
    pub series: String,
    /// The series on which it gains.
    pub over: String,
}
