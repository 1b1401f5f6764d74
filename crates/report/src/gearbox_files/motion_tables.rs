//! Tables of a gearbox in motion beside its rows: section, orders, waterfall.

use analysis::{
    gearbox::{GearboxMotionResult, MotionOrder},
    motion::{MotionSpectrum, RunUp, Waterfall},
};
use answer::Table;
use scene::gearbox::Gearbox;

use super::vibration_rows::which;
use crate::{
    ReportError,
    motion_files::{self, WaterfallOf},
    pair_files::rows::cycles_of_meshes,
};

/// `section`: the rows once a common period of all meshes, at its start; `None` where the motion does not last one, the
/// meshes have none, or the input does not turn one way alone.
///
/// # Errors
/// [`ReportError`] for rows that hold what is no number.
pub(super) fn section(motion: &GearboxMotionResult, rows: &Table) -> Result<Option<Table>, ReportError> {
    let places = &motion.reached.cycles[..];
    let Some(period) = motion.common_period.map(|p| p as f64) else { return Ok(None) };
    let lasts = places.last().is_some_and(|last| *last > (1.0 - 1e-9) * period);
    if !lasts || places.windows(2).any(|w| w[1] <= w[0]) {
        return Ok(None);
    }
    motion_files::section(rows, places, period).map(Some)
}

/// `cycles`: the cycles of every mesh of a run-up, one row a cycle.
pub(super) fn cycles(file: &Gearbox, run_ups: &[RunUp]) -> Table {
    cycles_of_meshes(file.meshes.iter().map(|mesh| mesh.name.as_str()).zip(run_ups))
}

/// `motion_orders`: what every order of every mesh does along a motion, one row an order over a stretch.
pub(super) fn orders(file: &Gearbox, orders: &[MotionOrder]) -> Table {
    let table = Table::new("motion_orders").numbers("time_s", "middle of the interval", orders.iter().map(|o| o.time));
    let rows = orders.iter().map(|o| (o.speed.abs(), o.mesh, o.order, o.frequency));
    let mut table = which(table, rows);
    for i in 0..file.meshes.len() {
        let errors = orders.iter().map(|o| 1e3 * o.transmission_errors[i]);
        table.push_numbers(
            format!("mesh_{}_dte_um", i + 1),
            "amplitude (peak) of the order in the dynamic transmission error",
            errors,
        );
        let forces = orders.iter().map(|o| o.mesh_forces[i]);
        table.push_numbers(
            format!("mesh_{}_normal_force_n", i + 1),
            "amplitude (peak) of the order in the normal force",
            forces,
        );
    }
    for i in 0..file.bearings.len() {
        let forces = orders.iter().map(|o| o.bearing_forces[i]);
        table.push_numbers(
            format!("bearing_{}_force_n", i + 1),
            "amplitude (peak) of the order in the bearing force, x, y, z together",
            forces,
        );
    }
    table
}

/// `waterfall`: spectra of a motion whose speed is led from one to another.
pub(super) fn waterfall(file: &Gearbox, of: &Waterfall) -> Table {
    let quantities = quantities(file);
    let of_gearbox = WaterfallOf {
        speed: ["input_rpm", "mean speed of the input over the interval"],
        order: "order of the frequency of the fastest mesh",
        quantities: &quantities,
    };
    motion_files::waterfall(of, of_gearbox)
}

/// `spectrum`: lines of a motion whose speed is not led.
pub(super) fn spectrum(file: &Gearbox, of: &MotionSpectrum) -> Table {
    motion_files::spectrum(of, quantities(file))
}

/// Columns of spectra: of each mesh, then of each bearing.
fn quantities(file: &Gearbox) -> Vec<(String, &'static str)> {
    let mesh = |i: usize| {
        [
            (format!("mesh_{i}_dte_um"), "single-sided amplitude of the dynamic transmission error"),
            (format!("mesh_{i}_normal_force_n"), "single-sided amplitude of the normal force"),
        ]
    };
    let bearing =
        |i: usize| (format!("bearing_{i}_force_n"), "single-sided amplitude of the bearing force, x, y, z together");
    let meshes = (1..=file.meshes.len()).flat_map(mesh);
    meshes.chain((1..=file.bearings.len()).map(bearing)).collect()
}
