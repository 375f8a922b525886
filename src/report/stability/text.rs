//! The matrix for a terminal and as Markdown.

use super::{Cell, Failure, Line, Matrix, StressRun, Unseen};
use crate::report::format::{count, short};
use crate::report::markdown::{align, escape};

/// As wide as a line may be for a terminal.
const MAX_COLUMNS: usize = 120;
const GAP: &str = "  ";
const NOTES: &str = "A cell says the first value at which the method fails, and its artifact pixels there \
    and, after an arrow, where they are the most. **!** is a failure that no limit of the method declares; \
    · no failure; – unavailable.";

impl StressRun {
    /// The matrix for a terminal: methods are numbered columns, their names a legend below.
    pub fn matrix_text(&self) -> String {
        let matrix = self.matrix();
        let mut text = String::new();
        let rows: Vec<Vec<String>> = matrix.lines.iter().map(texts).collect();
        for columns in blocks(&matrix, &rows) {
            text.push_str(&block(&matrix, &rows, &columns));
            text.push('\n');
        }
        let digits = matrix.methods.len().to_string().len();
        for (index, method) in matrix.methods.iter().enumerate() {
            text.push_str(&format!("{:>digits$}{GAP}{}\n", index + 1, method.name()));
        }
        text.push_str(&format!("\n{}\n{}\n", legend(&rows), self.tally()));
        for unseen in self.unseen() {
            text.push_str(&format!("declared, not seen: {}\n", unseen.words()));
        }
        text
    }

    /// The matrix as a Markdown document.
    pub fn matrix_markdown(&self) -> String {
        let matrix = self.matrix();
        let mut head = vec!["Cause".to_owned(), "Number".to_owned()];
        head.extend(matrix.methods.iter().map(|method| escape(&method.name())));
        let mut rows = vec![head];
        for line in &matrix.lines {
            let mut row = vec![escape(&line.cause.id), escape(&line.cause.number)];
            row.extend(line.cells.iter().map(markdown_cell));
            rows.push(row);
        }
        let mut text = format!(
            "# {}\n\n{}\n{NOTES}\n\n{}\n",
            escape(self.title()),
            align(&rows, &[0, 1]),
            self.tally()
        );
        let unseen = self.unseen();
        if !unseen.is_empty() {
            text.push_str("\n## Declared, not seen\n\n");
        }
        for unseen in unseen {
            text.push_str(&format!("- {}\n", escape(&unseen.words())));
        }
        text
    }

    /// What the run is about.
    pub fn title(&self) -> &str {
        match self.info.title.trim() {
            "" => "Stress run",
            title => title,
        }
    }

    /// The counts in a sentence.
    fn tally(&self) -> String {
        let counts = self.counts();
        let of = |number: usize| count(number as u64);
        let end = if self.info.complete {
            ""
        } else {
            " The run was interrupted."
        };
        let failed = match counts.failed {
            0 => String::new(),
            failed => format!(", {} not drawn", of(failed)),
        };
        format!(
            "Of {} pictures, {} right, {} wrong by a declared limit, {} wrong undeclared, {} unavailable{failed}.{end}",
            of(counts.all()),
            of(counts.right),
            of(counts.declared),
            of(counts.undeclared),
            of(counts.unavailable)
        )
    }
}

impl Unseen<'_> {
    /// In a line.
    fn words(&self) -> String {
        let Self {
            method,
            declared,
            value,
            seen_at,
        } = self;
        let then = match seen_at {
            Some(value) => format!("wrong from {}", short(*value)),
            None => "and at every later value".to_owned(),
        };
        format!(
            "{}: {} from {}, but right at {}, {then}",
            method.name(),
            declared.cause,
            short(declared.from),
            short(*value),
        )
    }
}

/// The cells of a line in few characters.
fn texts(line: &Line<'_>) -> Vec<String> {
    let text = |cell: &Cell<'_>| match cell {
        Cell::Untried => String::new(),
        Cell::Unavailable { .. } => "–".to_owned(),
        Cell::Right { cut_off: true, .. } => "·…".to_owned(),
        Cell::Right { unavailable: 0, .. } => "·".to_owned(),
        Cell::Right { .. } => "·–".to_owned(),
        Cell::Fails(failure) => format!("{}{}", short(failure.first.value), mark(failure)),
    };
    line.cells.iter().map(text).collect()
}

