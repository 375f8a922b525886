//! The TOML of a stress run: which methods are tried on which causes of failure.

use super::{Cause, corpus, find_cause};
use crate::config::method_tables::read_methods;
use crate::config::misplaced::{Misplaced, twice};
use crate::config::run_file::{check_size, read_text};
use crate::config::{ConfigError, MethodPlan};
use crate::methods::{Registry, ShadowMethod};
use crate::toml_array::Exactly;
use crate::toml_error;
use serde::Deserialize;
use std::collections::BTreeSet;
use std::path::Path;
use toml::Spanned;
use toml::de::{DeTable, Deserializer};

/// What to try.
pub struct StressPlan {
    /// What the run is about.
    pub title: String,
    /// Width and height of the pictures.
    pub size_px: (u32, u32),
    /// Seed of what is random in the scenes.
    pub seed: u64,
    /// The causes, in order.
    pub causes: Vec<Cause>,
    /// The methods, in order.
    pub methods: Vec<Box<dyn ShadowMethod>>,
    /// The configuration file as named by the user.
    pub path: String,
    /// Its text.
    pub text: String,
}

/// All keys but `methods`, whose tables belong to the methods.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PlanWire {
    title: String,
    #[serde(default = "default_size")]
    size: Spanned<Exactly<u32, 2>>,
    #[serde(default)]
    seed: u64,
    causes: Option<Vec<Spanned<String>>>,
    /// Never read: taken out before. Here so that messages about unknown keys name it.
    #[serde(default, rename = "methods")]
    _methods: Vec<serde::de::IgnoredAny>,
}

/// Small: failures are as plain there, and there is much to draw.
fn default_size() -> Spanned<Exactly<u32, 2>> {
    Spanned::new(0..0, Exactly([160, 120]))
}

impl StressPlan {
    /// The configuration that comes with the program.
    ///
    /// # Errors
    /// When `registry` lacks one of its methods; with those of the program never, as a test makes sure.
    pub fn builtin(registry: &Registry) -> Result<Self, ConfigError> {
        let text = include_str!("../../configs/stability.toml");
        Self::parse(text, "configs/stability.toml", registry)
    }

    /// Reads and checks a configuration file.
    ///
    /// # Errors
    /// What is wrong, with file, line and column.
    pub fn read(path: &Path, registry: &Registry) -> Result<Self, ConfigError> {
        Self::parse(&read_text(path)?, &path.display().to_string(), registry)
    }

    /// Refuses causes and methods that are there twice: results tell pictures apart by them.
    ///
    /// # Errors
    /// When one is; the message names it.
    pub fn check_distinct(&self) -> Result<(), ConfigError> {
        let causes = self
            .causes
            .iter()
            .map(|cause| format!("cause `{}`", cause.id));
        let methods = self
            .methods
            .iter()
            .map(|method| format!("method `{}`", method.name()));
        let mut known = BTreeSet::new();
        match causes
            .chain(methods)
            .find(|name| !known.insert(name.clone()))
        {
            Some(name) => Err(ConfigError(format!(
                "the {name} is there twice; remove one of the two"
            ))),
            None => Ok(()),
        }
    }

    fn parse(text: &str, name: &str, registry: &Registry) -> Result<Self, ConfigError> {
        let plan = parse(text, registry).map_err(|Misplaced { span, message }| match span {
            Some(span) => ConfigError(toml_error::at(&span, &message, text, name)),
            None => ConfigError(format!("{name}: {message}")),
        })?;
        Ok(Self {
            path: name.to_owned(),
            text: text.to_owned(),
            ..plan
        })
    }
}

fn parse(text: &str, registry: &Registry) -> Result<StressPlan, Misplaced> {
    let mut document = DeTable::parse(text)?;
    let methods = read_methods(document.get_mut().remove("methods"), registry)?;
    let wire = PlanWire::deserialize(Deserializer::from(document))?;
    let Exactly([width, height]) = *wire.size.get_ref();
    check_size((width, height)).map_err(|message| Misplaced::new(wire.size.span(), message))?;
    let causes = match &wire.causes {
        None => corpus(),
        Some(names) => read_causes(names)?,
    };
    let method = |MethodPlan { method, .. }: MethodPlan| method;
    Ok(StressPlan {
        title: wire.title,
        size_px: (width, height),
        seed: wire.seed,
        causes,
        methods: methods.into_iter().map(method).collect(),
        path: String::new(),
        text: String::new(),
    })
}

fn read_causes(names: &[Spanned<String>]) -> Result<Vec<Cause>, Misplaced> {
    let mut causes: Vec<Cause> = Vec::new();
    for name in names {
        let id = name.get_ref();
        let cause = cause_called(id).map_err(|error| Misplaced::new(name.span(), error.0))?;
        if causes.iter().any(|earlier| earlier.id == *id) {
            return Err(twice(name.span(), "cause", id));
        }
        causes.push(cause);
    }
    Ok(causes)
}

/// The cause of an id that comes with the program.
///
/// # Errors
/// When there is none; the message names the nearest.
pub fn cause_called(id: &str) -> Result<Cause, ConfigError> {
    find_cause(id).ok_or_else(|| {
        let all = corpus();
        let ids = || all.iter().map(|cause| cause.id.as_str());
        let hint = toml_error::nearest(id, ids())
            .map(|nearest| format!("; did you mean `{nearest}`?"))
            .unwrap_or_default();
        let known = ids().collect::<Vec<_>>().join(", ");
        ConfigError(format!("unknown cause `{id}`{hint} (known: {known})"))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_configuration_of_the_program_tries_everything() {
        let plan = StressPlan::builtin(&Registry::builtin()).unwrap();
        assert_eq!(plan.causes, corpus());
        assert!(plan.methods.len() > 10);
    }

    #[test]
    fn errors_name_the_place() {
        let message = |text: &str| {
            StressPlan::parse(text, "s.toml", &Registry::builtin())
                .err()
                .unwrap()
                .0
        };
        let method = "[[methods]]\nid = \"silhouette_gs\"\n";
        let misspelt = message(&format!("title = \"t\"\ncauses = [\"fans\"]\n{method}"));
        assert!(misspelt.contains("s.toml:2:11"), "{misspelt}");
        assert!(misspelt.contains("did you mean `fan`?"), "{misspelt}");
        let twice = message(&format!(
            "title = \"t\"\ncauses = [\"fan\", \"fan\"]\n{method}"
        ));
        assert!(twice.contains("s.toml:2:18"), "{twice}");
        assert!(message("title = \"t\"").contains("[[methods]]"));
        let unknown = message(&format!("title = \"t\"\ncause = 1\n{method}"));
        assert!(unknown.contains("did you mean `causes`?"), "{unknown}");
    }
}
