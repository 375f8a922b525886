//! The triangles that cast shadows in a scene, and what methods derive from them.

use crate::geometry::rays::RayTree;
use crate::geometry::{EdgeTriangles, OpenEdges, Topology, occluded};
use crate::scene::{Mesh, Scene};
use glam::Vec4;
use std::cell::OnceCell;
use std::ops::Range;
use std::rc::Rc;
use std::sync::Arc;

/// The triangles that cast, and what is derived from them once a method asks for it.
pub struct Casters {
    /// The scene's objects, each with those of its triangles that cast.
    pub mesh: Arc<Mesh>,
    topology: OnceCell<Rc<Topology>>,
    ray_tree: OnceCell<Rc<RayTree>>,
    edge_triangles: OnceCell<Rc<EdgeTriangles>>,
    open_edges: OnceCell<Rc<OpenEdges>>,
    /// See [`Self::are_closed`].
    are_closed: OnceCell<Rc<[bool]>>,
    /// `None` within if no triangle is left out.
    unoccluded: OnceCell<Option<Rc<Self>>>,
    /// The scene's light, if it stands still.
    still_light: Option<Vec4>,
    /// Whether triangles are left out that another light may reach.
    are_for_still_light: bool,
}

impl Casters {
    /// All of a scene's.
    pub fn of(scene: &Scene) -> Self {
        let light = scene.flight.light.standing_still();
        Self::new(Arc::clone(&scene.mesh), light.map(|light| light.place))
    }

    fn new(mesh: Arc<Mesh>, still_light: Option<Vec4>) -> Self {
        Self {
            mesh,
            topology: OnceCell::new(),
            ray_tree: OnceCell::new(),
            edge_triangles: OnceCell::new(),
            open_edges: OnceCell::new(),
            are_closed: OnceCell::new(),
            unoccluded: OnceCell::new(),
            still_light,
            are_for_still_light: false,
        }
    }

    /// The topology, if a method has asked for it.
    pub fn topology_if_built(&self) -> Option<&Topology> {
        self.topology.get().map(|topology| &**topology)
    }

    /// Those of each object, in drawing order.
    pub(super) fn triangles(&self) -> Vec<Range<u32>> {
        let of_objects = self.mesh.casters().map(|object| object.triangles.clone());
        of_objects.collect()
    }

    /// Edges with their opposite vertices.
    pub fn topology(&self) -> &Rc<Topology> {
        let build = || Rc::new(Topology::build(&self.mesh));
        self.topology.get_or_init(build)
    }

    /// What shadow rays are followed through.
    pub fn ray_tree(&self) -> &Rc<RayTree> {
        let build = || Rc::new(RayTree::new(&self.mesh));
        self.ray_tree.get_or_init(build)
    }

    /// The triangles of these edges.
    pub fn edge_triangles(&self) -> &Rc<EdgeTriangles> {
        let build = || Rc::new(EdgeTriangles::build(&self.mesh, self.topology()));
        self.edge_triangles.get_or_init(build)
    }

    /// The edges where surfaces end.
    pub fn open_edges(&self) -> &Rc<OpenEdges> {
        let find = || OpenEdges::new(&self.mesh, self.topology(), self.edge_triangles());
        self.open_edges.get_or_init(|| Rc::new(find()))
    }

    /// For each object that casts, in drawing order, whether the scene's is closed and wound consistently: then what its
    /// triangles that face the light shadow is all that it does.
    pub fn are_closed(&self) -> &Rc<[bool]> {
        let find = || {
            let triangles = self.edge_triangles();
            Rc::from(triangles.closed_casters(&self.mesh, self.topology()))
        };
        self.are_closed.get_or_init(find)
    }

    /// Those that may be lit in part, see [`occluded`]; `None` if the light does not stand still.
    pub fn unoccluded(self: &Rc<Self>) -> Option<Rc<Self>> {
        let light = self.still_light?;
        let find = || {
            let of = (&*self.mesh, &**self.topology(), &**self.edge_triangles());
            let occluded = occluded::left_out(light, of, self.are_closed());
            if !occluded.contains(&true) {
                return None;
            }
            let casters = Self {
                are_for_still_light: true,
                ..Self::new(Arc::new(without(&self.mesh, &occluded)), Some(light))
            };
            // It is the first surface on the way from the light that must face it, and that is never left out.
            let _ = casters.are_closed.set(Rc::clone(self.are_closed()));
            Some(Rc::new(casters))
        };
        let found = self.unoccluded.get_or_init(find).as_ref();
        Some(Rc::clone(found.unwrap_or(self)))
    }

    /// Whether they cast all shadows of the scene under this light.
    pub(super) fn are_for(&self, light: Vec4) -> bool {
        !self.are_for_still_light || self.still_light == Some(light)
    }
}

/// The same vertices and objects, with fewer triangles.
fn without(mesh: &Mesh, left_out: &[bool]) -> Mesh {
    let mut kept = Mesh {
        positions: mesh.positions.clone(),
        ..Mesh::default()
    };
    for object in &mesh.objects {
        let start = kept.triangles.len() as u32;
        let range = object.triangle_range();
        let all = mesh.triangles[range.clone()].iter().zip(&left_out[range]);
        let own = all.filter(|(_, is_left_out)| !**is_left_out);
        kept.triangles.extend(own.map(|(triangle, _)| *triangle));
        let mut object = object.clone();
        object.triangles = start..kept.triangles.len() as u32;
        kept.objects.push(object);
    }
    kept
}
