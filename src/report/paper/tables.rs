//! The paper's tables as CSV, a row a cell, and as Markdown, laid out as in the paper.

use anyhow::Result;
use serde::Serialize;

use super::sheet::{Column, Sheet};
use super::spec::{Place, Point};
use crate::report::markdown::{align, escape};
use crate::table::text;

/// A row of a table's CSV; `device` to `fps` are the columns of the published files.
#[derive(Debug, Serialize)]
struct Row<'a> {
    source: &'static str,
    device: &'a str,
    stage: &'a str,
    determinism: &'a str,
    method: &'a str,
    triangles: Option<u64>,
    objects: Option<u64>,
    scene: Option<Place>,
    fps: Option<f64>,
    best: bool,
    mask: &'static str,
    record_ms_median: Option<f64>,
    draw_calls: Option<u32>,
    svbench_method: &'a str,
    variant: &'a str,
    run: &'a str,
}

/// A place in the layout: which series, which point.
#[derive(Debug, Clone, Copy)]
pub struct Address {
    /// The series.
    pub series: usize,
    /// The point.
    pub point: usize,
}

impl Sheet {
    /// The table as CSV: a row for each cell of each device, measured or not.
    pub fn csv(&self) -> Result<String> {
        let mut rows = Vec::new();
        for column in &self.columns {
            for point in 0..self.points.len() {
                for series in 0..self.spec.series.len() {
                    // What the paper lacks is no cell that it left empty.
                    if self.spec.series[series].in_paper || !column.is_published() {
                        rows.push(self.row(column, Address { series, point }));
                    }
                }
            }
        }
        Ok(String::from_utf8(text(&rows)?)?)
    }

    fn row<'a>(&'a self, column: &'a Column, Address { series, point }: Address) -> Row<'a> {
        let cell = column.cell(series, point);
        let measured = !column.is_published();
        let (triangles, objects, scene) = match self.points[point] {
            Point::Triangles(triangles) => (Some(triangles), None, None),
            Point::Objects(objects) => (None, Some(objects), None),
            Point::Scene(place) => (None, None, Some(place)),
        };
        let what = &self.spec.series[series];
        Row {
            source: if measured { "measured" } else { "paper" },
            device: &column.device,
            stage: what.stage,
            determinism: what.determinism,
            method: if what.stage.is_empty() { what.id } else { "" },
            triangles,
            objects,
            scene,
            fps: cell.map(|cell| cell.fps),
            best: column.is_best(series, point),
            mask: cell.map_or("", |cell| cell.mask.word()),
            record_ms_median: cell.and_then(|cell| cell.record_ms),
            draw_calls: cell.and_then(|cell| cell.draw_calls),
            svbench_method: if measured { what.method } else { "" },
            variant: column.variants[series].as_str(),
            run: cell.map_or("", |cell| column.run_of(cell)),
        }
    }

    /// The table as Markdown.
    pub fn markdown(&self) -> String {
        let corner = if self.spec.series_are_rows {
            "Method"
        } else {
            self.spec.points
        };
        let mut head = vec![corner.to_owned()];
        for column in &self.columns {
            let names = (0..self.across()).map(|index| self.across_name(index));
            head.extend(names.map(|name| format!("{}: {name}", escape(&column.device))));
        }
        let mut rows = vec![head];
        for down in 0..self.down() {
            let mut row = vec![self.down_name(down)];
            for column in &self.columns {
                let cells = (0..self.across()).map(|across| self.address(down, across));
                row.extend(cells.map(|at| self.cell_text(column, at)));
            }
            rows.push(row);
        }
        let notes: String = self
            .notes()
            .iter()
            .map(|note| format!("- {}\n", escape(note)))
            .collect();
        format!("# {}\n\n{}\n{notes}", self.title(), align(&rows, &[0]))
    }

    /// How many rows the layout has.
    pub fn down(&self) -> usize {
        if self.spec.series_are_rows {
            self.spec.series.len()
        } else {
            self.points.len()
        }
    }

    /// How many columns a device has in the layout.
    pub fn across(&self) -> usize {
        if self.spec.series_are_rows {
            self.points.len()
        } else {
            self.spec.series.len()
        }
    }

    /// What stands at a place of the layout.
    pub fn address(&self, down: usize, across: usize) -> Address {
        if self.spec.series_are_rows {
            Address {
                series: down,
                point: across,
            }
        } else {
            Address {
                series: across,
                point: down,
            }
        }
    }

    /// The head of a row.
    pub fn down_name(&self, index: usize) -> String {
        if self.spec.series_are_rows {
            self.series_name(index)
        } else {
            self.points[index].name()
        }
    }

    /// The head of a device's column.
    pub fn across_name(&self, index: usize) -> String {
        if self.spec.series_are_rows {
            self.points[index].name()
        } else {
            self.series_name(index)
        }
    }

    fn series_name(&self, index: usize) -> String {
        let series = &self.spec.series[index];
        let star = if series.in_paper { "" } else { " *" };
        format!("{}{star}", series.name)
    }

    fn cell_text(&self, column: &Column, Address { series, point }: Address) -> String {
        let Some(cell) = column.cell(series, point) else {
            return "–".to_owned();
        };
        let mut text = format!("{}{}", cell.text(), cell.mask.mark());
        if column.is_best(series, point) {
            text = format!("**{text}**");
        }
        let beside = self.beside(cell);
        if !beside.is_empty() {
            text.push_str(&format!(" ({})", beside.join(", ")));
        }
        text
    }
}
