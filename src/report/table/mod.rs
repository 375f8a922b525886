//! Tables as data: what they hold is said once, and rendered as HTML, as Markdown or as text.
//!
//! A [`Table`] has [`Column`]s and [`Row`]s of [`Cell`]s; a cell is a line of [`Part`]s, each with a role (code, a
//! remark in small type), which every renderer shows in its own way. Where each row is about one thing of a kind, a
//! [`Listing`] says column by column what it shows of it.

mod cell;
mod html;
mod lines;

pub(crate) use cell::{Cell, DASH, Part};
pub(crate) use lines::escape;

/// A table, before it is anything to read.
#[derive(Debug, Clone, Default)]
pub(crate) struct Table {
    /// What it shows, for those who cannot see it.
    pub label: String,
    /// Its class on the page, if the style sheet knows one.
    pub class: &'static str,
    pub columns: Vec<Column>,
    pub rows: Vec<Row>,
    /// A last row that sums up the others, if there is one.
    pub foot: Option<Row>,
}

#[derive(Debug, Clone, Default)]
pub(crate) struct Column {
    /// What stands over its head and those of its neighbours; may be empty.
    pub over: Cell,
    pub head: Cell,
    /// Its head in renderings with one line of heads, where that must say more.
    pub plain: Option<String>,
    /// Whether it holds text, which is set to the left; numbers are set to the right.
    pub is_text: bool,
    /// Whether its cells are the heads of their rows.
    pub is_head: bool,
    pub class: &'static str,
}

#[derive(Debug, Clone, Default)]
pub(crate) struct Row {
    /// Fewer than there are columns where there are no numbers: the reason stands in their place.
    pub cells: Vec<Cell>,
    /// Why its numbers are absent or to be doubted; may be empty.
    pub reason: String,
    /// Whether it is less important than others.
    pub is_faint: bool,
    /// For the line above a group of rows: what it says over the whole width of the page's table. Its cells are for
    /// other renderings.
    pub wide: Option<Cell>,
}

/// A table in the making whose rows are known and whose columns are said one by one.
pub(crate) struct Listing<'a, T> {
    things: Vec<&'a T>,
    pub table: Table,
}

impl Table {
    /// A table without rows.
    pub(crate) fn new(label: impl Into<String>, columns: impl IntoIterator<Item = Column>) -> Self {
        Self {
            label: label.into(),
            columns: columns.into_iter().collect(),
            ..Self::default()
        }
    }

    /// A table with a row for each thing, without columns.
    pub(crate) fn of<'a, T>(
        label: impl Into<String>,
        things: impl IntoIterator<Item = &'a T>,
    ) -> Listing<'a, T> {
        let things: Vec<&T> = things.into_iter().collect();
        let rows = things.iter().map(|_| Row::default());
        let table = Self::new(label, []).extend(rows);
        Listing { things, table }
    }

    pub(crate) fn class(self, class: &'static str) -> Self {
        Self { class, ..self }
    }

    pub(crate) fn push(&mut self, row: impl Into<Row>) {
        self.rows.push(row.into());
    }

    pub(crate) fn extend<R: Into<Row>>(mut self, rows: impl IntoIterator<Item = R>) -> Self {
        self.rows.extend(rows.into_iter().map(Into::into));
        self
    }

    /// Begins a group of rows.
    pub(crate) fn begin(&mut self, wide: Cell, plain: Vec<Cell>) {
        let wide = Some(wide);
        self.push(Row {
            wide,
            ..plain.into()
        });
    }
}

impl<'a, T> Listing<'a, T> {
    pub(crate) fn class(mut self, class: &'static str) -> Self {
        self.table.class = class;
        self
    }

    pub(crate) fn text<C: Into<Cell>>(
        self,
        head: impl Into<Cell>,
        cell: impl Fn(&'a T) -> C,
    ) -> Self {
        self.column(Column::text(head), cell)
    }

    pub(crate) fn number<C: Into<Cell>>(
        self,
        head: impl Into<Cell>,
        cell: impl Fn(&'a T) -> C,
    ) -> Self {
        self.column(Column::number(head), cell)
    }

    pub(crate) fn column<C: Into<Cell>>(
        mut self,
        column: Column,
        cell: impl Fn(&'a T) -> C,
    ) -> Self {
        self.table.columns.push(column);
        for (row, thing) in self.table.rows.iter_mut().zip(&self.things) {
            row.cells.push(cell(thing).into());
        }
        self
    }

    pub(crate) fn faint(mut self, is_faint: impl Fn(&T) -> bool) -> Self {
        for (row, thing) in self.table.rows.iter_mut().zip(&self.things) {
            row.is_faint = is_faint(thing);
        }
        self
    }

    /// Sets a head over those of the last columns.
    pub(crate) fn over(mut self, over: &str, columns: usize) -> Self {
        for column in self.table.columns.iter_mut().rev().take(columns) {
            column.over = over.into();
        }
        self
    }
}

impl Column {
    pub(crate) fn text(head: impl Into<Cell>) -> Self {
        Self {
            is_text: true,
            ..Self::number(head)
        }
    }

    pub(crate) fn number(head: impl Into<Cell>) -> Self {
        Self {
            head: head.into(),
            ..Self::default()
        }
    }

    /// A first column, whose cells are the heads of their rows.
    pub(crate) fn heads(head: impl Into<Cell>, class: &'static str) -> Self {
        Self {
            is_head: true,
            class,
            ..Self::text(head)
        }
    }

    /// What stands above.
    pub(crate) fn over(self, over: impl Into<Cell>) -> Self {
        let over = over.into();
        Self { over, ..self }
    }

    pub(crate) fn plain(self, plain: impl Into<String>) -> Self {
        let plain = Some(plain.into());
        Self { plain, ..self }
    }

    pub(crate) fn class(self, class: &'static str) -> Self {
        Self { class, ..self }
    }
}

impl<C: IntoIterator<Item = Cell>> From<C> for Row {
    fn from(cells: C) -> Self {
        Self {
            cells: cells.into_iter().collect(),
            ..Self::default()
        }
    }
}

#[cfg(test)]
mod tests;
