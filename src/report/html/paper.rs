//! The paper's tables with measured devices beside the published ones.

use maud::{Markup, html};

use crate::report::paper::Sheet;
use crate::report::paper::sheet::Column;
use crate::report::paper::tables::Address;

/// The section of the paper's tables.
pub(super) fn section(sheets: &[Sheet]) -> Markup {
    html! {
        section #paper {
            h2 { "The paper's tables" }
            p.note {
                "Milet, Kobrtek, Zemčík, Pečiva: " em { "Fast and Robust Tessellation-Based "
                "Silhouette Shadows" } ", 2014. Published numbers stand beside measured ones. "
                "They come from other hardware and another flight: compare how methods rank and "
                "scale, not the values."
            }
            @for sheet in sheets { (table(sheet)) }
        }
    }
}

fn table(sheet: &Sheet) -> Markup {
    let title = sheet.title();
    let corner = if sheet.spec.series_are_rows {
        "Method"
    } else {
        sheet.spec.points
    };
    html! {
        h3 { (title) }
        div.scroll tabindex="0" role="region" aria-label=(title) {
            table.paper {
                thead {
                    tr {
                        th.text scope="col" rowspan="2" { (corner) }
                        @for column in &sheet.columns {
                            th.group.measured[!column.is_published()] scope="colgroup"
                                colspan=(sheet.across())
                            {
                                (column.device)
                                small { @if column.is_published() { "published" } @else { "measured" } }
                            }
                        }
                    }
                    tr {
                        @for column in &sheet.columns {
                            @for across in 0..sheet.across() {
                                th.measured[!column.is_published()].first[across == 0] scope="col" {
                                    (sheet.across_name(across))
                                }
                            }
                        }
                    }
                }
                tbody {
                    @for down in 0..sheet.down() {
                        tr {
                            th.text scope="row" { (sheet.down_name(down)) }
                            @for column in &sheet.columns {
                                @for across in 0..sheet.across() {
                                    (cell(sheet, column, sheet.address(down, across), across == 0))
                                }
                            }
                        }
                    }
                }
            }
        }
        ul.note { @for note in sheet.notes() { li { (note) } } }
    }
}

fn cell(sheet: &Sheet, column: &Column, Address { series, point }: Address, first: bool) -> Markup {
    let Some(cell) = column.cell(series, point) else {
        return html! { td.first[first].measured[!column.is_published()] { "–" } };
    };
    let fps = format!("{}{}", cell.text(), cell.mask.mark());
    html! {
        td.first[first].measured[!column.is_published()] {
            @if column.is_best(series, point) { strong { (fps) } } @else { (fps) }
            @for part in sheet.beside(cell) { small { (part) } }
        }
    }
}
