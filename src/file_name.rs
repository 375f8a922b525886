//! Names of files made from names of other things: scenes, methods, objects.
//!
//! Different names give different files, on any file system. A plain name (lower-case ASCII letters, digits, `-`, inner
//! dots and single inner `_`, not too long, and none that a system reserves) is its own file name. Any other gets a
//! hash of itself behind a `~`, which no plain name has. So names may be joined by `__` and stay apart.

use crate::variant::Variant;

/// Longest plain name in bytes: three of them and what stands between and behind them fit the 255 that file systems
/// allow.
const LONGEST: usize = 72;
/// How much of a name that is not plain stands before its hash.
const KEPT: usize = 48;
/// Hexadecimal digits of a hash.
const HASH_DIGITS: usize = 16;
/// What Windows takes for devices, with any extension.
const RESERVED: [&str; 4] = ["con", "prn", "aux", "nul"];

/// The file name of anything; it is safe in an address too.
pub fn file_name(name: &str) -> String {
    if is_plain(name) {
        name.to_owned()
    } else {
        hashed(name)
    }
}

/// A file name that no plain name is, with what can be kept of it.
fn hashed(name: &str) -> String {
    let mut plain = String::new();
    for c in name.chars().take(KEPT) {
        let is_inner = !plain.is_empty() && !plain.ends_with('_');
        plain.push(match c {
            // A dot might leave a reserved name before it.
            '.' => '-',
            '_' if !is_inner => '-',
            c if is_plain_char(c) => c,
            _ => '-',
        });
    }
    let hash = blake3::hash(name.as_bytes()).to_hex();
    // Not to the system: `con~…` is a name like any other.
    format!("{plain}~{}", &hash[..HASH_DIGITS])
}

/// The file name of a variant: `resolution-2048-pcf-3`.
pub fn variant_file_name(variant: &Variant) -> String {
    let is_plain_pair =
        |(name, value): (&str, &str)| is_word(name) && (is_word(value) || is_number(value));
    // Of such lists, each has a text of its own without `=` and commas, too: names and values take turns, and what
    // begins with a digit or a sign is a number.
    if variant.parameters().all(is_plain_pair) {
        let text = variant.as_str().replace(['=', ','], "-");
        if is_plain(&text) {
            return text;
        }
    }
    hashed(variant.as_str())
}

/// The file name of a method with its parameters: `shadow_map-resolution-2048`.
pub fn method_file_name(id: &str, variant: &Variant) -> String {
    let id = file_name(id);
    if variant.is_empty() {
        id
    } else {
        format!("{id}-{}", variant_file_name(variant))
    }
}

fn is_plain(name: &str) -> bool {
    let stem = name.split('.').next().unwrap_or_default();
    let is_numbered_device = matches!(stem.len(), 4)
        && (stem.starts_with("com") || stem.starts_with("lpt"))
        && stem.ends_with(|c: char| c.is_ascii_digit());
    !name.is_empty()
        && name.len() <= LONGEST
        && !name.starts_with(['.', '_'])
        && !name.ends_with(['.', '_'])
        && !name.contains("__")
        && !RESERVED.contains(&stem)
        && !is_numbered_device
        && name
            .chars()
            .all(|c| is_plain_char(c) && !c.is_ascii_uppercase())
}

/// Upper case is kept where a hash tells it from lower case.
fn is_plain_char(c: char) -> bool {
    c.is_ascii_alphanumeric() || matches!(c, '_' | '-' | '.')
}

fn is_word(text: &str) -> bool {
    text.starts_with(|c: char| c.is_ascii_lowercase())
        && text
            .chars()
            .all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_')
}

fn is_number(text: &str) -> bool {
    text.starts_with(|c: char| c.is_ascii_digit() || c == '-')
        && text.ends_with(|c: char| c.is_ascii_digit())
        && text.parse::<f64>().is_ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn plain_names_stay() {
        assert_eq!(file_name("Cornell Box"), "Cornell-Box~2696cc7bb0e633ba");
        for name in [
            "sponza",
            "sphere_grid_n60",
            "a-b.c",
            "fan_1e-7",
            &"x".repeat(LONGEST),
        ] {
            assert_eq!(file_name(name), name);
        }
        let pairs = "resolution=2048,slope_bias=-1.5,counting=z_pass";
        assert_eq!(
            variant_file_name(&pairs.parse().unwrap()),
            "resolution-2048-slope_bias--1.5-counting-z_pass"
        );
    }

    #[test]
    fn different_names_are_different_files() {
        let long = "x".repeat(300);
        let names = [
            "a b",
            "a-b",
            "a  b",
            "a_b",
            "a__b",
            "_a",
            "a_",
            "A b",
            "a:b",
            "é",
            "e\u{301}",
            "a",
            "A",
            "con",
            "CON",
            "con.b",
            "com1",
            ".",
            "..",
            "",
            ".a",
            "-a",
            "a.",
            "a..",
            "a/b",
            "a\\b",
            &long,
            &long[1..],
            "日本",
            "日木",
        ];
        let mut files: Vec<String> = names
            .iter()
            // Some file systems know no case.
            .map(|name| file_name(name).to_lowercase())
            .collect();
        for file in &files {
            assert!(
                file.len() <= LONGEST && !file.starts_with('.') && !file.ends_with('.'),
                "{file}"
            );
            assert!(
                !["con", "com1"].contains(&file.split('.').next().unwrap()),
                "{file}"
            );
        }
        files.sort();
        files.dedup();
        assert_eq!(files.len(), names.len(), "{files:?}");
    }

    #[test]
    fn lists_of_parameters_are_told_apart() {
        let lists = [
            "a=1,b=2", "a=1-b=2", "a=-1,b=2", "a=1,b=-2", "a=1 b=2", "a=1,B=2", "a=1e-9",
            "a=1,e=9", "a=inf", "", "a=", "a==1", "a=b,c=d", "a=b-c-d",
        ];
        let mut files: Vec<String> = lists
            .iter()
            .map(|list| variant_file_name(&list.parse().unwrap()))
            .collect();
        files.sort();
        files.dedup();
        assert_eq!(files.len(), lists.len(), "{files:?}");
    }

    proptest! {
        #[test]
        fn any_two_names_are_two_safe_files(a in "\\PC{0,90}", b in "[aA .~-]{0,4}") {
            for name in [&a, &b] {
                let file = file_name(name);
                prop_assert!(file.len() <= LONGEST && !file.is_empty());
                prop_assert!(file.chars().all(|c| c.is_ascii_alphanumeric() || "_-.~".contains(c)));
                prop_assert!(!file.starts_with('.') && !file.contains("__"));
            }
            let same = file_name(&a).eq_ignore_ascii_case(&file_name(&b));
            prop_assert_eq!(same, a == b);
        }
    }
}
