//! A method that looks a shadow map up: the parameters of both kinds, and what they have in common.

use super::light_depth::Rounding;
use super::limit::PRECISION_LIMIT;
use super::{
    BiasSearch, Bound, Domain, Limit, MethodError, MethodInfo, PrepareContext, ShadowMethod,
};
use crate::frame::PreparedMethod;
use crate::metrics::Label;
use crate::parameters;
use serde::{Deserialize, Deserializer, Serialize, Serializer, de};
use std::fmt;

/// See [`MethodInfo::tolerated_share`]: at true edges a map is wrong by a texel, which may be several pixels.
pub(super) const TOLERATED_SHARE: f64 = 0.0025;

/// What every map cannot do. The shares are those that the corpus of stress and random scenes need at 1024 texels,
/// and some headroom.
pub(super) const LIMITS: &[Limit] = &[
    Limit {
        text: "edges are as coarse as the map's texels, and the slope bias detaches shadows by as much",
        with: &[],
        unless: &[],
        fails: &[],
        kinds: &[Label::Staircase, Label::DetachedShadow],
        at_most: Bound::Share(0.1),
    },
    Limit {
        text: "errors of a texel or two where surfaces are thin, steep or close together: some acne, some of no \
               clear kind",
        with: &[],
        unless: &[],
        fails: &[],
        kinds: &[Label::Acne, Label::Unlabelled],
        at_most: Bound::Share(0.03),
    },
    Limit {
        text: "slope_bias=0: acne on every surface that does not face the light squarely, in any scene",
        with: &[("slope_bias", "0.0")],
        unless: &[],
        fails: &[],
        kinds: &[Label::Acne, Label::Seam, Label::Grazing, Label::Unlabelled],
        at_most: Bound::Share(0.9),
    },
    PRECISION_LIMIT,
];

/// Largest square of percentage-closer filtering.
const MAX_PCF: u32 = 15;

/// The bias by the slope of a surface, in texels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum SlopeBias {
    /// So much.
    Fixed(f64),
    /// The smallest without acne, which somebody has to find first.
    Search,
}

/// The word for [`SlopeBias::Search`].
const SEARCH: &str = "search";

impl Serialize for SlopeBias {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Fixed(texels) => serializer.serialize_f64(*texels),
            Self::Search => serializer.serialize_str(SEARCH),
        }
    }
}

impl<'de> Deserialize<'de> for SlopeBias {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Visitor;
        impl de::Visitor<'_> for Visitor {
            type Value = SlopeBias;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(f, "a number of texels or \"{SEARCH}\"")
            }

            fn visit_f64<E: de::Error>(self, texels: f64) -> Result<SlopeBias, E> {
                Ok(SlopeBias::Fixed(texels))
            }

            fn visit_i64<E: de::Error>(self, texels: i64) -> Result<SlopeBias, E> {
                Ok(SlopeBias::Fixed(texels as f64))
            }

            fn visit_str<E: de::Error>(self, word: &str) -> Result<SlopeBias, E> {
                match word {
                    SEARCH => Ok(SlopeBias::Search),
                    _ => Err(E::invalid_value(de::Unexpected::Str(word), &self)),
                }
            }
        }
        deserializer.deserialize_any(Visitor)
    }
}

/// A kind of shadow map.
pub(super) trait MapKind: fmt::Debug + Clone + 'static {
    /// The method that draws it.
    fn info() -> &'static MethodInfo;
    /// Default side of the map.
    const RESOLUTION: u32;
    /// What the resolution is.
    const RESOLUTION_WORDS: &'static str;
    /// Makes it ready for a scene.
    fn prepare(
        context: &PrepareContext<'_>,
        map: &MapParameters,
    ) -> Result<Box<dyn PreparedMethod>, MethodError>;
}

/// What a map is made with.
#[derive(Debug, Clone, Copy)]
pub(super) struct MapParameters {
    /// Side in texels.
    pub resolution: u32,
    /// Bias in units of rounding, see [`Rounding`].
    pub constant_bias: i32,
    /// Bias in texels, by the slope.
    pub slope_bias: f32,
    /// Side of the square that is averaged.
    pub pcf: u32,
}

parameters! {
    /// A method that looks a map up; the two differ in the map, nothing else.
    pub(super) struct DepthMap<K: MapKind> {
        resolution: u32 = K::RESOLUTION, in 1..=1 << 16, K::RESOLUTION_WORDS;
        constant_bias: i32 = Rounding::DEFAULT_UNITS, in 0..=i32::MAX,
            "how far surfaces are taken to be nearer to the light, in units of rounding: half the last bit of the \
             largest coordinate of scene, light and eye";
        slope_bias: SlopeBias = SlopeBias::Fixed(2.0), in Domain::or_word(0.0..=1e6, SEARCH),
            "depth bias in texels times the slope of the surface; search: in a run, the smallest without acne";
        pcf: u32 = 1, in Domain::odd(1..=MAX_PCF),
            "side of the square of texels whose answers are averaged";
    }
}

impl<K: MapKind> ShadowMethod for DepthMap<K> {
    fn info(&self) -> &'static MethodInfo {
        K::info()
    }

    fn bias_search(&self) -> Option<BiasSearch<'_>> {
        (self.slope_bias == SlopeBias::Search).then(|| BiasSearch {
            resolution: self.resolution,
            with_bias: Box::new(|texels| {
                Box::new(Self {
                    slope_bias: SlopeBias::Fixed(texels),
                    ..self.clone()
                })
            }),
        })
    }

    fn prepare(
        &self,
        context: &PrepareContext<'_>,
    ) -> Result<Box<dyn PreparedMethod>, MethodError> {
        let SlopeBias::Fixed(slope_bias) = self.slope_bias else {
            let reason =
                "slope_bias=search is for runs, which find the bias first: give a number here";
            return Err(MethodError::Parameter(reason.to_owned()));
        };
        let map = MapParameters {
            resolution: self.resolution,
            constant_bias: self.constant_bias,
            slope_bias: slope_bias as f32,
            pcf: self.pcf,
        };
        K::prepare(context, &map)
    }
}
