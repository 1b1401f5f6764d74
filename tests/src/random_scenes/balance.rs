//! Forces, moments and energy of a result, put together again from its columns.

use super::{Csv, case::Case, csv::largest};

/// Sum of forces, of moments about one point and of torques, over the largest of them.
const BALANCE: f64 = 1e-6;
/// Rows of energy: they are sums of many steps.
const LEDGER: f64 = 1e-6;
/// Round-off of places over places.
const ROUND_OFF: f64 = 64.0 * f64::EPSILON;
/// Force below zero over the largest.
const PULL: f64 = 1e-6;

fn size(v: [f64; 3]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// Forces on both gears sum to zero; at rest their moments about one point do so, too.
pub fn equilibrium(case: &Case<'_>) -> Vec<String> {
    let both = |what: &str, unit: &str| {
        let [pinion, wheel] = ["pinion", "wheel"].map(|gear| case.history.vectors(&format!("{gear}_{what}"), unit));
        Some((pinion?, wheel?))
    };
    let (Some(force), Some(moment)) = (both("force", "n"), both("moment", "nmm")) else { return Vec::new() };
    let mut wrong = Vec::new();
    // Seen along the two springs of that law, the forces are not those of one contact.
    let projected = case.inputs["lumped8"]["law"] == "projected";
    for (row, (a, b)) in force.0.iter().zip(&force.1).enumerate() {
        let sum = [0, 1, 2].map(|i| a[i] + b[i]);
        if size(sum) > BALANCE * size(*a).max(size(*b)) && !projected {
            wrong.push(format!("row {row}: forces on both gears sum to {sum:?} N of {a:?}"));
            break;
        }
    }
    let Some(distance) = case.summary["geometry"]["centre_distance_mm"].as_f64().filter(|_| case.is_static()) else {
        return wrong;
    };
    // Moments of a gear are about its own mid-face.
    let up = case.inputs["pair"]["mid_face_offset_mm"].as_f64().unwrap_or(0.0);
    for (row, (a, b)) in moment.0.iter().zip(&moment.1).enumerate() {
        let f = force.1[row];
        let sum = [a[0] + b[0] - up * f[1], a[1] + b[1] - distance * f[2] + up * f[0], a[2] + b[2] + distance * f[1]];
        if size(sum) > BALANCE * (distance * size(f)).max(size(*a)).max(size(*b)) {
            wrong.push(format!("row {row}: moments about the pinion's centre sum to {sum:?} N mm of {a:?}"));
            break;
        }
    }
    wrong
}

/// At rest the flanks balance the torque on the driven gear.
pub fn torque(case: &Case<'_>) -> Vec<String> {
    let torque = 1e3 * case.inputs["operation"]["torque_nm"].as_f64().unwrap_or(f64::NAN);
    // A ring turns as its pinion does.
    let ring = case.inputs["wheel"]["teeth"].as_f64().is_some_and(|teeth| teeth < 0.0);
    let wheel = if ring { 1.0 } else { -1.0 };
    let (driven, turns) = if case.word("operation", "driver") == "wheel" { ("pinion", 1.0) } else { ("wheel", wheel) };
    let sense = if case.word("operation", "rotation") == "cw" { -1.0 } else { 1.0 };
    let Some(moment) = case.history.column(&format!("{driven}_moment_z_nmm")) else { return Vec::new() };
    let wanted = turns * sense * torque;
    // The torque is about the gear's own axis, the column about that of the frame.
    let leans: f64 = case.inputs["pair"]["misalignment"].as_object().map_or(0.0, |parts| {
        let width = case.inputs["pair"]["face_width_mm"].as_f64().unwrap_or(1.0);
        parts.values().filter_map(serde_json::Value::as_f64).map(|um| 1e-3 * um.abs() / width).sum()
    });
    let across = case.history.vectors(&format!("{driven}_moment"), "nmm").unwrap_or_default();
    let leaned = |row: usize| across.get(row).map_or(0.0, |m| leans * (m[0].hypot(m[1]) + leans * m[2].abs()));
    // A difference that is no number is off as well.
    let held = |row: usize| (moment[row] - wanted).abs() <= BALANCE * torque + 2.0 * leaned(row);
    let off = (0..moment.len()).find(|&row| !held(row));
    off.map(|row| format!("row {row}: {} N mm turn the {driven}, {wanted} N mm are wanted", moment[row]))
        .into_iter()
        .collect()
}

/// No flank pulls, no length or pressure is below zero.
pub fn pull(case: &Case<'_>) -> Vec<String> {
    // A linear mesh pulls, and says so.
    let linear = ["lumped8", "lumped12", "shaft18"].contains(&case.word("analysis", "model"));
    let never_below = |name: &str| {
        name.starts_with("normal_force_pair_")
            || name == "contact_line_length_mm"
            || name == "max_pressure_mpa"
            || name == "strain_energy_nmm"
            || name == "mesh_stiffness_tangent_n_per_um"
            || (name == "coast_normal_force_n" || name == "normal_force_n") && !linear
    };
    let mut wrong = Vec::new();
    for name in case.history.names.iter().filter(|n| never_below(n)) {
        let Some(column) = case.history.column(name) else { continue };
        let most = largest(&column);
        if let Some(row) = column.iter().position(|v| *v < -PULL * most) {
            wrong.push(format!("row {row}: {name} is {}, largest {most}", column[row]));
        }
    }
    wrong
}

/// Energy closes from row to row; dampers and friction take it away, and never give.
pub fn ledger(case: &Case<'_>, energy: &Csv) -> Vec<String> {
    let column = |name: &str| energy.column(name);
    let (Some(kinetic), Some(elastic), Some(supplied), Some(parametric), Some(dissipated), Some(residual)) = (
        column("kinetic_mj"),
        column("elastic_mj"),
        column("supplied_mj"),
        column("parametric_mj"),
        column("dissipated_mj"),
        column("residual_mj"),
    ) else {
        return vec![format!("energy.csv has the columns {:?}", energy.names)];
    };
    let all = [&kinetic, &elastic, &supplied, &parametric, &dissipated, &residual];
    if let Some(bad) = all.iter().flat_map(|c| c.iter()).find(|v| !v.is_finite()) {
        return vec![format!("energy.csv holds {bad}")];
    }
    let scale = all.iter().map(|c| largest(c)).fold(0.0, f64::max);
    // Work is a force times places that are known to round-off only; what is dissipated is no better than the rest.
    let teeth = |gear: &str| case.inputs[gear]["teeth"].as_f64().unwrap_or(0.0).abs();
    let turned = case.inputs["operation"]["torque_nm"].as_f64().unwrap_or(0.0) * 1e3;
    let floor = ROUND_OFF * turned.abs() * (teeth("pinion") + teeth("wheel"));
    let closed = |i: usize| kinetic[i] + elastic[i] - supplied[i] - parametric[i] + dissipated[i] - residual[i];
    let mut wrong = Vec::new();
    let open = (1..kinetic.len()).find(|&i| (closed(i) - closed(i - 1)).abs() > LEDGER * scale + floor);
    wrong.extend(open.map(|i| format!("energy.csv: row {i} does not close by {} mJ", closed(i) - closed(i - 1))));
    let round_off = LEDGER * scale + floor + largest(&residual);
    let given = dissipated.windows(2).position(|w| w[1] < w[0] - round_off);
    let below = dissipated.iter().position(|d| *d < -round_off);
    wrong.extend(below.map(|i| format!("energy.csv: {} mJ are dissipated in row {i}", dissipated[i])));
    wrong.extend(given.map(|i| format!("energy.csv: dampers or friction give energy from row {i} on")));
    wrong
}
