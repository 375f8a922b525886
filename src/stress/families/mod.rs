//! The families of scenes, by what goes wrong in them.

mod counts;
mod damage;
mod eye;
mod light;
mod map;
mod shapes;
mod slivers;
mod space;
mod surfaces;

use crate::scene::Scene;
use serde::Deserialize;
use shapes::Shot;

/// How the scenes of a cause are made from its number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Family {
    EyeInVolume,
    NearPlaneCutsCaster,
    FarCasters,
    LargeTriangles,
    Fan,
    NestedShells,
    StackedSheets,
    Duplicated,
    CoplanarOverlap,
    OpenMesh,
    Flipped,
    TJunctions,
    SelfIntersections,
    RandomSoup,
    Moebius,
    KleinBottle,
    Needles,
    Collinear,
    EdgeOn,
    LightInMesh,
    LightInLantern,
    LightNearVertex,
    LightNearEdge,
    LightNearFace,
    LightOnElement,
    LightDistance,
    LightAtInfinity,
    Translation,
    ScaleUp,
    ScaleDown,
    ThinWall,
    Contact,
    GrazingReceiver,
}

/// The numbers that a family takes.
enum ValueRange {
    /// Whole ones in this range.
    Whole(u32, u32),
    /// Any in this range.
    Between(f64, f64),
}

impl Family {
    fn domain(self) -> ValueRange {
        use ValueRange::{Between, Whole};
        match self {
            Self::EyeInVolume
            | Self::Flipped
            | Self::Collinear
            | Self::LightInMesh
            | Self::LightInLantern => Between(0.0, 1.0),
            Self::NearPlaneCutsCaster => Between(0.01, 6.0),
            Self::FarCasters => Between(1.0, 8.0),
            Self::Fan
            | Self::NestedShells
            | Self::StackedSheets
            | Self::Duplicated
            | Self::CoplanarOverlap
            | Self::SelfIntersections
            | Self::RandomSoup => Whole(1, 10_000),
            Self::OpenMesh => Whole(0, damage::OPEN_MESH_TRIANGLES - 1),
            Self::TJunctions => Whole(0, damage::MAX_T_JUNCTIONS),
            Self::Moebius => Whole(3, 10_000),
            Self::KleinBottle => Whole(4, 1000),
            Self::EdgeOn => Whole(0, 10_000),
            Self::LightOnElement => Whole(0, 3),
            Self::LightDistance => Between(0.0, 38.0),
            Self::ScaleUp => Between(0.0, 9.0),
            // Smaller, little would be left of it on the grid that positions lie on.
            Self::ScaleDown => Between(0.0, 7.0),
            Self::Needles
            | Self::LargeTriangles
            | Self::LightNearVertex
            | Self::LightNearEdge
            | Self::LightNearFace
            | Self::Translation
            | Self::ThinWall => Between(0.0, 8.0),
            Self::LightAtInfinity | Self::Contact | Self::GrazingReceiver => Between(0.0, 89.99),
        }
    }

    /// Says why there is no scene for a value, if there is none.
    pub(super) fn refusal(self, value: f64) -> Option<String> {
        let (is_one, what, least, most) = match self.domain() {
            ValueRange::Whole(least, most) => {
                let (least, most) = (f64::from(least), f64::from(most));
                (value.fract() == 0.0, "whole numbers", least, most)
            }
            ValueRange::Between(least, most) => (true, "numbers", least, most),
        };
        let fits = is_one && (least..=most).contains(&value);
        let message = || format!("this family takes {what} from {least} to {most}, not {value}");
        (!fits).then(message)
    }

    /// The scene for a value that is not refused.
    pub(super) fn scene(self, value: f64, seed: u64, name: String, title: String) -> Scene {
        self.shot(value, seed).scene(name, title)
    }

    fn shot(self, value: f64, seed: u64) -> Shot {
        let count = value as usize;
        match self {
            Self::EyeInVolume => eye::in_volume(value),
            Self::NearPlaneCutsCaster => eye::near_plane_cuts_caster(value),
            Self::FarCasters => eye::far_casters(value),
            Self::LargeTriangles => eye::large_triangles(value),
            Self::Fan => counts::fan(count, seed),
            Self::NestedShells => counts::nested_shells(count),
            Self::StackedSheets => counts::stacked_sheets(count),
            Self::Duplicated => counts::duplicated(count, seed),
            Self::CoplanarOverlap => counts::coplanar_overlap(count, seed),
            Self::OpenMesh => damage::open_mesh(count, seed),
            Self::Flipped => damage::flipped_share(value, seed),
            Self::TJunctions => damage::t_junctions(count, seed),
            Self::SelfIntersections => damage::self_intersections(count, seed),
            Self::RandomSoup => damage::random_soup(count, seed),
            Self::Moebius => surfaces::moebius(count),
            Self::KleinBottle => surfaces::klein_bottle(count),
            Self::Needles => slivers::needles(value),
            Self::Collinear => slivers::collinear(value, seed),
            Self::EdgeOn => slivers::edge_on(count, seed),
            Self::LightInMesh => light::in_mesh(value),
            Self::LightInLantern => light::in_lantern(value, seed),
            Self::LightNearVertex => light::near_vertex(10f64.powf(-value)),
            Self::LightNearEdge => light::near_edge(10f64.powf(-value)),
            Self::LightNearFace => light::near_face(10f64.powf(-value)),
            Self::LightOnElement => light::on_element(count),
            Self::LightDistance => space::light_distance(value),
            Self::LightAtInfinity => space::light_at_infinity(value),
            Self::Translation => space::translation(value),
            Self::ScaleUp => space::scaled(10f64.powf(value)),
            Self::ScaleDown => space::scaled(10f64.powf(-value)),
            Self::ThinWall => map::thin_wall(value),
            Self::Contact => map::contact(value),
            Self::GrazingReceiver => map::grazing_receiver(value),
        }
    }
}

#[cfg(test)]
mod tests;
