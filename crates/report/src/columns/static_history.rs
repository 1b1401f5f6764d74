//! `history.csv`: one row a position.

use std::f64::consts::PI;

use ltca::StaticHistory;

use scene::Scene;

use crate::{
    csv::push_row,
    results::{
        MAX_PRINCIPAL, Measure, PLACE_COLUMNS, VON_MISES, base_radius_mm, pairs, place_values, root_stress_columns,
        root_stress_row,
    },
};

const LEADING: &[&str] = &[
    "time_s",
    "pinion_angle_deg",
    "mesh_phase",
    "ste_um",
    "kinematic_te_um",
    "mesh_stiffness_n_per_um",
    "mesh_stiffness_tangent_n_per_um",
    "contact_line_length_mm",
    "geometric_line_length_mm",
    "pairs_in_contact",
];
const WRENCH: &[&str] = &["force_x_n", "force_y_n", "force_z_n", "moment_x_nmm", "moment_y_nmm", "moment_z_nmm"];
const PRESSURE: &str = "max_pressure_mpa";
const TRAILING: &[&str] = &[
    "strain_energy_nmm",
    "friction_power_loss_w",
    "tooth_changes",
    "torque_residual",
    "complementarity_residual",
    "action_reaction_residual",
    "window_edge_load",
    "iterations",
];

const GEARS: [&str; 2] = ["pinion", "wheel"];
/// Root stresses that have a column for every pair.
const BY_PAIR: [Measure; 2] = [MAX_PRINCIPAL, VON_MISES];

/// The history as CSV: one header row, a unit in every name, numbers that read back to the same bits.
///
/// Time starts with the first position. `NaN` stands where a quantity has no value (stiffness without load).
pub fn write_history(scene: &Scene, history: &StaticHistory) -> String {
    let pitch = 2.0 * PI / f64::from(scene.pinion.teeth);
    let columns = pairs::columns(history, pitch);
    let mut csv = history_columns(scene, &columns).join(",");
    csv.push('\n');
    let start = history.positions.first().map_or(0.0, |p| p.pinion_angle);
    for p in &history.positions {
        let mut row = vec![
            (p.pinion_angle - start) / scene.pinion_speed(),
            p.pinion_angle.to_degrees(),
            p.mesh_phase,
            p.transmission_error * 1e3,
            p.kinematic_transmission_error * 1e3,
            p.secant_stiffness * 1e-3,
            p.tangent_stiffness * 1e-3,
            p.contact_line_length,
            p.geometric_line_length,
            p.pairs.iter().filter(|pair| pair.normal_force > 0.0).count() as f64,
        ];
        for wrench in &p.wrench {
            row.extend(wrench.force);
            row.extend(wrench.moment);
        }
        row.extend(columns.iter().map(|&k| pairs::force(p, k, pitch)));
        let c = &p.certificate;
        row.push(p.max_pressure);
        if scene.has_slices() {
            row.extend(place_values(base_radius_mm(scene, 0), p.pairs.iter().flat_map(|pair| &pair.slices)));
        }
        row.extend([
            p.strain_energy,
            1e-3 * p.friction_work * scene.pinion_speed(),
            p.tooth_changes as f64,
            c.torque_residual,
            c.complementarity_residual,
            c.action_reaction_residual,
            c.window_edge_load,
            c.iterations as f64,
        ]);
        if scene.output.root_stress {
            row.extend(p.root_stress.iter().flat_map(|of| root_stress_row(of)));
            for (gear, &k) in (0..2).flat_map(|gear| columns.iter().map(move |k| (gear, k))) {
                let tooth = pairs::teeth(p, k, pitch).map(|teeth| teeth[gear]);
                row.extend(
                    BY_PAIR.map(|m| tooth.map_or(f64::NAN, |tooth| m.stress(&p.root_stress[gear], Some(tooth)))),
                );
            }
        }
        push_row(&mut csv, row);
    }
    csv
}

/// Names of the columns for the pairs with these numbers.
pub fn history_columns(scene: &Scene, pairs: &[i64]) -> Vec<String> {
    let mut names: Vec<String> = LEADING.iter().map(|&n| n.to_owned()).collect();
    for gear in GEARS {
        names.extend(WRENCH.iter().map(|n| format!("{gear}_{n}")));
    }
    names.extend(pairs.iter().map(|k| format!("normal_force_pair_{k}_n")));
    names.push(PRESSURE.to_owned());
    if scene.has_slices() {
        names.extend(PLACE_COLUMNS.map(str::to_owned));
    }
    names.extend(TRAILING.iter().map(|&n| n.to_owned()));
    if scene.output.root_stress {
        for gear in GEARS {
            names.extend(root_stress_columns(gear));
        }
        for (gear, k) in GEARS.iter().flat_map(|gear| pairs.iter().map(move |k| (gear, k))) {
            names.extend(BY_PAIR.iter().map(|m| format!("{gear}_root_stress_{}_pair_{k}_mpa", m.name)));
        }
    }
    names
}
