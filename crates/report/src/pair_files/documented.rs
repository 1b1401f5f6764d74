//! Tables beside the histories without rows: the columns that `docs/outputs.md` lists.

use analysis::{
    lumped::{LumpedQuantity, SweepOptions},
    motion::{MotionSpectrum, OrderCut, Passage},
};
use answer::Table;
use scene::plan::SectionEvery;

use super::{key_rows, rows};

/// A table of each kind without rows, from which the lists of columns in `docs/outputs.md` are made.
///
/// `<key>` and `<column>` stand for the key that a user varies and the column that a user looks at.
pub fn tables_without_rows() -> Vec<Table> {
    let spectrum = MotionSpectrum {
        orders: Vec::new(),
        frequencies: Vec::new(),
        dte_um: Vec::new(),
        normal_force_n: Vec::new(),
        wheel_force_z_n: Vec::new(),
        moment_y_nmm: [Vec::new(), Vec::new()],
    };
    let cut = OrderCut { time_s: 0.0, driver_speed_rpm: 0.0, mesh_frequency_hz: 0.0, amplitudes_um: vec![0.0] };
    let options = SweepOptions {
        key: "<key>".into(),
        ways: Vec::new(),
        every: SectionEvery::MeshCycle,
        quantity: LumpedQuantity::new("<column>", |row| row.transmission_error_um),
        points: 1,
        stretches: 0,
    };
    vec![
        rows::spectrum(&spectrum),
        rows::waterfall(&[], 1),
        rows::cycles(&Passage::default()),
        rows::order_cuts(&Passage { cuts: vec![cut], ..Passage::default() }),
        rows::resonance(&[]),
        key_rows::sweep(&options, &[]),
        key_rows::bifurcation(&options, &[]),
        key_rows::branch("<key>", &[]),
        key_rows::turns("<key>", &[]),
        key_rows::in_time("<key>", &[]),
        key_rows::basins(&[]),
        key_rows::attractors(&[]),
    ]
}
