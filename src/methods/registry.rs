//! The methods that a program knows.

use super::parameters::{Parameter, ParameterError, configure};
use super::{MethodInfo, ShadowMethod};
use super::{
    adjacency_gs, alias_free_map, cube_shadow_map, ray_compute, ray_cpu, ray_query, shadow_map,
    silhouette_cpu, silhouette_cs, silhouette_gs, silhouette_ms, silhouette_ts, silhouette_vs,
    triangle_frusta, triangle_gs, triangle_ts,
};
use crate::toml_error;
use crate::variant::{Variant, VariantError};
use std::collections::BTreeSet;
use toml::de::{DeTable, ValueDeserializer};

/// A known method: what it is, and how it is made.
pub struct Registration {
    /// What it is.
    pub info: &'static MethodInfo,
    /// Its parameters.
    pub parameters: Vec<Parameter>,
    make: fn() -> Box<dyn ShadowMethod>,
}

impl Registration {
    fn of<M: ShadowMethod + Default + 'static>() -> Self {
        let method = M::default();
        let (info, parameters) = (method.info(), method.parameters());
        let mut names = BTreeSet::new();
        for parameter in &parameters {
            let (id, name) = (info.id, parameter.name);
            assert!(names.insert(name), "`{id}` declares `{name}` twice");
            let fits = parameter.default.is_null() || parameter.domain.contains(&parameter.default);
            assert!(fits, "the default of `{id}`'s `{name}` is out of its range");
        }
        Self {
            info,
            parameters,
            make: || Box::new(M::default()),
        }
    }

    /// The method with the parameters of a table, which has no id.
    ///
    /// # Errors
    /// When one is unknown, of the wrong type or impossible; the place is the parameter's.
    pub fn configure(&self, table: &DeTable<'_>) -> Result<Box<dyn ShadowMethod>, ParameterError> {
        let mut method = (self.make)();
        configure(method.as_mut(), table)?;
        Ok(method)
    }
}

/// The methods that a program knows, in the order in which they are listed.
#[derive(Default)]
pub struct Registry(Vec<Registration>);

impl Registry {
    /// Those that come with the program, one line each.
    pub fn builtin() -> Self {
        Self::default()
            .with::<silhouette_ts::SilhouetteTs>()
            .with::<silhouette_gs::SilhouetteGs>()
            .with::<silhouette_cpu::SilhouetteCpu>()
            .with::<silhouette_cs::SilhouetteCs>()
            .with::<silhouette_ms::SilhouetteMs>()
            .with::<silhouette_vs::SilhouetteVs>()
            .with::<triangle_ts::TriangleTs>()
            .with::<triangle_gs::TriangleGs>()
            .with::<adjacency_gs::AdjacencyGs>()
            .with::<ray_query::RayQuery>()
            .with::<ray_compute::RayCompute>()
            .with::<ray_cpu::RayCpu>()
            .with::<alias_free_map::AliasFreeMap>()
            .with::<triangle_frusta::TriangleFrusta>()
            .with::<shadow_map::ShadowMap>()
            .with::<cube_shadow_map::CubeShadowMap>()
    }

