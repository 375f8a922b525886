//! The pictures of a run: in the page, or links to their files.

use std::collections::HashSet;
use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, Result};
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD as BASE64;
use maud::{Markup, html};

use crate::report::LegendEntry;

/// A page holds pictures up to this size; a browser opens one of a third more, as base64 makes it,
/// without a wait.
const MAX_BYTES: u64 = 22 << 20;

/// The pictures in a folder of a run, of which a page holds as many as fit; to the others it links.
pub(super) struct Album {
    dir: PathBuf,
    folder: &'static str,
    held: HashSet<String>,
    /// Whether no picture is left out.
    pub is_whole: bool,
}

/// Where a page has a picture.
pub(super) enum Source {
    /// In itself: an address that is the picture.
    Held(String),
    /// In a file, at this address.
    Linked(String),
}

impl Album {
    /// Holds the first sets of pictures, as many as fit. Once one does not, no lesser one is let in for being small.
    pub(super) fn new(
        dir: &Path,
        folder: &'static str,
        sets: impl IntoIterator<Item = Vec<String>>,
    ) -> Self {
        let dir = dir.join(folder);
        // The size of one that cannot be read is nothing; that it cannot be is reported where it is embedded.
        let size = |name: &String| dir.join(name).metadata().map_or(0, |data| data.len());
        let (mut held, mut left_bytes, mut is_whole) = (HashSet::new(), MAX_BYTES, true);
        for set in sets {
            let left = left_bytes.checked_sub(set.iter().map(size).sum());
            is_whole &= left.is_some();
            if is_whole {
                left_bytes = left.unwrap_or_default();
                held.extend(set);
            }
        }
        Self {
            dir,
            folder,
            held,
            is_whole,
        }
    }

    pub(super) fn holds(&self, name: &str) -> bool {
        self.held.contains(name)
    }

    /// The PNG file of that name, which must be safe in an address; `None` where there is none.
    pub(super) fn find(&self, name: &str) -> Result<Option<Source>> {
        let path = self.dir.join(name);
        if !path.is_file() {
            return Ok(None);
        }
        if !self.holds(name) {
            return Ok(Some(Source::Linked(format!("{}/{name}", self.folder))));
        }
        let png = fs::read(&path).with_context(|| format!("cannot read {}", path.display()))?;
        let data_uri = format!("data:image/png;base64,{}", BASE64.encode(png));
        Ok(Some(Source::Held(data_uri)))
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
