//! The paper's own numbers, from the files in `results/published` that come with the program.

use crate::variant::Variant;
use anyhow::{Context as _, Result, bail};
use serde::Deserialize;

use super::sheet::{Cell, Column, Mask, Sheet, Source};
use super::spec::{Place, Point, SPECS, Spec};

/// A row of any of the published tables; each has the columns that it needs.
#[derive(Debug, Deserialize)]
struct Row {
    device: String,
    #[serde(default)]
    stage: String,
    #[serde(default)]
    determinism: String,
    #[serde(default)]
    method: String,
    triangles: Option<u64>,
    objects: Option<u64>,
    scene: Option<Place>,
    fps: f64,
}

impl Row {
    fn series_id(&self) -> String {
        if self.method.is_empty() {
            format!("{}_{}", self.stage, self.determinism)
        } else {
            self.method.clone()
        }
    }

    fn point(&self) -> Result<Point> {
        match (self.triangles, self.objects, self.scene) {
            (Some(triangles), None, None) => Ok(Point::Triangles(triangles)),
            (None, Some(objects), None) => Ok(Point::Objects(objects)),
            (None, None, Some(place)) => Ok(Point::Scene(place)),
            _ => bail!("a row must have triangles, or objects, or a scene"),
        }
    }
}

/// The four tables with the devices of the paper in them.
///
/// # Errors
/// Where a published file does not fit the tables; the tests hold that none does.
pub(super) fn sheets() -> Result<Vec<Sheet>> {
    SPECS
        .iter()
        .map(|spec| {
            sheet(spec).with_context(|| {
                let number = spec.number;
                format!("results/published/milet2014_table{number}.csv is damaged")
            })
        })
        .collect()
}

fn sheet(spec: &'static Spec) -> Result<Sheet> {
    let rows: Vec<Row> = csv::Reader::from_reader(spec.published.as_bytes())
        .deserialize()
        .collect::<Result<_, _>>()?;
    let mut points: Vec<Point> = Vec::new();
    for row in &rows {
        let point = row.point()?;
        if !points.contains(&point) {
            points.push(point);
        }
    }
    let mut columns: Vec<Column> = Vec::new();
    for row in &rows {
        let index = columns.iter().position(|known| known.device == row.device);
        let index = index.unwrap_or_else(|| {
            columns.push(Column {
                device: row.device.clone(),
                source: Source::Paper,
                cells: vec![vec![None; points.len()]; spec.series.len()],
                variants: vec![Variant::default(); spec.series.len()],
                runs: Vec::new(),
            });
            columns.len() - 1
        });
        let id = row.series_id();
        let series = spec.series.iter().position(|series| series.id == id);
        let series = series.with_context(|| format!("unknown: {id}"))?;
        let here = row.point()?;
        let cells = points.iter().zip(&mut columns[index].cells[series]);
        for (_, cell) in cells.filter(|(point, _)| **point == here) {
            *cell = Some(Cell {
                fps: row.fps,
                mask: Mask::Published,
                record_ms: None,
                draw_calls: None,
                run: 0,
            });
        }
    }
    Ok(Sheet {
        spec,
        points,
        columns,
    })
}
