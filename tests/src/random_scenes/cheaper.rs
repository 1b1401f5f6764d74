//! The cheaper models: springs with a stiffness over the mesh cycle, shafts, impacts.

use super::{Draft, gears::Sizes, model::Asked, motion::SUPPORT};

/// Tables of the model of a scene.
pub fn draw_cheaper(d: &mut Draft, sizes: &Sizes, asked: &Asked) {
    if let Some(from) = asked.from {
        draw_mesh(d, sizes, asked, from);
    }
    match asked.model {
        "lumped8" => draw_lumped8(d),
        "lumped12" => draw_lumped12(d),
        "impact" => draw_impact(d),
        "shaft18" => draw_shafts(d, sizes),
        _ => {}
    }
}

fn draw_mesh(d: &mut Draft, sizes: &Sizes, asked: &Asked, from: &str) {
    if from != "series" || d.chance(0.5) {
        d.set("mesh.stiffness_from", from);
    }
    let mean = (0.014 * sizes.width * 1e3).clamp(1e-6, 1e9) * 1e-3;
    if from == "series" {
        let mean = mean.max(1e-6) * d.mostly_log([5.0, 50.0], [1e-3, 1e5]);
        d.set("mesh.stiffness_n_per_um", mean.clamp(1e-6, 1e9));
        for key in ["stiffness_cos_n_per_um", "stiffness_sin_n_per_um"] {
            if d.chance(0.6) {
                let list: Vec<f64> =
                    (0..d.whole(1, 4)).map(|k| mean * d.between(-0.2, 0.2) / f64::from(k + 1)).collect();
                d.set(&format!("mesh.{key}"), list);
            }
        }
    }
    if from != "reduced" {
        for key in ["error_cos_um", "error_sin_um"] {
            if d.chance(0.4) {
                let list: Vec<f64> = (0..d.whole(1, 3)).map(|_| d.between(-5.0, 5.0)).collect();
                d.set(&format!("mesh.{key}"), list);
            }
        }
    }
    if asked.model != "lumped12" && d.chance(0.4) {
        let half = d.pick(&[0.0, 5.0, 50.0, 1e5]);
        d.set("mesh.half_backlash_um", half);
    }
    if asked.model != "shaft18" && d.chance(0.3) {
        let sharing = d.pick(&["length", "line"]);
        d.set("mesh.line_sharing", sharing);
    }
}

fn draw_lumped8(d: &mut Draft) {
    if d.chance(0.4) {
        let law = d.pick(&["normal", "projected"]);
        d.set("lumped8.law", law);
    }
    if d.chance(0.3) {
        let (rpm, hz) = (d.mostly_log([1.0, 100.0], [1e-3, 1e7]), d.mostly_log([1.0, 1e3], [1e-6, 1e7]));
        d.set("lumped8.speed_fluctuation_rpm", rpm);
        d.set("lumped8.speed_fluctuation_hz", hz);
    }
}

fn draw_lumped12(d: &mut Draft) {
    if d.chance(0.3) {
        let angle = d.between(-360.0, 360.0);
        d.set("lumped12.orientation_deg", angle);
    }
    if d.chance(0.4) {
        let (ratio, from) = (d.mostly([0.0, 0.1], [0.0, 10.0]), d.mostly_log([10.0, 1e3], [1e-6, 1e6]));
        let above = d.log(2.0, 100.0);
        d.set("lumped12.damping_ratio", ratio);
        d.set("lumped12.damping_from_hz", from);
        d.set("lumped12.damping_to_hz", (from * above).min(1e7));
    }
}

fn draw_impact(d: &mut Draft) {
    if d.chance(0.5) {
        let exponent = d.mostly([1.0, 2.0], [1.0, 10.0]);
        d.set("impact.exponent", exponent);
    }
    let ranges = [
        ("stiffness_n_per_mm_to_exponent", [1e4, 1e7], [1e-6, 1e15]),
        ("damping_ns_per_mm", [1.0, 1e3], [1e-3, 1e9]),
        ("damping_depth_mm", [1e-3, 1.0], [1e-9, 1e3]),
        ("static_speed_mm_per_s", [0.01, 1.0], [1e-9, 1e5]),
    ];
    for (key, usual, all) in ranges {
        if d.chance(0.35) {
            let value = d.mostly_log(usual, all);
            d.set(&format!("impact.{key}"), value);
        }
    }
    if d.chance(0.4) {
        let base = d.number("impact.static_speed_mm_per_s").unwrap_or(0.1);
        let (creeps, slips, above) = (d.between(0.0, 0.4), d.between(0.0, 0.3), d.log(2.0, 10.0));
        d.set("impact.static_friction", creeps);
        d.set("impact.dynamic_friction", slips);
        d.set("impact.dynamic_speed_mm_per_s", base * above);
    }
}

