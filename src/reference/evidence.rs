//! What is known of the surface point behind one pixel: asked of wrong pixels, to tell why.

use glam::{DVec2, DVec3, Vec3};

use super::contact::{Contact, EdgeContact, contact};
use super::segment::{ExactLight, Plane, Segment};
use super::surface::point_seen;
use super::tree::{Primitive, Visit};
use super::view::Projection;
use super::{Reference, ReferenceError, ReferenceView};
use crate::scene::Light;

/// What the reference knows of one pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Evidence {
    /// The point seen through the pixel's centre, in world units.
    pub point: DVec3,
    /// Index of the triangle it lies on.
    pub triangle: u32,
    /// Casting triangles between the point and the light. Every casting triangle has a shadow
    /// volume of its own in the volume methods, so it is also the count that they should reach.
    pub blockers: u32,
    /// Distance from the point to the nearest of them, in world units.
    pub nearest_blocker: Option<f64>,
    /// Width of a pixel at the point, across the line of sight, in world units.
    pub px_size: f64,
}

/// Answers what is known of single pixels of one picture.
pub struct EvidenceProbe<'a> {
    reference: &'a Reference,
    light: ExactLight,
    projection: Projection,
    width: usize,
    triangle_ids: &'a [u32],
}

impl Reference {
    /// A probe into the picture that [`Reference::trace`] takes with the same arguments.
    ///
    /// # Errors
    /// As [`Reference::trace`].
    pub fn evidence<'a>(
        &'a self,
        light: Light,
        view: &ReferenceView,
        triangle_ids: &'a [u32],
    ) -> Result<EvidenceProbe<'a>, ReferenceError> {
        self.check_ids(view, triangle_ids)?;
        Ok(EvidenceProbe {
            reference: self,
            light: ExactLight::new(light)?,
            projection: Projection::new(view)?,
            width: view.width as usize,
            triangle_ids,
        })
    }
}

impl EvidenceProbe<'_> {
    /// The id at a pixel, counted by rows from the top: 0 for background and outside the picture,
    /// otherwise the triangle's index plus one.
    #[must_use]
    pub fn triangle_id(&self, pixel: usize) -> u32 {
        self.triangle_ids.get(pixel).copied().unwrap_or(0)
    }

    /// The point seen through a pixel's centre, in world units; `None` at the background.
    #[must_use]
    pub fn point(&self, pixel: usize) -> Option<DVec3> {
        self.seen(pixel).map(|(_, point)| point)
    }

    /// All that is known of a pixel; `None` at the background.
    #[must_use]
    pub fn at(&self, pixel: usize) -> Option<Evidence> {
        let (own, point) = self.seen(pixel)?;
        let (blockers, nearest_blocker) = self.blockers(own, point);
        Some(Evidence {
            point,
            triangle: own.triangle,
            blockers,
            nearest_blocker,
            px_size: self.px_size(point),
        })
    }

    /// Whether an edge of the triangle seen passes the pixel's centre within so many steps of the rasteriser's
    /// grid, and the surface goes on across it.
    #[must_use]
    pub fn at_inner_edge(&self, pixel: usize, steps: f64) -> bool {
        let Some(triangle) = self.triangle_id(pixel).checked_sub(1) else {
            return false;
        };
        let own = self.reference.tree.primitive(triangle);
        let (projection, centre_px) = (&self.projection, self.centre_px(pixel));
        projection.at_an_edge(centre_px, &own.corners, steps)
            && self
                .reference
                .goes_on(projection, centre_px, own, self.light, steps)
    }

    /// The sine of the angle between the surface seen and the way to the light; `None` at the background and
    /// where the triangle has no area.
    #[must_use]
    pub fn light_sine(&self, pixel: usize) -> Option<f64> {
        let (own, point) = self.seen(pixel)?;
        let [a, b, c] = own.corners.map(Vec3::as_dvec3);
        let normal = (b - a).cross(c - a).try_normalize()?;
        Some(normal.dot(self.towards_light(point)).abs())
    }

    /// The unit vector from a point towards the light; not a number at the light itself.
    #[must_use]
    pub fn towards_light(&self, point: DVec3) -> DVec3 {
        Segment::new(point, self.light, self.reference.tree.scale).direction()
    }

    /// The direction, of length 1, of the picture of a line through the light, at a place in the
    /// picture (pixels from the top left corner). It points to or from the light. `None` at the
    /// light's own picture.
    #[must_use]
    pub fn radial_px(&self, place_px: DVec2) -> Option<DVec2> {
        self.projection
            .line_through(self.light.homogeneous(), place_px)
    }

    /// Width of a pixel at a point, across the line of sight, in world units.
    #[must_use]
    pub fn px_size(&self, point: DVec3) -> f64 {
        let centre = self.projection.place_px(point).unwrap_or_default();
        let [one, other] = [-0.5, 0.5].map(|x| self.projection.ray(centre + DVec2::new(x, 0.0)));
        one.direction.distance(other.direction) * point.distance(self.projection.eye)
    }

    fn seen(&self, pixel: usize) -> Option<(&Primitive, DVec3)> {
        let triangle = self.triangle_id(pixel).checked_sub(1)?;
        let tree = &self.reference.tree;
        let own = tree.primitive(triangle);
        let centre_px = self.centre_px(pixel);
        let point = point_seen(&self.projection, centre_px, &own.corners, tree.scale)?;
        Some((own, point))
    }

    fn centre_px(&self, pixel: usize) -> DVec2 {
        let (x, y) = (pixel % self.width, pixel / self.width);
        DVec2::new(x as f64 + 0.5, y as f64 + 0.5)
    }

    /// How many casting triangles block the way to the light, and the distance of the nearest.
    fn blockers(&self, own: &Primitive, start: DVec3) -> (u32, Option<f64>) {
        let tree = &self.reference.tree;
        let segment = Segment::new(start, self.light, tree.scale);
        let (mut count, mut nearest) = (0, None);
        let mut edges: Vec<EdgeContact> = Vec::new();
        tree.visit_along(start, segment.direction(), segment.reach(), |other| {
            if !other.casts || other.triangle == own.triangle {
                return Visit::On;
            }
            let blocks = match contact(&segment, &other.corners) {
                Contact::Block => true,
                // Of two triangles that close an edge, one blocks.
                Contact::Edge(edge) => {
                    let closing = edges.iter().position(|known| known.closes(&edge));
                    match closing {
                        Some(known) => drop(edges.swap_remove(known)),
                        None => edges.push(edge),
                    }
                    closing.is_some()
                }
                Contact::Miss | Contact::Touch | Contact::Unsure => false,
            };
            if blocks {
                count += 1;
                let distance = Plane::new(&other.corners)
                    .map_or(f64::INFINITY, |plane| plane.distance_along(&segment));
                nearest = Some(nearest.map_or(distance, |least: f64| least.min(distance)));
            }
            Visit::On
        });
        (count, nearest)
    }
}

#[cfg(test)]
#[path = "evidence_tests.rs"]
mod tests;
