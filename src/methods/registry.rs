//! All methods, one line each.

use super::parameters::{ParameterError, configure};
use super::{MethodInfo, ShadowMethod};
use super::{cube_shadow_map, shadow_map, silhouette_gs, silhouette_ts, triangle_gs, triangle_ts};
use toml::Spanned;
use toml::de::DeTable;

type Configure = fn(&Spanned<DeTable<'_>>) -> Result<Box<dyn ShadowMethod>, ParameterError>;

/// A known method: what it is, and how its parameters are read.
pub struct Registration {
    /// What it is.
    pub info: &'static MethodInfo,
    /// Reads a table of parameters, without the id.
    pub configure: Configure,
}

/// Every method, in the order in which they are listed.
pub static REGISTRY: &[Registration] = &[
    Registration {
        info: &silhouette_ts::INFO,
        configure: configure::<silhouette_ts::SilhouetteTs>,
    },
    Registration {
        info: &silhouette_gs::INFO,
        configure: configure::<silhouette_gs::SilhouetteGs>,
    },
    Registration {
        info: &triangle_ts::INFO,
        configure: configure::<triangle_ts::TriangleTs>,
    },
    Registration {
        info: &triangle_gs::INFO,
        configure: configure::<triangle_gs::TriangleGs>,
    },
    Registration {
        info: &shadow_map::INFO,
        configure: configure::<shadow_map::ShadowMap>,
    },
    Registration {
        info: &cube_shadow_map::INFO,
        configure: configure::<cube_shadow_map::CubeShadowMap>,
    },
];

/// The method called `id`.
pub fn find(id: &str) -> Option<&'static Registration> {
    REGISTRY
        .iter()
        .find(|registration| registration.info.id == id)
}
