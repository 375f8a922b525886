//! Tables for a terminal, in blocks of as many columns as a line has room for.

use super::Table;

/// As wide as a line may be.
const MAX_COLUMNS: usize = 120;
const GAP: &str = "  ";

impl Table {
    /// The table as text. The first column is repeated in every block.
    pub fn text(&self) -> String {
        let heads = self.columns.iter().map(|column| column.line());
        let mut lines: Vec<Vec<String>> = vec![heads.collect()];
        for row in self.groups.iter().flat_map(|group| &group.rows) {
            let cells = row.cells.iter();
            lines.push(
                cells
                    .map(|cell| cell.line(|_, text| text.to_owned()))
                    .collect(),
            );
        }
        let width = |column: usize| {
            let widths = lines.iter().map(|line| line[column].chars().count());
            widths.max().unwrap_or_default()
        };
        let widths: Vec<usize> = (0..self.columns.len()).map(width).collect();
        let blocks = blocks(&widths);
        let block = |columns: &Vec<usize>| -> String {
            lines
                .iter()
                .map(|line| self.cut(line, &widths, columns))
                .collect()
        };
        blocks.iter().map(block).collect::<Vec<_>>().join("\n")
    }

    /// A line with the columns of a block alone.
    fn cut(&self, line: &[String], widths: &[usize], columns: &[usize]) -> String {
        let mut text = format!("{:<width$}", line[0], width = widths[0]);
        for &column in columns {
            let (cell, width) = (&line[column], widths[column]);
            text.push_str(GAP);
            text.push_str(&if self.columns[column].is_text {
                format!("{cell:<width$}")
            } else {
                format!("{cell:>width$}")
            });
        }
        format!("{}\n", text.trim_end())
    }
}

/// The columns but the first, as many in a block as a line has room for.
fn blocks(widths: &[usize]) -> Vec<Vec<usize>> {
    let mut blocks: Vec<Vec<usize>> = Vec::new();
    let mut left = 0;
    for (column, width) in widths.iter().enumerate().skip(1) {
        let width = GAP.len() + width;
        match blocks.last_mut() {
            Some(block) if width <= left => {
                block.push(column);
                left -= width;
            }
            _ => {
                blocks.push(vec![column]);
                left = MAX_COLUMNS.saturating_sub(widths[0] + width);
            }
        }
    }
    blocks
}
