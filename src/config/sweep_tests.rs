use super::*;

/// A point's table, and its curve's with its value.
type Described = (String, Option<(String, f64)>);

fn points(text: &str) -> Result<Vec<Described>, String> {
    let table = DeTable::parse(text).unwrap().into_inner();
    let describe = |table: &DeTable<'_>| {
        let pairs = table.iter().map(|(key, value)| {
            let value = match value.get_ref() {
                DeValue::Integer(n) => n.to_string(),
                DeValue::Float(x) => x.to_string(),
                other => format!("{:?}", other.as_str()),
            };
            format!("{}={value}", key.get_ref())
        });
        pairs.collect::<Vec<_>>().join(",")
    };
    let read = |point: SweepPoint<'_>| {
        let sweep = point.on.map(|on| (describe(&on.table), on.value));
        Ok((describe(&point.table), sweep))
    };
    expand(table, read).map_err(|error| error.message)
}

#[test]
fn plain_values_are_one_point_without_a_curve() {
    assert_eq!(points("a = 1\n").unwrap(), [("a=1".to_owned(), None)]);
}

#[test]
fn curves_run_along_the_longest_list_of_numbers() {
    let found = points("b = [1, 2, 3]\na = [5, 6]\nc = \"x\"").unwrap();
    assert_eq!(found.len(), 6);
    assert_eq!(
        found[1],
        (
            "a=5,b=2,c=Some(\"x\")".to_owned(),
            Some(("a=5,c=Some(\"x\")".to_owned(), 2.0))
        )
    );
    let words = points("a = [\"x\", \"y\"]").unwrap();
    assert!(words.iter().all(|(_, sweep)| sweep.is_none()));
}

#[test]
fn ranges_hold_both_ends() {
    let names = |text| -> Vec<String> {
        let points = points(text).unwrap();
        points.into_iter().map(|(name, _)| name).collect()
    };
    assert_eq!(
        names("r = { from = 512, to = 2048, factor = 2 }"),
        ["r=512", "r=1024", "r=2048"]
    );
    assert_eq!(
        names("r = { from = 0.1, to = 0.3, step = 0.1 }"),
        ["r=0.1", "r=0.2", "r=0.3"]
    );
    assert_eq!(names("r = { from = 1, to = 2, step = 0.5 }").len(), 3);
    assert_eq!(
        names("r = { from = 1e-9, to = 3e-9, factor = 1.5 }"),
        ["r=1e-9", "r=1.5e-9", "r=2.25e-9"]
    );
}

#[test]
fn impossible_lists_are_refused() {
    for (text, part) in [
        ("a = []", "lists no value"),
        ("a = { from = 1, to = 2 }", "`step` above 0"),
        ("a = { from = 1, to = 2, step = 0 }", "`step` above 0"),
        ("a = { from = 0, to = 2, factor = 2 }", "`from` above 0"),
        ("a = { from = 3, to = 2, step = 1 }", "no value"),
        ("a = { from = 0, to = 1, step = 1e-9 }", "too many"),
        (
            "a = { from = 0, upto = 1, step = 1 }",
            "unknown field `upto`",
        ),
    ] {
        let error = points(text).unwrap_err();
        assert!(error.contains(part), "{text}: {error}");
    }
    let long = format!("a = [{}]\nb = [{}]", "1,".repeat(40), "2,".repeat(40));
    assert!(points(&long).unwrap_err().contains("1600 values"));
    let range = "{ from = 1, to = 256, step = 1 }";
    let longer: String = ('a'..='h')
        .map(|name| format!("{name} = {range}\n"))
        .collect();
    assert!(points(&longer).unwrap_err().contains("65536 values"));
}
