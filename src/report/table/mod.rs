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

mod cell;
mod html;
mod markdown;
mod text;

pub use cell::{Cell, DASH, Part};
pub use markdown::escape;

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
