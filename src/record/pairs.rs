//! Numbers by name in one field of a row: `volumes=12.3;resolve=0.4`, `acne=120;leak=3`.

use std::fmt::Display;
use std::str::FromStr;

/// Writes numbers by name as a field.
pub fn pairs_to_text<'a, T: Display>(pairs: impl IntoIterator<Item = (&'a str, T)>) -> String {
    let parts: Vec<String> = pairs
        .into_iter()
        .map(|(name, number)| format!("{name}={number}"))
        .collect();
    parts.join(";")
}

/// Reads such a field back; a part that is not `name=number` is left out.
pub fn pairs_from_text<T: FromStr>(text: &str) -> Vec<(&str, T)> {
    text.split(';')
        .filter_map(|part| part.rsplit_once('='))
        .filter_map(|(name, number)| Some((name, number.parse().ok()?)))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_survive_the_way_through_text() {
        let text = pairs_to_text([("volumes", 12.3), ("resolve", 0.4)]);
        assert_eq!(text, "volumes=12.3;resolve=0.4");
        let back: Vec<(&str, f64)> = pairs_from_text(&text);
        assert_eq!(back, [("volumes", 12.3), ("resolve", 0.4)]);
        assert_eq!(pairs_from_text::<u64>(""), []);
        let damaged = pairs_from_text::<u64>("broken;half=;third=1.5;whole=1");
        assert_eq!(damaged, [("whole", 1)]);
    }
}
