//! A gearbox in motion as a file, as numbers of the summary and as lines of the closing table.

use std::f64::consts::TAU;
use std::fmt::Write;

use analysis::gearbox_at_rest::{GearboxMotionResult, GearboxResult};
use gearbox::motion::GearboxInstant;
use scene::gearbox::Gearbox;
use serde_json::{Value, json};

use crate::{csv::push_row, tables::fixed};

/// A column: its name, and its value at an instant.
type Column = (String, Box<dyn Fn(&GearboxInstant) -> f64>);

const PER_MINUTE: f64 = 60.0 / TAU;

/// Columns of `motion.csv`. Meshes, bearings and outputs are numbered from 1 in the order of the file.
fn columns(file: &Gearbox) -> Vec<Column> {
    let mut all: Vec<Column> = vec![
        ("time_s".into(), Box::new(|p| p.time)),
        ("input_angle_deg".into(), Box::new(|p| p.input[0].to_degrees())),
        ("input_speed_rpm".into(), Box::new(|p| PER_MINUTE * p.input[1])),
        ("input_torque_nm".into(), Box::new(|p| 1e-3 * p.input_torque)),
    ];
    let mut push = |name: String, of: Box<dyn Fn(&GearboxInstant) -> f64>| all.push((name, of));
    for i in 0..file.torques.len() {
        push(format!("output_{}_speed_rpm", i + 1), Box::new(move |p| PER_MINUTE * p.output_speeds[i]));
    }
    for i in 0..file.meshes.len() {
        let name = |what: &str| format!("mesh_{}_{what}", i + 1);
        push(name("cycles"), Box::new(move |p| p.meshes[i].cycles));
        push(name("dte_um"), Box::new(move |p| 1e3 * p.meshes[i].transmission_error));
        push(name("normal_force_n"), Box::new(move |p| p.meshes[i].normal_force));
    }
    for i in 0..file.bearings.len() {
        for (k, axis) in ["x", "y", "z"].into_iter().enumerate() {
            push(format!("bearing_{}_force_{axis}_n", i + 1), Box::new(move |p| p.bearings[i].force[k]));
        }
        for (k, axis) in ["x", "y", "z"].into_iter().enumerate() {
            push(format!("bearing_{}_moment_{axis}_nmm", i + 1), Box::new(move |p| p.bearings[i].moment[k]));
        }
    }
    all
}

/// `motion.csv`: one row an instant.
pub(super) fn motion(file: &Gearbox, result: &GearboxMotionResult) -> String {
    let columns = columns(file);
    let mut csv = columns.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>().join(",") + "\n";
    for instant in &result.rows {
        push_row(&mut csv, columns.iter().map(|(_, of)| of(instant)));
    }
    csv
}

/// Least and largest value of the second half of a motion: what settles is in the first.
fn range(result: &GearboxMotionResult, of: impl Fn(&GearboxInstant) -> f64) -> [f64; 2] {
    let settled = &result.rows[result.rows.len() / 2..];
    settled.iter().map(of).fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], x| [l.min(x), h.max(x)])
}

/// What `summary.json` has of it.
pub(super) fn summary(file: &Gearbox, result: &GearboxResult) -> Value {
    let Some(motion) = &result.motion else { return Value::Null };
    let meshes = (0..file.meshes.len()).map(|i| {
        let dte = range(motion, |p| 1e3 * p.meshes[i].transmission_error);
        let force = range(motion, |p| p.meshes[i].normal_force);
        json!({
            "name": result.meshes[i].name,
            "mesh_hz": motion.mesh_frequencies[i],
            "mean_mesh_stiffness_n_per_um": 1e-3 * motion.stiffness[i],
            "mesh_damping_n_s_per_mm": motion.damping[i],
            "peak_to_peak_dte_um": dte[1] - dte[0],
            "min_normal_force_n": force[0],
            "max_normal_force_n": force[1],
            "separations": motion.separations[i][0],
            "coast_separations": motion.separations[i][1],
            "map_use": motion.reach[i],
        })
    });
    let bearings = file.bearings.iter().enumerate().map(|(i, b)| {
        let force = range(motion, |p| p.bearings[i].force[0].hypot(p.bearings[i].force[1]));
        json!({ "name": b.name, "min_radial_force_n": force[0], "max_radial_force_n": force[1] })
    });
    let energy = &motion.energy;
    let reduction = &motion.reduction;
    json!({
        "rows": motion.rows.len(),
        "step_s": motion.step,
        "steps": motion.steps[0],
        "divided_steps": motion.steps[1],
        "meshes": meshes.collect::<Vec<_>>(),
        "bearings": bearings.collect::<Vec<_>>(),
        "energy": {
            "input_work_mj": energy.input_work,
            "output_work_mj": energy.output_work,
            "kinetic_mj": energy.kinetic,
            "shafts_mj": energy.shafts,
            "supports_mj": energy.supports,
            "meshes_mj": energy.meshes,
            "gained_mj": energy.gained,
            "dissipated_mj": energy.dissipated,
            "relative_residual": energy.relative_residual,
            "open_over_vibration": energy.open_over_vibration,
        },
        "reduction": {
            "dof": reduction.coordinates[0],
            "dof_kept": reduction.coordinates[1],
            "kept_modes": reduction.modes,
            "highest_frequency_hz": reduction.limit / TAU,
            "frequencies_compared": reduction.compared,
            "frequency_error": reduction.error,
        },
    })
}

/// Lines of the closing table.
pub(super) fn table(t: &mut String, file: &Gearbox, result: &GearboxResult) {
    let Some(motion) = &result.motion else { return };
    // Writing to a String cannot fail.
    let _ = writeln!(
        t,
        "\n  {:<24} {:>10} {:>10} {:>10} {:>10} {:>9}",
        "in motion", "Hz", "DTE p-p um", "least N", "most N", "lost"
    );
    for (i, mesh) in result.meshes.iter().enumerate().take(file.meshes.len()) {
        let dte = range(motion, |p| 1e3 * p.meshes[i].transmission_error);
        let force = range(motion, |p| p.meshes[i].normal_force);
        let _ = writeln!(
            t,
            "  {:<24} {:>10} {:>10} {:>10} {:>10} {:>9}",
            mesh.name,
            fixed(motion.mesh_frequencies[i], 1),
            fixed(dte[1] - dte[0], 3),
            fixed(force[0], 0),
            fixed(force[1], 0),
            motion.separations[i][0],
        );
    }
    let (energy, reduction) = (&motion.energy, &motion.reduction);
    let _ = writeln!(
        t,
        "  {} steps; energy closes to {:.0e}; {} of {} coordinates, frequencies up to {} Hz to {:.0e}",
        motion.steps[0],
        energy.open_over_vibration,
        reduction.coordinates[1],
        reduction.coordinates[0],
        fixed(reduction.limit / TAU, 0),
        reduction.error,
    );
}
