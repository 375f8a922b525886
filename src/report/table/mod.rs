//! Tables as data: what they hold is said once, and rendered as HTML, as Markdown or as text.
//!
//! A [`Table`] has [`Column`]s and [`Group`]s of [`Row`]s. A [`Cell`] is a line of [`Part`]s, each with a role (code,
//! a remark in small type), which every renderer shows in its own way.
//!
//! ```
//! use svbench::report::table::{Column, Table};
//!
//! let columns = [Column::text("Scene"), Column::number("Frame").unit("ms")];
//! let mut table = Table::new("Frame times", columns);
//! table.push(["sponza".into(), "1.25".into()]);
//! assert_eq!(table.markdown(), "\
//! | Scene  | Frame ms |
//! | ------ | -------: |
//! | sponza |     1.25 |
//! ");
//! ```

use maud::Markup;

mod html;
mod markdown;
mod text;

pub use markdown::escape;

/// What stands where there is nothing to say.
pub const DASH: &str = "–";

/// A table, before it is anything to read.
#[derive(Debug, Clone)]
pub struct Table {
    /// What it shows, for those who cannot see it.
    pub label: String,
    /// Its class on the page, if the style sheet knows one.
    pub class: &'static str,
    /// Its columns.
    pub columns: Vec<Column>,
    /// Its rows, in groups; most tables have one group.
    pub groups: Vec<Group>,
    /// A last row that sums up the others, if there is one.
    pub foot: Option<Row>,
}

/// A column.
#[derive(Debug, Clone)]
pub struct Column {
    /// What stands over its head and those of its neighbours; may be empty.
    pub over: Cell,
    /// Its head.
    pub head: Cell,
    /// Its head in renderings with one line of heads, where that must say more.
    pub plain: Option<String>,
    /// Whether it holds text, which is set to the left; numbers are set to the right.
    pub is_text: bool,
    /// Whether its cells are the heads of their rows.
    pub is_head: bool,
    /// The class of its cells.
    pub class: &'static str,
}

/// Rows that belong together.
#[derive(Debug, Clone, Default)]
pub struct Group {
    /// What they have in common, if anything is said of it.
    pub head: Option<GroupHead>,
    /// The rows.
    pub rows: Vec<Row>,
}

/// The line above a group.
#[derive(Debug, Clone)]
pub struct GroupHead {
    /// Over the whole width of the page's table.
    pub wide: Cell,
    /// In the columns of other renderings, from the first one on.
    pub plain: Vec<Cell>,
}

/// A row.
#[derive(Debug, Clone, Default)]
pub struct Row {
    /// Its cells.
    pub cells: Vec<Cell>,
    /// Why its numbers are absent or to be doubted; may be empty.
    pub reason: String,
    /// Whether there are no numbers: the reason stands in their place.
    pub is_absent: bool,
    /// Whether it is less important than others.
    pub is_faint: bool,
}

/// The content of one cell.
#[derive(Debug, Clone, Default)]
pub struct Cell {
    /// In the order in which they are read.
    pub parts: Vec<Part>,
    /// Class on the page, beside its column's; may be empty.
    pub class: String,
    /// What a pointer over it is told.
    pub tooltip: String,
}

/// A piece of a cell.
#[derive(Debug, Clone)]
pub enum Part {
    /// Plain text.
    Text(String),
    /// What is written in files and commands.
    Code(String),
    /// The best.
    Strong(String),
    /// Text of less weight, which may break after commas.
    Quiet(String),
    /// A line below in small type.
    Small(String),
    /// A link within the page, and its text.
    Link(String, String),
    /// What only the page can show.
    Drawn(Markup),
}

impl Table {
    /// A table without rows.
    pub fn new(label: impl Into<String>, columns: impl IntoIterator<Item = Column>) -> Self {
        Self {
            label: label.into(),
            class: "",
            columns: columns.into_iter().collect(),
            groups: Vec::new(),
            foot: None,
        }
    }

    /// The table, with a class on the page.
    pub fn class(self, class: &'static str) -> Self {
        Self { class, ..self }
    }

    /// Adds a row to the last group.
    pub fn push(&mut self, row: impl Into<Row>) {
        if self.groups.is_empty() {
            self.groups.push(Group::default());
        }
        if let Some(group) = self.groups.last_mut() {
            group.rows.push(row.into());
        }
    }

    /// Adds many rows.
    pub fn extend<R: Into<Row>>(mut self, rows: impl IntoIterator<Item = R>) -> Self {
        rows.into_iter().for_each(|row| self.push(row));
        self
    }

