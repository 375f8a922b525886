//! What a file is that was taken for an OBJ file and is none.

const EXPORT: &str = "open it in a 3D program and export it as OBJ";
const UNPACK: &str = "unpack it first";
const ENCODING: &str = "save it as UTF-8 or ASCII";
const DOWNLOAD: &str = "the download went wrong: fetch the file itself";
/// How files of other kinds begin, what they are, and what to do.
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

/// What a file is, if it begins as a file of another kind does, and what to do about it.
pub(super) fn other_kind(bytes: &[u8]) -> Option<(&'static str, &'static str)> {
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
