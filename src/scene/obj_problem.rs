//! What can be wrong with a line of an OBJ file.

use std::fmt;

use super::mesh::LARGEST_COORDINATE;

/// What is wrong with a line.
#[derive(Clone, Debug, PartialEq)]
pub enum ObjProblem {
    /// Something else stands where a number should.
    Number(String),
    /// A vertex with fewer than three coordinates.
    Coordinates(usize),
    /// A number is NaN, infinite or too large for 32 bits.
    NotFinite,
    /// A coordinate beyond [`LARGEST_COORDINATE`].
    TooLarge,
    /// A vertex with a weight of 0, which lies at infinity.
    ZeroWeight,
    /// A face with fewer than three corners.
    ShortFace(usize),
    /// A face names a vertex that is not there.
    Index {
        /// The index as written, from 1, or from -1 backwards.
        index: isize,
        /// How many vertices precede the face.
        vertices: usize,
    },
    /// The line begins with numbers and belongs to no other.
    Stray(String),
    /// The last line says that it goes on.
    CutShort,
    /// A carriage return without a line feed.
    CarriageReturn,
    /// A byte of zero.
    ZeroByte,
}

impl fmt::Display for ObjProblem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(word) if word.contains(',') => write!(
                f,
                "`{word}` is not a number that belongs here; numbers have a decimal point, no comma"
            ),
            Self::Number(word) => write!(
                f,
                "`{word}` is not a number that belongs here; correct the line"
            ),
            Self::Coordinates(count) => {
                write!(
                    f,
                    "a vertex needs three coordinates, not {count}; complete the line"
                )
            }
            Self::NotFinite => f.write_str(
                "a coordinate is not a finite 32-bit number; repair the model and export it again",
            ),
            Self::TooLarge => write!(
                f,
                "a coordinate is larger than {LARGEST_COORDINATE}: products of three lengths overflow \
                 32 bits; scale the model down"
            ),
            Self::ZeroWeight => {
                f.write_str("a vertex with weight 0 lies at infinity; remove the fourth number")
            }
            Self::ShortFace(count) => {
                write!(
                    f,
                    "a face needs at least three corners, not {count}; remove it or make it a \
                     line (`l`)"
                )
            }
            Self::Index { index, vertices } => write!(
                f,
                "the face names vertex {index}, but {vertices} vertices precede it; the file may \
                 be cut short"
            ),
            Self::Stray(word) => write!(
                f,
                "the line begins with `{word}`, which is no statement; if it goes on from the line \
                 before, that must end in `\\`"
            ),
            Self::CutShort => f.write_str(
                "the file ends with a `\\`, which says that the line goes on; it may be cut short: \
                 get it again",
            ),
            Self::CarriageReturn => f.write_str(
                "a carriage return without a line feed, as in files of the old Mac OS; turn all of \
                 them into line feeds: `tr '\\r' '\\n' < old.obj > new.obj`",
            ),
            Self::ZeroByte => f.write_str(
                "a byte of zero, which no text has; the file is binary, or was damaged: get it again",
            ),
        }
    }
}
