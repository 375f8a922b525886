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
#[serde(tag = "kind", rename_all = "snake_case")]
pub(crate) enum Check {
    SpeedUp(SpeedUp),
    Faster(Faster),
    Crossover(Crossover),
    Share(Share),
    Grows(Grows),
}

/// A series is faster than another by so many percent: speed over speed, less one.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SpeedUp {
    pub series: String,
    pub over: String,
    /// The tables that have both. The claim's mean is held against the first.
    pub tables: Vec<u8>,
    pub mean_percent: f64,
    pub max_percent: f64,
}

/// A series is faster than others.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Faster {
    pub table: u8,
    pub series: String,
    pub than: Vec<String>,
    pub scenes: Vec<String>,
}

/// A series is faster than another up to a number of triangles.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Crossover {
    pub table: u8,
    pub series: String,
    pub than: String,
    pub triangles: u64,
}

/// A series reaches a share of another's speed.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Share {
    pub table: u8,
    pub scene: String,
    pub series: String,
    pub of: String,
    /// The shares claimed, one a device.
    pub percent: Vec<f64>,
}

/// A series gains on another from a small scene to a large one.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Grows {
    pub table: u8,
    pub small: String,
    pub large: String,
    pub pairs: Vec<Pair>,
}

#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Pair {
    pub series: String,
    pub over: String,
}
