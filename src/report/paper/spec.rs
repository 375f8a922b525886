//! What the tables of Milet et al. 2014 are made of, as plain data.
//!
//! A table has **series** (what is compared: methods, or one method's ways to be deterministic) and
//! **points** (where: numbers of triangles, numbers of objects, scenes). Which of the two are its
//! rows is a matter of layout. The points come from the published numbers themselves.

use crate::variant::Variant;
use serde::{Deserialize, Serialize};

use crate::record::Summary;
use crate::report::format::count;

/// A table of the paper, and the figure that draws it.
#[derive(Debug)]
pub struct Spec {
    /// The table's number in the paper.
    pub number: u8,
    /// The number of the figure with the same values.
    pub figure: u8,
    /// What the table shows.
    pub title: &'static str,
    /// What its points are, as an axis is titled.
    pub points: &'static str,
    /// What is compared, in the paper's order.
    pub series: &'static [Series],
    /// Whether the series are the rows, as in table 4; else the points are.
    pub series_are_rows: bool,
    /// Whether the table is about draw calls, so that they and the time of recording are shown.
    pub shows_recording: bool,
    /// The published numbers, as CSV.
    pub published: &'static str,
}

impl Spec {
    /// The name of the table's files, without extension.
    pub fn table_name(&self) -> String {
        format!("table{}", self.number)
    }

    /// The name of the figure's files, without extension.
    pub fn figure_name(&self) -> String {
        format!("figure{}", self.figure)
    }
}

/// One thing compared in a table.
#[derive(Debug, PartialEq, Eq)]
pub struct Series {
    /// Its id in the published numbers: the method, or stage and determinism joined by `_`.
    pub id: &'static str,
    /// Stage in tables 1 and 2, else empty.
    pub stage: &'static str,
    /// Determinism in tables 1 and 2, else empty.
    pub determinism: &'static str,
    /// Its name for people.
    pub name: &'static str,
    /// Id of the method that stands for it here.
    pub method: &'static str,
    /// What that method's variant must say, if anything.
    pub needs: Option<Parameter>,
    /// Whether the paper has it.
    pub in_paper: bool,
}

/// A parameter that a variant must have.
#[derive(Debug, PartialEq, Eq)]
pub struct Parameter {
    /// Name of the parameter.
    pub name: &'static str,
    /// The value wanted.
    pub value: &'static str,
    /// The value of a variant that does not name the parameter.
    pub default: &'static str,
}

/// Where a series is measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Point {
    /// A 10 × 10 sphere grid of this many triangles.
    Triangles(u64),
    /// A million triangles in this many objects.
    Objects(u64),
    /// A scene of table 4.
    Scene(Place),
}

/// A scene of table 4, by its name in the published files.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Place {
    /// A 10 × 10 sphere grid of four million triangles.
    #[serde(rename = "spheres_4m")]
    Spheres4M,
    /// Crytek Sponza.
    Sponza,
}

/// How far from a million table 2's triangles may be: the paper's own 2 %.
const MILLION_TOLERANCE: u64 = 20_000;
const GRID: &str = "sphere_grid";
const GRID_OBJECTS: u64 = 100;
const OBJECTS: &str = "sphere_objects";

impl Point {
    /// Whether a run's row was measured here.
    pub(super) fn holds(self, row: &Summary) -> bool {
        let grid = |triangles| {
            row.scene.starts_with(GRID)
                && row.triangles == Some(triangles)
                && row.objects == Some(GRID_OBJECTS)
        };
        match self {
            Self::Triangles(triangles) => grid(triangles),
            Self::Scene(Place::Spheres4M) => grid(4_000_000),
            Self::Objects(objects) => {
                let near = |triangles: u64| triangles.abs_diff(1_000_000) <= MILLION_TOLERANCE;
                row.scene.starts_with(OBJECTS)
                    && row.objects == Some(objects)
                    && row.triangles.is_some_and(near)
            }
            Self::Scene(Place::Sponza) => row.scene == "sponza",
        }
    }

    /// The place on a figure's axis, where it is a number.
    pub fn number(self) -> Option<u64> {
        match self {
            Self::Triangles(number) | Self::Objects(number) => Some(number),
            Self::Scene(_) => None,
        }
    }

    /// Its name for people.
    pub fn name(self) -> String {
        match self {
            Self::Triangles(number) | Self::Objects(number) => count(number),
            Self::Scene(Place::Spheres4M) => "Spheres, 4M triangles".to_owned(),
            Self::Scene(Place::Sponza) => "Crytek Sponza".to_owned(),
        }
    }
}

