//! The names of a run's pictures.

/// What a picture in `images/` shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ImageKind {
    /// The lit picture.
    Picture,
    /// The method's shadow mask.
    Mask,
    /// The mask compared with the reference.
    Error,
    /// The reference mask, one per scene; method and variant are not part of its name.
    Reference,
}

/// The file name of a picture in `images/`: `sponza__silhouette_ts__reference_edge_mask.png`.
///
/// Anything but ASCII letters, digits, `_`, `-` and inner dots becomes `-`, so that a name from a
/// configuration can neither leave the folder nor trip a file system.
pub fn image_name(scene: &str, method: &str, variant: &str, kind: ImageKind) -> String {
    let (scene, method, variant) = (file_safe(scene), file_safe(method), file_safe(variant));
    let suffix = match kind {
        ImageKind::Picture => "picture",
        ImageKind::Mask => "mask",
        ImageKind::Error => "error",
        ImageKind::Reference => return format!("{scene}__reference.png"),
    };
    if variant.is_empty() {
        format!("{scene}__{method}_{suffix}.png")
    } else {
        format!("{scene}__{method}__{variant}_{suffix}.png")
    }
}

/// `text` with every character that is not safe in a file name replaced by `-`.
pub fn file_safe(text: &str) -> String {
    let safe = |c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '-' | '.');
    let name: String = text
        .chars()
        .map(|c| if safe(c) { c } else { '-' })
        .collect();
    if name.starts_with('.') {
        name.replacen('.', "-", 1)
    } else {
        name
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn image_names_are_safe_and_tell_cells_apart() {
        use ImageKind::{Error, Mask, Reference};
        assert_eq!(
            image_name("sponza", "ray_query", "", Mask),
            "sponza__ray_query_mask.png"
        );
        assert_eq!(
            image_name("sponza", "shadow_map", "resolution=8192", Error),
            "sponza__shadow_map__resolution-8192_error.png"
        );
        assert_eq!(
            image_name("sponza", "any", "any", Reference),
            "sponza__reference.png"
        );
        assert_eq!(
            image_name("../../a<b>", "", "", Reference),
            "-.-..-a-b-__reference.png"
        );
    }
}
