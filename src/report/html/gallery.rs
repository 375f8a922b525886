//! The pictures: what every method drew, beside the reference and its errors.

use anyhow::Result;
use maud::{Markup, html};

use super::pictures::{Held, Picture, legend_list, picture, size_bytes};
use super::shell::Section;
use crate::record::{IMAGES_DIR, ImageKind, Summary};
use crate::report::LegendEntry;
use crate::report::curve::{Contender, Curves};
use crate::report::load::Run;
use crate::report::pareto::Cloud;
use crate::variant::Variant;

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

/// The cells whose pictures the page holds, by scene and contender; those of the others it links to.
type HeldCells = Held<(String, String)>;

impl HeldCells {
    /// Those of the front first, then the first of each curve, then the others.
    fn of(run: &Run, clouds: &[Cloud]) -> Self {
        let curves = Curves::of(run);
        let mut cells: Vec<(u8, &Summary, Contender)> = Vec::new();
        for row in run.scenes().into_iter().flat_map(|scene| run.rows(scene)) {
            let contender = run.contender(row);
            let rank = match is_on_front(clouds, row, &contender) {
                true => 0,
                false if is_first(&curves, &contender) => 1,
                false => 2,
            };
            cells.push((rank, row, contender));
        }
        cells.sort_by_key(|(rank, ..)| *rank);
        Self::as_many_as_fit(cells.into_iter().map(|(_, row, contender)| {
            let names =
                KINDS.map(|(kind, ..)| run.image(&row.scene, &row.method, &row.variant, kind));
            let sizes = names.map(|name| size_bytes(&run.dir.join(IMAGES_DIR).join(name)));
            ((row.scene.clone(), contender.label()), sizes.iter().sum())
        }))
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

/// The gallery; none where the run has no pictures.
pub(super) fn section(
    run: &Run,
    clouds: &[Cloud],
    legend: &[LegendEntry],
) -> Result<Option<Section>> {
    let held = HeldCells::of(run, clouds);
    let mut scenes = Vec::new();
    for scene in run.scenes() {
        if let Some(markup) = scene_gallery(run, scene, &held, legend)? {
            scenes.push(markup);
        }
    }
    let content = html! {
        p.note { "Click a picture, or move the focus to it, to see it large." }
        @if !held.holds_all() {
            p.note {
                "The pictures of this run are too many for one page. It holds those of the Pareto "
                "fronts, then those of the first method of each sweep and of the others, as far as there is "
                "room; the rest it links to, in the folder " code { (IMAGES_DIR) } " of the run."
            }
        }
        @for scene in &scenes { (scene) }
    };
    Ok((!scenes.is_empty()).then(|| Section::new("pictures", "Pictures", content)))
}

fn scene_gallery(
    run: &Run,
    scene: &str,
    held: &HeldCells,
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
        strips.extend(strip(run, title, row, held)?);
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
            @for strip in &strips { (strip) }
        }
    }))
}

/// The pictures of one method in one scene: side by side; links in a line. None where there are none.
fn strip(run: &Run, scene: &str, row: &Summary, held: &HeldCells) -> Result<Option<Markup>> {
    let contender = run.contender(row);
    let label = contender.label();
    let hold = held.holds(&(row.scene.clone(), label.clone()));
    let mut pictures = Vec::new();
    for (kind, caption, what) in KINDS {
        let name = run.image(&row.scene, &row.method, &row.variant, kind);
        let alt = format!("{scene}, {label}: {what}");
        pictures.extend(picture(run, &name, caption, alt, hold)?);
    }
    let is_held = pictures.iter().any(Picture::is_held);
    let strip = html! {
        h4 { (run.method_title(&contender)) " " code { (label) } }
        div class=(if is_held { "strip" } else { "links" }) {
            @for picture in &pictures { (picture.figure(run)) }
        }
    };
    Ok((!pictures.is_empty()).then_some(strip))
}
