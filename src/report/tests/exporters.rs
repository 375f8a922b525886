//! What every exporter writes, word for word. After a change that is meant to be seen, look at each difference and
//! accept it: `INSTA_UPDATE=always cargo test --release --lib report`.

use super::*;
use crate::report::pareto::PARETO_FILE;

/// A page with a line for each tag, without its style sheet and plots.
fn structure(page: &str) -> String {
    let mut text = page.to_owned();
    for (from, to) in [
        ("<style>", "</style>"),
        ("<svg", "</svg>"),
        ("base64,", "\""),
    ] {
        while let Some(start) = text.find(from) {
            let end = start + text[start..].find(to).unwrap();
            text.replace_range(start..end + to.len(), "");
        }
    }
    text.replace("><", ">\n<")
}

/// The words of a plot, in the order in which they are drawn, and how many shapes of each kind it has.
fn words(svg: &str) -> String {
    let lines = svg.lines().map(str::trim);
    let words: Vec<&str> = lines
        .filter(|line| !line.is_empty() && !line.starts_with('<'))
        .collect();
    let shapes = ["polyline", "polygon", "circle", "rect"];
    let counts =
        shapes.map(|shape| format!("{} {shape}", svg.matches(&format!("<{shape}")).count()));
    format!("{}\n{}", counts.join(", "), words.join("\n"))
}

#[test]
fn results_as_markdown() {
    let (dir, _) = run_without_a_model();
    let run = Run::read(dir.path()).unwrap();
    insta::assert_snapshot!(results::markdown(&run));
    let run = Run::read(made_up_run().path()).unwrap();
    insta::assert_snapshot!("results_with_wrong_masks", results::markdown(&run));
}

#[test]
fn the_page_of_a_run() {
    insta::assert_snapshot!(structure(&html_of(&made_up_run())));
}

#[test]
fn sections_of_a_run_with_sweeps() {
    let page = structure(&html_of(&swept_run()));
    let cuts = [
        ("pareto", "<section id=\"pareto\">", "</details>"),
        ("errors", "<h3>sponza</h3>", "</section>"),
        ("bias", "<section id=\"bias\">", "</section>"),
    ];
    for (name, from, to) in cuts {
        let (_, rest) = page.split_once(from).unwrap();
        let (text, _) = rest.split_once(to).unwrap();
        insta::assert_snapshot!(format!("section_{name}"), text);
    }
}

#[test]
fn points_as_csv() {
    let dir = swept_run();
    let clouds = pareto::clouds(&Run::read(dir.path()).unwrap());
    pareto::write(dir.path(), &clouds).unwrap();
    insta::assert_snapshot!(fs::read_to_string(dir.path().join(PARETO_FILE)).unwrap());
}

#[test]
fn the_words_of_plots() {
    let run = Run::read(made_up_run().path()).unwrap();
    let clouds = pareto::clouds(&run);
    let mut plots = plots::draw_pareto(&run, &clouds).unwrap();
    plots.extend(plots::draw(&run).unwrap());
    let texts = plots
        .iter()
        .map(|plot| format!("== {}\n{}\n", plot.name, words(&plot.svg)));
    insta::assert_snapshot!(texts.collect::<String>());
}
