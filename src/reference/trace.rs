//! From a scene, a light and a picture of triangle ids to the verdict of each pixel.

use glam::{DVec2, DVec3, Vec3};
use rayon::prelude::*;

use super::contact::{Contact, EdgeContact, contact, coplanar};
use super::segment::{ExactLight, Plane, Segment};
use super::surface::{hit, point_seen};
use super::tree::{Primitive, Tree, Visit};
use super::view::Projection;
use super::{RELATIVE_TOLERANCE, ReferenceError, ReferenceMask, ReferenceView, Visibility};
use crate::scene::Light;

/// A scene, ready to answer what is in shadow.
pub struct Reference {
    pub(super) tree: Tree,
}

/// A pixel and the triangle that it shows.
struct Pixel<'a> {
    own: &'a Primitive,
    centre_px: DVec2,
}

/// The last triangle found blocking: the next ray's first candidate, as neighbours mostly share it.
pub(super) type LastBlocker = Option<u32>;

impl Reference {
    /// Prepares a scene. `casts` says of each triangle's index whether it blocks light; the others
    /// only receive.
    ///
    /// # Errors
    /// [`ReferenceError::BadTriangle`] for a corner that is missing or not finite.
    pub fn new(
        positions: &[Vec3],
        triangles: &[[u32; 3]],
        casts: impl Fn(u32) -> bool,
    ) -> Result<Self, ReferenceError> {
        let corner = |index: u32| {
            positions
                .get(index as usize)
                .copied()
                .filter(|p| p.is_finite())
        };
        let primitive = |(triangle, &[a, b, c]): (usize, &[u32; 3])| {
            let triangle = triangle as u32;
            let error = ReferenceError::BadTriangle { triangle };
            match (corner(a), corner(b), corner(c)) {
                (Some(a), Some(b), Some(c)) => Ok(Primitive {
                    corners: [a, b, c],
                    triangle,
                    casts: casts(triangle),
                }),
                _ => Err(error),
            }
        };
        let primitives: Result<Vec<_>, _> = triangles.iter().enumerate().map(primitive).collect();
        Ok(Self {
            tree: Tree::new(primitives?),
        })
    }

    /// Judges a picture of triangle ids: one a pixel, by rows from the top, 0 for background and
    /// otherwise the index of the triangle plus one.
    ///
    /// # Errors
    /// Any [`ReferenceError`] but `BadTriangle`.
    pub fn trace(
        &self,
        light: Light,
        view: &ReferenceView,
        triangle_ids: &[u32],
    ) -> Result<ReferenceMask, ReferenceError> {
        let (light, projection) = (ExactLight::new(light)?, Projection::new(view)?);
        self.check_ids(view, triangle_ids)?;
        let width = view.width as usize;
        let mut pixels = vec![None; triangle_ids.len()];
        let rows = pixels
            .par_chunks_mut(width.max(1))
            .zip(triangle_ids.par_chunks(width.max(1)));
        rows.enumerate().for_each(|(y, (pixels, ids))| {
            let mut last_blocker = None;
            for (x, (visibility, &id)) in pixels.iter_mut().zip(ids).enumerate() {
                let Some(triangle) = id.checked_sub(1) else {
                    continue;
                };
                let own = self.tree.primitive(triangle);
                let centre_px = DVec2::new(x as f64 + 0.5, y as f64 + 0.5);
                let pixel = Pixel { own, centre_px };
                *visibility = Some(self.judge_pixel(&projection, light, &pixel, &mut last_blocker));
            }
        });
        ReferenceMask::new(view.width, view.height, pixels)
    }

    /// What reaches a pixel that shows `own`. Where the rasteriser's grid could show another place of that
    /// surface, and another part of the light would reach it there, it may be either.
    fn judge_pixel(
        &self,
        projection: &Projection,
        light: ExactLight,
        pixel: &Pixel<'_>,
        last_blocker: &mut LastBlocker,
    ) -> Visibility {
        let Pixel { own, centre_px } = *pixel;
        let Some(point) = point_seen(projection, centre_px, &own.corners, self.tree.scale) else {
            return Visibility::UNKNOWN;
        };
        let visibility = self.judge(own, point, projection.eye, light, last_blocker);
        if !projection.at_an_edge(centre_px, &own.corners, 1.0)
            || self.is_dark_side(own, point, projection.eye, light)
        {
            return visibility;
        }
        let mut either = visibility;
        for other in self.visibility_around(projection, centre_px, own, light) {
            either = either.or(other);
            if either == Visibility::UNKNOWN {
                break;
            }
        }
        either
    }

    /// The triangle ids that an exact rasteriser would draw, in the form that [`Self::trace`]
    /// takes: for a reference without a GPU, and for tests of G-buffers. Of triangles at
    /// the same distance, the one with the smallest index is seen.
    ///
    /// # Errors
    /// [`ReferenceError::BadMatrix`].
    pub fn visible_ids(&self, view: &ReferenceView) -> Result<Vec<u32>, ReferenceError> {
        let projection = Projection::new(view)?;
        let id = |pixel: usize| {
            let (x, y) = (pixel % view.width as usize, pixel / view.width as usize);
            let centre_px = DVec2::new(x as f64 + 0.5, y as f64 + 0.5);
            self.visible(&projection, centre_px)
                .map_or(0, |(own, _)| own.triangle + 1)
        };
        Ok((0..view.pixel_count())
            .into_par_iter()
            .with_min_len(256)
            .map(id)
            .collect())
    }

