//! What mesh orders do to meshes and bearings, as files with commas and as a universal file.

use analysis::{gearbox_at_rest::GearboxSwings, motion::RPM};
use scene::gearbox::Gearbox;
use study::Columns;

use crate::{
    columns_to_csv,
    universal::{Function, Response, universal_file},
};

/// Components of a bearing's load: name, and unit of the column.
const COMPONENTS: [(&str, &str); 6] = [
    ("force_x", "n"),
    ("force_y", "n"),
    ("force_z", "n"),
    ("moment_x", "nmm"),
    ("moment_y", "nmm"),
    ("moment_z", "nmm"),
];

/// Columns that say which order of which mesh a row tells of.
pub(super) const WHICH: [&str; 4] = ["input_rpm", "exciting_mesh", "exciting_order", "frequency_hz"];

/// Rows of every order of every mesh, speed after speed.
fn each_order<const N: usize>(
    swings: &GearboxSwings,
    names: Vec<String>,
    values: impl Fn(&analysis::gearbox_at_rest::OrderForces) -> Vec<[f64; N]>,
) -> String {
    let mut rows = Columns::named(WHICH.map(str::to_owned).into_iter().chain(names));
    for (speed, orders) in swings.speeds.iter().zip(&swings.orders) {
        for own in orders {
            let which = [speed / RPM, (own.mesh + 1) as f64, own.order as f64, own.frequency_hz];
            rows.push(which.into_iter().chain(values(own).into_iter().flatten()));
        }
    }
    columns_to_csv(&rows)
}

/// `response.csv`: the dynamic normal force of every mesh under every order of every mesh.
pub(super) fn response(file: &Gearbox, swings: &GearboxSwings) -> String {
    let names = (1..=file.meshes.len())
        .flat_map(|i| [format!("mesh_{i}_dynamic_force_n"), format!("mesh_{i}_dynamic_force_phase_deg")]);
    each_order(swings, names.collect(), |own| {
        own.mesh_forces.iter().map(|f| [f.norm(), f.arg().to_degrees()]).collect()
    })
}

/// `bearing_forces.csv`: forces of the bearings on the housing under every order of every mesh.
pub(super) fn bearing_forces(file: &Gearbox, swings: &GearboxSwings) -> String {
    let names = (1..=file.bearings.len()).flat_map(|i| {
        COMPONENTS.into_iter().flat_map(move |(what, unit)| {
            [format!("bearing_{i}_housing_{what}_{unit}"), format!("bearing_{i}_housing_{what}_phase_deg")]
        })
    });
    each_order(swings, names.collect(), |own| {
        own.bearing_forces.iter().flatten().map(|f| [f.norm(), f.arg().to_degrees()]).collect()
    })
}

/// `rms.csv`: all orders together, one row a speed.
pub(super) fn rms(file: &Gearbox, swings: &GearboxSwings) -> String {
    let meshes = (1..=file.meshes.len()).map(|i| format!("mesh_{i}_dynamic_force_rms_n"));
    let bearings = (1..=file.bearings.len()).map(|i| format!("bearing_{i}_housing_force_rms_n"));
    let mut rows = Columns::named(std::iter::once("input_rpm".to_owned()).chain(meshes).chain(bearings));
    for (speed, own) in swings.speeds.iter().zip(&swings.rms) {
        let values = own.mesh_forces.iter().chain(&own.bearing_forces).copied();
        rows.push(std::iter::once(speed / RPM).chain(values));
    }
    columns_to_csv(&rows)
}

/// `bearing_forces.uff`: the same forces, a function for each component of each bearing and each order of each mesh.
pub(super) fn universal(file: &Gearbox, swings: &GearboxSwings) -> String {
    let Some(orders) = swings.orders.first() else { return universal_file(&[]) };
    let mut functions = Vec::new();
    for (place, order) in orders.iter().enumerate() {
        for (i, bearing) in file.bearings.iter().enumerate() {
            for (k, (what, _)) in COMPONENTS.into_iter().enumerate() {
                let own = || swings.orders.iter().map(move |all| &all[place]);
                let ends = [own().next(), own().next_back()].map(|o| o.map_or(0.0, |o| o.frequency_hz));
                let steps = swings.orders.len().saturating_sub(1).max(1) as f64;
                let mesh = &file.meshes[order.mesh].name;
                functions.push(Function {
                    words: vec![
                        format!("{}: {what} on the housing, common axes", bearing.name),
                        format!("order {} of mesh {} ({mesh})", order.order, order.mesh + 1),
                        "peak of Re(x exp(i w t)), t = 0 where the input is at its start".to_owned(),
                        format!("input {} to {} 1/min", rpm(swings.speeds.first()), rpm(swings.speeds.last())),
                        file.name.clone(),
                    ],
                    number: functions.len() + 1,
                    response: Response { name: format!("BEARING{}", i + 1), node: i + 1, direction: k as u8 + 1 },
                    frequencies_hz: [ends[0], (ends[1] - ends[0]) / steps],
                    values: own().map(|o| [o.bearing_forces[i][k].re, o.bearing_forces[i][k].im]).collect(),
                });
            }
        }
    }
    universal_file(&functions)
}

fn rpm(speed: Option<&f64>) -> f64 {
    // Speeds of the file to the digits that it has them with.
    speed.map_or(0.0, |s| (s / RPM * 1e6).round() / 1e6)
}