fn draw_shafts(d: &mut Draft, sizes: &Sizes) {
    for (key, share, value) in [("mass_damping_per_s", 0.4, [1.0, 1e3]), ("stiffness_damping_s", 0.4, [1e-9, 1e-5])] {
        if d.chance(share) {
            let value = d.log(value[0], value[1]);
            d.set(&format!("shaft18.{key}"), value);
        }
    }
    if d.chance(0.4) {
        let gravity: Vec<f64> = (0..3).map(|_| d.between(-10.0, 10.0)).collect();
        d.set("shaft18.gravity_m_per_s2", gravity);
    }
    for (i, gear) in ["pinion", "wheel"].into_iter().enumerate() {
        one_shaft(d, gear, sizes.reference[i], sizes.width);
    }
}

fn one_shaft(d: &mut Draft, gear: &str, diameter: f64, width: f64) {
    let outer = diameter * d.between(0.2, 0.8);
    let rows: Vec<Vec<f64>> = (0..d.whole(1, 3))
        .map(|_| {
            let bore = if d.chance(0.3) { d.between(0.0, 0.8) } else { 0.0 };
            let outer = outer * d.between(0.7, 1.3);
            vec![(width + outer) * d.between(0.5, 3.0), outer, outer * bore]
        })
        .collect();
    let length: f64 = rows.iter().map(|r| r[0]).sum();
    d.set_rows(&format!("{gear}.shaft.segments_mm"), rows);
    let place = |d: &mut Draft| length * d.between(0.02, 0.98);
    let gear_at = place(d);
    d.set(&format!("{gear}.shaft.gear_at_mm"), gear_at);
    if d.chance(0.5) {
        let at = if d.chance(0.5) { 0.0 } else { place(d) };
        d.set(&format!("{gear}.shaft.torque_at_mm"), at);
    }
    if d.chance(0.3) {
        let nodes: Vec<f64> = (0..d.whole(1, 3)).map(|_| place(d)).collect();
        d.set(&format!("{gear}.shaft.nodes_mm"), nodes);
    }
    if d.chance(0.4) {
        let (run_out, phase) = (d.mostly([0.0, 30.0], [0.0, 1e4]), d.between(-360.0, 360.0));
        d.set(&format!("{gear}.shaft.run_out_um"), run_out);
        d.set(&format!("{gear}.shaft.run_out_phase_deg"), phase);
    }
    let mass = 6.2e-6 * diameter.powi(2) * width;
    for k in 0..d.whole(0, 2) {
        let disc = format!("{gear}.shaft.discs.{k}");
        let (at, size) = (place(d), d.log(0.1, 10.0));
        let inertia = 1e-6 * mass * size * diameter.powi(2) / 8.0;
        d.set(&format!("{disc}.at_mm"), at);
        d.set(&format!("{disc}.mass_kg"), mass * size);
        d.set(&format!("{disc}.polar_inertia_kg_m2"), inertia);
        d.set(&format!("{disc}.transverse_inertia_kg_m2"), 0.5 * inertia);
        if d.chance(0.5) {
            let keeps = d.some_of(&["x", "y", "z", "rx", "ry", "rz"]);
            d.set(&format!("{disc}.keeps"), keeps);
        }
    }
    let supports = if d.chance(0.95) { 2 } else { d.whole(0, 1) };
    for k in 0..supports {
        let support = format!("{gear}.shaft.supports.{k}");
        d.set(&format!("{support}.at_mm"), length * [0.1, 0.9][k as usize]);
        for (name, key, damping) in SUPPORT {
            let turns = name.starts_with('r');
            let held = if turns { d.chance(0.1) } else { name != "z" || k == 0 || d.chance(0.2) };
            if held {
                let stiffness = d.mostly_log([1e4, 1e6], [1.0, 1e15]) * if turns { 1e3 } else { 1.0 };
                d.set(&format!("{support}.{key}"), stiffness.min(1e15));
            }
            if held && d.chance(0.3) {
                let damping_value = d.log(1e-3, 10.0);
                d.set(&format!("{support}.{damping}"), damping_value);
            }
        }
    }
}
