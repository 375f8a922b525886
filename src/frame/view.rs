//! What the processor knows of the frame under way: where volumes may end, and which casters could
//! shadow the eye.

use crate::geometry::end_plane::AT_INFINITY;
use crate::geometry::{Bounds, NearVolume, end_plane};
use crate::scene::{Light, Mesh, View};
use glam::{DVec3, Mat4, Vec4};

/// The near rectangle is taken to be larger by this part, more than all rounding.
const NEAR_MARGIN: f64 = 1e-3;

/// How far a scene reaches.
#[derive(Debug, Clone)]
pub struct SceneExtents {
    /// The box around everything.
    pub scene: Bounds,
    /// The box around each object that casts, in drawing order.
    pub casters: Vec<Bounds>,
    /// The box around all that casts.
    pub all_casters: Bounds,
}

impl SceneExtents {
    /// Of a mesh.
    pub fn new(mesh: &Mesh) -> Self {
        let objects = Bounds::of_objects(mesh);
        let casters: Vec<_> = mesh
            .objects
            .iter()
            .zip(&objects)
            .filter(|(object, _)| object.casts_shadow)
            .map(|(_, bounds)| *bounds)
            .collect();
        let around = |boxes: &[Bounds]| boxes.iter().copied().fold(Bounds::EMPTY, Bounds::union);
        Self {
            scene: around(&objects),
            all_casters: around(&casters),
            casters,
        }
    }
}

/// View and light of the frame under way.
#[derive(Debug, Clone, Copy)]
pub struct FrameView {
    /// World to clip space with reversed infinite depth. What the device uses has these very bits in
    /// the rows for x, y and w.
    pub view_projection: Mat4,
    /// The light.
    pub light: Light,
    /// The plane on which shadow volumes may end, see [`end_plane`](fn@end_plane).
    pub end_plane: Vec4,
    near_corners: [DVec3; 4],
}

impl FrameView {
    pub(super) fn new(
        view: &View,
        view_projection: Mat4,
        clip_to_eye_ray: Mat4,
        light: Light,
        extents: &SceneExtents,
    ) -> Self {
        let side = 1.0 + NEAR_MARGIN;
        let near_corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, y)| {
            let ndc = glam::DVec4::new(x * side, y * side, 0.0, 1.0);
            let ray = (clip_to_eye_ray.as_dmat4() * ndc).truncate();
            view.eye.as_dvec3() + ray * f64::from(view.near)
        });
        let plane = end_plane(extents.scene, extents.all_casters, light.place);
        // Back caps lie on the plane and count everywhere: nothing visible may be behind them.
        let is_before = |corner: &DVec3| plane.as_dvec4().dot(corner.extend(1.0)) > 0.0;
        Self {
            view_projection,
            light,
            end_plane: if near_corners.iter().all(is_before) {
                plane
            } else {
                AT_INFINITY
            },
            near_corners,
        }
    }

    /// A box around the near rectangle.
    pub fn near_rectangle(&self) -> Bounds {
        let [first, rest @ ..] = self.near_corners;
        let corner = |corner| Bounds {
            low: corner,
            high: corner,
        };
        rest.into_iter()
            .map(corner)
            .fold(corner(first), Bounds::union)
    }

    /// Whether all of a box is farther from the eye than the near plane. Errs to false.
    pub fn is_beyond_near_plane(&self, bounds: Bounds) -> bool {
        let [near, distance] = [2, 3].map(|row| self.view_projection.row(row).as_dvec4());
        let axis = distance.truncate();
        let size = bounds.low.abs().max(bounds.high.abs()).max_element();
        let least = bounds.range_along(axis).0 + distance.w;
        least > near.w + NEAR_MARGIN * (near.w + size * f64::from(f32::EPSILON).sqrt())
    }

    /// The near volume of this view and light.
    pub fn near_volume(&self) -> NearVolume {
        NearVolume::new(self.near_corners, self.light.place)
    }
}
