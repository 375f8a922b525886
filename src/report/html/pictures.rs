//! The pictures of a run: in the page, or links to their files.

use std::collections::HashMap;
use std::fs;
use std::path::Path;

use anyhow::{Context as _, Result};
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD as BASE64;
use maud::{Markup, html};

use crate::report::LegendEntry;

/// A page holds pictures up to this size; a browser opens one of a third more, as base64 makes it,
/// without a wait.
const MAX_BYTES: u64 = 22 << 20;

/// The pictures of a run by their names, of which a page holds as many as fit; to the others it links.
pub(super) struct Album(HashMap<String, Picture>);

/// A picture as a page has it.
pub(super) struct Picture {
    /// What the page names as its source: the picture itself if it holds it, else the file.
    pub address: String,
    pub is_held: bool,
}

impl Album {
    /// The PNG files of these names, which must be safe in an address, as far as they are there. The first sets are
    /// held. Once one does not fit, no lesser one is let in for being small.
    pub(super) fn read(
        dir: &Path,
        folder: &str,
        sets: impl IntoIterator<Item = Vec<String>>,
    ) -> Result<Self> {
        let (mut pictures, mut is_held, mut left_bytes) = (HashMap::new(), true, MAX_BYTES);
        for mut set in sets {
            let path = |name: &String| dir.join(folder).join(name);
            set.retain(|name| !pictures.contains_key(name) && path(name).is_file());
            let size = |name| path(name).metadata().map_or(0, |data| data.len());
            let left = left_bytes.checked_sub(set.iter().map(size).sum());
            is_held &= left.is_some();
            left_bytes = left.unwrap_or_default();
            for name in set {
                let mut address = format!("{folder}/{name}");
                if is_held {
                    let png =
                        fs::read(path(&name)).with_context(|| format!("cannot read {address}"))?;
                    address = format!("data:image/png;base64,{}", BASE64.encode(png));
                }
                pictures.insert(name, Picture { address, is_held });
            }
        }
        Ok(Self(pictures))
    }

    pub(super) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Whether no picture is left out.
    pub(super) fn is_whole(&self) -> bool {
        self.0.values().all(|picture| picture.is_held)
    }

    pub(super) fn get(&self, name: &str) -> Option<&Picture> {
        self.0.get(name)
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