    /// Begins a group of rows.
    pub fn begin(&mut self, wide: Cell, plain: Vec<Cell>) {
        let head = Some(GroupHead { wide, plain });
        self.groups.push(Group {
            head,
            rows: Vec::new(),
        });
    }
}

impl Column {
    /// A column of text.
    pub fn text(head: impl Into<Cell>) -> Self {
        Self {
            over: Cell::default(),
            head: head.into(),
            plain: None,
            is_text: true,
            is_head: false,
            class: "",
        }
    }

    /// A column of numbers.
    pub fn number(head: impl Into<Cell>) -> Self {
        Self {
            is_text: false,
            ..Self::text(head)
        }
    }

    /// A first column, whose cells are the heads of their rows.
    pub fn heads(head: impl Into<Cell>, class: &'static str) -> Self {
        Self {
            is_head: true,
            class,
            ..Self::text(head)
        }
    }

    /// What its numbers are counted in.
    pub fn unit(mut self, unit: &str) -> Self {
        self.head = self.head.small(unit);
        self
    }

    /// What stands above.
    pub fn over(self, over: impl Into<Cell>) -> Self {
        Self {
            over: over.into(),
            ..self
        }
    }

    /// Its head where there is one line of heads.
    pub fn plain(self, plain: impl Into<String>) -> Self {
        Self {
            plain: Some(plain.into()),
            ..self
        }
    }

    /// The class of its cells on the page.
    pub fn class(self, class: &'static str) -> Self {
        Self { class, ..self }
    }
}

impl Cell {
    /// What is written in files and commands.
    pub fn code(text: impl Into<String>) -> Self {
        Self::default().with(Part::Code(text.into()))
    }

    /// The best of its kind.
    pub fn strong(text: impl Into<String>) -> Self {
        Self::default().with(Part::Strong(text.into()))
    }

    /// A link to the place `id` of the page.
    pub fn link(id: impl Into<String>, text: impl Into<String>) -> Self {
        Self::default().with(Part::Link(id.into(), text.into()))
    }

    /// What only the page can show.
    pub fn drawn(markup: Markup) -> Self {
        Self::default().with(Part::Drawn(markup))
    }

    /// The id of a method and its variant, which may be empty.
    pub fn method(id: &str, variant: &str) -> Self {
        let cell = Self::code(id);
        if variant.is_empty() {
            cell
        } else {
            cell.with(Part::Quiet(variant.to_owned()))
        }
    }

    /// The cell, with a line below in small type.
    pub fn small(self, text: impl Into<String>) -> Self {
        self.with(Part::Small(text.into()))
    }

    /// The cell, with one more part.
    pub fn with(mut self, part: Part) -> Self {
        self.parts.push(part);
        self
    }

    /// The cell, with a class on the page.
    pub fn class(self, class: impl Into<String>) -> Self {
        let class = class.into();
        Self { class, ..self }
    }

    /// The cell, with what a pointer over it is told.
    pub fn tooltip(self, tooltip: &str) -> Self {
        let tooltip = tooltip.to_owned();
        Self { tooltip, ..self }
    }

    /// Its text in one line, with each part as `show` has it; small parts follow in brackets.
    fn line(&self, show: impl Fn(&Part, &str) -> String) -> String {
        let (mut line, mut small) = (String::new(), Vec::new());
        for part in &self.parts {
            match part {
                Part::Small(text) => small.push(show(part, text)),
                Part::Quiet(text) => line.push_str(&format!(" {}", show(part, text))),
                Part::Text(text) | Part::Code(text) | Part::Strong(text) | Part::Link(_, text) => {
                    line.push_str(&show(part, text));
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

impl<const N: usize> From<[Cell; N]> for Row {
    fn from(cells: [Cell; N]) -> Self {
        Vec::from(cells).into()
    }
}

impl From<Vec<Cell>> for Row {
    fn from(cells: Vec<Cell>) -> Self {
        Self {
            cells,
            ..Self::default()
        }
    }
}

impl From<String> for Cell {
    fn from(text: String) -> Self {
        Self::default().with(Part::Text(text))
    }
}

impl From<&str> for Cell {
    fn from(text: &str) -> Self {
        text.to_owned().into()
    }
}

impl From<Option<String>> for Cell {
    fn from(text: Option<String>) -> Self {
        text.unwrap_or_else(|| DASH.to_owned()).into()
    }
}

impl Column {
    /// The head in one line.
    fn line(&self) -> String {
        let line = || {
            let head = self.head.line(|_, text| text.replace('\n', " "));
            head.replace(['(', ')'], "")
        };
        self.plain.clone().unwrap_or_else(line)
    }
}

#[cfg(test)]
mod tests;
