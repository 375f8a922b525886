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

/// What a file is, if it begins as a file of another kind does, and what to do about it.
pub(super) fn other_kind(bytes: &[u8]) -> Option<(&'static str, &'static str)> {
    const EXPORT: &str = "open it in a 3D program and export it as OBJ";
    const UNPACK: &str = "unpack it first";
    const ENCODING: &str = "save it as UTF-8 or ASCII";
    const DOWNLOAD: &str = "the download went wrong: fetch the file itself";
    const KINDS: &[(&[u8], &str, &str)] = &[
        (b"\xff\xfe\0\0", "UTF-32 text", ENCODING),
        (b"\0\0\xfe\xff", "UTF-32 text", ENCODING),
        (b"\xff\xfe", "UTF-16 text", ENCODING),
        (b"\xfe\xff", "UTF-16 text", ENCODING),
        (b"\x1f\x8b", "a gzip archive", UNPACK),
        (b"PK\x03\x04", "a zip archive", UNPACK),
        (b"PK\x05\x06", "a zip archive", UNPACK),
        (b"BZh", "a bzip2 archive", UNPACK),
        (b"\xfd7zXZ\0", "an xz archive", UNPACK),
        (b"\x28\xb5\x2f\xfd", "a zstd archive", UNPACK),
        (b"7z\xbc\xaf\x27\x1c", "a 7z archive", UNPACK),
        (b"Rar!", "a RAR archive", UNPACK),
        (
            b"version https://git-lfs",
            "a Git LFS pointer, which only names the file",
            "run `git lfs pull`",
        ),
        (
            b"/annex/objects/",
            "a git-annex pointer, which only names the file",
            "run `git annex get`",
        ),
        (b"glTF", "a binary glTF model", EXPORT),
        (b"ply\n", "a PLY model", EXPORT),
        (b"ply\r", "a PLY model", EXPORT),
        (b"solid ", "an STL model", EXPORT),
        (b"solid\n", "an STL model", EXPORT),
        (b"solid\r", "an STL model", EXPORT),
        (b"#usda ", "a USD model", EXPORT),
        (b"PXR-USDC", "a USD model", EXPORT),
        (b"#VRML ", "a VRML model", EXPORT),
        (b"#Inventor ", "an Open Inventor model", EXPORT),
        (b"Kaydara FBX", "an FBX model", EXPORT),
        (b"; FBX", "an FBX model", EXPORT),
        (b"OFF\n", "an OFF model", EXPORT),
        (b"OFF\r", "an OFF model", EXPORT),
        (b"BLENDER", "a Blender file", EXPORT),
        (b"\x89PNG", "a PNG picture", "name the OBJ file"),
        (b"\xff\xd8\xff", "a JPEG picture", "name the OBJ file"),
        (b"%PDF", "a PDF document", "name the OBJ file"),
    ];
    let known = KINDS.iter().find(|kind| bytes.starts_with(kind.0));
    if let Some(&(_, what, advice)) = known {
        return Some((what, advice));
    }
    let is_tar = bytes.get(257..262) == Some(b"ustar");
    if is_tar {
        return Some(("a tar archive", UNPACK));
    }
    // Every other byte of Latin letters is zero in UTF-16, with a mark at the start or without.
    if let [0, 1..=127, 0, 1..=127, ..] | [1..=127, 0, 1..=127, 0, ..] = bytes {
        return Some(("UTF-16 text", ENCODING));
    }
    if is_binary_stl(bytes) {
        return Some(("a binary STL model", EXPORT));
    }
    let text = bytes
        .strip_prefix(b"\xef\xbb\xbf")
        .unwrap_or(bytes)
        .trim_ascii_start();
    let begins = |tag: &[u8]| {
        text.get(..tag.len())
            .is_some_and(|t| t.eq_ignore_ascii_case(tag))
    };
    match text.first() {
        Some(b'<') if begins(b"<!doctype html") || begins(b"<html") => {
            Some(("a web page (HTML)", DOWNLOAD))
        }
        Some(b'<') => Some((
            "XML or HTML",
            "if it is a COLLADA or X3D model, export it as OBJ; else the download went wrong",
        )),
        Some(b'{' | b'[') => Some((
            "JSON",
            "if it is a glTF model, export it as OBJ; else the download went wrong",
        )),
        _ => None,
    }
}

/// 80 bytes of anything, the number of triangles, and 50 bytes for each.
fn is_binary_stl(bytes: &[u8]) -> bool {
    let count = bytes.get(80..84).and_then(|count| count.try_into().ok());
    count.is_some_and(|count| bytes.len() as u64 == 84 + 50 * u64::from(u32::from_le_bytes(count)))
}
