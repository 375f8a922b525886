//! How the volume of each object is drawn in a frame: no more of it than its topology, the view and the light ask for.

use super::volume_parameters::{Counting, Culling, Reach, VolumeParameters};
use super::{Casters, PrepareContext};
use crate::frame::{DrawnVolumes, FrameView};
use crate::geometry::{
    Bounds, Casting, Determinism, EdgeTriangles, EndPlane, NearCount, NearCounts, NearRay,
    NearVolume, OpenEdges, Topology,
};
use std::rc::Rc;

/// How the volume of one caster is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct CasterPlan {
    /// Whether it is drawn at all.
    pub(super) is_drawn: bool,
    /// Counted z-pass, without caps; else z-fail.
    pub(super) z_pass: bool,
    pub(super) casting: Casting,
    /// Where it ends.
    pub(super) end: EndPlane,
}

/// How all volumes are drawn in a frame.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(super) struct FramePlan {
    /// For each object that casts, in drawing order.
    pub(super) casters: Vec<CasterPlan>,
    /// In how many of the volumes that are counted z-pass the near rectangle lies: counts begin there.
    pub(super) near_count: i32,
    /// The same for the counts that go on with the open edges of objects that cast [`Casting::EachSide`]; `None` if none
    /// does.
    pub(super) near_count_of_rest: Option<i32>,
    /// The casters in whose volumes the near rectangle lies.
    around_near: u32,
    /// Boxes that the device was asked about, and casters that are not drawn as it answered.
    pub(super) queries: u32,
    pub(super) hidden: u32,
}

impl FramePlan {
    /// What comes of it.
    pub(super) fn drawn(&self) -> DrawnVolumes {
        let mut drawn = DrawnVolumes {
            z_pass_counted: self.around_near,
            queries: self.queries,
            hidden: self.hidden,
            ..DrawnVolumes::default()
        };
        for plan in &self.casters {
            if !plan.is_drawn {
                drawn.culled += 1;
                continue;
            }
            *if plan.z_pass {
                &mut drawn.z_pass
            } else {
                &mut drawn.z_fail
            } += 1;
            *match plan.casting {
                Casting::LightFacing => &mut drawn.light_facing,
                Casting::EachSide => &mut drawn.each_side,
                Casting::All => &mut drawn.all,
            } += 1;
            drawn.at_infinity += u32::from(plan.end == EndPlane::INFINITY);
        }
        drawn.culled -= self.hidden;
        drawn
    }
}

/// An object with a larger share of open edges draws less with all its triangles in one count: its open edges would be
/// drawn twice, and there are few folds between them. Of Sponza's objects this is within a twentieth of the best choice.
const MOST_OPEN: f64 = 0.3;

/// Where objects with fewer of a scene's edges would cast [`Casting::EachSide`], all their triangles cast instead: the second
/// count has a price for the whole picture.
const FEWEST_EACH_SIDE: f64 = 0.05;

/// Makes plans.
pub(super) struct Planner {
    casters: Rc<Casters>,
    parameters: VolumeParameters,
    determinism: Determinism,
    /// For each object that casts whether any of its triangles is left to do so.
    casts: Vec<bool>,
    /// Where not all triangles may cast.
    sides: Option<Sides>,
    /// Where volumes around the near rectangle are counted.
    near: Option<Near>,
}

/// What counts the volumes around the near rectangle.
struct Near {
    counts: NearCounts,
    topology: Rc<Topology>,
}

/// What is known of the two sides of surfaces.
struct Sides {
    triangles: Rc<EdgeTriangles>,
    /// For each caster whether it is closed and wound consistently.
    closed: Rc<[bool]>,
    open_edges: Rc<OpenEdges>,
    /// Whether objects that are not closed may cast [`Casting::EachSide`].
    each_side: bool,
}

/// Which part of all edges is of objects that are not closed, and closed enough for [`Casting::EachSide`].
fn share_of_each_side(closed: &[bool], open_edges: &OpenEdges) -> f64 {
    let (mut of_each_side, mut of_all) = (0, 0);
    for (caster, is_closed) in closed.iter().enumerate() {
        let edges = open_edges.edge_count(caster);
        of_all += edges;
        if !is_closed && open_edges.share(caster) <= MOST_OPEN {
            of_each_side += edges;
        }
    }
    of_each_side as f64 / of_all.max(1) as f64
}

