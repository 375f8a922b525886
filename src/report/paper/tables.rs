//! A paper's tables as CSV, a row a cell, and laid out as in the paper.

use anyhow::Result;

use super::sheet::{Column, Sheet};
use super::value::Value;
use crate::report::table::{self, Cell, Table, escape};
use crate::table::text;

impl Sheet {
    /// The table as CSV: a row for each cell of each device, measured or not. The columns from `device` on are those of
    /// the published files.
    pub fn csv(&self) -> Result<String> {
        let tables = self.paper.tables.iter();
        let mut keys: Vec<&str> = Vec::new();
        let series = tables.clone().flat_map(|table| &table.series_columns);
        for key in series.chain(tables.flat_map(|table| &table.point_columns)) {
            if !keys.contains(&&**key) {
                keys.push(key);
            }
        }
        let mut head = vec!["source", "device"];
        head.extend(&keys);
        head.push(self.paper.quantity.column());
        head.extend(["best", "mask", "record_ms_median", "draw_calls"]);
        head.extend(["svbench_method", "variant", "run"]);
        let mut rows: Vec<Vec<String>> = vec![head.into_iter().map(str::to_owned).collect()];
        for column in &self.columns {
            for point in 0..self.points.len() {
                for (series, what) in self.paper.series_of(self.spec).enumerate() {
                    // What the paper lacks is no cell that it left empty.
                    if what.in_paper || !column.is_published() {
                        rows.push(self.csv_row(&keys, column, series, point));
                    }
                }
            }
        }
        Ok(String::from_utf8(text(&rows)?)?)
    }

    fn csv_row(&self, keys: &[&str], column: &Column, series: usize, point: usize) -> Vec<String> {
        let value = column.value(series, point);
        let of = |of: &dyn Fn(&Value) -> Option<String>| value.and_then(of).unwrap_or_default();
        let what = &self.paper.series[&self.spec.series[series]];
        let is_measured = !column.is_published();
        let source = if is_measured { "measured" } else { "paper" };
        let method = if is_measured {
            what.method.as_str()
        } else {
            ""
        };
        let mut row = vec![source.to_owned(), column.device.clone()];
        row.extend(
            keys.iter()
                .map(|key| self.key(key, series, point).to_owned()),
        );
        row.extend([
            of(&|value| Some(format!("{:?}", value.value))),
            self.is_best(column, series, point).to_string(),
            of(&|value| Some(value.mask.word().to_owned())),
            of(&|value| value.record_ms.map(|record_ms| format!("{record_ms:?}"))),
            of(&|value| value.draw_calls.map(|draws| draws.to_string())),
            method.to_owned(),
            column.variants[series].to_string(),
            of(&|value| column.runs.get(value.run).cloned()),
        ]);
        row
    }

    /// What the published file has in a column for a series and a point.
    fn key(&self, column: &str, series: usize, point: usize) -> &str {
        // Only the last column of an id may have a `_` in it.
        fn part<'a>(columns: &[String], id: &'a str, column: &str) -> Option<&'a str> {
            let place = columns.iter().position(|known| known == column)?;
            id.splitn(columns.len(), '_').nth(place)
        }
        let (series, point) = (&self.spec.series[series], &self.points[point].id);
        let series = part(&self.spec.series_columns, series, column);
        let point = || part(&self.spec.point_columns, point, column);
        series.or_else(point).unwrap_or_default()
    }

    /// The table as a Markdown document.
    pub fn markdown(&self) -> String {
        let notes = self.notes();
        let notes = notes.iter().map(|note| format!("- {}\n", escape(note)));
        let notes: String = notes.collect();
        format!("# {}\n\n{}\n{notes}", self.title(), self.table().markdown())
    }

    /// The table, laid out as in the paper.
    pub fn table(&self) -> Table {
        let spec = self.spec;
        let series = self.paper.series_of(spec).map(|series| {
            let star = if series.in_paper { "" } else { " *" };
            format!("{}{star}", series.name)
        });
        let series: Vec<String> = series.collect();
        let points: Vec<String> = self.points.iter().map(|point| point.name.clone()).collect();
        let (down, across, corner) = if spec.series_are_rows {
            (series, points, "Method")
        } else {
            (points, series, spec.points.as_str())
        };
        let mut columns = vec![table::Column::heads(corner, "text")];
        for column in &self.columns {
            let by = if column.is_published() {
                "published"
            } else {
                "measured"
            };
            let over = Cell::from(column.device.as_str())
                .small(by)
                .class(class(column, false));
            for (index, name) in across.iter().enumerate() {
                let head = Cell::from(name.as_str()).class(class(column, index == 0));
                let plain = format!("{}: {name}", column.device);
                let of = table::Column::number(head).over(over.clone()).plain(plain);
                columns.push(of.class(class(column, index == 0)));
            }
        }
        let rows = down.into_iter().enumerate().map(|(down, name)| {
            let mut cells = vec![Cell::from(name)];
            for column in &self.columns {
                cells.extend((0..across.len()).map(|across| {
                    let is_row = spec.series_are_rows;
                    let (series, point) = if is_row {
                        (down, across)
                    } else {
                        (across, down)
                    };
                    self.cell(column, series, point)
                }));
            }
            cells
        });
        Table::new(self.title(), columns)
            .class("paper")
            .extend(rows)
    }

    fn cell(&self, column: &Column, series: usize, point: usize) -> Cell {
        let Some(value) = column.value(series, point) else {
            return table::DASH.into();
        };
        let cell = if self.is_best(column, series, point) {
            Cell::strong(value.text())
        } else {
            value.text().into()
        };
        self.beside(value).into_iter().fold(cell, Cell::small)
    }
}

fn class(column: &Column, is_first: bool) -> &'static str {
    match (column.is_published(), is_first) {
        (true, true) => "first",
        (true, false) => "",
        (false, true) => "first measured",
        (false, false) => "measured",
    }
}
