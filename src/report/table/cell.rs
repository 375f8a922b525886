//! What one cell of a table holds.

use maud::Markup;

/// What stands where there is nothing to say.
pub const DASH: &str = "–";

/// The content of one cell.
#[derive(Debug, Clone, Default)]
pub struct Cell {
    /// In the order in which they are read.
    pub parts: Vec<Part>,
    /// Class on the page, beside its column's; may be empty.
    pub class: String,
    /// What a pointer over it is told.
    pub tooltip: String,
}

/// A piece of a cell.
#[derive(Debug, Clone)]
pub enum Part {
    /// Plain text.
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
    /// What is written in files and commands.
    pub fn code(text: impl Into<String>) -> Self {
        Self::default().with(Part::Code(text.into()))
    }

    /// The best of its kind.
    pub fn strong(text: impl Into<String>) -> Self {
        Self::default().with(Part::Strong(text.into()))
    }

    /// A link to the place `id` of the page.
    pub fn link(id: impl Into<String>, text: impl Into<String>) -> Self {
        Self::default().with(Part::Link(id.into(), text.into()))
    }

    /// What only the page can show.
    pub fn drawn(markup: Markup) -> Self {
        Self::default().with(Part::Drawn(markup))
    }

    /// The id of a method and its variant, which may be empty.
    pub fn method(id: &str, variant: &str) -> Self {
        let cell = Self::code(id);
        if variant.is_empty() {
            cell
        } else {
            cell.with(Part::Quiet(variant.to_owned()))
        }
    }

    /// The cell, with a line below in small type.
    pub fn small(self, text: impl Into<String>) -> Self {
        self.with(Part::Small(text.into()))
    }

    /// The cell, with one more part.
    pub fn with(mut self, part: Part) -> Self {
        self.parts.push(part);
        self
    }

    /// The cell, with a class on the page.
    pub fn class(self, class: impl Into<String>) -> Self {
        let class = class.into();
        Self { class, ..self }
    }

    /// The cell, with what a pointer over it is told.
    pub fn tooltip(self, tooltip: &str) -> Self {
        let tooltip = tooltip.to_owned();
        Self { tooltip, ..self }
    }

    /// Its text in one line, with each part as `show` has it; small parts follow in brackets.
    pub(super) fn line(&self, show: impl Fn(&Part, &str) -> String) -> String {
        let (mut line, mut small) = (String::new(), Vec::new());
        for part in &self.parts {
            match part {
                Part::Small(text) => small.push(show(part, text)),
                Part::Quiet(text) => line.push_str(&format!(" {}", show(part, text))),
                Part::Text(text) | Part::Code(text) | Part::Strong(text) | Part::Link(_, text) => {
                    line.push_str(&show(part, text));
                }
                Part::Drawn(_) => {}
            }
        }
        if !small.is_empty() {
            line.push_str(&format!(" ({})", small.join(", ")));
        }
        line
    }
}

impl From<String> for Cell {
    fn from(text: String) -> Self {
        Self::default().with(Part::Text(text))
    }
}

impl From<&str> for Cell {
    fn from(text: &str) -> Self {
        text.to_owned().into()
    }
}

impl From<Option<String>> for Cell {
    fn from(text: Option<String>) -> Self {
        text.unwrap_or_else(|| DASH.to_owned()).into()
    }
}
