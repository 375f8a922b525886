//! The ray-traced truth that every shadow mask is judged by.
//!
//! For each pixel, the triangle that the GPU's own G-buffer saw is met exactly (f64) by the ray
//! through the pixel's centre, and the open segment from there to the light is tested against
//! every *other* triangle that casts. The answer is [`Verdict::Lit`], [`Verdict::Shadowed`], or,
//! where a perturbation within [`RELATIVE_TOLERANCE`] could turn it, [`Verdict::Ambiguous`].
//!
//! In reading order: [`ReferenceMask`] is the result, `view` the pixel rays, `surface` the point
//! seen through a pixel, `segment` the way from it to the light, `contact` how that meets one
//! triangle, `tree` which triangles are worth asking, `trace` the whole picture,
//! `grid` which pixels the rasteriser's grid decides,
//! [`BoundaryProbe`] where the true shadow boundary runs, [`EvidenceProbe`] what is known of a
//! single pixel, [`Motion`] where the points of one picture appear in another, and
//! [`ReferenceCache`] what is kept on disk between runs.

mod around;
mod boundary;
mod cache;
mod cache_folder;
mod contact;
mod evidence;
mod grid;
mod motion;
mod samples;
mod segment;
mod surface;
mod trace;
mod tree;
mod verdict;
mod view;
mod visibility;

#[cfg(test)]
pub(crate) mod fixtures;
#[cfg(test)]
mod tests;

pub use around::SurroundingsProbe;
pub use boundary::BoundaryProbe;
pub use cache::{CacheKey, ReferenceCache};
pub use evidence::{Evidence, EvidenceProbe};
pub use motion::Motion;
pub use trace::Reference;
pub use verdict::{ReferenceMask, Verdict};
pub use view::ReferenceView;
pub use visibility::Visibility;

/// How far a decision may be from turning, relative to the scene, and still count as undecided.
///
/// A length is compared with this times the *scale*: the largest absolute coordinate of the
/// scene's vertices, or the length of the segment to the light where that is longer. The vertices,
/// the light and the matrix are f32 and are taken as exact, so only our own f64 arithmetic is
/// uncertain. Its error is some 1e-15 of the scale, and up to 1e-12 after the inverse of an
/// ill-conditioned matrix: 1e-9 stands well above both, and still is a millionth of a pixel that
/// shows a thousandth of the scene.
pub const RELATIVE_TOLERANCE: f64 = 1e-9;

/// Why a reference cannot be traced.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ReferenceError {
    /// A corner is not finite or not in the list of positions.
    #[error("triangle {triangle} has a corner that is missing or not finite")]
    BadTriangle {
        /// Index of the triangle.
        triangle: u32,
    },
    /// The matrix cannot be inverted, or maps no point to the eye (a parallel projection).
    #[error("the view-projection matrix is not a perspective that can be inverted")]
    BadMatrix,
    /// The light is not finite, or a direction of length zero.
    #[error("the light is neither a finite point nor a direction")]
    BadLight,
    /// The light is a ball, whose shadows are soft.
    #[error("the light has a radius, and soft shadows are not traced")]
    LightHasSize,
    /// A picture has another number of pixels than the view.
    #[error("{found} pixels given for a picture of {expected}")]
    WrongSize {
        /// Width times height of the view.
        expected: usize,
        /// Pixels given.
        found: usize,
    },
    /// A pixel names a triangle that the scene does not have.
    #[error("pixel {pixel} shows triangle id {id}, but the scene has {triangles} triangles")]
    UnknownTriangle {
        /// Index of the pixel, counted by rows from the top.
        pixel: usize,
        /// The id found there.
        id: u32,
        /// Triangles in the scene.
        triangles: usize,
    },
}
