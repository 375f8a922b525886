//! Silhouette shadow volumes in a geometry shader (Milet et al. 2014, the comparison of tables 1
//! and 2): the same decision as in tessellation shaders, one edge a point primitive.

use super::parameters::Parameters;
use super::silhouette::{COMMON_NEEDS, COUNTER_LIMIT, SideShaders, SilhouetteVolumes};
use super::{MethodError, MethodInfo, PrepareContext, PreparedMethod, ShadowMethod};
use crate::gpu::native::PrimitiveTopology;
use crate::gpu::shader;
use serde::{Deserialize, Serialize};

/// Every device lets a geometry shader emit 256 vertices: 64 quads.
const MOST_QUADS: u32 = 64;

/// What the method is.
pub(super) static INFO: MethodInfo = MethodInfo {
    id: "silhouette_gs",
    title: "silhouette shadow volumes, side quads by a geometry shader",
    source: "Milet, Kobrtek, Zemčík, Pečiva 2014, section 3",
    needs: &COMMON_NEEDS,
    limits: &[COUNTER_LIMIT],
    parameters: &[(
        "max_multiplicity",
        "32",
        "most opposite vertices of one point, 1 to 64; edges with more are split",
    )],
};

/// The method's parameters.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct SilhouetteGs {
    max_multiplicity: u32,
}

impl Default for SilhouetteGs {
    fn default() -> Self {
        Self {
            max_multiplicity: 32,
        }
    }
}

impl Parameters for SilhouetteGs {
    fn validate(&self) -> Result<(), String> {
        super::parameters::in_range("max_multiplicity", self.max_multiplicity, 1..=MOST_QUADS)
    }
}

impl ShadowMethod for SilhouetteGs {
    fn info(&self) -> &'static MethodInfo {
        &INFO
    }

    fn variant(&self) -> String {
        self.difference()
    }

    fn prepare(
        &self,
        context: &PrepareContext<'_>,
    ) -> Result<Box<dyn PreparedMethod>, MethodError> {
        let volumes = SilhouetteVolumes::new(context, self.max_multiplicity, |largest| {
            // Room for exactly what this scene can need: a larger output slows the stage down.
            let room = [("MAX_MULTIPLICITY", largest)];
            SideShaders {
                stages: vec![shader::glsl("methods/silhouette_gs/sides.geom", &room)],
                topology: PrimitiveTopology::Points,
            }
        })?;
        Ok(Box::new(volumes))
    }
}
