//! The matrix for a terminal and as Markdown.

use super::{Cell, Failure, Matrix, StressRun, Unseen};
use crate::report::format::{count, short};
use crate::report::table::{self, Column, Part, Table, escape};

const NOTES: &str = "A cell says the first value at which the method fails, and its artifact pixels there \
    and, after an arrow, where they are the most. **!** is a failure that no limit of the method declares; \
    · no failure; – unavailable.";

impl StressRun {
    /// The matrix for a terminal: methods are numbered columns, their names a legend below.
    pub fn matrix_text(&self) -> String {
        let matrix = self.matrix();
        let numbers = (1..=matrix.methods.len()).map(|number| Column::number(number.to_string()));
        let columns = [Column::text("cause")].into_iter().chain(numbers);
        let rows = matrix.lines.iter().map(|line| {
            let cells = line.cells.iter().map(|cell| text(cell).into());
            let head = [line.cause.id.as_str().into()].into_iter();
            head.chain(cells).collect::<Vec<table::Cell>>()
        });
        let mut text = Table::new("", columns).extend(rows).text() + "\n";
        let digits = matrix.methods.len().to_string().len();
        for (index, method) in matrix.methods.iter().enumerate() {
            text.push_str(&format!("{:>digits$}  {}\n", index + 1, method.name()));
        }
        text.push_str(&format!("\n{}\n{}\n", legend(&matrix), self.tally()));
        for unseen in self.unseen() {
            text.push_str(&format!("declared, not seen: {}\n", unseen.words()));
        }
        text
    }

    /// The matrix as a Markdown document.
    pub fn matrix_markdown(&self) -> String {
        let matrix = self.matrix();
        let methods = matrix
            .methods
            .iter()
            .map(|method| Column::number(method.name()));
        let columns = ["Cause", "Number"]
            .map(Column::text)
            .into_iter()
            .chain(methods);
        let rows = matrix.lines.iter().map(|line| {
            let heads = [
                line.cause.id.as_str().into(),
                line.cause.number.as_str().into(),
            ];
            let cells = line.cells.iter().map(markdown);
            heads.into_iter().chain(cells).collect::<Vec<table::Cell>>()
        });
        let table = Table::new("", columns).extend(rows).markdown();
        let title = escape(self.title());
        let mut text = format!("# {title}\n\n{table}\n{NOTES}\n\n{}\n", self.tally());
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

/// A cell in few characters.
fn text(cell: &Cell<'_>) -> String {
    match cell {
        Cell::Untried => "",
        Cell::Unavailable { .. } => table::DASH,
        Cell::Right { cut_off: true, .. } => "·…",
        Cell::Right { unavailable: 0, .. } => "·",
        Cell::Right { .. } => "·–",
        Cell::Fails(failure) => return format!("{}{}", short(failure.first.value), mark(failure)),
    }
    .to_owned()
}

fn mark(failure: &Failure<'_>) -> &'static str {
    match failure.undeclared {
        None => "",
        Some(_) if failure.begins_undeclared() => "!",
        Some(_) => "+!",
    }
}

/// What the signs in the cells mean: those that there are.
fn legend(matrix: &Matrix<'_>) -> String {
    let cells = matrix.lines.iter().flat_map(|line| &line.cells);
    let cells: Vec<String> = cells.map(text).collect();
    let signs = [
        ("!", "! declared by no limit."),
        ("+!", "+! undeclared at a later value."),
        ("·", "· never."),
        ("–", "– unavailable."),
        ("·–", "·– unavailable at some values."),
        ("·…", "·… interrupted before the last value."),
    ];
    let known = signs
        .iter()
        .filter(|(sign, _)| cells.iter().any(|cell| cell.ends_with(sign)));
    let mut parts = vec!["A cell says the first value that fails."];
    parts.extend(known.map(|(_, meaning)| meaning));
    parts.join(" ")
}

fn markdown(cell: &Cell<'_>) -> table::Cell {
    let Cell::Fails(failure) = cell else {
        return text(cell).into();
    };
    let first = short(failure.first.value);
    let value = match failure.undeclared {
        None => first.into(),
        Some(_) if failure.begins_undeclared() => table::Cell::strong(format!("{first}!")),
        Some(later) => {
            let later = Part::Strong(format!("{}!", short(later.value)));
            table::Cell::from(format!("{first}, ")).with(later)
        }
    };
    value.small(px(failure))
}

/// Artifact pixels at the first failure and at the worst, once where they are equal.
fn px(failure: &Failure<'_>) -> String {
    let (first, worst) = (failure.first.artifact_px, failure.worst.artifact_px);
    if first == worst {
        format!("{} px", count(first))
    } else {
        format!("{} → {} px", count(first), count(worst))
    }
}
