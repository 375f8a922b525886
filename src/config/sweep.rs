//! Lists and ranges of values in a method's table: a method for each, and the curves that they make.

use super::Sweep;
use super::misplaced::Misplaced;
use crate::variant::Variant;
use serde::Deserialize;
use std::collections::BTreeMap;
use toml::Spanned;
use toml::de::{DeTable, DeValue, ValueDeserializer};

/// More methods than this from one table are a slip of the finger.
const MAX_POINTS: usize = 1000;

/// A parameter with every value that it is to take, the first one in `values` first.
struct Axis<'a> {
    name: String,
    values: Vec<Spanned<DeValue<'a>>>,
}

impl Axis<'_> {
    /// The values as numbers, if there are several and all are.
    fn numbers(&self) -> Option<Vec<f64>> {
        let numbers = self.values.iter().map(|value| number(value.get_ref()));
        numbers.collect::<Option<Vec<_>>>().filter(|n| n.len() > 1)
    }
}

/// One method of a table of lists.
pub(super) struct SweepPoint<'a> {
    /// Its parameters.
    pub table: DeTable<'a>,
    /// The curve that it is on, by the parameters of the curve.
    pub on: Option<OnCurve<'a>>,
}

/// Where on a curve a point is.
pub(super) struct OnCurve<'a> {
    /// The parameters of the curve: all but the swept one.
    table: DeTable<'a>,
    parameter: String,
    value: f64,
}

