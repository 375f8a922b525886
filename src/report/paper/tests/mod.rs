//! Tables and ledger over the published numbers and over made-up runs.

use super::Paper;
use super::numbers;
use super::published::{Publication, papers};
use super::sheet::{Point, Sheet};
use crate::record::{Cell, Summary};
use crate::report::fixture::{info, paper_row};
use crate::report::groups::group;
use crate::report::load::Run;
use crate::variant::Variant;

mod ledger;
mod second;
mod tables;

fn milet() -> &'static Publication {
    let found = papers()
        .unwrap()
        .iter()
        .find(|paper| paper.prefix.is_empty());
    found.unwrap()
}

fn milet_sheets() -> Vec<Sheet> {
    numbers::sheets(milet()).unwrap()
}

/// Where the cell of a series at a point is measured.
fn place(series: &str, point: &Point) -> Cell {
    let (scene, triangles, objects) = match (point.id.as_str(), point.at.objects, point.number) {
        ("spheres_4m", ..) => ("sphere_grid_n200", 4_000_000, 100),
        ("sponza", ..) => ("sponza", 262_267, 381),
        (_, Some(100), Some(triangles)) if point.at.scene_prefix == "sphere_grid" => {
            ("sphere_grid_n1", triangles, 100)
        }
        (_, Some(objects), _) => ("sphere_objects_1x1_n1", 983_756, objects),
        _ => panic!("{point:?}"),
    };
    let consistent = series.ends_with("consistent_triangle");
    Cell {
        scene: scene.to_owned(),
        triangles: Some(triangles),
        objects: Some(objects),
        method: milet().series[series].method.clone(),
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
fn rows_like(device: &str, change: impl Fn(u8, &str, &Point, f64) -> Option<f64>) -> Vec<Summary> {
    let mut rows: Vec<Summary> = Vec::new();
    for sheet in milet_sheets() {
        let column = sheet.columns.iter().find(|c| c.device == device).unwrap();
        for (series, what) in sheet.spec.series.iter().enumerate() {
            for (at, point) in sheet.points.iter().enumerate() {
                let value = column.value(series, at);
                let fps = value.and_then(|v| change(sheet.spec.number, what, point, v.value));
                let cell = place(what, point);
                let key = |row: &Summary| {
                    let Summary {
                        scene,
                        triangles,
                        objects,
                        method,
                        variant,
                        ..
                    } = row.clone();
                    (scene, triangles, objects, method, variant)
                };
                let new = fps.map(|fps| paper_row(&cell, fps, Some(0)));
                rows.extend(new.filter(|new| rows.iter().all(|row| key(row) != key(new))));
            }
        }
    }
    rows
}

fn compare(runs: &[Run]) -> Paper {
    let groups = group(runs, false).unwrap();
    Paper::compare(milet(), &groups).unwrap().unwrap()
}
