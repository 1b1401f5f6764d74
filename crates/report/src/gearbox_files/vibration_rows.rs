//! Natural motions of a gearbox and what mesh orders do to it, as tables and as a universal file.

use std::f64::consts::TAU;

use analysis::{
    gearbox::{GearboxCampbell, VibrationResult},
    motion::RPM,
};
use answer::Table;
use gearbox::{Component, OrderForces, WhirlMode};
use scene::gearbox::Gearbox;

use export::universal::{Function, Response, universal_file};

/// `modes`: natural motions at the first and the last speed, a row each.
pub(super) fn modes(file: &Gearbox, swings: &VibrationResult) -> Table {
    let speeds = &swings.campbell.diagram.speeds;
    let ends = [0, swings.modes.len().saturating_sub(1)];
    let ends = if ends[0] == ends[1] { &ends[..1] } else { &ends[..] };
    let rows: Vec<(f64, usize, &WhirlMode)> = (ends.iter())
        .filter_map(|&at| Some((60.0 * speeds.get(at)?, swings.modes.get(at)?)))
        .flat_map(|(speed, found)| found.modes.iter().enumerate().map(move |(i, mode)| (speed, i + 1, mode)))
        .collect();
    let mut table = Table::new("modes")
        .numbers("input_rpm", "speed of the input", rows.iter().map(|r| r.0))
        .numbers("mode", "number of the mode, ascending in frequency", rows.iter().map(|r| r.1 as f64))
        .numbers("frequency_hz", "natural frequency, undamped", rows.iter().map(|r| r.2.frequency / TAU));
    for i in 0..file.shafts.len() {
        let meaning = "direction of whirl: +1 forward on circles, -1 backward, 0 in a plane";
        table.push_numbers(format!("shaft_{}_whirl", i + 1), meaning, rows.iter().map(|r| r.2.whirl[i]));
    }
    let elastic = swings.gear_modes.iter().any(Option::is_some);
    for (name, component, strain) in parts(file, elastic) {
        let meaning = if strain {
            "share of the strain energy of the mode; all add up to 1"
        } else {
            "share of the kinetic energy of the mode; all add up to 1"
        };
        table.push_numbers(name, meaning, rows.iter().map(|r| share(r.2, component, strain)));
    }
    table
}

/// Columns of the shares of energy: name, part, and whether it is strain; of gears strain where they are `elastic`.
fn parts(file: &Gearbox, elastic: bool) -> Vec<(String, Component, bool)> {
    let each = |count: usize, name: &'static str, of: fn(usize) -> Component, strain: bool| {
        let what = if strain { "strain_share" } else { "kinetic_share" };
        (0..count).map(move |i| (format!("{name}_{}_{what}", i + 1), of(i), strain))
    };
    let strain = each(file.shafts.len(), "shaft", Component::Shaft, true)
        .chain(each(file.bearings.len(), "bearing", Component::Bearing, true))
        .chain(each(file.meshes.len(), "mesh", Component::Mesh, true))
        .chain([("housing_strain_share".to_owned(), Component::Housing, true)])
        // Gears that are rigid beside their teeth have none.
        .chain(each(if elastic { file.gears.len() } else { 0 }, "gear", Component::Body, true));
    let kinetic = each(file.shafts.len(), "shaft", Component::Shaft, false)
        .chain(each(file.gears.len(), "gear", Component::Disc, false))
        .chain([("input_kinetic_share".to_owned(), Component::Machine(0), false)])
        .chain(each(file.torques.len(), "output", |i| Component::Machine(i + 1), false));
    strain.chain(kinetic).collect()
}

/// Share of a part in a mode, 0 where it has none.
fn share(mode: &WhirlMode, component: Component, strain: bool) -> f64 {
    let all = if strain { &mode.energy.strain } else { &mode.energy.kinetic };
    all.iter().find(|s| s.component == component).map_or(0.0, |s| s.share)
}

/// `campbell`: natural frequencies and lines of excitation, one row a speed.
pub(super) fn campbell(GearboxCampbell { diagram, lines }: &GearboxCampbell) -> Table {
    let mut table =
        Table::new("campbell").numbers("input_rpm", "speed of the input", diagram.speeds.iter().map(|s| 60.0 * s));
    for (m, mode) in diagram.frequencies.iter().enumerate() {
        table.push_numbers(format!("mode_{}_hz", m + 1), "natural frequency", mode.iter().copied());
    }
    for (line, order) in lines.iter().zip(&diagram.orders) {
        let along = diagram.speeds.iter().map(|speed| order * speed);
        table.push_numbers(format!("{}_hz", line.name), "line of excitation", along);
    }
    table
}

