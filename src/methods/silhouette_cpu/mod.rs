//! Silhouette shadow volumes with silhouettes found on the processor (Wallner 2006), drawn by plain vertex shaders: it runs
//! wherever there is a stencil buffer.

mod edges;
mod extraction;
mod faces;
mod plan;

use super::portable_volumes::{Corners, PortableVolumes};
use super::volume_parameters::VolumeParameters;
use super::volumes::{CHOOSE_STAGE, STENCIL, VOLUMES_STAGE};
use super::{MethodError, MethodInfo, PrepareContext, ShadowMethod, volume_limits};
use crate::frame::{DepthSetup, Frame, PreparedMethod};
use crate::geometry::Topology;
use crate::geometry::silhouette::{Facings, HEXTREE_DEPTH, SilhouetteEdge};
use crate::gpu::{Gpu, Stage};
use crate::parameters;
use crate::scene::Mesh;
use edges::{CasterEdges, fan_apexes};
use extraction::{Extraction, Extractor};
use faces::Faces;
use glam::Vec4;
use plan::{CasterPlan, Planner};
use serde::{Deserialize, Serialize};
use std::rc::Rc;

/// What the method is.
pub(super) static INFO: MethodInfo = MethodInfo {
    id: "silhouette_cpu",
    title: "silhouette shadow volumes, silhouettes found on the processor",
    source: "Wallner 2006, sections 4 and 5",
    needs: &[STENCIL],
    limits: &[volume_limits::LIMITS],
    tolerated_share: 0.0,
};

/// What caps are made of.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Caps {
    /// Of closed objects, fans over the silhouette wherever these cover the same; else triangles.
    #[default]
    Fan,
    /// The triangles that cast, and the same at their far ends.
    Triangles,
    /// In front the triangles that cast; behind, where only those cast that face the light, all the others at their
    /// far ends.
    FarTriangles,
}

