//! Tables on a page: they scroll inside their own box, and all text is escaped.

use maud::{Markup, PreEscaped, html};

use super::{Cell, Column, Group, Part, Row, Table};

impl Table {
    /// The table as it stands on a page.
    pub fn html(&self) -> Markup {
        html! {
            div.scroll tabindex="0" role="region" aria-label=(self.label) {
                table class=[some(self.class)] {
                    thead { (self.heads()) }
                    @for group in &self.groups {
                        tbody {
                            @if let Some(head) = &group.head {
                                tr.scene {
                                    th scope="rowgroup" colspan=(self.columns.len()) { (head.wide.html()) }
                                }
                            }
                            @for row in &group.rows { (self.row(group, row)) }
                        }
                    }
                    @if let Some(foot) = &self.foot { tfoot { (self.cells(foot)) } }
                }
            }
        }
    }

    fn heads(&self) -> Markup {
        let has_two = self.columns.iter().any(|column| column.has_over());
        let rows = has_two.then_some(2);
        html! {
            tr {
                @for (index, column) in self.columns.iter().enumerate() {
                    @if !column.has_over() {
                        (column.head(rows))
                    } @else if index == 0 || !column.is_under(&self.columns[index - 1].over) {
                        @let over = &column.over;
                        @let alike = self.columns[index..].iter().take_while(|next| next.is_under(over));
                        th class=(classes(["group", &over.class])) scope="colgroup" colspan=(alike.count()) {
                            (over.html())
                        }
                    }
                }
            }
            @if has_two {
                tr { @for column in self.columns.iter().filter(|column| column.has_over()) { (column.head(None)) } }
            }
        }
    }

    fn row(&self, group: &Group, row: &Row) -> Markup {
        let columns = self.columns.len();
        let is_all_absent = group.head.is_some() && row.cells.len() == 1;
        html! {
            @if row.is_absent {
                tr.absent {
                    @if !is_all_absent { (self.columns[0].cell(&row.cells[0])) }
                    td.text.why colspan=(columns - 1 - usize::from(!is_all_absent)) { (row.reason) }
                    @if let (Some(column), Some(last)) = (self.columns.last(), row.cells.last()) {
                        (column.cell(last))
                    }
                }
            } @else {
                (self.cells(row))
                @if !row.reason.is_empty() {
                    tr.remark { td.text.why colspan=(columns) { (row.reason) } }
                }
            }
        }
    }

    fn cells(&self, row: &Row) -> Markup {
        html! {
            tr.absent[row.is_faint] {
                @for (column, cell) in self.columns.iter().zip(&row.cells) { (column.cell(cell)) }
            }
        }
    }
}

impl Column {
    fn has_over(&self) -> bool {
        !self.over.parts.is_empty()
    }

    fn is_under(&self, over: &Cell) -> bool {
        let text = |cell: &Cell| cell.line(|_, text| text.to_owned());
        text(&self.over) == text(over)
    }

    fn head(&self, rows: Option<usize>) -> Markup {
        let class = classes([if self.is_text { "text" } else { "" }, &self.head.class]);
        html! { th class=[some(&class)] scope="col" rowspan=[rows] { (self.head.html()) } }
    }

    fn cell(&self, cell: &Cell) -> Markup {
        let text = if self.is_text && self.class.is_empty() {
            "text"
        } else {
            ""
        };
        let class = classes([text, self.class, &cell.class]);
        let (class, tooltip) = (some(&class), some(&cell.tooltip));
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
    pub fn html(&self) -> Markup {
        html! {
            @for part in &self.parts {
                @match part {
                    Part::Text(text) => (broken(text)),
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

fn broken(text: &str) -> Markup {
    html! {
        @for (index, line) in text.split('\n').enumerate() {
            @if index > 0 { br; }
            (line)
        }
    }
}

fn classes<const N: usize>(classes: [&str; N]) -> String {
    let all = classes.into_iter().filter(|class| !class.is_empty());
    all.collect::<Vec<_>>().join(" ")
}

/// A value of an attribute that is left out where it is empty.
fn some(text: &str) -> Option<&str> {
    (!text.is_empty()).then_some(text)
}
