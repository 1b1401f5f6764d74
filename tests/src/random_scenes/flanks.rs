//! Micro-geometry: every term of it, on both flanks of a tooth or on one.

use geometry::Side;

use super::{Draft, gears::Sizes};

/// Terms of flanks for some of the gears.
pub fn draw_modifications(d: &mut Draft, sizes: &Sizes) {
    for (i, gear) in ["pinion", "wheel"].into_iter().enumerate() {
        if !d.chance(0.6) {
            continue;
        }
        for flank in ["", "drive.", "coast."] {
            if d.chance(if flank.is_empty() { 0.7 } else { 0.3 }) {
                one_flank(d, sizes, i, &format!("{gear}.modification.{flank}"), gear);
            }
        }
    }
}

fn amount(d: &mut Draft) -> f64 {
    let size = d.mostly_log([1.0, 60.0], [0.01, 1000.0]);
    if d.chance(0.15) { -size } else { size }
}

fn one_flank(d: &mut Draft, sizes: &Sizes, i: usize, table: &str, gear: &str) {
    for key in ["profile_crowning_um", "profile_slope_um", "lead_crowning_um", "lead_slope_um", "bias_um"] {
        if d.chance(0.3) {
            let value = amount(d);
            d.set(&format!("{table}{key}"), value);
        }
    }
    if d.chance(0.35) {
        relief(d, sizes, i, &format!("{table}tip_relief"), [0.4, 0.9]);
    }
    if d.chance(0.25) {
        relief(d, sizes, i, &format!("{table}root_relief"), [0.1, 0.5]);
    }
    let mut ends = 0;
    for end in ["lower", "upper"] {
        if d.chance(0.25) {
            ends += 1;
            let (depth, length) = (amount(d), sizes.width * d.mostly([0.05, 0.5], [0.001, 1.0]));
            d.set(&format!("{table}end_relief_{end}_um"), depth);
            d.set(&format!("{table}end_relief_{end}_length_mm"), length.max(1e-3).min(sizes.width.max(1e-3)));
        }
    }
    if ends > 0 && d.chance(0.5) {
        let shape = d.pick(&["linear", "parabolic"]);
        d.set(&format!("{table}end_relief_shape"), shape);
    }
    let Some(pair) = &sizes.pair else { return };
    let flank = [&pair.pinion, &pair.wheel][i].flank(Side::Left);
    let [low, high] = [flank.roll_form, flank.roll_tip];
    let radius = |roll: f64| [&pair.pinion, &pair.wheel][i].base_radius() * roll.hypot(1.0);
    if d.chance(0.15) {
        let at = low + (high - low) * d.mostly([0.0, 0.3], [-0.1, 1.1]);
        d.set(&format!("{table}evaluation_start_diameter_mm"), (2.0 * radius(at)).clamp(0.01, 1e5));
    }
    if d.chance(0.12) {
        let name = format!("{gear}_topography_{}.csv", d.files.len());
        let grid = topography(d, [2.0 * radius(low), 2.0 * radius(high)], sizes.width);
        d.files.push((name.clone(), grid));
        d.set(&format!("{table}topography"), name);
    }
}

fn relief(d: &mut Draft, sizes: &Sizes, i: usize, key: &str, [from, to]: [f64; 2]) {
    let depth = amount(d);
    let share = if d.chance(0.9) { d.between(from, to) } else { d.between(-0.2, 1.2) };
    let start = match &sizes.pair {
        None => [25.0, sizes.reference[i]],
        Some(pair) => {
            let gear = [&pair.pinion, &pair.wheel][i];
            let flank = gear.flank(Side::Left);
            let roll = flank.roll_form + share * (flank.roll_tip - flank.roll_form);
            [roll.to_degrees().clamp(0.0, 360.0), (2.0 * gear.base_radius() * roll.hypot(1.0)).clamp(0.01, 1e5)]
        }
    };
    d.set(&format!("{key}_um"), depth);
    if d.chance(0.5) {
        d.set(&format!("{key}_start_roll_deg"), start[0]);
    } else {
        d.set(&format!("{key}_start_diameter_mm"), start[1]);
    }
    if d.chance(0.5) {
        let shape = d.pick(&["linear", "parabolic"]);
        d.set(&format!("{key}_shape"), shape);
    }
}

/// Depths over diameters (mm) and heights, a little inside of the flank or beyond it.
fn topography(d: &mut Draft, [low, high]: [f64; 2], width: f64) -> String {
    let (rows, columns) = (d.whole(2, 5), d.whole(2, 5));
    let reach = d.mostly([0.8, 1.0], [0.3, 1.2]);
    let place = |k: u32, n: u32| (2.0 * f64::from(k) / f64::from(n - 1) - 1.0) * reach;
    let mut text = "# drawn by chance\ndiameter_mm".to_owned();
    for k in 0..columns {
        text += &format!(", {}", 0.5 * width * place(k, columns));
    }
    for r in 0..rows {
        text += &format!("\n{}", 0.5 * (low + high) + 0.5 * (high - low) * place(r, rows));
        for _ in 0..columns {
            text += &format!(", {}", d.between(-5.0, 20.0));
        }
    }
    text + "\n"
}
