//! Two series of a table held against each other, cell by cell.

use anyhow::{Context as _, Result};

use super::sheet::{Column, Point, Sheet, Source};
use super::value::Mask;

/// The numbers of one measurer: of the paper's authors on all their devices, or of one device here.
#[derive(Debug, Clone, Copy)]
pub(super) struct Evidence<'a> {
    pub(super) sheets: &'a [Sheet],
    pub(super) source: Source,
}

/// A series' speed over another's, wherever both were measured.
#[derive(Debug, Clone)]
pub(super) struct Ratios<'a> {
    pub(super) list: Vec<Ratio<'a>>,
    /// How many there would be had everything been measured.
    pub(super) possible: usize,
    /// The series' names for people.
    pub(super) names: [&'a str; 2],
}

/// The ratio of two cells.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ratio<'a> {
    pub(super) device: &'a str,
    pub(super) point: &'a Point,
    pub(super) ratio: f64,
    /// Whether the mask behind either was wrong.
    pub(super) wrong: bool,
}

impl<'a> Evidence<'a> {
    fn sheet(&self, table: u8) -> Result<&'a Sheet> {
        let sheet = self.sheets.iter().find(|sheet| sheet.spec.number == table);
        sheet.with_context(|| format!("a claim names table {table}"))
    }

    /// The ratios of `series` over `over` in a table, at the points wanted.
    pub(super) fn ratios(
        &self,
        table: u8,
        [series, over]: [&str; 2],
        wanted: impl Fn(&Point) -> bool,
    ) -> Result<Ratios<'a>> {
        let sheet = self.sheet(table)?;
        let index = |id: &str| {
            let found = sheet.spec.series.iter().position(|series| series == id);
            found.with_context(|| format!("a claim names {id}, which table {table} lacks"))
        };
        let (series, over) = (index(series)?, index(over)?);
        let points = sheet.points.iter().enumerate();
        let points: Vec<(usize, &Point)> = points.filter(|(_, point)| wanted(point)).collect();
        let own = |column: &&Column| column.source == self.source;
        let columns: Vec<&Column> = sheet.columns.iter().filter(own).collect();
        let speed = |value: f64| sheet.paper.quantity.speed(value);
        let mut list = Vec::new();
        for column in &columns {
            for (place, point) in &points {
                let both = column.value(series, *place).zip(column.value(over, *place));
                list.extend(both.map(|(a, b)| Ratio {
                    device: &column.device,
                    point,
                    ratio: speed(a.value) / speed(b.value),
                    wrong: [a.mask, b.mask].contains(&Mask::Wrong),
                }));
            }
        }
        let name = |index: usize| sheet.paper.series[&sheet.spec.series[index]].name.as_str();
        Ok(Ratios {
            list,
            possible: points.len() * columns.len().max(1),
            names: [name(series), name(over)],
        })
    }

    /// The name of a place of a table in a sentence.
    pub(super) fn place(&self, table: u8, id: &str) -> Result<&'a str> {
        let point = self
            .sheet(table)?
            .points
            .iter()
            .find(|point| point.id == id);
        let point =
            point.with_context(|| format!("a claim names {id}, which table {table} lacks"))?;
        Ok(&point.short)
    }
}

impl<'a> Ratios<'a> {
    /// Devices, in order.
    pub(super) fn devices(&self) -> Vec<&'a str> {
        let mut devices: Vec<&str> = self.list.iter().map(|ratio| ratio.device).collect();
        devices.dedup();
        devices
    }

    /// What stands before a device's part of a text: its name, where there are several.
    pub(super) fn whose(&self, device: &str) -> String {
        if self.devices().len() > 1 {
            format!("{device}: ")
        } else {
            String::new()
        }
    }

    /// The ratios of a device.
    pub(super) fn of(&self, device: &str) -> impl Iterator<Item = &Ratio<'a>> {
        self.list.iter().filter(move |ratio| ratio.device == device)
    }
}
