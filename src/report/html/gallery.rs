//! The pictures: what every method drew, beside the reference and its errors.

use anyhow::Result;
use maud::{Markup, html};

use super::pictures::{Album, Picture, legend_list};
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
    let album = album(run, clouds)?;
    let content = html! {
        (note("Click a picture, or move the focus to it, to see it large."))
        @if !album.is_whole() { (note(include_str!("notes/too_many_pictures.html"))) }
        @for scene in run.scenes() { (gallery(run, scene, &album, legend)) }
    };
    Ok((!album.is_empty()).then(|| Section::new("pictures", "Pictures", content)))
}

/// The references, then the cells of the front, then the first of each curve, then the others.
fn album(run: &Run, clouds: &[Cloud]) -> Result<Album> {
    let curves = Curves::of(run);
    let scenes = run.scenes();
    let mut cells: Vec<&Summary> = scenes.iter().flat_map(|scene| run.rows(scene)).collect();
    cells.sort_by_cached_key(|row| {
        let contender = run.contender(row);
        let is_on_front = is_on_front(clouds, row, &contender);
        (!is_on_front, !is_on_front && !is_first(&curves, &contender))
    });
    let references = scenes.iter().map(|scene| vec![reference(run, scene)]);
    let cells = cells.into_iter().map(|row| names(run, row).to_vec());
    Album::read(&run.dir, IMAGES_DIR, references.chain(cells))
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

/// The pictures of a scene; nothing where there are none.
fn gallery(run: &Run, scene: &str, album: &Album, legend: &[LegendEntry]) -> Markup {
    let title = run.scene_title(scene);
    let alt = format!("{title}: shadow mask by the ray-traced reference");
    let reference = album.get(&reference(run, scene));
    let strips = html! { @for row in run.rows(scene) { (strip(run, title, row, album)) } };
    html! {
        @if reference.is_some() || !strips.0.is_empty() {
            article.gallery {
                h3 { (title) }
                div.strip {
                    @if let Some(picture) = reference { (figure(run, picture, "Reference mask", &alt)) }
                    @if !legend.is_empty() { (legend_list(legend)) }
                }
                (strips)
            }
        }
    }
}

/// The pictures of one method in one scene: side by side; links in a line.
fn strip(run: &Run, scene: &str, row: &Summary, album: &Album) -> Markup {
    let contender = run.contender(row);
    let label = contender.label();
    let names = names(run, row).into_iter().zip(KINDS);
    let pictures = names.filter_map(|(name, kind)| Some((album.get(&name)?, kind)));
    let pictures: Vec<(&Picture, _)> = pictures.collect();
    let is_held = pictures.iter().any(|(picture, _)| picture.is_held);
    html! {
        @if !pictures.is_empty() {
            h4 { (run.method_title(&contender)) " " code { (label) } }
            div class=(if is_held { "strip" } else { "links" }) {
                @for (picture, (_, caption, what)) in pictures {
                    (figure(run, picture, caption, &format!("{scene}, {label}: {what}")))
                }
            }
        }
    }
}

fn figure(run: &Run, picture: &Picture, caption: &str, alt: &str) -> Markup {
    html! {
        @if picture.is_held {
            figure {
                img tabindex="0" src=(picture.address) alt=(alt) width=(run.info.width) height=(run.info.height);
                figcaption { (caption) }
            }
        } @else {
            a href=(picture.address) aria-label=(alt) { (caption) }
        }
    }
}
