//! What one cell of a table holds.

use maud::Markup;

use crate::report::format::count;

/// What stands where there is nothing to say.
pub(crate) const DASH: &str = "–";

#[derive(Debug, Clone, Default)]
pub(crate) struct Cell {
    pub parts: Vec<Part>,
    /// Class on the page, beside its column's; may be empty.
    pub class: String,
    /// What a pointer over it is told.
    pub tooltip: String,
}

/// A piece of a cell.
#[derive(Debug, Clone)]
pub(crate) enum Part {
    Text(String),
    /// What is written in files and commands.
    Code(String),
    /// The best.
    Strong(String),
    /// Text of less weight, which may break after commas.
    Quiet(String),
    /// A line below in small type.
    Small(String),
    /// A link within the page, and its text.
    Link(String, String),
    /// What only the page can show.
    Drawn(Markup),
}

impl Cell {
    pub(crate) fn code(text: impl Into<String>) -> Self {
        Part::Code(text.into()).into()
    }

    pub(crate) fn strong(text: impl Into<String>) -> Self {
        Part::Strong(text.into()).into()
    }

    pub(crate) fn drawn(markup: Markup) -> Self {
        Part::Drawn(markup).into()
    }

    /// The id of a method and its variant, which may be empty.
    pub(crate) fn method(id: &str, variant: &str) -> Self {
        let cell = Self::code(id);
        if variant.is_empty() {
            cell
        } else {
            cell.with(Part::Quiet(variant.to_owned()))
        }
    }

    pub(crate) fn small(self, text: impl Into<String>) -> Self {
        self.with(Part::Small(text.into()))
    }

    pub(crate) fn with(mut self, part: Part) -> Self {
        self.parts.push(part);
        self
    }

    pub(crate) fn class(self, class: impl Into<String>) -> Self {
        let class = class.into();
        Self { class, ..self }
    }

    pub(crate) fn tooltip(self, tooltip: &str) -> Self {
        let tooltip = tooltip.to_owned();
        Self { tooltip, ..self }
    }
}

impl From<Part> for Cell {
    fn from(part: Part) -> Self {
        Self::default().with(part)
    }
}

impl From<String> for Cell {
    fn from(text: String) -> Self {
        Part::Text(text).into()
    }
}

impl From<&str> for Cell {
    fn from(text: &str) -> Self {
        text.to_owned().into()
    }
}

/// A text and its unit.
impl From<(&str, &str)> for Cell {
    fn from((text, unit): (&str, &str)) -> Self {
        Self::from(text).small(unit)
    }
}

impl From<u64> for Cell {
    fn from(number: u64) -> Self {
        count(number).into()
    }
}

impl<T: Into<Self>> From<Option<T>> for Cell {
    fn from(content: Option<T>) -> Self {
        content.map_or_else(|| DASH.into(), Into::into)
    }
}