impl<'a> OnCurve<'a> {
    /// The sweep, once `variant` has said what the curve's parameters are called.
    pub(super) fn sweep(self, variant: impl FnOnce(DeTable<'a>) -> Variant) -> Sweep {
        Sweep {
            curve: variant(self.table),
            parameter: self.parameter,
            value: self.value,
        }
    }
}

/// Reads every combination of the values that the table lists. Curves run along the longest list of numbers
/// (the first by name, of several); the other lists tell curves apart.
pub(super) fn expand<R>(
    table: DeTable<'_>,
    read: impl FnMut(SweepPoint<'_>) -> Result<R, Misplaced>,
) -> Result<Vec<R>, Misplaced> {
    // The values of ranges stand nowhere in the file: their text has to live until they are read.
    let ranges = table
        .iter()
        .filter(|(_, value)| value.get_ref().is_table())
        .map(|(key, value)| Ok((key.get_ref().to_string(), range(key.get_ref(), value)?)))
        .collect::<Result<BTreeMap<_, _>, Misplaced>>()?;
    let mut fixed = DeTable::new();
    let mut axes: Vec<(Spanned<_>, Axis<'_>)> = Vec::new();
    for (key, value) in table {
        match values(key.get_ref(), value, &ranges)? {
            Values::One(value) => {
                fixed.insert(key, value);
            }
            Values::Many(values) => {
                let name = key.get_ref().to_string();
                axes.push((key, Axis { name, values }));
            }
        }
    }
    let points = point_count(&axes)?;
    let lengths = axes
        .iter()
        .enumerate()
        .filter_map(|(i, (_, axis))| Some((i, axis.numbers()?)));
    // The first of the longest.
    let along = lengths.rev().max_by_key(|(_, numbers)| numbers.len());
    let point = |mut index: usize| {
        let mut table = fixed.clone();
        let mut curve = fixed.clone();
        let mut on = None;
        for (i, (key, axis)) in axes.iter().enumerate().rev() {
            let at = index % axis.values.len();
            index /= axis.values.len();
            table.insert(key.clone(), axis.values[at].clone());
            match &along {
                Some((swept, numbers)) if *swept == i => on = Some((&axis.name, numbers[at])),
                _ => {
                    curve.insert(key.clone(), axis.values[at].clone());
                }
            }
        }
        SweepPoint {
            table,
            on: on.map(|(parameter, value)| OnCurve {
                table: curve,
                parameter: parameter.clone(),
                value,
            }),
        }
    };
    (0..points).map(point).map(read).collect()
}

/// How many combinations the lists make.
fn point_count<K>(axes: &[(Spanned<K>, Axis<'_>)]) -> Result<usize, Misplaced> {
    axes.iter().try_fold(1, |points: usize, (key, axis)| {
        let points = points.saturating_mul(axis.values.len());
        if points <= MAX_POINTS {
            return Ok(points);
        }
        let message = format!("lists of {points} values together; at most {MAX_POINTS} are run");
        Err(Misplaced::new(key.span(), message))
    })
}

enum Values<'a> {
    One(Spanned<DeValue<'a>>),
    Many(Vec<Spanned<DeValue<'a>>>),
}

fn values<'a>(
    name: &str,
    value: Spanned<DeValue<'a>>,
    ranges: &'a BTreeMap<String, Vec<String>>,
) -> Result<Values<'a>, Misplaced> {
    let span = value.span();
    match value.get_ref() {
        DeValue::Array(array) if array.is_empty() => {
            let message = format!("`{name}` lists no value; name at least one");
            Err(Misplaced::new(span, message))
        }
        DeValue::Array(array) => Ok(Values::Many(array.iter().cloned().collect())),
        DeValue::Table(_) => {
            let texts = ranges.get(name).into_iter().flatten();
            let value = |text: &'a String| {
                let value = DeValue::parse(text).map_err(Misplaced::from)?;
                Ok(Spanned::new(span.clone(), value.into_inner()))
            };
            texts.map(value).collect::<Result<_, _>>().map(Values::Many)
        }
        _ => Ok(Values::One(value)),
    }
}

/// `{ from = 512, to = 8192, factor = 2 }` or `{ from = 0, to = 4, step = 1 }`, both ends included.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RangeWire {
    from: Number,
    to: Number,
    step: Option<Number>,
    factor: Option<Number>,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(untagged)]
enum Number {
    Integer(i64),
    Float(f64),
}

impl Number {
    fn value(self) -> f64 {
        match self {
            Self::Integer(n) => n as f64,
            Self::Float(x) => x,
        }
    }

    fn is_integer(self) -> bool {
        matches!(self, Self::Integer(_))
    }
}

/// The values of a range, as TOML.
fn range(name: &str, value: &Spanned<DeValue<'_>>) -> Result<Vec<String>, Misplaced> {
    let span = value.span();
    let misplaced = |message: String| Misplaced::new(span.clone(), format!("`{name}`: {message}"));
    let wire = RangeWire::deserialize(ValueDeserializer::from(value.clone()))
        .map_err(|error| misplaced(error.message().to_owned()))?;
    let (from, to) = (wire.from.value(), wire.to.value());
    let (next, by): (fn(f64, f64, i32) -> f64, _) = match (wire.step, wire.factor) {
        (Some(step), None) if step.value() > 0.0 => (|from, by, i| from + by * f64::from(i), step),
        (None, Some(factor)) if factor.value() > 1.0 && from > 0.0 => {
            (|from, by, i| from * by.powi(i), factor)
        }
        _ => {
            let advice = "a range has a `step` above 0, or a `factor` above 1 and `from` above 0";
            return Err(misplaced(advice.to_owned()));
        }
    };
    // The last value may be missed by rounding.
    let most = to + 1e-9 * (to - from);
    let numbers: Vec<f64> = (0..)
        .map(|i| next(from, by.value(), i))
        .take_while(|value| *value <= most)
        .take(MAX_POINTS + 1)
        .collect();
    if numbers.is_empty() || numbers.len() > MAX_POINTS {
        let message = format!("a range from {from} to {to} of no value, or of too many");
        return Err(misplaced(message));
    }
    let whole = [wire.from, wire.to, by].into_iter().all(Number::is_integer);
    let text = |number: f64| match whole {
        true => format!("{number:.0}"),
        // As a person would have written it, and always with a point or an exponent.
        false => {
            let rounded: f64 = format!("{number:.11e}").parse().unwrap_or(number);
            format!("{rounded:?}")
        }
    };
    Ok(numbers.into_iter().map(text).collect())
}

fn number(value: &DeValue<'_>) -> Option<f64> {
    match value {
        DeValue::Integer(n) => i64::from_str_radix(n.as_str(), n.radix())
            .ok()
            .map(|n| n as f64),
        DeValue::Float(x) => x.as_str().parse().ok(),
        _ => None,
    }
}

#[cfg(test)]
#[path = "sweep_tests.rs"]
mod tests;
