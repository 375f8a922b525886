//! A paper's tables as CSV, a row a cell, and laid out as in the paper.

use anyhow::Result;
use csv::StringRecord;
use serde::Serialize;

use super::sheet::{Column, Sheet};
use crate::record::unique;
use crate::report::table::{self, Cell, Table, escape};
use crate::table::text_under;

impl Sheet {
    /// The table as CSV: a row for each cell of each device, measured or not. The columns from `device` on are those of
    /// the published files.
    pub(crate) fn csv(&self) -> Result<String> {
        let tables = &self.paper.tables;
        let series = tables.iter().flat_map(|table| &table.series_columns);
        let points = tables.iter().flat_map(|table| &table.point_columns);
        let keys: Vec<&String> = unique(series.chain(points));
        let mut head = StringRecord::from(vec!["source", "device"]);
        keys.iter().for_each(|key| head.push_field(key));
        head.push_field(self.paper.quantity.column());
        let more = [
            "best",
            "mask",
            "record_ms_median",
            "draw_calls",
            "svbench_method",
            "variant",
            "run",
        ];
        head.extend(more);
        let mut rows = Vec::new();
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
        Ok(String::from_utf8(text_under(head, &rows)?)?)
    }

    fn csv_row<'a>(
        &'a self,
        keys: &[&String],
        column: &'a Column,
        series: usize,
        point: usize,
    ) -> impl Serialize + use<'a> {
        let value = column.value(series, point);
        let method = &*self.paper.series[&self.spec.series[series]].method;
        let (source, method) = if column.is_published() {
            ("paper", "")
        } else {
            ("measured", method)
        };
        let keys = keys.iter().map(|key| self.key(key, series, point));
        (
            source,
            &column.device,
            keys.collect::<Vec<_>>(),
            value.map(|value| value.value),
            value.is_some_and(|value| self.is_best(column, value)),
            value.map(|value| value.mask),
            value.and_then(|value| value.record_ms),
            value.and_then(|value| value.draw_calls),
            method,
            column.variant(series),
            value.map(|value| &value.run),
        )
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
    pub(crate) fn markdown(&self) -> String {
        let notes = self.notes();
        let notes = notes.iter().map(|note| format!("- {}\n", escape(note)));
        let notes: String = notes.collect();
        format!("# {}\n\n{}\n{notes}", self.title(), self.table().markdown())
    }

    /// The table, laid out as in the paper.
    pub(crate) fn table(&self) -> Table {
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
            let [first, class, by] = if column.is_published() {
                ["first", "", "published"]
            } else {
                ["first measured", "measured", "measured"]
            };
            let over = Cell::from(column.device.as_str()).small(by).class(class);
            for (index, name) in across.iter().enumerate() {
                let class = if index == 0 { first } else { class };
                let head = table::Column::number(Cell::from(name.as_str()).class(class));
                let plain = format!("{}: {name}", column.device);
                columns.push(head.over(over.clone()).plain(plain).class(class));
            }
        }
        let rows = down.into_iter().enumerate().map(|(down, name)| {
            let mut cells = vec![name.into()];
            for column in &self.columns {
                cells.extend((0..across.len()).map(|across| match spec.series_are_rows {
                    true => self.cell(column, down, across),
                    false => self.cell(column, across, down),
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
        let cell = if self.is_best(column, value) {
            Cell::strong(value.text())
        } else {
            value.text().into()
        };
        self.beside(value).into_iter().fold(cell, Cell::small)
    }
}