/// `crossings`: where a line of excitation meets a natural frequency, ascending in speed.
pub(super) fn crossings(GearboxCampbell { diagram, lines }: &GearboxCampbell) -> Table {
    let all = &diagram.resonances;
    let line = |order: f64| lines.iter().find(|l| l.order == order).map_or("", |l| l.name.as_str());
    Table::new("crossings")
        .numbers("input_rpm", "speed of the input", all.iter().map(|m| 60.0 * m.speed))
        .numbers("frequency_hz", "frequency of both lines", all.iter().map(|m| m.frequency))
        .numbers("mode", "number of the mode", all.iter().map(|m| (m.mode + 1) as f64))
        .texts("line", "line of excitation", all.iter().map(|m| line(m.order)))
}

/// Components of a bearing's load: name, and unit of the column.
const COMPONENTS: [(&str, &str); 6] = [
    ("force_x", "n"),
    ("force_y", "n"),
    ("force_z", "n"),
    ("moment_x", "nmm"),
    ("moment_y", "nmm"),
    ("moment_z", "nmm"),
];

/// Which order of which mesh a row tells of: speed (rad/s), mesh from 0, order, frequency (Hz).
pub(super) fn which(table: Table, rows: impl Iterator<Item = (f64, usize, usize, f64)> + Clone) -> Table {
    table
        .numbers("input_rpm", "speed of the input", rows.clone().map(|r| r.0 / RPM))
        .numbers("exciting_mesh", "number of the mesh that excites", rows.clone().map(|r| (r.1 + 1) as f64))
        .numbers("exciting_order", "order of its mesh frequency", rows.clone().map(|r| r.2 as f64))
        .numbers("frequency_hz", "frequency of the order", rows.map(|r| r.3))
}

/// Every order of every mesh, speed after speed.
fn each_order(swings: &VibrationResult) -> impl Iterator<Item = (f64, &OrderForces)> + Clone {
    swings.speeds.iter().zip(&swings.orders).flat_map(|(speed, orders)| orders.iter().map(move |own| (*speed, own)))
}

fn with_orders(name: &'static str, swings: &VibrationResult) -> Table {
    which(Table::new(name), each_order(swings).map(|(speed, own)| (speed, own.mesh, own.order, own.frequency_hz)))
}

/// `response`: the dynamic normal force of every mesh under every order of every mesh.
pub(super) fn response(file: &Gearbox, swings: &VibrationResult) -> Table {
    let mut table = with_orders("response", swings);
    for i in 0..file.meshes.len() {
        let name = format!("mesh_{}_dynamic_force", i + 1);
        let forces = || each_order(swings).map(|(_, own)| own.mesh_forces[i]);
        table.push_numbers(
            format!("{name}_n"),
            "amplitude of the dynamic normal force, peak of Re(x exp(i w t))",
            forces().map(|f| f.norm()),
        );
        table.push_numbers(
            format!("{name}_phase_deg"),
            "phase of the dynamic normal force, with the input at its start at t = 0",
            forces().map(|f| f.arg().to_degrees()),
        );
    }
    table
}

/// `bearing_forces`: forces of the bearings on the housing under every order of every mesh.
pub(super) fn bearing_forces(file: &Gearbox, swings: &VibrationResult) -> Table {
    let mut table = with_orders("bearing_forces", swings);
    for i in 0..file.bearings.len() {
        for (k, (what, unit)) in COMPONENTS.into_iter().enumerate() {
            let name = format!("bearing_{}_housing_{what}", i + 1);
            let forces = || each_order(swings).map(|(_, own)| own.bearing_forces[i][k]);
            table.push_numbers(
                format!("{name}_{unit}"),
                "amplitude of the load on the housing, peak of Re(x exp(i w t))",
                forces().map(|f| f.norm()),
            );
            table.push_numbers(
                format!("{name}_phase_deg"),
                "phase of the load on the housing, with the input at its start at t = 0",
                forces().map(|f| f.arg().to_degrees()),
            );
        }
    }
    table
}

/// `rms`: all orders together, one row a speed.
pub(super) fn rms(file: &Gearbox, swings: &VibrationResult) -> Table {
    let mut table = Table::new("rms").numbers("input_rpm", "speed of the input", swings.speeds.iter().map(|s| s / RPM));
    for i in 0..file.meshes.len() {
        let meaning = "root mean square of the dynamic normal force, all orders of all meshes";
        let forces = swings.rms.iter().map(|own| own.mesh_forces[i]);
        table.push_numbers(format!("mesh_{}_dynamic_force_rms_n", i + 1), meaning, forces);
    }
    for i in 0..file.bearings.len() {
        let meaning = "root mean square of the force on the housing, x, y, z and all orders of all meshes together";
        let forces = swings.rms.iter().map(|own| own.bearing_forces[i]);
        table.push_numbers(format!("bearing_{}_housing_force_rms_n", i + 1), meaning, forces);
    }
    table
}

/// `bearing_forces.uff`: the same forces, a function for each component of each bearing and each order of each mesh.
pub(super) fn universal(file: &Gearbox, swings: &VibrationResult) -> String {
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
