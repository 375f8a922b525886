//! Errors in TOML files, for people: file, line and column, and the key that was probably meant.

use std::ops::Range;

/// Describes an error of the TOML parser: `file:line:column: message; did you mean `x`?`.
pub fn describe(error: &toml::de::Error, text: &str, file: &str) -> String {
    let message = with_suggestion(error.message());
    match error.span() {
        Some(span) => at(&span, &message, text, file),
        None => format!("{file}: {message}"),
    }
}

/// The message, and the name that was probably meant if it is about an unknown one.
pub fn with_suggestion(message: &str) -> String {
    match suggestion(message) {
        Some(known) => format!("{message}; did you mean `{known}`?"),
        None => message.to_owned(),
    }
}

/// The known name that is most like `unknown`, if one is like it.
pub fn nearest<'a>(unknown: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let distance = |known: &&str| strsim::damerau_levenshtein(unknown, known);
    let nearest = known.into_iter().min_by_key(distance)?;
    // Two slips in a name of six letters are a slip; in one of three, another word.
    (distance(&nearest) * 3 <= unknown.chars().count().max(3)).then_some(nearest)
}

/// A message about a part of the text: `file:line:column: message`, see [`place`].
pub fn at(span: &Range<usize>, message: &str, text: &str, file: &str) -> String {
    format!("{}: {message}", place(span, text, file))
}

/// Where a part of the text begins: `file:line:column`.
///
/// Lines and columns count from 1, columns in characters. The span is one that the parser gave, as
/// from `toml::Spanned`.
pub fn place(span: &Range<usize>, text: &str, file: &str) -> String {
    let before = text.get(..span.start).unwrap_or(text);
    let line = before.matches('\n').count() + 1;
    let column = before
        .rsplit('\n')
        .next()
        .map_or(0, |start| start.chars().count())
        + 1;
    format!("{file}:{line}:{column}")
}

/// The known name most like the unknown one that the message is about, if one is like it.
///
/// The message is serde's: "unknown field `x`, expected one of `y`, `z`".
fn suggestion(message: &str) -> Option<&str> {
    if !message.starts_with("unknown field") && !message.starts_with("unknown variant") {
        return None;
    }
    let mut names = message.split('`').skip(1).step_by(2);
    let unknown = names.next()?;
    nearest(unknown, names)
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde::Deserialize;

    #[derive(Deserialize, Debug)]
    #[serde(deny_unknown_fields)]
    struct Grid {
        #[serde(rename = "rows")]
        _rows: u32,
        #[serde(rename = "columns")]
        _columns: Option<u32>,
    }

    fn error(text: &str) -> String {
        describe(
            &toml::from_str::<Grid>(text).unwrap_err(),
            text,
            "grid.toml",
        )
    }

    #[test]
    fn the_place_and_the_key_that_was_meant_are_named() {
        assert_eq!(
            error("# größer\nrows = 1\n  colums = 2\n"),
            "grid.toml:3:3: unknown field `colums`, expected `rows` or `columns`; \
             did you mean `columns`?"
        );
        assert_eq!(
            error("rows = 1\nshadow = 2\n"),
            "grid.toml:2:1: unknown field `shadow`, expected `rows` or `columns`"
        );
    }

    #[test]
    fn other_errors_have_a_place_too() {
        assert!(
            error("rows = \n").starts_with("grid.toml:1:"),
            "{}",
            error("rows = \n")
        );
        assert!(error("rows = 'ö'").starts_with("grid.toml:1:8: invalid type"));
        assert!(error("").contains("missing field `rows`"));
    }

    #[test]
    fn columns_count_characters() {
        assert_eq!(at(&(5..6), "here", "äö\nx", "f"), "f:2:1: here");
        assert_eq!(at(&(4..5), "here", "äöx", "f"), "f:1:3: here");
        assert_eq!(at(&(99..100), "beyond", "ab", "f"), "f:1:3: beyond");
    }
}
