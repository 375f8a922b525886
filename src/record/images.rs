//! The names of a run's pictures.

use crate::file_name::{file_name, variant_file_name};
use crate::variant::Variant;

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

impl ImageKind {
    fn suffix(self) -> &'static str {
        match self {
            Self::Picture => "picture",
            Self::Mask => "mask",
            Self::Error => "error",
            Self::Reference => "reference",
        }
    }
}

/// The file name of a picture in `images/`: `sponza__silhouette_ts__determinism-none_mask.png`. Each cell has its own,
/// see [`crate::file_name`].
pub fn image_name(scene: &str, method: &str, variant: &Variant, kind: ImageKind) -> String {
    let (scene, suffix) = (file_name(scene), kind.suffix());
    if kind == ImageKind::Reference {
        return format!("{scene}__{suffix}.png");
    }
    let method = file_name(method);
    if variant.is_empty() {
        format!("{scene}__{method}_{suffix}.png")
    } else {
        let variant = variant_file_name(variant);
        format!("{scene}__{method}__{variant}_{suffix}.png")
    }
}

/// The name that versions up to 0.4.0 gave a picture; several scenes might share one.
pub fn earlier_image_name(scene: &str, method: &str, variant: &Variant, kind: ImageKind) -> String {
    let safe = |c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '-' | '.');
    let earlier = |text: &str| {
        let name: String = text
            .chars()
            .map(|c| if safe(c) { c } else { '-' })
            .collect();
        match name.strip_prefix('.') {
            Some(rest) => format!("-{rest}"),
            None => name,
        }
    };
    let (scene, suffix) = (earlier(scene), kind.suffix());
    match (kind, earlier(method), earlier(variant.as_str())) {
        (ImageKind::Reference, ..) => format!("{scene}__{suffix}.png"),
        (_, method, variant) if variant.is_empty() => format!("{scene}__{method}_{suffix}.png"),
        (_, method, variant) => format!("{scene}__{method}__{variant}_{suffix}.png"),
    }
}

#[cfg(test)]
mod tests {
    use super::ImageKind::{Error, Mask, Reference};
    use super::*;

    fn variant(text: &str) -> Variant {
        text.parse().unwrap()
    }

    #[test]
    fn image_names_are_safe_and_tell_cells_apart() {
        assert_eq!(
            image_name("sponza", "ray_query", &Variant::default(), Mask),
            "sponza__ray_query_mask.png"
        );
        assert_eq!(
            image_name("sponza", "shadow_map", &variant("resolution=8192"), Error),
            "sponza__shadow_map__resolution-8192_error.png"
        );
        assert_eq!(
            image_name("sponza", "any", &variant("any=1"), Reference),
            "sponza__reference.png"
        );
        let names = ["a b", "a-b", "a_b", "A-b", "../a", &"x".repeat(300)]
            .map(|scene| image_name(scene, "m", &variant("k=v"), Mask));
        assert!(
            names
                .iter()
                .all(|name| name.len() < 255 && !name.contains('/'))
        );
        let mut apart = names.to_vec();
        apart.sort();
        apart.dedup();
        assert_eq!(apart.len(), names.len(), "{names:?}");
    }

    #[test]
    fn what_was_plain_before_is_called_as_before() {
        for (scene, text) in [("sponza", ""), ("sphere_grid_n18", "slope_bias=-0.5,pcf=3")] {
            for kind in [Mask, Reference] {
                assert_eq!(
                    image_name(scene, "shadow_map", &variant(text), kind),
                    earlier_image_name(scene, "shadow_map", &variant(text), kind)
                );
            }
        }
        assert_eq!(
            earlier_image_name("../../a<b>", "", &Variant::default(), Reference),
            "-.-..-a-b-__reference.png"
        );
    }
}
