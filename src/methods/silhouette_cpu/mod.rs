//! Silhouette shadow volumes with silhouettes found on the processor (Wallner 2006), drawn by plain vertex shaders: it runs
//! wherever there is a stencil buffer.

mod edges;
mod extraction;
mod faces;

use super::capping::{CappedPlan, CappedPlanner, Capping, Caps, fan_apexes};
use super::corner::Weights;
use super::counter::ROUND;
use super::portable_volumes::{Corners, EXTRACT_STAGE, FaceDraws, PortableVolumes};
use super::volume_parameters::{CASTING_WORDS, PortableVolumeParameters};
use super::volumes::STENCIL;
use super::{MethodError, MethodInfo, PrepareContext, ShadowMethod, clash, volume_limits};
use crate::frame::{DepthSetup, DrawnVolumes, Frame, PreparedMethod};
use crate::geometry::silhouette::{Facings, HEXTREE_DEPTH, SilhouetteEdge};
use crate::geometry::{Casting, OpenEdges, Topology};
use crate::gpu::{Gpu, Stage};
use crate::parameters;
use crate::scene::Mesh;
use edges::CasterEdges;
use extraction::{Extraction, Extractor};
use faces::Faces;
use glam::Vec4;
use std::rc::Rc;
use std::sync::Arc;

/// What the method is.
pub(super) static INFO: MethodInfo = MethodInfo {
    id: "silhouette_cpu",
    title: "silhouette shadow volumes, silhouettes found on the processor",
    source: "Wallner 2006, sections 4 and 5",
    needs: &[STENCIL],
    limits: &[volume_limits::LIMITS],
    clashes: clash::OF_VOLUMES,
    tolerated_share: 0.0,
};

parameters! {
    /// The method's parameters.
    pub(super) struct SilhouetteCpu {
        extraction: Extraction = Extraction::PlaneTree,
            "how silhouettes are found: plane_tree, hextree (Wallner 2006), brute_force (every edge)";
        hextree_depth: u32 = HEXTREE_DEPTH, in 0..=16,
            "how often the hextree divides its cubes at most";
        keep: bool = false,
            "whether a silhouette is kept while the light stands still";
        casting: Casting = Casting::LightFacing,
            CASTING_WORDS;
        caps: Caps = Caps::Fan,
            "what caps are made of in z_fail: fan (over the silhouette, of closed objects), triangles, far_triangles";
        ..volume: PortableVolumeParameters;
    }
}

impl ShadowMethod for SilhouetteCpu {
    fn info(&self) -> &'static MethodInfo {
        &INFO
    }

    fn depth_setup(&self) -> DepthSetup {
        self.volume.depth_setup()
    }

    fn prepare(
        &self,
        context: &PrepareContext<'_>,
    ) -> Result<Box<dyn PreparedMethod>, MethodError> {
        let volume = self.volume.planned(&context.scene.flight.light)?;
        let casting = volume.planned_casting(self.casting, Self::default().casting)?;
        let context = &volume.casters(context)?;
        let casters = &context.casters;
        let mesh = Arc::clone(&casters.mesh);
        let topology = Rc::clone(casters.topology());
        let triangles = Rc::clone(casters.edge_triangles());
        let capping = Capping {
            front_cap: volume.front_cap,
            caps: self.caps,
            closed: triangles.closed_casters(&mesh, &topology),
        };
        let weights = Weights::new(&mesh, volume.counter.into())?;
        let edges = CasterEdges::new(&mesh, &topology, triangles);
        let apexes = match self.caps {
            Caps::Fan => fan_apexes(&mesh, &topology),
            Caps::Triangles | Caps::FarTriangles => Vec::new(),
        };
        Ok(Box::new(CpuVolumes {
            extractor: Extractor::new(self.extraction, self.hextree_depth, &mesh, &topology),
            silhouette: Vec::new(),
            keep: self.keep,
            volumes: PortableVolumes::of_corners(context, &volume, weights)?,
            facings: Facings::new(&mesh),
            of_triangles: vec![0; mesh.triangles.len()],
            elements: elements(context.gpu, 0)?,
            faces: Faces::new(weights),
            kept: None,
            drawn: DrawnVolumes::default(),
            mesh,
            topology,
            edges,
            planner: CappedPlanner::new(context, *volume, casting, capping),
            open_edges: Rc::clone(casters.open_edges()),
            apexes,
        }))
    }
}

