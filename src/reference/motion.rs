//! Where the surface points seen in one picture appear in another.

use glam::DVec2;
use rayon::prelude::*;

use super::surface::point_seen;
use super::view::Projection;
use super::{Reference, ReferenceError, ReferenceView};

/// Stands for a point that the other picture does not show.
const NOT_SEEN: u32 = u32::MAX;

/// For each pixel of one picture, the pixel of another that shows the same surface point.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Motion {
    targets: Vec<u32>,
}

impl Motion {
    /// Pairs of a pixel and the one that shows its point in the other picture, both counted by
    /// rows from the top. Points that the other picture does not show are left out.
    pub fn pairs(&self) -> impl Iterator<Item = (usize, usize)> {
        let seen = |&(_, &target): &(usize, &u32)| target != NOT_SEEN;
        let targets = self.targets.iter().enumerate().filter(seen);
        targets.map(|(pixel, &target)| (pixel, target as usize))
    }
}

impl Reference {
    /// Follows the surface points at the pixel centres of one picture to another one of the same
    /// scene. A point is seen there if the pixel that it falls into shows the same triangle.
    /// Ids are as [`Reference::trace`] takes them.
    ///
    /// # Errors
    /// Any [`ReferenceError`] but `BadTriangle` and `BadLight`.
    pub fn follow(
        &self,
        (from_view, from_ids): (&ReferenceView, &[u32]),
        (to_view, to_ids): (&ReferenceView, &[u32]),
    ) -> Result<Motion, ReferenceError> {
        self.check_ids(from_view, from_ids)?;
        self.check_ids(to_view, to_ids)?;
        let (from, to) = (Projection::new(from_view)?, Projection::new(to_view)?);
        let width = from_view.width as usize;
        let target = |pixel: usize| {
            let id = from_ids[pixel];
            let own = self.tree.primitive(id.checked_sub(1)?);
            let centre_px = DVec2::new((pixel % width) as f64 + 0.5, (pixel / width) as f64 + 0.5);
            let point = point_seen(&from, centre_px, &own.corners, self.tree.scale)?;
            let place = to.place_px(point)?.floor();
            let size = DVec2::new(f64::from(to_view.width), f64::from(to_view.height));
            let inside = place.cmpge(DVec2::ZERO).all() && place.cmplt(size).all();
            let target = inside.then(|| place.y as u32 * to_view.width + place.x as u32)?;
            (to_ids[target as usize] == id).then_some(target)
        };
        let pixels = (0..from_ids.len()).into_par_iter().with_min_len(1024);
        let targets = pixels
            .map(|pixel| target(pixel).unwrap_or(NOT_SEEN))
            .collect();
        Ok(Motion { targets })
    }
}

#[cfg(test)]
mod tests {
    use super::super::fixtures::{Scene, sphere, square, view};
    use super::*;
    use glam::{DVec3, Vec3};

    #[test]
    fn a_still_eye_sees_every_point_where_it_was() {
        let scene = Scene::default()
            .cast(&sphere(Vec3::Y, 0.8, 20))
            .receive(&square(2.0, 0.0));
        let view = view(Vec3::new(2.0, 2.0, 3.0), Vec3::Y * 0.5, 64, 48);
        let reference = scene.reference();
        let ids = reference.visible_ids(&view).unwrap();
        let motion = reference.follow((&view, &ids), (&view, &ids)).unwrap();
        assert!(motion.pairs().all(|(pixel, target)| pixel == target));
        let surface = ids.iter().filter(|&&id| id != 0).count();
        assert_eq!(motion.pairs().count(), surface);
    }

    #[test]
    fn points_move_with_the_eye_and_hidden_ones_are_lost() {
        let scene = Scene::default()
            .cast(&square(0.5, 1.0))
            .receive(&square(20.0, 0.0));
        let reference = scene.reference();
        let [one, other] =
            [0.0, 0.4].map(|x| view(Vec3::new(x, 4.0, 0.1), Vec3::new(x, 0.0, 0.0), 100, 80));
        let [ids, other_ids] = [one, other].map(|view| reference.visible_ids(&view).unwrap());
        let motion = reference
            .follow((&one, &ids), (&other, &other_ids))
            .unwrap();
        let centre = |pixel: usize| DVec2::new((pixel % 100) as f64, (pixel / 100) as f64) + 0.5;
        let (from, to) = (
            Projection::new(&one).unwrap(),
            Projection::new(&other).unwrap(),
        );
        let on_floor = |projection: &Projection, pixel| -> DVec3 {
            let ray = projection.ray(centre(pixel));
            ray.eye - ray.eye.y / ray.direction.y * ray.direction
        };
        let mut hidden = 0;
        let pairs: Vec<_> = motion.pairs().collect();
        for &(pixel, target) in pairs.iter().filter(|(pixel, _)| ids[*pixel] > 2) {
            assert_eq!(ids[pixel], other_ids[target]);
            let moved = on_floor(&from, pixel).distance(on_floor(&to, target));
            assert!(moved < 0.06, "{moved} is more than a pixel");
        }
        for (pixel, id) in ids.iter().enumerate().filter(|(_, id)| **id > 2) {
            let place = to.place_px(on_floor(&from, pixel)).unwrap();
            let inside = place.cmpge(DVec2::ZERO).all() && place.x < 100.0 && place.y < 80.0;
            let covered = inside && other_ids[place.y as usize * 100 + place.x as usize] <= 2;
            hidden += u32::from(covered);
            let followed = pairs.iter().any(|(from, _)| *from == pixel);
            assert!(!followed || (inside && !covered), "pixel {pixel} of {id}");
        }
        assert!(hidden > 20, "{hidden}");
    }
}
