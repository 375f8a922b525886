//! The methods of a run configuration.

use super::misplaced::{Misplaced, missing, twice};
use crate::methods::{self, ShadowMethod, parameters};
use crate::toml_error;
use toml::Spanned;
use toml::de::{DeArray, DeValue};

/// Reads `[[methods]]`: at least one, and none twice.
pub(super) fn read_methods(
    value: Option<Spanned<DeValue<'_>>>,
) -> Result<Vec<Box<dyn ShadowMethod>>, Misplaced> {
    let example = "id = \"silhouette_ts\"";
    let value = value.ok_or_else(|| missing("methods", example))?;
    let span = value.span();
    match value.into_inner() {
        DeValue::Array(array) if array.is_empty() => Err(missing("methods", example)),
        DeValue::Array(array) => read_distinct_methods(array),
        _ => Err(Misplaced::new(
            span,
            "`methods` must be tables: `[[methods]]`",
        )),
    }
}

fn read_distinct_methods(array: DeArray<'_>) -> Result<Vec<Box<dyn ShadowMethod>>, Misplaced> {
    let label = |method: &dyn ShadowMethod| {
        let label = format!("{} {}", method.info().id, method.variant());
        label.trim_end().to_owned()
    };
    let mut methods: Vec<Box<dyn ShadowMethod>> = Vec::new();
    for entry in array {
        let span = entry.span();
        let method = read_method(entry)?;
        let name = label(method.as_ref());
        if methods
            .iter()
            .any(|earlier| label(earlier.as_ref()) == name)
        {
            return Err(twice(span, "method", &name));
        }
        methods.push(method);
    }
    Ok(methods)
}

fn read_method(entry: Spanned<DeValue<'_>>) -> Result<Box<dyn ShadowMethod>, Misplaced> {
    let span = entry.span();
    let DeValue::Table(mut table) = entry.into_inner() else {
        return Err(Misplaced::new(
            span,
            "a method must be a table with an `id`",
        ));
    };
    let id = table
        .remove("id")
        .ok_or_else(|| Misplaced::new(span.clone(), "this method has no `id`"))?;
    let Some(name) = id.get_ref().as_str() else {
        return Err(Misplaced::new(id.span(), "`id` must be a string"));
    };
    let registration = methods::find(name)
        .ok_or_else(|| Misplaced::new(id.span(), parameters::unknown_method(name)))?;
    (registration.configure)(Spanned::new(span.clone(), DeValue::Table(table))).map_err(|error| {
        let message = toml_error::with_suggestion(&error.message);
        Misplaced::new(
            error.span.unwrap_or(span),
            format!("method `{name}`: {message}"),
        )
    })
}