fn elements(gpu: &Gpu, bytes: u64) -> Result<wgpu::Buffer, crate::gpu::DeviceError> {
    let usage = wgpu::BufferUsages::INDEX | wgpu::BufferUsages::COPY_DST;
    gpu.empty_buffer("the faces of shadow volumes", bytes.max(1 << 20), usage)
}

/// The method ready for a scene.
struct CpuVolumes {
    mesh: Arc<Mesh>,
    topology: Rc<Topology>,
    edges: CasterEdges,
    open_edges: Rc<OpenEdges>,
    extractor: Extractor,
    /// That of the last light.
    silhouette: Vec<SilhouetteEdge>,
    keep: bool,
    planner: CappedPlanner,
    /// See [`fan_apexes`].
    apexes: Vec<u32>,
    facings: Facings,
    /// The facings of the frame under way, where caps need them.
    of_triangles: Vec<i8>,
    volumes: PortableVolumes,
    faces: Faces,
    elements: wgpu::Buffer,
    kept: Option<Kept>,
    /// Of the last frame.
    drawn: DrawnVolumes,
}

/// What the last frame was drawn from.
struct Kept {
    light: Vec4,
    plans: Vec<CappedPlan>,
    corners: Corners,
}

impl PreparedMethod for CpuVolumes {
    fn begin(&mut self) {
        self.planner.begin();
        self.kept = None;
    }

    fn record(&mut self, frame: &mut Frame<'_>) -> anyhow::Result<()> {
        let (light, resources, gpu) = (frame.view().light.place, frame.resources(), frame.gpu());
        let (plan, plans) = self.planner.choose(frame)?;
        let kept = self
            .kept
            .take()
            .filter(|kept| self.keep && kept.light == light);
        if kept.is_none() {
            frame.stage(EXTRACT_STAGE, |stage| {
                stage.on_processor(|| {
                    let silhouette = &mut self.silhouette;
                    self.extractor
                        .silhouette(&self.mesh, &self.topology, light, silhouette);
                });
            });
        }
        let same = kept.filter(|kept| kept.plans == plans);
        let corners = match same {
            Some(kept) => kept.corners,
            None => frame.stage("upload", |stage| {
                stage.on_processor(|| self.make_faces(&plans, light));
                self.upload(stage, gpu)
            })?,
        };
        let targets = frame.targets();
        frame.stage(ROUND.volumes, |stage| {
            self.volumes.counts.begin(stage, targets, &ROUND);
            self.volumes
                .record(stage, resources, Some(&self.elements), &corners);
        });
        let near_counts = (plan.near_count, plan.near_count_of_rest);
        self.volumes
            .counts
            .resolve(frame, &ROUND, near_counts, |stage| {
                self.volumes
                    .record_open_edges(stage, resources, Some(&self.elements), &corners);
            })?;
        self.kept = Some(Kept {
            light,
            plans,
            corners,
        });
        self.drawn = plan.drawn();
        Ok(())
    }

    fn drawn_volumes(&self) -> Option<DrawnVolumes> {
        Some(self.drawn)
    }
}

