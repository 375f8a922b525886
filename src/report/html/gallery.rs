//! The pictures: what every method drew, beside the reference and its errors.

use std::fs;
use std::io::ErrorKind;

use anyhow::{Context as _, Result};
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD as BASE64;
use maud::{Markup, html};

use crate::bench::record::{IMAGES_DIR, ImageKind, Summary, image_name};
use crate::report::LegendEntry;
use crate::report::load::Run;

/// One picture, ready to be embedded.
struct Picture {
    caption: &'static str,
    alt: String,
    data_uri: String,
}

/// The pictures of one method in one scene.
struct Strip {
    title: String,
    label: String,
    pictures: Vec<Picture>,
}

/// The gallery; `None` where the run has no pictures.
pub(super) fn section(run: &Run, legend: &[LegendEntry]) -> Result<Option<Markup>> {
    let mut scenes = Vec::new();
    for scene in run.scenes() {
        if let Some(markup) = scene_gallery(run, scene, legend)? {
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
            @for scene in scenes { (scene) }
        }
    }))
}

fn scene_gallery(run: &Run, scene: &str, legend: &[LegendEntry]) -> Result<Option<Markup>> {
    let title = run.scene_title(scene);
    let reference = picture(
        run,
        &image_name(scene, "", "", ImageKind::Reference),
        "Reference mask",
        format!("{title}: shadow mask by the ray-traced reference"),
    )?;
    let mut strips = Vec::new();
    for row in run.rows(scene) {
        let strip = strip(run, title, row)?;
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
                @if let Some(reference) = &reference { (figure(run, reference)) }
                @if !legend.is_empty() { (legend_list(legend)) }
            }
            @for strip in &strips {
                h4 { (strip.title) " " code { (strip.label) } }
                div.strip { @for picture in &strip.pictures { (figure(run, picture)) } }
            }
        }
    }))
}

fn strip(run: &Run, scene_title: &str, row: &Summary) -> Result<Strip> {
    let contender = run.contender(row);
    let label = contender.label();
    let kinds = [
        (ImageKind::Picture, "Picture", "lit picture"),
        (ImageKind::Mask, "Shadow mask", "shadow mask"),
        (
            ImageKind::Error,
            "Errors",
            "mask compared with the reference",
        ),
    ];
    let mut pictures = Vec::new();
    for (kind, caption, what) in kinds {
        let name = image_name(&row.scene, &row.method, &row.variant, kind);
        let alt = format!("{scene_title}, {label}: {what}");
        pictures.extend(picture(run, &name, caption, alt)?);
    }
    Ok(Strip {
        title: run.method_title(&contender).to_owned(),
        label,
        pictures,
    })
}

fn picture(run: &Run, name: &str, caption: &'static str, alt: String) -> Result<Option<Picture>> {
    let path = run.dir.join(IMAGES_DIR).join(name);
    match fs::read(&path) {
        Ok(png) => {
            let data_uri = format!("data:image/png;base64,{}", BASE64.encode(png));
            Ok(Some(Picture {
                caption,
                alt,
                data_uri,
            }))
        }
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
        Err(error) => Err(error).with_context(|| format!("cannot read {}", path.display())),
    }
}

fn figure(run: &Run, picture: &Picture) -> Markup {
    html! {
        figure {
            img tabindex="0" src=(picture.data_uri) alt=(picture.alt)
                width=(run.info.width) height=(run.info.height);
            figcaption { (picture.caption) }
        }
    }
}

fn legend_list(legend: &[LegendEntry]) -> Markup {
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
