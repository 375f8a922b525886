//! The methods of a run configuration.

use super::MethodPlan;
use super::misplaced::{Misplaced, missing, twice};
use super::sweep::{SweepPoint, expand};
use crate::methods::{Registration, Registry, ShadowMethod};
use crate::toml_error;
use crate::variant::Variant;
use std::collections::BTreeSet;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeArray, DeTable, DeValue};

/// Reads `[[methods]]`: at least one, and none twice.
pub(crate) fn read_methods(
    value: Option<Spanned<DeValue<'_>>>,
    registry: &Registry,
) -> Result<Vec<MethodPlan>, Misplaced> {
    let example = "id = \"silhouette_ts\"";
    let value = value.ok_or_else(|| missing("methods", example))?;
    let span = value.span();
    match value.into_inner() {
        DeValue::Array(array) if array.is_empty() => Err(missing("methods", example)),
        DeValue::Array(array) => read_distinct_methods(array, registry),
        _ => Err(Misplaced::new(
            span,
            "`methods` must be tables: `[[methods]]`",
        )),
    }
}

fn read_distinct_methods(
    array: DeArray<'_>,
    registry: &Registry,
) -> Result<Vec<MethodPlan>, Misplaced> {
    let label = |plan: &MethodPlan| {
        let label = format!("{} {}", plan.method.info().id, plan.method.variant());
        label.trim_end().to_owned()
    };
    let mut plans: Vec<MethodPlan> = Vec::new();
    let mut names = BTreeSet::new();
    for entry in array {
        let span = entry.span();
        for plan in read_entry(entry, registry)? {
            let name = label(&plan);
            if names.contains(&name) {
                return Err(twice(span, "method", &name));
            }
            names.insert(name);
            plans.push(plan);
        }
    }
    Ok(plans)
}

/// A method, or one for each combination of the values that the table lists.
fn read_entry(
    entry: Spanned<DeValue<'_>>,
    registry: &Registry,
) -> Result<Vec<MethodPlan>, Misplaced> {
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
    let registration =
        (registry.get(name)).map_err(|error| Misplaced::new(id.span(), error.message))?;
    let plan = |SweepPoint { table, on }: SweepPoint<'_>| {
        let method = configure(registration, &table, &span)?;
        let sweep = on.map(|on| {
            on.sweep(|table| {
                // What is valid with the swept parameter is so without it, but for a parameter that
                // needs another: then the curve has no other name than its method's.
                let curve = configure(registration, &table, &span);
                curve.map_or(Variant::default(), |curve| curve.variant())
            })
        });
        Ok(MethodPlan { method, sweep })
    };
    expand(table, plan)
}

fn configure(
    registration: &Registration,
    table: &DeTable<'_>,
    span: &Range<usize>,
) -> Result<Box<dyn ShadowMethod>, Misplaced> {
    registration.configure(table).map_err(|error| {
        let message = toml_error::with_suggestion(&error.message);
        let id = registration.info.id;
        Misplaced::new(
            error.span.unwrap_or(span.clone()),
            format!("method `{id}`: {message}"),
        )
    })
}
