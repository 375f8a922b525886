//! Circles among the modules of one folder: each file, and each folder with all that is in it, is one of them.
//! What a folder's `mod.rs` shares with its files is the folder's own matter and no circle.

use super::imports::{Import, Path};
use std::collections::{BTreeMap, BTreeSet};

/// Who imports whom within one folder, with an example of each.
type Graph<'a> = BTreeMap<&'a str, BTreeMap<&'a str, &'a Import>>;

/// All circles: the folder with its modules in the circle, and an example of each import.
pub(crate) fn circles(imports: &[Import]) -> Vec<(String, String)> {
    let mut folders: BTreeMap<Path, Graph<'_>> = BTreeMap::new();
    for import in imports {
        let (from, to) = (&import.from, &import.to);
        let common = from.iter().zip(to).take_while(|(a, b)| a == b).count();
        if let (Some(from_name), Some(to_name)) = (from.get(common), to.get(common)) {
            let graph = folders.entry(from[..common].to_vec()).or_default();
            graph
                .entry(from_name)
                .or_default()
                .entry(to_name)
                .or_insert(import);
        }
    }
    // Between the folders of the root the floors say it.
    folders.retain(|folder, _| !folder.is_empty());
    folders
        .iter()
        .flat_map(|(folder, graph)| circles_of(folder, graph))
        .collect()
}

fn circles_of(folder: &Path, graph: &Graph<'_>) -> Vec<(String, String)> {
    let reached: BTreeMap<_, _> = graph
        .keys()
        .map(|&from| (from, reachable(graph, from)))
        .collect();
    let reaches = |from: &str, to: &str| reached.get(from).is_some_and(|names| names.contains(to));
    let mut seen = BTreeSet::new();
    let mut found = Vec::new();
    for &name in graph.keys() {
        let circle: BTreeSet<_> = graph
            .keys()
            .copied()
            .filter(|&other| reaches(name, other) && reaches(other, name))
            .collect();
        if circle.len() < 2 || !seen.insert(circle.clone()) {
            continue;
        }
        let edges = circle
            .iter()
            .flat_map(|from| &graph[from])
            .filter(|(to, _)| circle.contains(*to));
        let examples: Vec<_> = edges.map(|(_, import)| format!("    {import}")).collect();
        let names: Vec<_> = circle.iter().copied().collect();
        found.push((
            format!("{}: {}", folder.join("::"), names.join(", ")),
            format!("\n{}", examples.join("\n")),
        ));
    }
    found
}

fn reachable<'a>(graph: &Graph<'a>, from: &'a str) -> BTreeSet<&'a str> {
    let mut reached = BTreeSet::new();
    let mut open = vec![from];
    while let Some(name) = open.pop() {
        for &next in graph.get(name).into_iter().flat_map(BTreeMap::keys) {
            if reached.insert(next) {
                open.push(next);
            }
        }
    }
    reached
}
