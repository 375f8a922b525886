//! The matrix for a terminal and as Markdown.

use super::{Cell, Failure, Matrix, StressRun, Unseen};
use crate::record::stress::Outcome;
use crate::record::unique;
use crate::report::format::{count, short};
use crate::report::table::{self, Column, Part, Table, escape};

const NOTES: &str = "A cell says the first value at which the method fails, and its artifact pixels there \
    and, after an arrow, where they are the most. **!** is a failure that no limit of the method declares; \
    · no failure; – unavailable.";

impl StressRun {
    /// The matrix for a terminal: methods are numbered columns, their names a legend below.
    pub(crate) fn matrix_text(&self) -> String {
        let matrix = self.matrix();
        let numbers = 1..=matrix.methods.len();
        let heads = [Column::text("cause")].into_iter();
        let columns = heads.chain(numbers.map(|number| Column::number(number.to_string())));
        let rows = matrix.lines.iter().map(|line| {
            let head = [table::Cell::from(line.cause.id.as_str())].into_iter();
            let cells = line.cells.iter().map(|cell| text(cell).into());
            head.chain(cells).collect::<Vec<_>>()
        });
        let mut text = Table::new("", columns).extend(rows).text() + "\n";
        let digits = matrix.methods.len().to_string().len();
        for (index, method) in matrix.methods.iter().enumerate() {
            text += &format!("{:>digits$}  {}\n", index + 1, method.name());
        }
        text += &format!("\n{}\n{}\n", legend(&matrix), self.tally());
        let unseen = self.unseen().into_iter();
        let unseen = unseen.map(|unseen| format!("declared, not seen: {}\n", unseen.words()));
        unseen.fold(text, |text, line| text + &line)
    }

    /// The matrix as a Markdown document.
    pub(crate) fn matrix_markdown(&self) -> String {
        let matrix = self.matrix();
        let heads = ["Cause", "Number"].map(Column::text).into_iter();
        let methods = matrix.methods.iter();
        let columns = heads.chain(methods.map(|method| Column::number(method.name())));
        let rows = matrix.lines.iter().map(|line| {
            let heads = [&line.cause.id, &line.cause.number].map(|head| head.as_str().into());
            let cells = line.cells.iter().map(markdown);
            heads.into_iter().chain(cells).collect::<Vec<table::Cell>>()
        });
        let table = Table::new("", columns).extend(rows).markdown();
        let title = escape(self.title());
        let text = format!("# {title}\n\n{table}\n{NOTES}\n\n{}\n", self.tally());
        let unseen = self.unseen().into_iter();
        let unseen = unseen.map(|unseen| format!("- {}\n", escape(&unseen.words())));
        match unseen.collect::<String>() {
            unseen if unseen.is_empty() => text,
            unseen => format!("{text}\n## Declared, not seen\n\n{unseen}"),
        }
    }

    /// What the run is about.
    pub(crate) fn title(&self) -> &str {
        match self.info.title.trim() {
            "" => "Stress run",
            title => title,
        }
    }

    /// The counts in a sentence.
    fn tally(&self) -> String {
        let of = |outcome| count(self.count(outcome) as u64);
        let failed = match of(Outcome::Failed) {
            failed if failed == "0" => String::new(),
            failed => format!(", {failed} not drawn"),
        };
        let end = match self.info.complete {
            true => "",
            false => " The run was interrupted.",
        };
        format!(
            "Of {} pictures, {} right, {} wrong by a declared limit, {} wrong undeclared, {} unavailable{failed}.{end}",
            count(self.rows.len() as u64),
            of(Outcome::Right),
            of(Outcome::Declared),
            of(Outcome::Undeclared),
            of(Outcome::Unavailable)
        )
    }
}

impl Unseen<'_> {
    /// In a line.
    fn words(&self) -> String {
        let then = match self.seen_at {
            Some(value) => format!("wrong from {}", short(value)),
            None => "and at every later value".to_owned(),
        };
        let (method, declared) = (self.method.name(), self.declared);
        let [from, value] = [declared.from, self.value].map(short);
        format!(
            "{method}: {} from {from}, but right at {value}, {then}",
            declared.cause
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
        Some(_) if failure.begins_undeclared() => table::Cell::strong(first + "!"),
        Some(later) => {
            let later = Part::Strong(short(later.value) + "!");
            table::Cell::from(first + ", ").with(later)
        }
    };
    // At the first failure and at the worst, once where they are equal.
    let px = [failure.first, failure.worst].map(|row| row.artifact_px);
    let px = unique(px.into_iter()).into_iter().map(count);
    value.small(px.collect::<Vec<_>>().join(" → ") + " px")
}
