//! The pictures: what every method drew, beside the reference and its errors.

use anyhow::Result;
use maud::{Markup, html};

use super::pictures::{Album, Source, legend_list};
use super::shell::{Section, note};
use crate::record::{IMAGES_DIR, ImageKind, Summary};
use crate::report::LegendEntry;
use crate::report::curve::{Contender, Curves};
use crate::report::load::Run;
use crate::report::pareto::Cloud;
use crate::variant::Variant;

const KINDS: [(ImageKind, &str, &str); 3] = [
    (ImageKind::Picture, "Picture", "lit picture"),
    (ImageKind::Mask, "Shadow mask", "shadow mask"),
    (
        ImageKind::Error,
        "Errors",
        "mask compared with the reference",
    ),
];

/// The section; none where there are no pictures.
pub(super) fn section(
    run: &Run,
    clouds: &[Cloud],
    legend: &[LegendEntry],
) -> Result<Option<Section>> {
    let album = album(run, clouds);
    let mut scenes = Vec::new();
    for scene in run.scenes() {
        scenes.extend(scene_gallery(run, scene, &album, legend)?);
    }
    let content = html! {
        (note("Click a picture, or move the focus to it, to see it large."))
        @if !album.is_whole { (note(include_str!("notes/too_many_pictures.html"))) }
        @for scene in &scenes { (scene) }
    };
    Ok((!scenes.is_empty()).then(|| Section::new("pictures", "Pictures", content)))
}

/// The references, then the cells of the front, then the first of each curve, then the others.
fn album(run: &Run, clouds: &[Cloud]) -> Album {
    let curves = Curves::of(run);
    let rows = run.scenes().into_iter().flat_map(|scene| run.rows(scene));
    let mut cells: Vec<&Summary> = rows.collect();
    cells.sort_by_cached_key(|row| {
        let contender = run.contender(row);
        let is_on_front = is_on_front(clouds, row, &contender);
        (!is_on_front, !is_on_front && !is_first(&curves, &contender))
    });
    let references = run.scenes().into_iter();
    let references = references.map(|scene| vec![reference(run, scene)]);
    let cells = cells.into_iter().map(|row| names(run, row).to_vec());
    Album::new(&run.dir, IMAGES_DIR, references.chain(cells))
}

fn is_on_front(clouds: &[Cloud], row: &Summary, contender: &Contender) -> bool {
    let mut clouds = clouds.iter();
    let of_scene = clouds.find(|cloud| cloud.scene.as_deref() == Some(&row.scene));
    let points = of_scene.into_iter().flat_map(|cloud| &cloud.points);
    let mut front = points.filter(|point| point.dominated_by.is_none());
    front.any(|point| point.contender == *contender)
}

fn is_first(curves: &Curves, contender: &Contender) -> bool {
    let place = curves.place(contender);
    let first = curves.members.iter().find(|(_, other, _)| *other == place);
    first.is_some_and(|(first, ..)| first == contender)
}

fn reference(run: &Run, scene: &str) -> String {
    run.image(scene, "", &Variant::default(), ImageKind::Reference)
}

fn names(run: &Run, row: &Summary) -> [String; KINDS.len()] {
    KINDS.map(|(kind, ..)| run.image(&row.scene, &row.method, &row.variant, kind))
}

fn scene_gallery(
    run: &Run,
    scene: &str,
    album: &Album,
    legend: &[LegendEntry],
) -> Result<Option<Markup>> {
    let title = run.scene_title(scene);
    let alt = format!("{title}: shadow mask by the ray-traced reference");
    let reference = figure(run, album, &reference(run, scene), "Reference mask", &alt)?;
    let mut strips = Vec::new();
    for row in run.rows(scene) {
        strips.extend(strip(run, title, row, album)?);
    }
    let gallery = html! {
        article.gallery {
            h3 { (title) }
            div.strip {
                @if let Some(reference) = &reference { (reference) }
                @if !legend.is_empty() { (legend_list(legend)) }
            }
            @for strip in &strips { (strip) }
        }
    };
    Ok((reference.is_some() || !strips.is_empty()).then_some(gallery))
}

/// The pictures of one method in one scene: side by side; links in a line. None where there are none.
fn strip(run: &Run, scene: &str, row: &Summary, album: &Album) -> Result<Option<Markup>> {
    let contender = run.contender(row);
    let label = contender.label();
    let names = names(run, row);
    let mut figures = Vec::new();
    for ((_, caption, what), name) in KINDS.iter().zip(&names) {
        let alt = format!("{scene}, {label}: {what}");
        figures.extend(figure(run, album, name, caption, &alt)?);
    }
    let strip = html! {
        h4 { (run.method_title(&contender)) " " code { (label) } }
        div class=(if album.holds(&names[0]) { "strip" } else { "links" }) {
            @for figure in &figures { (figure) }
        }
    };
    Ok((!figures.is_empty()).then_some(strip))
}

fn figure(
    run: &Run,
    album: &Album,
    name: &str,
    caption: &str,
    alt: &str,
) -> Result<Option<Markup>> {
    Ok(album.find(name)?.map(|source| match source {
        Source::Held(data_uri) => html! {
            figure {
                img tabindex="0" src=(data_uri) alt=(alt) width=(run.info.width) height=(run.info.height);
                figcaption { (caption) }
            }
        },
        Source::Linked(address) => html! { a href=(address) aria-label=(alt) { (caption) } },
    }))
}
