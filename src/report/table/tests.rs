//! One table in all its renderings.

use super::{Cell, Column, Part, Row, Table};

/// A table with all that the model has.
fn everything() -> Table {
    let columns = [
        Column::heads("Method", "method"),
        Column::number("FPS"),
        Column::number(("median", "ms"))
            .over("Shadow")
            .plain("Shadow ms"),
        Column::number(("p95", "ms")).over("Shadow"),
        Column::text("Status"),
    ];
    let mut table = Table::new("All <of> it", columns).class("results");
    table.begin(
        "Spheres & more".into(),
        vec![Cell::strong("Spheres | more")],
    );
    table.push([
        Cell::method("shadow_map", "resolution=512,pcf=3"),
        "59.9".into(),
        Cell::strong("1.5"),
        Cell::from("2.25").small("12 draws").small("0.5 ms"),
        Cell::from("ok").class("status"),
    ]);
    table.push(Row {
        reason: "no <geometry> stage".to_owned(),
        ..[Cell::method("triangle_gs", ""), "unavailable".into()].into()
    });
    table.begin("Town".into(), vec![Cell::strong("Town")]);
    table.push(Row {
        reason: "no model".to_owned(),
        ..[Cell::from("skipped")].into()
    });
    table.begin("Last".into(), Vec::new());
    table.push(Row {
        reason: "cut off".to_owned(),
        is_faint: true,
        ..[
            Cell::from(Part::Link("cause-1".to_owned(), "first".to_owned()))
                .with(Part::Drawn(maud::html! { b { "!" } })),
            None::<&str>.into(),
            "a\nb".into(),
            "3".into(),
            "unverified".into(),
        ]
        .into()
    });
    table
}

#[test]
fn html() {
    // A line a tag reads better than one long line.
    insta::assert_snapshot!(everything().html().into_string().replace("><", ">\n<"));
}

#[test]
fn markdown() {
    insta::assert_snapshot!(everything().markdown());
}

#[test]
fn text() {
    let rows = [["fan", "·", "1e-6!"], ["x", "12", ""]];
    let listing = Table::of("", &rows).text("cause", |row| row[0]);
    let table = listing
        .number("1", |row| row[1])
        .number("2", |row| row[2])
        .table;
    assert_eq!(
        table.text(),
        "cause   1      2\nfan     ·  1e-6!\nx      12\n"
    );
}
