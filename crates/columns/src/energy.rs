//! `energy.csv`: the ledger of a motion, row for row with its history.

use super::{Group, Over, Rows, Table, columns};
use analysis::motion::EnergyRow;

/// Rows of a ledger.
#[derive(Debug)]
pub struct EnergyRows;

impl Rows for EnergyRows {
    type Layout = ();
    type Record = EnergyRow;
}

columns!(EnergyRows, ALL, |(), _| true, {
    TIME = "time_s" ["s"] "time of the row of `history.csv`, of a gearbox of `motion.csv`, whose first row is the start; kinetic and elastic energy at the start are kinetic + elastic - supplied - parametric + dissipated - residual of any row", |(), row, _| row.time_s;
    KINETIC = "kinetic_mj" ["mJ"] "kinetic energy", |(), row, _| row.kinetic_mj;
    ELASTIC = "elastic_mj" ["mJ"] "elastic energy of teeth, bearings and modes", |(), row, _| row.elastic_mj;
    SUPPLIED = "supplied_mj" ["mJ"]
        "work of drive and load on the vibration, and energy that friction and the dampers of `impact` and `shaft18` take from the nominal rotation and from the tooth errors",
        |(), row, _| row.supplied_mj;
    PARAMETRIC = "parametric_mj" ["mJ"] "change of elastic energy by the rotation of the loaded teeth",
        |(), row, _| row.parametric_mj;
    DISSIPATED = "dissipated_mj" ["mJ"]
        "energy dissipated in dampers and by friction, never falling; friction of `lumped8` and `lumped12` is a load, in `supplied_mj`",
        |(), row, _| row.dissipated_mj;
    RESIDUAL = "residual_mj" ["mJ"] "energy that the integrator adds or takes", |(), row, _| row.residual_mj;
});

/// All columns of a ledger.
pub const ENERGY: Table<EnergyRows> = Table { groups: &[Group { over: Over::File, columns: ALL }] };
