//! Maps of where methods fail: a scene over two of its keys, each cell judged against a finer answer.

mod backlash_load;
mod friction_step;
mod helix_contact_ratio;
mod judge;
mod mesh_contact;
mod poisson_element;
mod speed_damping_steps;
mod torque_misalignment;

use rayon::prelude::*;
use serde::Serialize;

pub use judge::{Cell, Outcome};

/// A map: what is changed along its axes, and how a cell is found.
#[derive(Debug, Clone, Copy)]
pub struct EnvelopeMap {
    /// `a` .. `g`.
    pub key: &'static str,
    /// What over what.
    pub name: &'static str,
    /// File of the scene in `scenes/envelope`, without its ending; empty where the cells are no scenes.
    pub file: &'static str,
    /// What a cell is held against, and when it counts as solved.
    pub judged: &'static str,
    /// Columns: what they are, and their values.
    pub columns: (&'static str, &'static [&'static str]),
    /// Rows.
    pub rows: (&'static str, &'static [&'static str]),
    /// Maps of the same axes, one after the other; one without a name where there is but one.
    pub layers: &'static [&'static str],
    /// Finds a cell: layer, row, column.
    cell: fn(&str, &str, &str) -> Cell,
}

/// A map with its cells.
#[derive(Debug, Clone, Serialize)]
pub struct DrawnMap {
    /// Layer by layer, row by row, column by column.
    pub layers: Vec<Vec<Vec<Cell>>>,
}

/// All maps, in the order of their letters.
pub const MAPS: &[EnvelopeMap] = &[
    torque_misalignment::MAP,
    helix_contact_ratio::MAP,
    speed_damping_steps::MAP,
    poisson_element::MAP,
    mesh_contact::MAP,
    backlash_load::MAP,
    friction_step::MAP,
];

impl EnvelopeMap {
    /// Finds all cells, on all threads; `done` is called after each. They do not depend on the number of threads.
    pub fn draw(&self, done: &(dyn Fn() + Sync)) -> DrawnMap {
        let (rows, columns) = (self.rows.1, self.columns.1);
        let places: Vec<(usize, usize, usize)> = (0..self.layers.len())
            .flat_map(|l| (0..rows.len()).flat_map(move |r| (0..columns.len()).map(move |c| (l, r, c))))
            .collect();
        let cells: Vec<Cell> = places
            .par_iter()
            .map(|&(l, r, c)| {
                let cell = (self.cell)(self.layers[l], rows[r], columns[c]);
                done();
                cell
            })
            .collect();
        let layers = cells.chunks(rows.len() * columns.len());
        DrawnMap { layers: layers.map(|l| l.chunks(columns.len()).map(<[Cell]>::to_vec).collect()).collect() }
    }

    /// Number of cells.
    pub fn count(&self) -> usize {
        self.layers.len() * self.rows.1.len() * self.columns.1.len()
    }
}

impl DrawnMap {
    /// All cells, in order.
    pub fn cells(&self) -> impl Iterator<Item = &Cell> {
        self.layers.iter().flatten().flatten()
    }

    /// Cells whose number is wrong though nothing was said.
    pub fn wrong(&self) -> usize {
        self.cells().filter(|c| c.outcome == Outcome::Wrong).count()
    }
}
