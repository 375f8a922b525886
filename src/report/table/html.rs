//! Tables on a page: they scroll inside their own box, and all text is escaped.

use maud::{Markup, PreEscaped, html};

use super::{Cell, Column, Listing, Part, Row, Table};

impl Table {
    pub(crate) fn html(&self) -> Markup {
        html! {
            div.scroll tabindex="0" role="region" aria-label=(self.label) {
                table class=[classes([self.class])] {
                    thead { (self.heads()) }
                    @for group in self.rows.chunk_by(|_, next| next.wide.is_none()) {
                        tbody { @for row in group { (self.row(row)) } }
                    }
                    @if let Some(foot) = &self.foot { tfoot { (self.row(foot)) } }
                }
            }
        }
    }

    fn heads(&self) -> Markup {
        let over = |column: &Column| column.over.line(str::to_owned, "");
        let is_under = |column: &Column| !column.over.parts.is_empty();
        let rows = self.columns.iter().any(is_under).then_some(2);
        html! {
            tr {
                @for alike in self.columns.chunk_by(|one, next| is_under(one) && over(one) == over(next)) {
                    @if let Some(Column { over, .. }) = alike.iter().find(|column| is_under(column)) {
                        th class=[classes(["group", &over.class])] scope="colgroup" colspan=(alike.len()) {
                            (over.html())
                        }
                    } @else {
                        @for column in alike { (column.head(rows)) }
                    }
                }
            }
            @if rows.is_some() {
                tr { @for column in self.columns.iter().filter(|column| is_under(column)) { (column.head(None)) } }
            }
        }
    }

    /// A row; where numbers are missing before the last cell, the reason.
    fn row(&self, row: &Row) -> Markup {
        let missing = self.columns.len().saturating_sub(row.cells.len());
        let (first, last) = row.cells.split_at(row.cells.len().saturating_sub(1));
        html! {
            @if let Some(wide) = &row.wide {
                tr.scene { th scope="rowgroup" colspan=(self.columns.len()) { (wide.html()) } }
            } @else {
                tr.absent[row.is_faint || missing > 0] {
                    @for (column, cell) in self.columns.iter().zip(first) { (column.cell(cell)) }
                    @if missing > 0 { td.text.why colspan=(missing) { (row.reason) } }
                    @for (column, cell) in self.columns.iter().rev().zip(last) { (column.cell(cell)) }
                }
                @if missing == 0 && !row.reason.is_empty() {
                    tr.remark { td.text.why colspan=(self.columns.len()) { (row.reason) } }
                }
            }
        }
    }
}

impl<T> Listing<'_, T> {
    pub(crate) fn html(&self) -> Markup {
        self.table.html()
    }
}

impl Column {
    fn head(&self, rows: Option<usize>) -> Markup {
        let class = classes([if self.is_text { "text" } else { "" }, &self.head.class]);
        html! { th class=[class] scope="col" rowspan=[rows] { (self.head.html()) } }
    }

    fn cell(&self, cell: &Cell) -> Markup {
        let is_plain = self.is_text && self.class.is_empty();
        let own = if is_plain { "text" } else { self.class };
        let class = classes([own, &cell.class]);
        let tooltip = (!cell.tooltip.is_empty()).then_some(&cell.tooltip);
        html! {
            @if self.is_head {
                th class=[class] scope="row" title=[tooltip] { (cell.html()) }
            } @else {
                td class=[class] title=[tooltip] { (cell.html()) }
            }
        }
    }
}

impl Cell {
    /// Its parts, one after the other.
    pub(crate) fn html(&self) -> Markup {
        html! {
            @for part in &self.parts {
                @match part {
                    Part::Text(text) => {
                        @for (index, line) in text.split('\n').enumerate() { @if index > 0 { br; } (line) }
                    }
                    Part::Code(text) => code { (text) },
                    Part::Strong(text) => strong { (text) },
                    Part::Quiet(text) => {
                        " " span.quiet {
                            @for piece in text.split_inclusive(',') { (piece) (PreEscaped("<wbr>")) }
                        }
                    }
                    Part::Small(text) => small { (text) },
                    Part::Link(id, text) => a href={ "#" (id) } { (text) },
                    Part::Drawn(markup) => (markup),
                }
            }
        }
    }
}

/// The value of an attribute, which is left out where there are none.
fn classes<const N: usize>(classes: [&str; N]) -> Option<String> {
    let all = classes.into_iter().filter(|class| !class.is_empty());
    let all = all.collect::<Vec<_>>().join(" ");
    (!all.is_empty()).then_some(all)
}
