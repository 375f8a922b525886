//! The words of an OBJ file, statement by statement, with their lines.
//!
//! A statement of numbers goes on in the next line if its own ends in `\`; names and comments do not, for a
//! path may end so. A comment begins with a `#` where a word begins.

use std::iter::Peekable;

use super::obj_problem::ObjProblem;

/// Statements whose words are numbers, and which may go on in the next line. Of these only `v`, `f` and `fo`
/// are read; the others must be known so that their further lines are not taken for statements.
const OF_NUMBERS: &[&str] = &[
    "v", "vt", "vn", "vp", "f", "fo", "l", "p", "cstype", "deg", "bmat", "step", "curv", "curv2",
    "surf", "parm", "trim", "hole", "scrv", "sp", "con", "bsp", "bzp", "cdc", "cdp", "res",
];

/// A problem and its line, counted from 1.
pub(super) type AtLine = (usize, ObjProblem);

/// One statement.
pub(super) struct Statement<'a> {
    /// Its first word.
    pub(super) keyword: &'a str,
    /// The line on which it begins, counted from 1.
    pub(super) line: usize,
    /// The further words, each with its line.
    pub(super) words: Vec<(usize, &'a str)>,
    /// All that follows the first word on its line, without comment.
    pub(super) rest: &'a str,
}

/// The statements of a text, in order.
pub(super) fn statements(text: &str) -> impl Iterator<Item = Result<Statement<'_>, AtLine>> {
    let text = text.trim_start_matches('\u{feff}');
    let mut lines = (1..).zip(text.lines()).peekable();
    std::iter::from_fn(move || {
        loop {
            let (line, text) = lines.next()?;
            let text = without_comment(text).trim();
            if let Some(keyword) = text.split_whitespace().next() {
                return Some(statement(keyword, line, text, &mut lines));
            }
        }
    })
}

fn statement<'a>(
    keyword: &'a str,
    line: usize,
    text: &'a str,
    lines: &mut Peekable<impl Iterator<Item = (usize, &'a str)>>,
) -> Result<Statement<'a>, AtLine> {
    if is_stray(keyword) {
        return Err((line, ObjProblem::Stray(keyword.to_owned())));
    }
    let rest = text[keyword.len()..].trim_start();
    let mut statement = Statement {
        keyword,
        line,
        words: Vec::new(),
        rest,
    };
    if !OF_NUMBERS.contains(&keyword.trim_end_matches('\\')) {
        return Ok(statement);
    }
    statement.keyword = keyword.trim_end_matches('\\');
    let (mut line, mut rest) = (line, &text[statement.keyword.len()..]);
    loop {
        let own = rest.strip_suffix('\\');
        let words = own.unwrap_or(rest).split_whitespace();
        statement.words.extend(words.map(|word| (line, word)));
        if own.is_none() {
            return Ok(statement);
        }
        let next = lines.next().ok_or((line, ObjProblem::CutShort))?;
        (line, rest) = (next.0, without_comment(next.1).trim());
    }
}

/// The line up to a `#` with which a word begins.
fn without_comment(line: &str) -> &str {
    let begins_word = |at: &usize| {
        line[..*at]
            .chars()
            .next_back()
            .is_none_or(char::is_whitespace)
    };
    let hashes = line.match_indices('#').map(|(at, _)| at);
    match hashes.into_iter().find(begins_word) {
        Some(at) => &line[..at],
        None => line,
    }
}

/// Whether a line that begins so was meant to hold numbers: it lost what stood before it, or a space.
fn is_stray(keyword: &str) -> bool {
    let number = keyword.strip_prefix(['v', 'f']).unwrap_or(keyword);
    let digits = number.trim_start_matches(['+', '-', '.']);
    digits.starts_with(|c: char| c.is_ascii_digit())
}

/// The place of a byte or of a line end that no text has, if there is one.
pub(super) fn damage(bytes: &[u8]) -> Option<AtLine> {
    let mut line = 1;
    for (i, byte) in bytes.iter().enumerate() {
        match byte {
            b'\n' => line += 1,
            0 => return Some((line, ObjProblem::ZeroByte)),
            b'\r' => match bytes.get(i + 1) {
                // Before a line feed, several do no harm.
                Some(b'\n' | b'\r') | None => {}
                Some(_) => return Some((line, ObjProblem::CarriageReturn)),
            },
            _ => {}
        }
    }
    None
}