    /// The triangle seen at a place in the picture, and the point of it.
    pub(super) fn visible(
        &self,
        projection: &Projection,
        place_px: DVec2,
    ) -> Option<(&Primitive, DVec3)> {
        let ray = projection.ray(place_px);
        let mut nearest: Option<(u32, DVec3, f64)> = None;
        self.tree
            .visit_along(ray.eye, ray.direction, f64::INFINITY, |primitive| {
                let Some((point, distance)) = hit(&ray, &primitive.corners) else {
                    return Visit::On;
                };
                let nearer = nearest.is_none_or(|(triangle, _, least)| {
                    distance < least || (distance == least && primitive.triangle < triangle)
                });
                if !nearer || !projection.beyond_near_plane(point) {
                    return Visit::On;
                }
                nearest = Some((primitive.triangle, point, distance));
                Visit::Within(distance)
            });
        nearest.map(|(triangle, point, _)| (self.tree.primitive(triangle), point))
    }

    /// How much of the light reaches a point of the triangle `own`, seen from the eye.
    pub(super) fn judge(
        &self,
        own: &Primitive,
        point: DVec3,
        eye: DVec3,
        light: ExactLight,
        last_blocker: &mut LastBlocker,
    ) -> Visibility {
        let segment = Segment::new(point, light, self.tree.scale);
        match self.sides(own, &segment, eye) {
            (0, _) | (_, 0) => Visibility::UNKNOWN,
            (eye_side, light_side) if eye_side != light_side => Visibility::NONE,
            _ => self.occlusion(own, &segment, last_blocker),
        }
    }

    /// Whether eye and light are on different sides of the triangle `own`, which is dark wherever it is seen then.
    fn is_dark_side(&self, own: &Primitive, point: DVec3, eye: DVec3, light: ExactLight) -> bool {
        let segment = Segment::new(point, light, self.tree.scale);
        let (eye_side, light_side) = self.sides(own, &segment, eye);
        eye_side * light_side < 0
    }

    /// The sides of a triangle's plane on which eye and light lie; 0 where that cannot be told, or there is no
    /// plane.
    fn sides(&self, own: &Primitive, segment: &Segment, eye: DVec3) -> (i8, i8) {
        let Some(plane) = Plane::new(&own.corners) else {
            return (0, 0);
        };
        let tolerance = RELATIVE_TOLERANCE * self.tree.scale.max(eye.distance(segment.start));
        (plane.side(eye, tolerance), segment.light_side(&plane))
    }

    /// Whether no other triangle blocks the segment from a point of `own` that faces the light.
    ///
    /// One triangle met for certain, or two that close an edge between them, settle it. Otherwise
    /// any triangle met or missed within the tolerance leaves it ambiguous, except those that lie
    /// in the own plane: they touch the start, and do not block the side that faces the light.
    pub(super) fn occlusion(
        &self,
        own: &Primitive,
        segment: &Segment,
        last_blocker: &mut LastBlocker,
    ) -> Visibility {
        if let Some(triangle) = *last_blocker
            && triangle != own.triangle
            && contact(segment, &self.tree.primitive(triangle).corners) == Contact::Block
        {
            return Visibility::NONE;
        }
        let tolerance = RELATIVE_TOLERANCE * self.tree.scale;
        let mut visibility = Visibility::FULL;
        let mut edges: Vec<EdgeContact> = Vec::new();
        self.tree.visit_along(
            segment.start,
            segment.direction(),
            segment.reach(),
            |other| {
                if !other.casts || other.triangle == own.triangle {
                    return Visit::On;
                }
                match contact(segment, &other.corners) {
                    Contact::Miss => {}
                    Contact::Touch if coplanar(&own.corners, &other.corners, tolerance) => {}
                    Contact::Touch | Contact::Unsure => visibility = Visibility::UNKNOWN,
                    Contact::Edge(edge) if !edges.iter().any(|known| known.closes(&edge)) => {
                        visibility = Visibility::UNKNOWN;
                        edges.push(edge);
                    }
                    Contact::Block | Contact::Edge(_) => {
                        visibility = Visibility::NONE;
                        *last_blocker = Some(other.triangle);
                        return Visit::Stop;
                    }
                }
                Visit::On
            },
        );
        visibility
    }

    pub(super) fn check_ids(
        &self,
        view: &ReferenceView,
        ids: &[u32],
    ) -> Result<(), ReferenceError> {
        let (expected, found) = (view.pixel_count(), ids.len());
        if expected != found {
            return Err(ReferenceError::WrongSize { expected, found });
        }
        let triangles = self.tree.len();
        match ids.iter().position(|&id| id as usize > triangles) {
            Some(pixel) => Err(ReferenceError::UnknownTriangle {
                pixel,
                id: ids[pixel],
                triangles,
            }),
            None => Ok(()),
        }
    }
}
