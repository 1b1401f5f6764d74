//! `motion_orders.csv`: what every order of every mesh does along a motion.

use analysis::{gearbox_at_rest::MotionOrder, motion::RPM};
use scene::gearbox::Gearbox;
use study::Columns;

use super::response::WHICH;
use crate::columns_to_csv;

/// One row an order of a mesh over a stretch of the motion.
pub(super) fn motion_orders(file: &Gearbox, orders: &[MotionOrder]) -> String {
    let meshes = (1..=file.meshes.len()).flat_map(|i| [format!("mesh_{i}_dte_um"), format!("mesh_{i}_normal_force_n")]);
    let bearings = (1..=file.bearings.len()).map(|i| format!("bearing_{i}_force_n"));
    let first = std::iter::once("time_s").chain(WHICH).map(str::to_owned);
    let mut rows = Columns::named(first.chain(meshes).chain(bearings));
    for own in orders {
        let which = [own.time, own.speed.abs() / RPM, (own.mesh + 1) as f64, own.order as f64, own.frequency];
        let of_meshes = own.transmission_errors.iter().zip(&own.mesh_forces).flat_map(|(te, f)| [1e3 * te, *f]);
        rows.push(which.into_iter().chain(of_meshes).chain(own.bearing_forces.iter().copied()));
    }
    columns_to_csv(&rows)
}
