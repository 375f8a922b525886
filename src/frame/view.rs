//! What the processor knows of the frame under way: where volumes may end, and which casters could
//! shadow the eye.

use crate::geometry::{Bounds, EndPlane, EndPlanes, NearVolume};
use crate::scene::{Light, Mesh, View};
use glam::{DVec3, DVec4, Mat4, Vec3};

/// The near rectangle is taken to be larger by this part, more than all rounding.
const NEAR_MARGIN: f64 = 1e-3;

/// What the sides of the view frustum are uncertain by, as a part of the largest coordinate.
const FRUSTUM_MARGIN: f64 = 1e-5;

/// How far a scene reaches.
#[derive(Debug, Clone)]
pub struct SceneExtents {
    /// The box around everything.
    pub scene: Bounds,
    /// The box around each object, in drawing order.
    pub objects: Vec<Bounds>,
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
            objects,
        }
    }
}

/// A plane of the view frustum that has a box on its other side.
struct Side {
    /// Positive inside of the frustum.
    plane: DVec4,
    /// The largest value of the plane in the box, margin included.
    farthest_in: f64,
}

/// View and light of the frame under way.
#[derive(Debug, Clone, Copy)]
pub struct FrameView {
    /// World to clip space with reversed infinite depth. What the device uses has these very bits in
    /// the rows for x, y and w.
    pub view_projection: Mat4,
    /// Where it is seen from.
    pub eye: Vec3,
    /// Maps normalised x and y, with z = 0 and w = 1, to the vector from the eye whose length along the viewing
    /// direction is 1.
    pub clip_to_eye_ray: Mat4,
    /// The light.
    pub light: Light,
    /// The planes on which shadow volumes may end.
    pub end_planes: EndPlanes,
    /// That of them on which all may end.
    pub end_plane: EndPlane,
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
            let ndc = DVec4::new(x * side, y * side, 0.0, 1.0);
            let ray = (clip_to_eye_ray.as_dmat4() * ndc).truncate();
            view.eye.as_dvec3() + ray * f64::from(view.near)
        });
        let end_planes = EndPlanes::new(extents.scene, light.place, &near_corners);
        Self {
            view_projection,
            eye: view.eye,
            clip_to_eye_ray,
            light,
            end_planes,
            end_plane: end_planes.of(extents.all_casters),
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

    /// Whether the light is at infinity, or outside of a box. Errs to false.
    pub fn is_outside_of_lamp(&self, bounds: Bounds) -> bool {
        let at = self.light.place.truncate().as_dvec3();
        let lamp = Bounds { low: at, high: at };
        self.light.place.w == 0.0 || !bounds.may_meet(lamp)
    }

    /// Whether something in a box may be in view. Errs to true.
    pub fn may_see(&self, bounds: Bounds) -> bool {
        self.is_in_frustum(bounds, |_| true)
    }

    /// Whether what is in a box may shadow something in view. Errs to true.
    pub fn may_see_shadow_of(&self, bounds: Bounds) -> bool {
        let light = self.light.place.as_dvec4();
        self.is_in_frustum(bounds, |side| {
            // Away from the light there is no way back in if the light is farther in than the box; a light at infinity
            // shines along the plane or out.
            let of_light = side.plane.dot(light);
            if light.w == 0.0 {
                of_light >= 0.0
            } else {
                let margin =
                    FRUSTUM_MARGIN * side.plane.truncate().length() * light.abs().max_element();
                of_light >= side.farthest_in + margin
            }
        })
    }

    /// False if all of a box is behind a plane of the view frustum, and `stays_out` says that so is what goes with it.
    fn is_in_frustum(&self, bounds: Bounds, stays_out: impl Fn(Side) -> bool) -> bool {
        let [x, y, near, w] = [0, 1, 2, 3].map(|row| self.view_projection.row(row).as_dvec4());
        // Inside is positive.
        let planes = [w + x, w - x, w + y, w - y, w - near];
        let size = bounds.low.abs().max(bounds.high.abs()).max_element();
        !planes.into_iter().any(|plane| {
            let axis = plane.truncate();
            let margin = FRUSTUM_MARGIN * (axis.length() * size + plane.w.abs());
            let farthest_in = bounds.range_along(axis).1 + plane.w + margin;
            farthest_in < 0.0 && stays_out(Side { plane, farthest_in })
        })
    }

    /// The near volume of this view and light.
    pub fn near_volume(&self) -> NearVolume {
        NearVolume::new(self.near_corners, self.light.place)
    }
}
