//! `counters.csv`: what methods counted while they were prepared.

use super::Summary;
use crate::variant::Variant;
use serde::{Deserialize, Serialize};

/// A counter of a cell: a row of `counters.csv`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct CounterRow {
    scene: String,
    method: String,
    variant: Variant,
    width: u32,
    height: u32,
    counter: String,
    value: u64,
}

impl CounterRow {
    fn is_of(&self, row: &Summary) -> bool {
        (&self.scene, &self.method, &self.variant) == (&row.scene, &row.method, &row.variant)
            && (self.width, self.height) == (row.width, row.height)
    }
}

/// The rows of cells.
pub fn counter_rows(cells: &[Summary]) -> Vec<CounterRow> {
    let rows = |cell: &Summary| {
        let cell = cell.clone();
        cell.counters
            .into_iter()
            .map(move |(counter, value)| CounterRow {
                scene: cell.scene.clone(),
                method: cell.method.clone(),
                variant: cell.variant.clone(),
                width: cell.width,
                height: cell.height,
                counter,
                value,
            })
    };
    cells.iter().flat_map(rows).collect()
}

/// Gives each cell its counters.
pub(super) fn join_counters(cells: &mut [Summary], rows: &[CounterRow]) {
    for cell in cells {
        let own = rows.iter().filter(|row| row.is_of(cell));
        let own = own.map(|row| (row.counter.clone(), row.value));
        cell.counters = own.collect();
    }
}
