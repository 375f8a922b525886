//! Families of scenes that a run grows in one direction, as their names tell: see [`SceneFile::with_sphere_grid`],
//! [`SceneFile::with_shells`], [`SceneFile::with_city`] and [`SceneFile::at_size`].
//!
//! [`SceneFile::with_sphere_grid`]: crate::scene::SceneFile::with_sphere_grid
//! [`SceneFile::with_shells`]: crate::scene::SceneFile::with_shells
//! [`SceneFile::with_city`]: crate::scene::SceneFile::with_city
//! [`SceneFile::at_size`]: crate::scene::SceneFile::at_size

use super::Summary;

/// What scenes of a family have more and more of. Beside triangles, the number of slices may differ too: a run sets it so that
/// all have about as many triangles.
pub struct Growth {
    /// How their names say so, with `#` for digits: one of these.
    marks: &'static [&'static str],
    /// In file names.
    pub name: &'static str,
    /// In words.
    pub title: &'static str,
    /// How much a row's scene has of it.
    of: fn(&Summary) -> Option<u64>,
}

/// All that is known.
pub const ALL: [Growth; 4] = [
    Growth {
        marks: &["_n#"],
        name: "triangles",
        title: "Casting triangles",
        of: |row| row.triangles,
    },
    Growth {
        marks: &["_#x#_n#", "_o#"],
        name: "objects",
        title: "Casting objects",
        of: |row| row.objects,
    },
    Growth {
        marks: &["_d#_n#"],
        name: "shells",
        title: "Nested shells",
        of: |row| number_after("_d", &row.scene),
    },
    Growth {
        marks: &["_#x#px"],
        name: "pixels",
        title: "Pixels",
        of: |row| Some(u64::from(row.width) * u64::from(row.height)),
    },
];

impl Growth {
    /// The family of a scene: its name without the last part that tells how much. `None` where it does not tell.
    pub fn family(&self, scene: &str) -> Option<String> {
        self.marks.iter().find_map(|mark| family(scene, mark))
    }

    /// How much of it a row's scene has.
    pub fn amount(&self, row: &Summary) -> Option<u64> {
        (self.of)(row)
    }
}

/// What a name says besides the last part that is like `mark`. `None` where it has none.
fn family(scene: &str, mark: &str) -> Option<String> {
    let ends = scene.char_indices().rev();
    ends.filter_map(|(at, _)| Some((at, after(&scene[at..], mark)?)))
        .map(|(at, rest)| format!("{}{rest}", &scene[..at]))
        .next()
}

/// What follows a mark at the start of a text.
fn after<'a>(text: &'a str, mark: &str) -> Option<&'a str> {
    let mut pieces = mark.split('#');
    let mut rest = text.strip_prefix(pieces.next()?)?;
    for piece in pieces {
        let digits = rest.trim_start_matches(|c: char| c.is_ascii_digit());
        if digits.len() == rest.len() {
            return None;
        }
        rest = digits.strip_prefix(piece)?;
    }
    Some(rest)
}

/// The last number in a name that follows a word.
fn number_after(word: &str, name: &str) -> Option<u64> {
    let numbers = name.rmatch_indices(word).map(|(at, _)| {
        let rest = &name[at + word.len()..];
        let end = rest.find(|c: char| !c.is_ascii_digit());
        rest[..end.unwrap_or(rest.len())].parse().ok()
    });
    numbers.flatten().next()
}

#[cfg(test)]
mod tests {
    use super::{family, number_after};

    #[test]
    fn a_family_is_the_name_without_its_last_size() {
        let of = |scene, mark| family(scene, mark);
        let triangles = "_n#";
        assert_eq!(
            of("spheres_10x10_n140", triangles).as_deref(),
            Some("spheres_10x10")
        );
        assert_eq!(of("a_n2_b_n3", triangles).as_deref(), Some("a_n2_b"));
        assert_eq!(
            of("spheres_n18_high", triangles).as_deref(),
            Some("spheres_high")
        );
        assert_eq!(of("town_night", triangles), None);
        assert_eq!(of("sponza", triangles), None);
        assert_eq!(
            of("spheres_10x10_n140", "_#x#_n#").as_deref(),
            Some("spheres")
        );
        assert_eq!(of("spheres_d16_n24", "_d#_n#").as_deref(), Some("spheres"));
        let pixels = "_#x#px";
        assert_eq!(
            of("spheres_10x10_n18_640x480px", pixels).as_deref(),
            Some("spheres_10x10_n18")
        );
        assert_eq!(of("spheres_10x10_n18", pixels), None);
        assert_eq!(number_after("_d", "dragon_d16_n24"), Some(16));
        assert_eq!(number_after("_d", "dragon"), None);
    }
}
