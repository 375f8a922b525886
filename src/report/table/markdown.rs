//! Markdown tables, aligned so that they also read well in a terminal.

use super::{Cell, Column, Part, Row, Table};

/// No column is narrower than its rule.
const MIN_WIDTH: usize = 3;

/// `text` on one line, with the characters escaped that Markdown would read as markup.
pub fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '|' | '<' | '*' | '`' | '\\' => escaped.extend(['\\', c]),
            '\n' | '\r' => escaped.push(' '),
            _ => escaped.push(c),
        }
    }
    escaped
}

impl Table {
    /// The table as Markdown, every column as wide as its widest cell; but the last one, where it holds text, as
    /// wide as its head, lest one long text make every line too long for a terminal.
    pub fn markdown(&self) -> String {
        let mut rows = Vec::new();
        for group in &self.groups {
            let mut cells = group.rows.as_slice();
            if let Some(head) = &group.head {
                let mut line: Vec<String> = head.plain.iter().map(markdown).collect();
                line.resize(self.columns.len(), String::new());
                // A group without numbers says why in its own line.
                if let [row] = cells
                    && row.cells.len() == 1
                {
                    line[self.columns.len() - 1] = with_reason(row);
                    cells = &[];
                }
                rows.push(line);
            }
            rows.extend(cells.iter().map(|row| self.line(row)));
        }
        let heads: Vec<String> = self.columns.iter().map(|c| escape(&c.line())).collect();
        let width = |(column, head): (usize, &String)| {
            let is_ragged = column + 1 == heads.len() && self.columns[column].is_text;
            let rows = if is_ragged { &[] } else { rows.as_slice() };
            let widths = rows.iter().map(|row| row[column].chars().count());
            widths.fold(head.chars().count().max(MIN_WIDTH), usize::max)
        };
        let widths: Vec<usize> = heads.iter().enumerate().map(width).collect();
        let rule = self.columns.iter().zip(&widths).map(|(column, width)| {
            let end = if column.is_text { "-" } else { ":" };
            format!("{}{end}", "-".repeat(width - 1))
        });
        let rule: Vec<String> = rule.collect();
        let lines = [&heads, &rule].into_iter().chain(&rows);
        lines.map(|line| self.joined(line, &widths)).collect()
    }

    fn line(&self, row: &Row) -> Vec<String> {
        let mut line: Vec<String> = row.cells.iter().map(markdown).collect();
        if row.is_absent {
            let missing = self.columns.len() - line.len();
            line.splice(1..1, vec![super::DASH.to_owned(); missing]);
        }
        if let (Some(last), false) = (line.last_mut(), row.reason.is_empty()) {
            *last = with_reason(row);
        }
        line
    }

    fn joined(&self, line: &[String], widths: &[usize]) -> String {
        let padded = |((cell, column), width): ((&String, &Column), &usize)| {
            if column.is_text {
                format!("{cell:<width$}")
            } else {
                format!("{cell:>width$}")
            }
        };
        let cells = line.iter().zip(&self.columns).zip(widths).map(padded);
        format!("| {} |\n", cells.collect::<Vec<_>>().join(" | "))
    }
}

/// The last cell of a row, and why.
fn with_reason(row: &Row) -> String {
    let last = row.cells.last().map(markdown).unwrap_or_default();
    format!("{last}: {}", escape(&row.reason))
}

fn markdown(cell: &Cell) -> String {
    cell.line(|part, text| match part {
        Part::Strong(_) => format!("**{}**", escape(text)),
        _ => escape(text),
    })
}
