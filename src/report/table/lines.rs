//! Tables in lines: Markdown that also reads well in a terminal, and text for one.

use std::mem;

use super::{Cell, Column, DASH, Part, Table};

/// No column of Markdown is narrower than its rule.
const MIN_WIDTH: usize = 3;
/// As wide as a line of text may be.
const MAX_COLUMNS: usize = 120;
const GAP: &str = "  ";

/// `text` on one line, with the characters escaped that Markdown would read as markup.
pub(crate) fn escape(text: &str) -> String {
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
    pub(crate) fn markdown(&self) -> String {
        let mut lines = self.lines(escape, "**");
        let last = self.columns.len() - 1;
        let width = |column: usize| {
            let is_ragged = column == last && self.columns[column].is_text;
            let lines = if is_ragged { &lines[..1] } else { &lines };
            widest(lines, column).max(MIN_WIDTH)
        };
        let widths: Vec<usize> = (0..=last).map(width).collect();
        let rule = self.columns.iter().zip(&widths).map(|(column, width)| {
            let end = if column.is_text { "-" } else { ":" };
            "-".repeat(width - 1) + end
        });
        lines.insert(1, rule.collect());
        let all: Vec<usize> = (0..=last).collect();
        let lines = lines.iter().map(|line| self.cut(line, &all, &widths));
        lines
            .map(|cells| format!("| {} |\n", cells.join(" | ")))
            .collect()
    }

    /// The table as text, in blocks of as many columns as a line has room for. The first column is repeated in
    /// every block.
    pub(crate) fn text(&self) -> String {
        let lines = self.lines(str::to_owned, "");
        let widths = (0..self.columns.len()).map(|column| widest(&lines, column));
        let widths: Vec<usize> = widths.collect();
        let (mut blocks, mut block) = (Vec::new(), vec![0]);
        let mut left = MAX_COLUMNS.saturating_sub(widths[0]);
        for (column, width) in widths.iter().enumerate().skip(1) {
            let width = GAP.len() + width;
            if block.len() > 1 && width > left {
                blocks.push(mem::replace(&mut block, vec![0]));
                left = MAX_COLUMNS.saturating_sub(widths[0]);
            }
            block.push(column);
            left = left.saturating_sub(width);
        }
        blocks.push(block);
        let text = |block: &Vec<usize>| -> String {
            let lines = lines.iter().map(|line| self.cut(line, block, &widths));
            lines
                .map(|cells| cells.join(GAP).trim_end().to_owned() + "\n")
                .collect()
        };
        blocks.iter().map(text).collect::<Vec<_>>().join("\n")
    }

    /// The heads and the rows, a text a column.
    fn lines(&self, escape: fn(&str) -> String, strong: &str) -> Vec<Vec<String>> {
        let heads = self.columns.iter().map(|column| escape(&column.line()));
        let mut lines: Vec<Vec<String>> = vec![heads.collect()];
        for row in &self.rows {
            let cells = row.cells.iter().map(|cell| cell.line(escape, strong));
            let mut line: Vec<String> = cells.collect();
            if let (Some(last), false) = (line.last_mut(), row.reason.is_empty()) {
                last.push_str(&format!(": {}", escape(&row.reason)));
            }
            let missing = self.columns.len() - line.len();
            match (line.as_mut_slice(), lines.last_mut()) {
                _ if row.wide.is_some() => line.resize(self.columns.len(), String::new()),
                // A group without numbers says why in its own line.
                ([why], Some(group)) if missing > 0 => {
                    group[missing] = mem::take(why);
                    continue;
                }
                _ => drop(line.splice(1..1, vec![DASH.to_owned(); missing])),
            }
            lines.push(line);
        }
        lines
    }

    /// Some columns of a line, each as wide as it is to be.
    fn cut(&self, line: &[String], columns: &[usize], widths: &[usize]) -> Vec<String> {
        let padded = |&column: &usize| {
            let (cell, width) = (&line[column], widths[column]);
            if self.columns[column].is_text {
                format!("{cell:<width$}")
            } else {
                format!("{cell:>width$}")
            }
        };
        columns.iter().map(padded).collect()
    }
}

impl Column {
    fn line(&self) -> String {
        let head = || self.head.line(|text| text.replace('\n', " "), "");
        let line = || head().replace(['(', ')'], "");
        self.plain.clone().unwrap_or_else(line)
    }
}

impl Cell {
    /// Its text in one line, small parts following in brackets. `strong` stands on both sides of what is the best.
    pub(super) fn line(&self, escape: impl Fn(&str) -> String, strong: &str) -> String {
        let (mut line, mut small) = (String::new(), Vec::new());
        for part in &self.parts {
            match part {
                Part::Small(text) => small.push(escape(text)),
                Part::Quiet(text) => line.push_str(&format!(" {}", escape(text))),
                Part::Strong(text) => line.push_str(&format!("{strong}{}{strong}", escape(text))),
                Part::Text(text) | Part::Code(text) | Part::Link(_, text) => {
                    line.push_str(&escape(text));
                }
                Part::Drawn(_) => {}
            }
        }
        if !small.is_empty() {
            line.push_str(&format!(" ({})", small.join(", ")));
        }
        line
    }
}

fn widest(lines: &[Vec<String>], column: usize) -> usize {
    let widths = lines.iter().map(|line| line[column].chars().count());
    widths.max().unwrap_or_default()
}
