//! What a paper compares and where, and which cells of a run are that.

use serde::Deserialize;

use crate::record::Summary;
use crate::variant::Variant;

/// Which cells of a run are meant.
#[derive(Debug, Clone, Default, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct At {
    /// The scene's name; any where empty.
    pub scene: String,
    /// How the scene's name begins.
    pub scene_prefix: String,
    /// Casting triangles.
    pub triangles: Option<u64>,
    /// How far from that number they may be.
    pub tolerance: u64,
    /// Objects.
    pub objects: Option<u64>,
}

/// One thing compared in a table.
#[derive(Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Series {
    /// Its name for people.
    pub name: String,
    /// Id of the method that stands for it here.
    pub method: String,
    /// What that method's variant must say, if anything.
    pub needs: Option<Needed>,
    /// Whether the paper has it.
    #[serde(default = "yes")]
    pub in_paper: bool,
}

/// A parameter that a variant must have.
#[derive(Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Needed {
    /// Name of the parameter.
    pub name: String,
    /// The value wanted.
    pub value: String,
    /// The value of a variant that does not name the parameter.
    pub default: String,
}

fn yes() -> bool {
    true
}

impl At {
    /// Whether a run's row was measured here.
    pub(super) fn holds(&self, row: &Summary) -> bool {
        let is_near = |triangles: u64| {
            row.triangles
                .is_some_and(|own| own.abs_diff(triangles) <= self.tolerance)
        };
        (self.scene.is_empty() || row.scene == self.scene)
            && row.scene.starts_with(&self.scene_prefix)
            && self.triangles.is_none_or(is_near)
            && (self.objects.is_none() || row.objects == self.objects)
    }
}

impl Series {
    /// Whether a method in this variant stands for the series.
    pub(super) fn is(&self, method: &str, variant: &Variant) -> bool {
        let has =
            |wanted: &Needed| variant.get(&wanted.name).unwrap_or(&wanted.default) == wanted.value;
        self.method == method && self.needs.as_ref().is_none_or(has)
    }

    /// What a variant says besides what makes it this series.
    pub(super) fn besides(&self, variant: &Variant) -> Variant {
        let needed = self.needs.as_ref();
        needed.map_or_else(|| variant.clone(), |needed| variant.without(&needed.name))
    }
}
