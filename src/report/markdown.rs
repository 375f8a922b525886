//! Markdown tables, aligned so that they also read well in a terminal.

/// `text` on one line, with the characters escaped that Markdown would read as markup.
pub(super) fn escape(text: &str) -> String {
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

/// The rows as a Markdown table, the first one the head, every column as wide as its widest cell; but
/// the last one, where it holds text, as wide as its head, lest one long text make every line too
/// long for a terminal. Text columns are set to the left, the others to the right.
pub(super) fn align(rows: &[Vec<String>], text_columns: &[usize]) -> String {
    let columns = rows.first().map_or(0, Vec::len);
    let width = |column: usize| {
        let ragged = column + 1 == columns && text_columns.contains(&column);
        let rows = if ragged { &rows[..1] } else { rows };
        rows.iter()
            .map(|row| row[column].chars().count())
            .max()
            .unwrap_or_default()
            .max(3)
    };
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let mut text = String::new();
    for (index, row) in rows.iter().enumerate() {
        let cells = row
            .iter()
            .zip(&widths)
            .enumerate()
            .map(|(column, (cell, width))| {
                if text_columns.contains(&column) {
                    format!("{cell:<width$}")
                } else {
                    format!("{cell:>width$}")
                }
            });
        text.push_str(&format!("| {} |\n", cells.collect::<Vec<_>>().join(" | ")));
        if index == 0 {
            text.push_str(&rule(&widths, text_columns));
        }
    }
    text
}

/// The line between head and body, which says how columns are set.
fn rule(widths: &[usize], text_columns: &[usize]) -> String {
    let rules = widths.iter().enumerate().map(|(column, width)| {
        let end = if text_columns.contains(&column) {
            "-"
        } else {
            ":"
        };
        format!("{}{end}", "-".repeat(width - 1))
    });
    format!("| {} |\n", rules.collect::<Vec<_>>().join(" | "))
}
