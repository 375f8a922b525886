//! Silhouette shadow volumes with silhouettes found by compute shaders, drawn by plain vertex shaders: it runs wherever
//! there is a stencil buffer.

mod blocks;
mod extraction;
mod kernel;
mod kernels;
mod tables;

use super::capping::{CappedPlanner, Capping, Caps};
use super::corner::Weights;
use super::counter::ROUND;
use super::portable_volumes::{EXTRACT_STAGE, PortableVolumes};
use super::volume_parameters::{CASTING_WORDS, PortableVolumeParameters};
use super::volumes::STENCIL;
use super::{MethodError, MethodInfo, PrepareContext, ShadowMethod, clash, volume_limits};
use crate::frame::{DepthSetup, DrawnVolumes, Frame, PreparedMethod};
use crate::geometry::Casting;
use crate::parameters;
use extraction::Extractor;
use serde::{Deserialize, Serialize};

/// What the method is.
pub(super) static INFO: MethodInfo = MethodInfo {
    id: "silhouette_cs",
    title: "silhouette shadow volumes, silhouettes found by compute shaders",
    source: "left to future work in Milet et al. 2014; clusters after Wallner 2006, section 2.1",
    needs: &[STENCIL],
    limits: &[volume_limits::LIMITS],
    clashes: clash::OF_VOLUMES,
    tolerated_share: 0.0,
};

/// Which edges are asked, and how they know the facings of their triangles.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Extraction {
    /// Those of clusters whose planes may lie on both sides of the light; they find the facings themselves.
    #[default]
    Clusters,
    /// All, after the facing of every triangle was decided once.
    Facings,
}

/// How many indirect calls there are for each way of counting.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
enum DrawCalls {
    /// One.
    #[default]
    Scene,
    /// One an object.
    Object,
}

parameters! {
    /// The method's parameters.
    pub(super) struct SilhouetteCs {
        extraction: Extraction = Extraction::Clusters,
            "which edges are asked: clusters (of those with triangles on both sides of the light), \
             facings (all, by the facings of all triangles)";
        draw_calls: DrawCalls = DrawCalls::Scene,
            "indirect draw calls for each way of counting: scene (one), object (one an object)";
        faces_mib: u32 = 1024, in 1..=4096,
            "memory for the faces of volumes in MiB; more faces are made and drawn in rounds";
        casting: Casting = Casting::LightFacing,
            CASTING_WORDS;
        caps: Caps = Caps::Fan,
            "what caps are made of in z_fail: fan (over the silhouette, of closed objects), triangles, far_triangles";
        ..volume: PortableVolumeParameters;
    }
}

impl ShadowMethod for SilhouetteCs {
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
        let triangles = casters.edge_triangles();
        let capping = Capping {
            front_cap: volume.front_cap,
            caps: self.caps,
            closed: triangles.closed_casters(&casters.mesh, casters.topology()),
        };
        let weights = Weights::new(&casters.mesh, volume.counter.into())?;
        Ok(Box::new(CsVolumes {
            extractor: Extractor::new(context, self, (&capping, weights))?,
            volumes: PortableVolumes::of_corners(context, &volume, weights)?,
            planner: CappedPlanner::new(context, *volume, casting, capping),
            drawn: DrawnVolumes::default(),
        }))
    }
}

/// The method ready for a scene.
struct CsVolumes {
    extractor: Extractor,
    volumes: PortableVolumes,
    planner: CappedPlanner,
    /// Of the last frame.
    drawn: DrawnVolumes,
}

impl PreparedMethod for CsVolumes {
    fn begin(&mut self) {
        self.planner.begin();
    }

    fn record(&mut self, frame: &mut Frame<'_>) -> anyhow::Result<()> {
        let (light, resources) = (frame.view().light.place, frame.resources());
        let (plan, plans) = self.planner.choose(frame)?;
        frame.stage(EXTRACT_STAGE, |stage| {
            self.extractor.extract(stage, &plans, light)
        })?;
        let Self {
            extractor, volumes, ..
        } = self;
        let elements = Some(extractor.elements());
        let targets = frame.targets();
        frame.stage(ROUND.volumes, |stage| {
            volumes.counts.begin(stage, targets, &ROUND);
            for round in 0..extractor.rounds() {
                extractor.emit(stage, &plans, round);
                let corners = extractor.corners(&plans, round);
                volumes.record(stage, resources, elements, &corners);
            }
        });
        let near_counts = (plan.near_count, plan.near_count_of_rest);
        volumes
            .counts
            .resolve(frame, &ROUND, near_counts, |stage| {
                for round in 0..extractor.rounds() {
                    // What was made in a single round is still there.
                    if extractor.rounds() > 1 {
                        extractor.emit(stage, &plans, round);
                    }
                    let corners = extractor.corners(&plans, round);
                    volumes.record_open_edges(stage, resources, elements, &corners);
                }
            })?;
        self.drawn = plan.drawn();
        Ok(())
    }

    fn drawn_volumes(&self) -> Option<DrawnVolumes> {
        Some(self.drawn)
    }
}