    /// These and one more.
    ///
    /// # Panics
    /// When there is a method of the same id already, or a parameter is declared twice or with a default out of its
    /// range.
    #[must_use]
    pub fn with<M: ShadowMethod + Default + 'static>(mut self) -> Self {
        let registration = Registration::of::<M>();
        let id = registration.info.id;
        assert!(self.find(id).is_none(), "there is a method `{id}` already");
        self.0.push(registration);
        self
    }

    /// All of them.
    pub fn iter(&self) -> impl Iterator<Item = &Registration> {
        self.0.iter()
    }

    fn find(&self, id: &str) -> Option<&Registration> {
        self.iter().find(|registration| registration.info.id == id)
    }

    /// The method called `id`.
    ///
    /// # Errors
    /// When there is none; the message names the nearest.
    pub fn get(&self, id: &str) -> Result<&Registration, ParameterError> {
        self.find(id).ok_or_else(|| {
            let ids: Vec<_> = self.iter().map(|known| known.info.id).collect();
            let hint = toml_error::nearest(id, ids.iter().copied())
                .map(|nearest| format!("; did you mean `{nearest}`?"))
                .unwrap_or_default();
            let known = ids.join(", ");
            ParameterError::plain(format!("unknown method `{id}`{hint} (known: {known})"))
        })
    }

    /// Reads `ID[,key=value...]`, the form of command lines. Values are TOML; what is no TOML value
    /// is taken as a string.
    ///
    /// # Errors
    /// A message for people that names the nearest known id or parameter.
    pub fn parse(&self, text: &str) -> Result<Box<dyn ShadowMethod>, ParameterError> {
        let (id, rest) = text.split_once(',').unwrap_or((text, ""));
        let registration = self.get(id)?;
        let variant: Variant = rest.parse().map_err(|error: VariantError| {
            ParameterError::plain(format!("method `{id}`: {error}"))
        })?;
        let mut document = String::new();
        for (key, value) in variant.parameters() {
            match ValueDeserializer::parse(value) {
                Ok(_) => document.push_str(&format!("{key} = {value}\n")),
                Err(_) => document.push_str(&format!("{key} = {value:?}\n")),
            }
        }
        let table = DeTable::parse(&document).map_err(ParameterError::from)?;
        registration.configure(table.get_ref()).map_err(|error| {
            let message = toml_error::with_suggestion(&error.message);
            ParameterError::plain(format!("method `{id}`: {message}"))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each default and each choice can be written into a configuration, and is then no difference.
    #[test]
    fn what_is_declared_can_be_set() {
        for known in Registry::builtin().iter() {
            let id = known.info.id;
            let set = |name: &str, value: &str| {
                let method = Registry::builtin().parse(&format!("{id},{name}={value}"));
                method.unwrap_or_else(|error| panic!("{error}")).variant()
            };
            for parameter in &known.parameters {
                let (name, default) = (parameter.name, parameter.default_text());
                if !parameter.default.is_null() {
                    assert_eq!(set(name, &default).as_str(), "", "{id} {name}");
                }
                if let super::super::Domain::Choice { choices } = &parameter.domain {
                    for choice in choices.iter().filter(|choice| **choice != default) {
                        assert_eq!(set(name, choice).as_str(), format!("{name}={choice}"));
                    }
                }
            }
        }
    }

    #[test]
    fn a_variant_is_what_differs_in_the_order_of_names() {
        let registry = Registry::builtin();
        let text =
            "silhouette_gs,push_back_px=0.5,near=2,max_multiplicity=3,counting=auto,reach=scene";
        let method = registry.parse(text).unwrap();
        assert_eq!(
            method.variant().as_str(),
            "counting=auto,max_multiplicity=3,near=2.0,push_back_px=0.5"
        );
    }

    #[test]
    fn what_is_no_finite_number_is_refused() {
        for value in ["near=nan", "near=inf", "near=-inf", "push_back_px=nan"] {
            let error = Registry::builtin().parse(&format!("triangle_gs,{value}"));
            let message = error.err().expect("an error").message;
            assert!(message.contains("not finite; it must be from"), "{message}");
        }
    }

    #[test]
    #[should_panic(expected = "there is a method `shadow_map` already")]
    fn ids_are_distinct() {
        let _ = Registry::builtin().with::<shadow_map::ShadowMap>();
    }

    #[test]
    fn the_contract_lists_every_parameter() {
        let contract = include_str!("../../FORMAT.md");
        let (_, table) = contract
            .split_once("| method | parameter | type | default |")
            .unwrap();
        let lines = table.lines().skip(2).take_while(|line| !line.is_empty());
        let mut method = "";
        let mut rows: Vec<(&str, &str, &str)> = Vec::new();
        for line in lines {
            let cells: Vec<&str> = line.split('|').map(str::trim).collect();
            if !cells[1].is_empty() {
                method = cells[1];
            }
            rows.push((method, cells[2], cells[4]));
        }
        let mut listed = BTreeSet::new();
        for Registration {
            info, parameters, ..
        } in Registry::builtin().iter()
        {
            let of_volumes = ["silhouette", "triangle", "adjacency"];
            let is_volume = of_volumes.iter().any(|what| info.id.starts_with(what));
            for Parameter { name, default, .. } in parameters {
                let default = match default.is_null() {
                    true => "the camera's".to_owned(),
                    false => default.to_string(),
                };
                let position = rows.iter().position(|(methods, names, defaults)| {
                    let is_its = methods.contains(&format!("`{}`", info.id))
                        || is_volume && methods.starts_with("all volume methods");
                    is_its && names.contains(&format!("`{name}`")) && defaults.contains(&default)
                });
                let Some(position) = position else {
                    panic!(
                        "FORMAT.md has no row for `{name}` of `{}`, default {default}",
                        info.id
                    );
                };
                listed.insert(position);
            }
        }
        let named = (0..rows.len()).filter(|row| !rows[*row].1.is_empty());
        assert!(listed.into_iter().eq(named), "FORMAT.md lists others too");
    }
}
