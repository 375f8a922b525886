//! Silhouette shadow volumes in tessellation shaders (Milet et al. 2014, algorithms 2 to 5).

use super::parameters::Parameters;
use super::silhouette::{COMMON_NEEDS, COUNTER_LIMIT, SideShaders, SilhouetteVolumes};
use super::{MethodError, MethodInfo, PrepareContext, PreparedMethod, ShadowMethod};
use crate::gpu::native::PrimitiveTopology;
use crate::gpu::{Requirement, shader};
use serde::{Deserialize, Serialize};

/// 2 · 32 − 1 is the largest odd tessellation level that every device has.
const MOST_QUADS: u32 = 32;

/// What the method is.
pub(super) static INFO: MethodInfo = MethodInfo {
    id: "silhouette_ts",
    title: "silhouette shadow volumes, side quads by tessellation shaders",
    source: "Milet, Kobrtek, Zemčík, Pečiva 2014, section 2.2",
    needs: &[
        Requirement::TessellationStage,
        COMMON_NEEDS[0],
        COMMON_NEEDS[1],
    ],
    limits: &[COUNTER_LIMIT],
    parameters: &[(
        "max_multiplicity",
        "32",
        "most opposite vertices of one patch, 1 to 32; edges with more are split",
    )],
};

/// The method's parameters.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct SilhouetteTs {
    max_multiplicity: u32,
}

impl Default for SilhouetteTs {
    fn default() -> Self {
        Self {
            max_multiplicity: MOST_QUADS,
        }
    }
}

impl Parameters for SilhouetteTs {
    fn validate(&self) -> Result<(), String> {
        super::parameters::in_range("max_multiplicity", self.max_multiplicity, 1..=MOST_QUADS)
    }
}

impl ShadowMethod for SilhouetteTs {
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
        let volumes = SilhouetteVolumes::new(context, self.max_multiplicity, |_| SideShaders {
            stages: vec![
                shader::glsl("methods/silhouette_ts/sides.tesc", &[]),
                shader::glsl("methods/silhouette_ts/sides.tese", &[]),
            ],
            topology: PrimitiveTopology::Patches,
        })?;
        Ok(Box::new(volumes))
    }
}
