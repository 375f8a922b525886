//! The kinds of error that wrong pixels are sorted into; [`super::labels`] does it.

use serde::{Serialize, Serializer};

/// A kind of error.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Label {
    /// False-shadowed speckle or stripes on a lit surface: it shadows itself.
    Acne,
    /// False lit where a shadow begins: it does not reach its caster.
    DetachedShadow,
    /// A streak on a line through the light, lit or in shadow: a shadow volume that is not closed.
    Leak,
    /// Along the true edge, in steps of the shadow map's texels.
    Staircase,
    /// False lit where so many shadows overlap that an 8-bit counter wraps around.
    Overflow,
    /// False lit where the shadow map has no texel: it does not cover all that is in view.
    Uncovered,
    /// One or two pixels on an edge between triangles, where the surface goes on.
    Seam,
    /// On a surface that the light sees edge-on but for a little.
    Grazing,
    /// The whole mask is the opposite of the truth.
    Inverted,
    /// The whole mask is the truth, moved by one pixel.
    Offset,
    /// No clear evidence for any of these.
    Unlabelled,
}

impl Label {
    /// All of them.
    pub const ALL: [Self; 11] = [
        Self::Acne,
        Self::DetachedShadow,
        Self::Leak,
        Self::Staircase,
        Self::Overflow,
        Self::Uncovered,
        Self::Seam,
        Self::Grazing,
        Self::Inverted,
        Self::Offset,
        Self::Unlabelled,
    ];

    /// As it is written in results.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Acne => "acne",
            Self::DetachedShadow => "detached_shadow",
            Self::Leak => "leak",
            Self::Staircase => "staircase",
            Self::Overflow => "overflow",
            Self::Uncovered => "uncovered",
            Self::Seam => "seam",
            Self::Grazing => "grazing",
            Self::Inverted => "inverted",
            Self::Offset => "offset",
            Self::Unlabelled => "unlabelled",
        }
    }
}

impl Serialize for Label {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.word())
    }
}
