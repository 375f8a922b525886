//! The pictures: what every method drew, beside the reference and its errors.

use crate::variant::Variant;
use std::collections::HashSet;

use anyhow::Result;
use maud::{Markup, html};

use super::pictures::{Picture, picture};
use crate::record::{IMAGES_DIR, ImageKind, Summary};
use crate::report::LegendEntry;
use crate::report::curve::{Contender, Curves};
use crate::report::load::Run;
use crate::report::pareto::Cloud;

/// A page holds pictures up to this size; a browser opens one of a third more, as base64 makes it,
/// without a wait.
const MAX_BYTES: u64 = 22 << 20;
/// The pictures of a cell.
const KINDS: [(ImageKind, &str, &str); 3] = [
    (ImageKind::Picture, "Picture", "lit picture"),
    (ImageKind::Mask, "Shadow mask", "shadow mask"),
    (
        ImageKind::Error,
        "Errors",
        "mask compared with the reference",
    ),
];

/// The pictures of one method in one scene.
struct Strip {
    title: String,
    label: String,
    pictures: Vec<Picture>,
}

impl Strip {
    /// Pictures side by side; links in a line.
    fn markup(&self, run: &Run) -> Markup {
        let class = if self.pictures.iter().any(Picture::is_held) {
            "strip"
        } else {
            "links"
        };
        html! {
            div class=(class) { @for picture in &self.pictures { (picture.figure(run)) } }
        }
    }
}

/// The cells whose pictures the page holds, by scene and contender; those of the others it links to.
struct Held {
    cells: HashSet<(String, String)>,
    all: bool,
}

impl Held {
    /// Those of the front first, then the first of each curve, then the others: as many as
    /// [`MAX_BYTES`] allow.
    fn of(run: &Run, clouds: &[Cloud]) -> Self {
        let curves = Curves::of(run);
        let mut cells: Vec<(u8, &Summary, Contender)> = Vec::new();
        for row in run.scenes().into_iter().flat_map(|scene| run.rows(scene)) {
            let contender = run.contender(row);
            let rank = if is_on_front(clouds, row, &contender) {
                0
            } else if is_first(&curves, &contender) {
                1
            } else {
                2
            };
            cells.push((rank, row, contender));
        }
        cells.sort_by_key(|(rank, ..)| *rank);
        let all = cells.len();
        let mut left_bytes = MAX_BYTES;
        let mut held = HashSet::new();
        for (_, row, contender) in cells {
            // Once one does not fit, no lesser one is let in for being small.
            left_bytes = match left_bytes.checked_sub(size_bytes(run, row)) {
                Some(left_bytes) => left_bytes,
                None => break,
            };
            held.insert((row.scene.clone(), contender.label()));
        }
        let all = held.len() == all;
        Self { cells: held, all }
    }

    fn holds(&self, scene: &str, label: &str) -> bool {
        self.all || self.cells.contains(&(scene.to_owned(), label.to_owned()))
    }
}

fn is_on_front(clouds: &[Cloud], row: &Summary, contender: &Contender) -> bool {
    let of_scene = clouds
        .iter()
        .find(|cloud| cloud.scene.as_deref() == Some(row.scene.as_str()));
    of_scene.is_some_and(|cloud| {
        let mut front = cloud.front().into_iter().map(|index| &cloud.points[index]);
        front.any(|point| point.contender == *contender)
    })
}

fn is_first(curves: &Curves, contender: &Contender) -> bool {
    let place = curves.place(contender);
    let first = curves.members.iter().find(|(_, other, _)| *other == place);
    first.is_some_and(|(first, ..)| first == contender)
}

fn size_bytes(run: &Run, row: &Summary) -> u64 {
    let names = KINDS.map(|(kind, ..)| run.image(&row.scene, &row.method, &row.variant, kind));
    let sizes = names.iter().map(|name| {
        // What cannot be read is reported where it is embedded.
        std::fs::metadata(run.dir.join(IMAGES_DIR).join(name)).map_or(0, |data| data.len())
    });
    sizes.sum()
}

/// The gallery; `None` where the run has no pictures.
pub(super) fn section(
    run: &Run,
    clouds: &[Cloud],
    legend: &[LegendEntry],
) -> Result<Option<Markup>> {
    let held = Held::of(run, clouds);
    let mut scenes = Vec::new();
    for scene in run.scenes() {
        if let Some(markup) = scene_gallery(run, scene, &held, legend)? {
            scenes.push(markup);
        }
    }
    if scenes.is_empty() {
        return Ok(None);
    }
    Ok(Some(html! {
        section #pictures {
            h2 { "Pictures" }
            p.note { "Click a picture, or move the focus to it, to see it large." }
            @if !held.all {
                p.note {
                    "The pictures of this run are too many for one page. It holds those of the Pareto "
                    "fronts, then those of the first method of each sweep and of the others, as far as there is "
                    "room; the rest it links to, in the folder " code { (IMAGES_DIR) } " of the run."
                }
            }
            @for scene in scenes { (scene) }
        }
    }))
}

fn scene_gallery(
    run: &Run,
    scene: &str,
    held: &Held,
    legend: &[LegendEntry],
) -> Result<Option<Markup>> {
    let title = run.scene_title(scene);
    let reference = picture(
        run,
        &run.image(scene, "", &Variant::default(), ImageKind::Reference),
        "Reference mask",
        format!("{title}: shadow mask by the ray-traced reference"),
        true,
    )?;
    let mut strips = Vec::new();
    for row in run.rows(scene) {
        let strip = strip(run, title, row, held)?;
        if !strip.pictures.is_empty() {
            strips.push(strip);
        }
    }
    if reference.is_none() && strips.is_empty() {
        return Ok(None);
    }
    Ok(Some(html! {
        article.gallery {
            h3 { (title) }
            div.strip {
                @if let Some(reference) = &reference { (reference.figure(run)) }
                @if !legend.is_empty() { (legend_list(legend)) }
            }
            @for strip in &strips {
                h4 { (strip.title) " " code { (strip.label) } }
                (strip.markup(run))
            }
        }
    }))
}

fn strip(run: &Run, scene_title: &str, row: &Summary, held: &Held) -> Result<Strip> {
    let contender = run.contender(row);
    let label = contender.label();
    let hold = held.holds(&row.scene, &label);
    let mut pictures = Vec::new();
    for (kind, caption, what) in KINDS {
        let name = run.image(&row.scene, &row.method, &row.variant, kind);
        let alt = format!("{scene_title}, {label}: {what}");
        pictures.extend(picture(run, &name, caption, alt, hold)?);
    }
    Ok(Strip {
        title: run.method_title(&contender).to_owned(),
        label,
        pictures,
    })
}

/// What the colours of error maps mean.
pub(super) fn legend_list(legend: &[LegendEntry]) -> Markup {
    html! {
        div.legend {
            p { "Colours of the error maps" }
            ul {
                @for LegendEntry { label, rgb: [r, g, b] } in legend {
                    li {
                        span.swatch style={ "background:rgb(" (r) "," (g) "," (b) ")" } {}
                        (label)
                    }
                }
            }
        }
    }
}
