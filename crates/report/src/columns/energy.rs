//! `energy.csv`: the ledger of a motion, row for row with its history.

pub use analysis::EnergyRecord;
use study::Columns;

use super::{Group, Over, Rows, Table, columns};

/// Rows of a ledger.
#[derive(Debug)]
pub struct EnergyRows;

impl Rows for EnergyRows {
    type Layout = ();
    type Record = EnergyRecord;
}

columns!(EnergyRows, ALL, |(), _| true, {
    TIME = "time_s" ["s"] "as in `history.csv`", |(), row, _| row.time;
    KINETIC = "kinetic_mj" ["mJ"] "kinetic energy", |(), row, _| row.ledger.kinetic;
    ELASTIC = "elastic_mj" ["mJ"] "elastic energy of teeth, bearings and modes", |(), row, _| row.ledger.potential;
    SUPPLIED = "supplied_mj" ["mJ"] "work of drive and load", |(), row, _| row.ledger.supplied;
    PARAMETRIC = "parametric_mj" ["mJ"] "what the turning of the teeth under load does to their elastic energy",
        |(), row, _| row.ledger.parametric;
    DISSIPATED = "dissipated_mj" ["mJ"] "in dampers and by friction", |(), row, _| row.ledger.dissipated;
    RESIDUAL = "residual_mj" ["mJ"] "what the integrator adds or takes", |(), row, _| row.ledger.residual();
});

/// All columns of a ledger.
pub const ENERGY: Table<EnergyRows> = Table { groups: &[Group { over: Over::File, columns: ALL }] };

/// The ledger of a motion as columns by name.
pub fn energy_columns(records: &[EnergyRecord]) -> Columns {
    let sheet = ENERGY.sheet(&(), &[]);
    let mut columns = Columns::named(sheet.names());
    records.iter().for_each(|record| columns.push(sheet.row(&(), record)));
    columns
}
