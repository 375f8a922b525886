//! Tables and ledger over the published numbers and over made-up runs.

use super::spec::{Place, Point, Series};
use super::{Paper, published};
use crate::record::{Cell, Summary};
use crate::report::fixture::{info, paper_row};
use crate::report::groups::group;
use crate::report::load::Run;
use crate::variant::Variant;

mod ledger;
mod tables;

/// Where the cell of a series at a point is measured.
fn place(series: &Series, point: Point) -> Cell {
    let (scene, triangles, objects) = match point {
        Point::Triangles(triangles) => ("sphere_grid_n1", triangles, 100),
        Point::Objects(objects) => ("sphere_objects_1x1_n1", 983_756, objects),
        Point::Scene(Place::Spheres4M) => ("sphere_grid_n200", 4_000_000, 100),
        Point::Scene(Place::Sponza) => ("sponza", 262_267, 381),
    };
    let consistent = series.determinism == "consistent_triangle";
    Cell {
        scene: scene.to_owned(),
        triangles: Some(triangles),
        objects: Some(objects),
        method: series.method.to_owned(),
        variant: if consistent {
            "determinism=consistent_triangle".parse().unwrap()
        } else {
            Variant::default()
        },
        width: info(&[], &[]).width,
        height: info(&[], &[]).height,
        counters: Vec::new(),
    }
}

/// Rows with the numbers of a published device, as `change` changes them; `None` leaves one out.
fn rows_like(device: &str, change: impl Fn(u8, &str, Point, f64) -> Option<f64>) -> Vec<Summary> {
    let mut rows: Vec<Summary> = Vec::new();
    for sheet in published::sheets().unwrap() {
        let column = sheet.columns.iter().find(|c| c.device == device).unwrap();
        for (series, what) in sheet.spec.series.iter().enumerate() {
            for (at, point) in sheet.points.iter().enumerate() {
                let cell = column.cell(series, at);
                let fps = cell.and_then(|c| change(sheet.spec.number, what.id, *point, c.fps));
                let cell = place(what, *point);
                let known = |row: &Summary| {
                    (
                        &row.scene,
                        row.triangles,
                        row.objects,
                        &row.method,
                        &row.variant,
                    ) == (
                        &cell.scene,
                        cell.triangles,
                        cell.objects,
                        &cell.method,
                        &cell.variant,
                    )
                };
                if let (Some(fps), false) = (fps, rows.iter().any(known)) {
                    rows.push(paper_row(&cell, fps, Some(0)));
                }
            }
        }
    }
    rows
}

fn compare(runs: &[Run]) -> Paper {
    Paper::compare(&group(runs, false).unwrap())
        .unwrap()
        .unwrap()
}