/// Which triangles cast.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Casting {
    /// Those that face the light, of objects that are closed and have eye and light outside; else all.
    #[default]
    LightFacing,
    /// All.
    All,
}

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
            "light_facing: of closed objects with eye and light outside, only triangles that face the light; all";
        caps: Caps = Caps::Fan,
            "what caps are made of in z_fail: fan (over the silhouette, of closed objects), triangles, far_triangles";
        ..volume: VolumeParameters;
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
        let mesh = context.scene.mesh.clone();
        let topology = Rc::clone(context.topology());
        let edges = CasterEdges::new(&mesh, &topology);
        let planner = Planner {
            volume: self.volume,
            casting: self.casting,
            caps: self.caps,
            closed: edges.closed_casters(&mesh, &topology),
        };
        let apexes = match self.caps {
            Caps::Fan => fan_apexes(&mesh, &topology),
            Caps::Triangles | Caps::FarTriangles => Vec::new(),
        };
        Ok(Box::new(CpuVolumes {
            extractor: Extractor::new(self.extraction, self.hextree_depth, &mesh, &topology),
            silhouette: Vec::new(),
            keep: self.keep,
            volumes: PortableVolumes::new(context, &self.volume),
            facings: Facings::new(&mesh),
            of_triangles: vec![0; mesh.triangles.len()],
            elements: elements(context.gpu, 0)?,
            faces: Faces::default(),
            kept: None,
            mesh,
            topology,
            edges,
            planner,
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
    mesh: Mesh,
    topology: Rc<Topology>,
    edges: CasterEdges,
    extractor: Extractor,
    /// That of the last light.
    silhouette: Vec<SilhouetteEdge>,
    keep: bool,
    planner: Planner,
    /// See [`fan_apexes`].
    apexes: Vec<u32>,
    facings: Facings,
    /// The facings of the frame under way, where caps need them.
    of_triangles: Vec<i8>,
    volumes: PortableVolumes,
    faces: Faces,
    elements: wgpu::Buffer,
    kept: Option<Kept>,
}

/// What the last frame was drawn from.
struct Kept {
    light: Vec4,
    plans: Vec<CasterPlan>,
    far_ends_meet: bool,
    corners: Corners,
}

impl PreparedMethod for CpuVolumes {
    fn begin(&mut self) {
        self.kept = None;
    }

    fn record(&mut self, frame: &mut Frame<'_>) -> anyhow::Result<()> {
        let (view, resources, gpu) = (*frame.view(), frame.resources(), frame.gpu());
        let casters = &resources.extents.casters;
        let plans = frame.stage(CHOOSE_STAGE, |stage| {
            stage.on_processor(|| self.planner.plans(&view, casters))
        });
        let light = view.light.place;
        let kept = self
            .kept
            .take()
            .filter(|kept| self.keep && kept.light == light);
        if kept.is_none() {
            frame.stage("extract", |stage| {
                stage.on_processor(|| {
                    let silhouette = &mut self.silhouette;
                    self.extractor
                        .silhouette(&self.mesh, &self.topology, light, silhouette);
                });
            });
        }
        let far_ends_meet = light.w == 0.0 && !self.planner.ends_on_plane(&view);
        let same = kept.filter(|kept| kept.plans == plans && kept.far_ends_meet == far_ends_meet);
        let corners = match same {
            Some(kept) => kept.corners,
            None => frame.stage("upload", |stage| {
                self.faces.far_ends_meet = far_ends_meet;
                stage.on_processor(|| self.make_faces(&plans, light));
                self.upload(stage, gpu)
            })?,
        };
        frame.stage(VOLUMES_STAGE, |stage| {
            self.volumes
                .record(stage, resources, &self.elements, &corners);
        });
        self.volumes.resolve.record(frame);
        self.kept = Some(Kept {
            light,
            plans,
            far_ends_meet,
            corners,
        });
        Ok(())
    }
}

impl CpuVolumes {
    /// Lists the faces of all volumes.
    fn make_faces(&mut self, plans: &[CasterPlan], light: Vec4) {
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
            let multiplicity = match plan.casting {
                Casting::All => found.multiplicity,
                Casting::LightFacing => {
                    edges.light_facing_multiplicity(mesh, topology, light, *found)
                }
            };
            let edge = edges.directed(found.edge, multiplicity);
            faces.side(&edge, plan.z_pass);
            if plan.fan_in_front {
                faces.fan_front(&edge, apexes[edge.a as usize]);
            }
            if plan.fan_behind {
                faces.fan_back(&edge, apexes[edge.a as usize]);
            }
        }
        if plans.iter().any(|plan| plan.has_triangles()) {
            self.facings.find(mesh, light, &mut self.of_triangles);
            let casters = mesh.casters().zip(plans);
            for (caster, plan) in casters.filter(|(_, plan)| plan.has_triangles()) {
                let triangles = caster.triangle_range();
                let of_caster = mesh.triangles[triangles.clone()].iter();
                for (triangle, facing) in of_caster.zip(&self.of_triangles[triangles]) {
                    self.planner.cap(faces, *plan, *triangle, *facing);
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
            ..
        } = &self.faces;
        let lists = [depth_passes, depth_fails, everywhere];
        let bytes = |corners: usize| (corners * size_of::<u32>()) as u64;
        let needed = bytes(lists.iter().map(|list| list.len()).sum());
        if needed > self.elements.size() {
            self.elements = elements(gpu, needed + needed / 2)?;
        }
        let mut first = 0;
        let mut ranges = [const { 0..0 }; 3];
        for (list, range) in lists.into_iter().zip(&mut ranges) {
            stage.upload(&self.elements, bytes(first), bytemuck::cast_slice(list))?;
            *range = first as u32..(first + list.len()) as u32;
            first += list.len();
        }
        let [depth_passes, depth_fails, everywhere] = ranges;
        Ok(Corners {
            depth_passes,
            depth_fails,
            everywhere,
        })
    }
}
