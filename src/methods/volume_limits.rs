//! What volume methods cannot do, or get wrong by design.

use super::limit::PRECISION_LIMIT;
use super::{Bound, Limit};
use crate::metrics::Label;

/// What every volume method cannot do.
pub(super) const LIMITS: &[Limit] = &[
    Limit {
        text: "8-bit counter: wrong where a point lies in 256 single-triangle shadow volumes or a multiple of \
               that; a closed surface counts as two, with casting=light_facing as one",
        with: &[],
        unless: &[
            ("counter", "stencil_export"),
            ("counter", "blend16"),
            ("counter", "blend32"),
        ],
        fails: &[],
        kinds: &[Label::Overflow],
        at_most: Bound::All,
    },
    Limit {
        with: &[("counter", "blend16")],
        ..Limit::in_words(
            "counter=blend16: wrong where a count passes 2048 on the way, whatever it is in the end",
        )
    },
    Limit {
        with: &[("counter", "stencil_export")],
        ..Limit::in_words(
            "counter=stencil_export: wrong where a count is 65,280 or a multiple of that",
        )
    },
    Limit {
        text: "counting=z_pass: wrong where the eye or part of the near rectangle lies in a shadow volume",
        with: &[("counting", "z_pass")],
        unless: &[],
        fails: &[
            ("eye_in_volume", 0.45),
            ("near_plane_cuts_caster", 1.5),
            ("light_in_mesh", 0.5),
            ("light_in_lantern", 0.6),
            ("light_near_face", 1.0),
            ("light_on_element", 1.0),
        ],
        kinds: &[],
        at_most: Bound::All,
    },
    Limit {
        text: "front_cap=in_place: wrong in any scene, mostly acne, where the depths of a cap and of its own surface \
               differ in the last bit; push_back_px removes most of it",
        with: &[("front_cap", "in_place")],
        unless: &[],
        fails: &[],
        kinds: &[
            Label::Acne,
            Label::Leak,
            Label::Seam,
            Label::Grazing,
            Label::DetachedShadow,
            Label::Inverted,
            Label::Unlabelled,
        ],
        at_most: Bound::Share(0.8),
    },
    Limit {
        text: "depth=standard: far from the eye, the depth buffer cannot separate volumes from the surfaces they \
               start from",
        with: &[("depth", "standard")],
        unless: &[],
        fails: &[
            ("far_casters", 5.0),
            ("large_triangles", 5.0),
            ("translation", 5.0),
        ],
        kinds: &[Label::Acne, Label::Seam, Label::Grazing, Label::Unlabelled],
        at_most: Bound::Share(0.05),
    },
    Limit::in_words(
        "a line of wrong pixels along the edge between two triangles that reach 10,000 times as far as what the \
         picture shows: both are clipped there, and their caps overlap or leave a gap",
    ),
    PRECISION_LIMIT,
    Limit {
        text: "a wrong pixel or two beside a clipped edge, or beside an edge whose side quad has the same depth as \
               the surface after rounding, in about one of a thousand random scenes",
        with: &[],
        unless: &[],
        fails: &[],
        kinds: &[Label::Unlabelled],
        at_most: Bound::Px(2),
    },
    Limit {
        text: "single wrong pixels where a side quad lies in the surface it starts from, but for the last bit of \
               depth: on surfaces edge-on to the light, and where coplanar triangles overlap",
        with: &[],
        unless: &[],
        fails: &[("coplanar_overlap", 64.0)],
        kinds: &[Label::Grazing],
        at_most: Bound::Px(16),
    },
];

/// What volume methods in whose stages each edge finds the facings of its triangles cannot do, beside that.
pub(super) const STAGE_LIMITS: &[Limit] = &[Limit {
    text: "determinism=none: leaks where a triangle is nearly edge-on to the light and its edges disagree",
    with: &[("determinism", "none")],
    unless: &[],
    fails: &[
        ("edge_on", 0.0),
        ("collinear", 0.01),
        ("needles", 7.0),
        ("light_near_vertex", 7.0),
    ],
    kinds: &[],
    at_most: Bound::Share(0.6),
}];

/// What volumes of single triangles cannot do.
pub(super) const TRIANGLE_LIMITS: &[Limit] = &[Limit {
    text: "single wrong pixels at edges between triangles, where the side quads of both should cancel; \
           anywhere in the picture where hundreds of such edges cast shadows",
    with: &[],
    unless: &[],
    fails: &[("nested_shells", 129.0)],
    kinds: &[Label::Seam],
    at_most: Bound::Px(16),
}];
