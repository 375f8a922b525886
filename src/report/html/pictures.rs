//! One picture: in the page, or a link to its file.

use std::collections::HashSet;
use std::fs;
use std::hash::Hash;
use std::io::ErrorKind;
use std::path::Path;

use anyhow::{Context as _, Result};
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD as BASE64;
use maud::{Markup, html};

use crate::record::IMAGES_DIR;
use crate::report::LegendEntry;
use crate::report::load::Run;

/// A page holds pictures up to this size; a browser opens one of a third more, as base64 makes it,
/// without a wait.
const MAX_BYTES: u64 = 22 << 20;

/// What of a run's pictures a page holds; to the others it links.
pub(super) struct Held<K> {
    held: HashSet<K>,
    all: bool,
}

impl<K: Eq + Hash> Held<K> {
    /// The first ones, as many as fit. Once one does not, no lesser one is let in for being small.
    pub(super) fn as_many_as_fit(pictures: impl Iterator<Item = (K, u64)>) -> Self {
        let (mut held, mut left_bytes) = (HashSet::new(), MAX_BYTES);
        for (key, bytes) in pictures {
            match left_bytes.checked_sub(bytes) {
                Some(left) => left_bytes = left,
                None => return Self { held, all: false },
            }
            held.insert(key);
        }
        Self { held, all: true }
    }

    pub(super) fn holds(&self, key: &K) -> bool {
        self.all || self.held.contains(key)
    }

    /// Whether no picture is left out.
    pub(super) fn holds_all(&self) -> bool {
        self.all
    }
}

/// The size of a file; 0 for one that cannot be read, which is reported where it is embedded.
pub(super) fn size_bytes(path: &Path) -> u64 {
    path.metadata().map_or(0, |data| data.len())
}

/// A picture that there is.
pub(super) struct Picture {
    caption: &'static str,
    alt: String,
    source: Source,
}

enum Source {
    /// The picture itself.
    Held(String),
    /// Its address from the page.
    Linked(String),
}

/// A picture of the run, held by the page or linked to; `None` where the run has none of that name,
/// which must be safe in an address.
pub(super) fn picture(
    run: &Run,
    name: &str,
    caption: &'static str,
    alt: String,
    hold: bool,
) -> Result<Option<Picture>> {
    let path = run.dir.join(IMAGES_DIR).join(name);
    let source = if hold {
        match data_uri(&path)? {
            Some(data_uri) => Source::Held(data_uri),
            None => return Ok(None),
        }
    } else if path.is_file() {
        Source::Linked(format!("{IMAGES_DIR}/{name}"))
    } else {
        return Ok(None);
    };
    Ok(Some(Picture {
        caption,
        alt,
        source,
    }))
}

/// A PNG file as an address that holds it; `None` where there is none.
pub(super) fn data_uri(path: &Path) -> Result<Option<String>> {
    match fs::read(path) {
        Ok(png) => Ok(Some(format!(
            "data:image/png;base64,{}",
            BASE64.encode(png)
        ))),
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
        Err(error) => Err(error).with_context(|| format!("cannot read {}", path.display())),
    }
}

impl Picture {
    pub(super) fn is_held(&self) -> bool {
        matches!(self.source, Source::Held(_))
    }

    pub(super) fn figure(&self, run: &Run) -> Markup {
        match &self.source {
            Source::Held(data_uri) => html! {
                figure {
                    img tabindex="0" src=(data_uri) alt=(self.alt)
                        width=(run.info.width) height=(run.info.height);
                    figcaption { (self.caption) }
                }
            },
            Source::Linked(address) => html! {
                a href=(address) aria-label=(self.alt) { (self.caption) }
            },
        }
    }
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
