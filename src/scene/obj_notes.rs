//! What the reader of a model should know: what of it could be read in more than one way, or was not read.

use std::borrow::Cow;
use std::path::Path;

use super::obj_checks::Checked;
use super::polygon::Shape;

/// What is to say of the polygons of a model.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Shapes {
    /// Those of more than three corners.
    polygons: usize,
    bent: usize,
    /// How much the one that is bent most is, and its line.
    most_bent: (f64, usize),
    crossing: usize,
    /// The line of the first.
    first_crossing: usize,
}

impl Shapes {
    pub(super) fn of(shape: Shape, corners: usize, line: usize) -> Self {
        let mut shapes = Self {
            polygons: usize::from(corners > 3),
            ..Self::default()
        };
        match shape {
            Shape::Flat => {}
            Shape::Bent(by) => (shapes.bent, shapes.most_bent) = (1, (by, line)),
            Shape::Crossing => (shapes.crossing, shapes.first_crossing) = (1, line),
        }
        shapes
    }

    /// Of objects in the order of the file.
    pub(super) fn and(self, next: Self) -> Self {
        let more_bent = next.most_bent.0 > self.most_bent.0;
        let first_crossing = [self.first_crossing, next.first_crossing];
        Self {
            polygons: self.polygons + next.polygons,
            bent: self.bent + next.bent,
            most_bent: if more_bent {
                next.most_bent
            } else {
                self.most_bent
            },
            crossing: self.crossing + next.crossing,
            first_crossing: first_crossing[usize::from(self.crossing == 0)],
        }
    }

    pub(super) fn notes(&self, path: &Path) -> Vec<String> {
        let file = file_name(path);
        let some = |count: usize, one: &str, many: &str| {
            let (all, verb) = (self.polygons, if count == 1 { one } else { many });
            format!("{file}: {count} of {all} polygons of more than three corners {verb}")
        };
        let mut notes = Vec::new();
        if self.bent > 0 {
            let (by, line) = self.most_bent;
            notes.push(format!(
                "{} not flat, the worst by {:.1} % of its size (line {line}): how it is cut into \
                 triangles decides its shape; export triangles to decide that yourself",
                some(self.bent, "is", "are"),
                100.0 * by,
            ));
        }
        if self.crossing > 0 {
            notes.push(format!(
                "{} (the first in line {}): without an inside, each is drawn as a fan of triangles; \
                 repair them, or export triangles",
                some(self.crossing, "crosses itself", "cross themselves"),
                self.first_crossing,
            ));
        }
        notes
    }
}

/// What to say of statements that are not read.
pub(super) fn unread_note(path: &Path, checked: &Checked) -> Option<String> {
    let (line, keyword) = checked.first_unread.as_ref()?;
    Some(format!(
        "{}: {} statements are not read (curved surfaces, other files, or unknown words), the first of them \
         `{}` in line {line}; export polygons",
        file_name(path),
        checked.unread,
        keyword.escape_debug(),
    ))
}

/// The vertices of a model of this size are moved by up to a thousandth of it.
const SMALLEST_SIZE: f32 = 1e-9;

/// What to say of a model whose longest side is `size`, if it is so small that it loses its shape.
pub(super) fn size_note(path: &Path, size: f32) -> Option<String> {
    (size < SMALLEST_SIZE).then(|| {
        format!(
            "{}: is only {size:e} units large, and vertices are moved to multiples of 2^-40; scale it up",
            file_name(path)
        )
    })
}

fn file_name(path: &Path) -> Cow<'_, str> {
    path.file_name().unwrap_or_default().to_string_lossy()
}