impl CpuVolumes {
    /// Lists the faces of all volumes.
    fn make_faces(&mut self, plans: &[CappedPlan], light: Vec4) {
        let Self {
            mesh,
            topology,
            silhouette,
            edges,
            faces,
            apexes,
            ..
        } = self;
        faces.clear();
        // Neighbours in a tree are far apart in space, and are drawn more slowly than neighbours in the mesh.
        silhouette.sort_unstable_by_key(|found| found.edge);
        let all_alike = plans.iter().all(|plan| *plan == plans[0]);
        for found in &*silhouette {
            let plan = plans[if all_alike {
                0
            } else {
                edges.caster(found.edge)
            }];
            if !plan.caster.is_drawn {
                continue;
            }
            let multiplicity = match plan.caster.casting {
                Casting::All => found.multiplicity,
                Casting::EachSide if edges.is_irregular(found.edge) => continue,
                // Of two triangles in opposite directions, one faces the light where both have a facing.
                _ if found.multiplicity % 2 == 0 => found.multiplicity / 2,
                _ => edges.light_facing_multiplicity(mesh, topology, light, found.edge),
            };
            if multiplicity == 0 {
                continue;
            }
            let edge = edges.directed(found.edge, multiplicity);
            faces.side(&edge, plan);
            if plan.fan_in_front {
                faces.fan_front(&edge, apexes[edge.a as usize]);
            }
            if plan.fan_behind {
                faces.fan_back(&edge, apexes[edge.a as usize], plan);
            }
        }
        for (caster, &plan) in plans.iter().enumerate() {
            if plan.caster.is_drawn && plan.caster.casting == Casting::EachSide {
                self.make_other_sides(caster, plan, light);
            }
        }
        self.make_caps(plans, light);
    }

    /// What a caster that casts [`Casting::EachSide`] has beside the sides of its regular edges.
    fn make_other_sides(&mut self, caster: usize, plan: CappedPlan, light: Vec4) {
        let (mesh, topology) = (&self.mesh, &self.topology);
        for &edge in self.edges.irregular(caster) {
            let multiplicity = self
                .edges
                .light_facing_multiplicity(mesh, topology, light, edge);
            self.faces
                .side(&self.edges.directed(edge, multiplicity), plan);
        }
        for open in self.open_edges.of(caster) {
            let edge = self.edges.directed(open.edge, open.multiplicity);
            self.faces.open_side(&edge, plan);
        }
    }

    fn make_caps(&mut self, plans: &[CappedPlan], light: Vec4) {
        if plans.iter().any(|plan| plan.has_triangles()) {
            self.facings.find(&self.mesh, light, &mut self.of_triangles);
            let casters = self.mesh.casters().zip(plans);
            for (caster, plan) in casters.filter(|(_, plan)| plan.has_triangles()) {
                let triangles = caster.triangle_range();
                let of_caster = self.mesh.triangles[triangles.clone()].iter();
                for (triangle, facing) in of_caster.zip(&self.of_triangles[triangles]) {
                    self.faces
                        .caps(&self.planner.capping, *plan, *triangle, *facing);
                }
            }
        }
    }

    /// Brings them to the device.
    fn upload(&mut self, stage: &mut Stage<'_, '_>, gpu: &Gpu) -> anyhow::Result<Corners> {
        let Faces {
            depth_passes,
            depth_fails,
            everywhere,
            of_open_edges,
            ..
        } = &self.faces;
        let lists = [depth_passes, depth_fails, everywhere, of_open_edges];
        let bytes = |corners: usize| (corners * size_of::<u32>()) as u64;
        let needed = bytes(lists.iter().map(|list| list.len()).sum());
        if needed > self.elements.size() {
            self.elements = elements(gpu, needed + needed / 2)?;
        }
        let mut first = 0;
        let mut ranges = [const { 0..0 }; 4];
        for (list, range) in lists.into_iter().zip(&mut ranges) {
            stage.upload(&self.elements, bytes(first), bytemuck::cast_slice(list))?;
            *range = first as u32..(first + list.len()) as u32;
            first += list.len();
        }
        let [depth_passes, depth_fails, everywhere, of_open_edges] = ranges.map(FaceDraws::Corners);
        Ok(Corners {
            depth_passes,
            depth_fails,
            everywhere,
            of_open_edges,
        })
    }
}