fn mark(failure: &Failure<'_>) -> &'static str {
    match failure.undeclared {
        None => "",
        Some(_) if failure.begins_undeclared() => "!",
        Some(_) => "+!",
    }
}

/// What the signs in the cells mean: those that there are.
fn legend(rows: &[Vec<String>]) -> String {
    let has = |end: &str| rows.iter().flatten().any(|cell| cell.ends_with(end));
    let mut parts = vec!["A cell says the first value that fails."];
    parts.extend((has("!")).then_some("! declared by no limit."));
    parts.extend((has("+!")).then_some("+! undeclared at a later value."));
    parts.extend(has("·").then_some("· never."));
    parts.extend(has("–").then_some("– unavailable."));
    parts.extend(has("·–").then_some("·– unavailable at some values."));
    parts.extend(has("·…").then_some("·… interrupted before the last value."));
    parts.join(" ")
}

fn label_width(matrix: &Matrix<'_>) -> usize {
    let ids = matrix
        .lines
        .iter()
        .map(|line| line.cause.id.chars().count());
    ids.max().unwrap_or_default().max("cause".len())
}

fn column_width(rows: &[Vec<String>], column: usize) -> usize {
    let cells = rows.iter().map(|row| row[column].chars().count());
    let number = (column + 1).to_string().len();
    cells.max().unwrap_or_default().max(number)
}

/// The columns, as many in a block as a line has room for.
fn blocks(matrix: &Matrix<'_>, rows: &[Vec<String>]) -> Vec<Vec<usize>> {
    let mut blocks: Vec<Vec<usize>> = Vec::new();
    let mut left = 0;
    for column in 0..matrix.methods.len() {
        let width = GAP.len() + column_width(rows, column);
        match blocks.last_mut() {
            Some(block) if width <= left => {
                block.push(column);
                left -= width;
            }
            _ => {
                blocks.push(vec![column]);
                left = MAX_COLUMNS.saturating_sub(label_width(matrix) + width);
            }
        }
    }
    blocks
}

fn block(matrix: &Matrix<'_>, rows: &[Vec<String>], columns: &[usize]) -> String {
    let label = label_width(matrix);
    let line = |name: &str, cell: &dyn Fn(usize) -> String| {
        let mut text = format!("{name:<label$}");
        for &column in columns {
            let width = column_width(rows, column);
            text.push_str(&format!("{GAP}{:>width$}", cell(column)));
        }
        format!("{}\n", text.trim_end())
    };
    let mut text = line("cause", &|column| (column + 1).to_string());
    for (row, of) in rows.iter().zip(&matrix.lines) {
        text.push_str(&line(&of.cause.id, &|column| row[column].clone()));
    }
    text
}

fn markdown_cell(cell: &Cell<'_>) -> String {
    let failure = match cell {
        Cell::Untried => return String::new(),
        Cell::Unavailable { .. } => return "–".to_owned(),
        Cell::Right { cut_off: true, .. } => return "·…".to_owned(),
        Cell::Right { unavailable: 0, .. } => return "·".to_owned(),
        Cell::Right { .. } => return "·–".to_owned(),
        Cell::Fails(failure) => failure,
    };
    let value = match failure.undeclared {
        None => short(failure.first.value),
        Some(_) if failure.begins_undeclared() => format!("**{}!**", short(failure.first.value)),
        Some(later) => format!(
            "{}, **{}!**",
            short(failure.first.value),
            short(later.value)
        ),
    };
    format!("{value} ({})", px(failure))
}

/// Artifact pixels at the first failure and at the worst, once where they are equal.
pub(in crate::report) fn px(failure: &Failure<'_>) -> String {
    let (first, worst) = (failure.first.artifact_px, failure.worst.artifact_px);
    if first == worst {
        format!("{} px", count(first))
    } else {
        format!("{} → {} px", count(first), count(worst))
    }
}
