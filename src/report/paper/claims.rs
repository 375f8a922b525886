//! What a paper claims, and how that is held against numbers.

use serde::Deserialize;

#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Claim {
    pub id: String,
    pub text: String,
    pub claimed: String,
    /// What to know about the paper's own numbers; may be empty.
    #[serde(default)]
    pub note: String,
    pub check: Check,
}

/// How a claim is held against numbers. Tables go by their numbers, series and scenes by their ids.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub(crate) enum Check {
    /// A series is faster than another by so many percent: speed over speed, less one.
    SpeedUp {
        series: String,
        over: String,
        /// The tables that have both. The claim's mean is held against the first.
        tables: Vec<u8>,
        mean_percent: f64,
        max_percent: f64,
    },
    /// A series is faster than others.
    Faster {
        table: u8,
        series: String,
        than: Vec<String>,
        scenes: Vec<String>,
    },
    /// A series is faster than another up to a number of triangles.
    Crossover {
        table: u8,
        series: String,
        than: String,
        triangles: u64,
    },
    /// A series reaches a share of another's speed.
    Share {
        table: u8,
        scene: String,
        series: String,
        of: String,
        /// The shares claimed, one a device.
        percent: Vec<f64>,
    },
    /// A series gains on another from a small scene to a large one.
    Grows {
        table: u8,
        small: String,
        large: String,
        pairs: Vec<Pair>,
    },
}

#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Pair {
    pub series: String,
    pub over: String,
}
