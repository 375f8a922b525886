//! Two series of a table held against each other, cell by cell, and what that says about a claim.

use anyhow::{Context as _, Result};

use super::sheet::{Column, Mask, Point, Sheet};
use crate::record::unique;

/// The numbers of one measurer: of the paper's authors on all their devices, or of one device here.
#[derive(Debug, Clone, Copy)]
pub(super) struct Evidence<'a> {
    pub(super) sheets: &'a [Sheet],
    /// The place in the list of device groups; none for the paper.
    pub(super) group: Option<usize>,
}

/// A series' speed over another's, wherever both were measured.
#[derive(Debug, Clone)]
pub(super) struct Ratios<'a> {
    pub(super) list: Vec<Ratio<'a>>,
    /// How many there would be had everything been measured.
    pub(super) possible: usize,
    pub(super) names: [&'a str; 2],
}

#[derive(Debug, Clone, Copy)]
pub(super) struct Ratio<'a> {
    pub(super) device: &'a str,
    pub(super) point: &'a Point,
    pub(super) ratio: f64,
    /// Whether the mask behind either was wrong.
    pub(super) wrong: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Verdict {
    /// The numbers bear it out.
    Reproduced,
    /// The direction is as claimed, the size is not.
    TrendOnly,
    /// The numbers contradict it.
    NotReproduced,
    NotMeasured,
    /// None on the paper's own numbers: a verdict is about a repetition.
    None,
}

/// What a measurer's numbers say about a claim.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Finding {
    pub verdict: Verdict,
    /// The figure that decides, where there is a single one.
    pub value: Option<f64>,
    pub unit: &'static str,
    pub text: String,
    /// On how many comparisons it rests.
    pub pairs: usize,
    /// How many there would be had everything been measured.
    pub pairs_of: usize,
    /// In how many of them the mask of either side was wrong.
    pub wrong_masks: usize,
}

impl<'a> Evidence<'a> {
    pub(super) fn ratios(
        &self,
        table: u8,
        series: [&str; 2],
        wanted: impl Fn(&Point) -> bool,
    ) -> Result<Ratios<'a>> {
        let sheet = self.sheets.iter().find(|sheet| sheet.spec.number == table);
        let sheet = sheet.with_context(|| format!("a claim names table {table}"))?;
        let place = |id: &str| {
            let found = sheet.spec.series.iter().position(|series| series == id);
            found.with_context(|| format!("a claim names {id}, which table {table} lacks"))
        };
        let both = [place(series[0])?, place(series[1])?];
        let points: Vec<(usize, &Point)> = sheet.points.iter().enumerate().collect();
        let points = points.into_iter().filter(|(_, point)| wanted(point));
        let own = |column: &&Column| column.group == self.group;
        let columns = sheet.columns.iter().filter(own);
        let ratio = |column: &'a Column, (at, point): (usize, &'a Point)| {
            let [one, other] = both.map(|series| column.value(series, at));
            let (one, other) = (one?, other?);
            let speed = |value: f64| sheet.paper.quantity.speed(value);
            Some(Ratio {
                device: &column.device,
                point,
                ratio: speed(one.value) / speed(other.value),
                wrong: [one.mask, other.mask].contains(&Mask::Wrong),
            })
        };
        let of = |column| points.clone().filter_map(move |point| ratio(column, point));
        Ok(Ratios {
            list: columns.clone().flat_map(of).collect(),
            possible: points.clone().count() * columns.count().max(1),
            names: both.map(|series| &*sheet.paper.series[&sheet.spec.series[series]].name),
        })
    }
}

impl<'a> Ratios<'a> {
    pub(super) fn devices(&self) -> Vec<&'a str> {
        unique(self.list.iter().map(|ratio| ratio.device))
    }

    /// What stands before a device's part of a text: its name, where there are several.
    pub(super) fn whose(&self, device: &str) -> String {
        if self.devices().len() > 1 {
            format!("{device}: ")
        } else {
            String::new()
        }
    }

    pub(super) fn of(&self, device: &str) -> impl Iterator<Item = &Ratio<'a>> {
        self.list.iter().filter(move |ratio| ratio.device == device)
    }
}

impl Verdict {
    pub(crate) fn word(self) -> &'static str {
        match self {
            Self::Reproduced => "reproduced",
            Self::TrendOnly => "trend only",
            Self::NotReproduced => "not reproduced",
            Self::NotMeasured => "not measured",
            Self::None => "",
        }
    }

    pub(super) fn of(reproduced: bool, trend: bool) -> Self {
        match (reproduced, trend) {
            (true, _) => Self::Reproduced,
            (false, true) => Self::TrendOnly,
            (false, false) => Self::NotReproduced,
        }
    }
}

impl Finding {
    pub(super) fn new(
        ratios: &[Ratios<'_>],
        verdict: Verdict,
        text: String,
        (value, unit): (Option<f64>, &'static str),
    ) -> Self {
        let all = || ratios.iter().flat_map(|ratios| &ratios.list);
        let pairs = all().count();
        let (verdict, text) = match pairs {
            0 => (Verdict::NotMeasured, String::new()),
            _ => (verdict, text),
        };
        Self {
            verdict,
            value,
            unit,
            text,
            pairs,
            pairs_of: ratios.iter().map(|ratios| ratios.possible).sum(),
            wrong_masks: all().filter(|ratio| ratio.wrong).count(),
        }
    }

    /// How much it rests on, and how much of that is doubtful.
    pub(crate) fn rests_on(&self) -> String {
        let doubtful = match self.wrong_masks {
            0 => String::new(),
            wrong => format!(", {wrong} with a wrong mask"),
        };
        format!("{} of {}{doubtful}", self.pairs, self.pairs_of)
    }
}