impl Series {
    /// Whether a method in this variant stands for the series.
    pub(super) fn is(&self, method: &str, variant: &Variant) -> bool {
        let has =
            |wanted: &Parameter| variant.get(wanted.name).unwrap_or(wanted.default) == wanted.value;
        self.method == method && self.needs.as_ref().is_none_or(has)
    }

    /// What a variant says besides what makes it this series.
    pub(super) fn besides(&self, variant: &Variant) -> Variant {
        match &self.needs {
            Some(parameter) => variant.without(parameter.name),
            None => variant.clone(),
        }
    }
}

/// The four tables, in the paper's order.
pub static SPECS: [Spec; 4] = [
    Spec {
        number: 1,
        figure: 5,
        title: "Silhouette methods on 10 × 10 spheres, by number of triangles",
        points: "Triangles",
        series: &STAGES,
        series_are_rows: false,
        shows_recording: false,
        published: include_str!("../../../results/published/milet2014_table1.csv"),
    },
    Spec {
        number: 2,
        figure: 6,
        title: "Silhouette methods on one million triangles, by number of objects",
        points: "Objects",
        series: &STAGES,
        series_are_rows: false,
        shows_recording: true,
        published: include_str!("../../../results/published/milet2014_table2.csv"),
    },
    Spec {
        number: 3,
        figure: 7,
        title: "Tessellation silhouettes and an 8K shadow map, by number of triangles",
        points: "Triangles",
        series: &[TS_SILHOUETTE, SHADOW_MAP_8K],
        series_are_rows: false,
        shows_recording: false,
        published: include_str!("../../../results/published/milet2014_table3.csv"),
    },
    Spec {
        number: 4,
        figure: 8,
        title: "All methods on 4M triangles of spheres and on Crytek Sponza",
        points: "Scene",
        series: &[
            plain("ts_triangle", "TS triangle", "triangle_ts"),
            TS_SILHOUETTE,
            plain("gs_triangle", "GS triangle", "triangle_gs"),
            silhouette("gs_silhouette", "GS silhouette", "silhouette_gs"),
            SHADOW_MAP_8K,
            Series {
                in_paper: false,
                ..plain("cube_shadow_map", "Cube shadow map", "cube_shadow_map")
            },
        ],
        series_are_rows: true,
        shows_recording: false,
        published: include_str!("../../../results/published/milet2014_table4.csv"),
    },
];

const STAGES: [Series; 4] = [
    Series {
        id: "ts_consistent_triangle",
        stage: "ts",
        determinism: "consistent_triangle",
        name: "TS consistent triangle",
        needs: Some(DETERMINED_BY_TRIANGLE),
        ..TS_SILHOUETTE
    },
    Series {
        id: "ts_reference_edge",
        stage: "ts",
        determinism: "reference_edge",
        name: "TS reference edge",
        ..TS_SILHOUETTE
    },
    Series {
        id: "gs_consistent_triangle",
        stage: "gs",
        determinism: "consistent_triangle",
        name: "GS consistent triangle",
        method: "silhouette_gs",
        needs: Some(DETERMINED_BY_TRIANGLE),
        ..TS_SILHOUETTE
    },
    Series {
        id: "gs_reference_edge",
        stage: "gs",
        determinism: "reference_edge",
        name: "GS reference edge",
        method: "silhouette_gs",
        ..TS_SILHOUETTE
    },
];

const DETERMINED_BY_EDGE: Parameter = Parameter {
    name: "determinism",
    value: "reference_edge",
    default: "reference_edge",
};
const DETERMINED_BY_TRIANGLE: Parameter = Parameter {
    value: "consistent_triangle",
    ..DETERMINED_BY_EDGE
};
const TS_SILHOUETTE: Series = silhouette("ts_silhouette", "TS silhouette", "silhouette_ts");
const SHADOW_MAP_8K: Series = Series {
    needs: Some(Parameter {
        name: "resolution",
        value: "8192",
        default: "8192",
    }),
    ..plain("shadow_map_8k", "Shadow map 8K", "shadow_map")
};

const fn plain(id: &'static str, name: &'static str, method: &'static str) -> Series {
    Series {
        id,
        stage: "",
        determinism: "",
        name,
        method,
        needs: None,
        in_paper: true,
    }
}

const fn silhouette(id: &'static str, name: &'static str, method: &'static str) -> Series {
    Series {
        needs: Some(DETERMINED_BY_EDGE),
        ..plain(id, name, method)
    }
}