impl Planner {
    /// A planner for volumes of these parameters, whatever their plan: see [`VolumeParameters::planned`].
    pub(super) fn new(
        context: &PrepareContext<'_>,
        parameters: VolumeParameters,
        casting: Casting,
        determinism: Determinism,
    ) -> Self {
        let casters = &context.casters;
        let mesh = &casters.mesh;
        let sides = || {
            let closed = Rc::clone(casters.are_closed());
            let open_edges = Rc::clone(casters.open_edges());
            Sides {
                each_side: casting == Casting::EachSide
                    && share_of_each_side(&closed, &open_edges) >= FEWEST_EACH_SIDE,
                triangles: Rc::clone(casters.edge_triangles()),
                closed,
                open_edges,
            }
        };
        let near = || Near {
            counts: NearCounts::build(mesh, casters.topology()),
            topology: Rc::clone(casters.topology()),
        };
        Self {
            casters: Rc::clone(casters),
            casts: mesh
                .casters()
                .map(|object| !object.triangles.is_empty())
                .collect(),
            parameters,
            determinism,
            sides: (casting != Casting::All).then(sides),
            near: (parameters.counting == Counting::ZPassCounted).then(near),
        }
    }

    /// Plans all objects as if they were closed and wound consistently.
    pub(super) fn take_all_as_closed(&mut self) {
        if let Some(sides) = &mut self.sides {
            sides.closed = vec![true; sides.closed.len()].into();
        }
    }

    /// The plan of a frame, given the boxes around the casters.
    ///
    /// # Panics
    /// If triangles were left out for another light.
    pub(super) fn plan(&self, view: &FrameView, casters: &[Bounds]) -> FramePlan {
        assert!(
            self.casters.are_for(view.light.place),
            "triangles were left out for a light that stands still"
        );
        let near = (view.near_volume(), view.near_rectangle());
        let mut all = FramePlan::default();
        let mut of_rest = None;
        let culls = self.parameters.culling != Culling::None;
        for (number, &bounds) in casters.iter().enumerate() {
            let is_drawn = self.casts[number] && (!culls || view.may_see_shadow_of(bounds));
            // A volume out of view is not around the near rectangle either.
            let (casting, count) = if is_drawn {
                self.casting(number, bounds, &near, view)
            } else {
                (Casting::All, None)
            };
            let NearCount {
                of_casting,
                of_windings,
            } = count.unwrap_or_default();
            all.near_count += of_casting;
            all.around_near += u32::from(of_casting != 0);
            if casting == Casting::EachSide {
                *of_rest.get_or_insert(0) -= of_windings;
            }
            all.casters.push(CasterPlan {
                is_drawn,
                z_pass: count.is_some(),
                casting,
                end: match self.parameters.reach {
                    Reach::Scene => view.end_plane,
                    Reach::Object => view.end_planes.of(bounds),
                    Reach::Infinity => EndPlane::INFINITY,
                },
            });
        }
        all.near_count_of_rest = of_rest.map(|of_rest| all.near_count + of_rest);
        all
    }

    /// Which triangles of a caster cast, and what z-pass begins with; `None` if it is to be counted z-fail.
    fn casting(
        &self,
        caster: usize,
        bounds: Bounds,
        near: &(NearVolume, Bounds),
        view: &FrameView,
    ) -> (Casting, Option<NearCount>) {
        let count = |casting| {
            (
                casting,
                self.near_count(caster, bounds, &near.0, view, casting),
            )
        };
        let Some(sides) = &self.sides else {
            return count(Casting::All);
        };
        // Seen from outside, and from a light outside, a closed surface has as many triangles that face the light
        // before a point as others: it is in shadow if there is one of the former. A point that is visible without
        // looking through the surface is outside, too, where the near rectangle is.
        let is_outside = || !bounds.may_meet(near.1) && view.is_outside_of_lamp(bounds);
        if sides.closed[caster] && is_outside() {
            return count(Casting::LightFacing);
        }
        if sides.each_side
            && sides.open_edges.share(caster) <= MOST_OPEN
            && let (casting, Some(count)) = count(Casting::EachSide)
        {
            return (casting, Some(count));
        }
        count(Casting::All)
    }

    fn near_count(
        &self,
        caster: usize,
        bounds: Bounds,
        near_volume: &NearVolume,
        view: &FrameView,
        casting: Casting,
    ) -> Option<NearCount> {
        match self.parameters.counting {
            Counting::ZFail => None,
            Counting::ZPass => Some(NearCount::default()),
            Counting::Auto | Counting::ZPassCounted if !near_volume.may_meet(bounds) => {
                Some(NearCount::default())
            }
            Counting::Auto => None,
            Counting::ZPassCounted => {
                let ray = NearRay {
                    volume: near_volume,
                    light: view.light.place,
                    casting,
                    determinism: self.determinism,
                };
                let near = self.near.as_ref()?;
                let triangles = self.sides.as_ref().map(|sides| &*sides.triangles);
                let of = (&*self.casters.mesh, &*near.topology, triangles);
                near.counts.count(of, caster, &ray)
            }
        }
    }
}
