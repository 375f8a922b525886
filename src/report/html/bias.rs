//! The biases that were searched for: what ends acne, and what it costs.

use maud::{Markup, html};

use crate::record::BiasRow;
use crate::report::load::Run;

/// The section; nothing where no bias was searched for.
pub(super) fn section(run: &Run) -> Markup {
    html! {
        @if !run.biases.is_empty() {
            section #bias {
                h2 { "Bias" }
                p.note {
                    "The smallest slope bias that leaves no more acne than the largest one does, for each shadow "
                    "map whose bias was searched for, and the shadow that it detaches from its caster: in pixels "
                    "per frame, before (without slope bias) and after. Biases are tried in other frames than the "
                    "verified ones."
                }
                div.scroll tabindex="0" role="region" aria-label="Biases found" {
                    table {
                        thead {
                            tr {
                                th.text scope="col" rowspan="2" { "Scene" }
                                th.text scope="col" rowspan="2" { "Method" }
                                th scope="col" rowspan="2" { "Resolution" small { "texels" } }
                                th scope="col" rowspan="2" { "Slope bias" }
                                th.group scope="colgroup" colspan="2" { "Acne" }
                                th.group scope="colgroup" colspan="2" { "Detached shadow" }
                                th scope="col" rowspan="2" { "Tried" }
                            }
                            tr {
                                th scope="col" { "before" }
                                th scope="col" { "after" }
                                th scope="col" { "before" }
                                th scope="col" { "after" }
                            }
                        }
                        tbody { @for bias in &run.biases { (row(run, bias)) } }
                    }
                }
            }
        }
    }
}

fn row(run: &Run, bias: &BiasRow) -> Markup {
    html! {
        tr {
            td.text { (run.scene_title(&bias.scene)) }
            th.method scope="row" {
                code { (bias.method) } " " span.quiet { (bias.variant) }
            }
            td { (bias.resolution) }
            td { (bias.slope_bias) }
            td { (px(bias.acne_px_unbiased)) }
            td { (px(bias.acne_px)) }
            td { (px(bias.detached_px_unbiased)) }
            td { (px(bias.detached_px)) }
            td { (bias.tried) }
        }
    }
}

/// A tenth of a pixel, but never nothing where there is something.
fn px(per_frame: f64) -> String {
    if per_frame > 0.0 && per_frame < 0.05 {
        "<0.1".to_owned()
    } else {
        format!("{per_frame:.1}")
    }
}
