//! What a paper compares and where, and which cells of a run are that.

use serde::Deserialize;

use crate::record::Summary;
use crate::variant::Variant;

#[derive(Debug, Clone, Default, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct At {
    /// The scene's name; any where empty.
    pub scene: String,
    /// How the scene's name begins.
    pub scene_prefix: String,
    pub triangles: Option<u64>,
    /// How far from that number they may be.
    pub tolerance: u64,
    pub objects: Option<u64>,
}

#[derive(Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Series {
    pub name: String,
    pub method: String,
    /// What that method's variant must say, if anything.
    pub needs: Option<Needed>,
    #[serde(default = "yes")]
    pub in_paper: bool,
}

#[derive(Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Needed {
    pub name: String,
    pub value: String,
    /// The value of a variant that does not name the parameter.
    pub default: String,
}

fn yes() -> bool {
    true
}

impl At {
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
