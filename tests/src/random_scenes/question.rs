//! What is asked of the pair: load, contact, positions, files.

use scene::Quantity;

use super::{Draft, gears::Sizes, model::Asked};
use crate::random_scene::torque_of_pressure;

/// Load, driver, sense.
pub fn draw_operation(d: &mut Draft, sizes: &Sizes, asked: &Asked) {
    let usual = sizes.pair.as_ref().map_or(100.0, |pair| 1e-3 * torque_of_pressure(pair, 1000.0));
    let light = d.between(0.0, 1.0);
    let torque = match light {
        // A motion begins under load.
        x if x < 0.03 && !asked.in_time => 0.0,
        x if x < 0.06 => 1e-9,
        x if x < 0.12 => usual * d.log(1e-9, 1e-2),
        x if x < 0.22 => usual * d.log(10.0, 1e4),
        x if x < 0.24 => d.between(0.0, 1e9),
        _ => usual * d.log(0.1, 4.0),
    };
    d.set("operation.torque_nm", torque.clamp(0.0, 1e9));
    if d.chance(0.4) {
        let driver = d.pick(&["pinion", "wheel"]);
        d.set("operation.driver", driver);
    }
    if d.chance(0.4) {
        let sense = d.pick(&["ccw", "cw"]);
        d.set("operation.rotation", sense);
    }
    if !asked.in_time && d.chance(0.3) {
        let speed = d.mostly_log([1.0, 2e4], [1e-6, 1e7]);
        d.set("operation.speed_rpm", speed);
    }
}

/// How flanks press.
pub fn draw_contact(d: &mut Draft, asked: &Asked) {
    let nodal = !asked.in_time && asked.meshed && d.chance(0.2);
    if nodal {
        d.set("contact.method", "nodal");
        let points = d.whole(1, 4);
        d.set("contact.points_per_face_edge", i64::from(points));
        if d.chance(0.35) {
            let penalty = d.mostly_log([1e4, 1e8], [1.0, 1e15]);
            d.set("contact.penalty_mpa_per_mm", penalty);
        }
        if d.chance(0.4) {
            let gap = d.pick(&["smooth", "facet"]);
            d.set("contact.gap", gap);
        }
    } else {
        if d.chance(0.1) {
            d.set("contact.method", "slice");
        }
        if asked.sliced && d.chance(0.93) {
            let slices = if d.chance(0.9) { d.whole(4, 9) } else { d.whole(10, 48) };
            d.set("contact.slices", i64::from(slices));
        }
        if asked.sliced && asked.meshed && d.chance(0.15) {
            let corner = d.chance(0.5);
            d.set("contact.corner_contact", corner);
        }
    }
    if asked.friction && d.chance(0.25) {
        let friction = d.mostly([0.0, 0.15], [0.0, 1.0]);
        d.set("contact.friction", friction);
    }
    if asked.meshed && d.chance(0.3) {
        let flanks = d.pick(&["driving", "both"]);
        d.set("contact.flanks", flanks);
    }
}

/// How many positions, of how many teeth.
pub fn draw_analysis(d: &mut Draft, sizes: &Sizes, asked: &Asked) {
    d.set("analysis.model", asked.model);
    if asked.model == "reduced" || asked.model == "reduced+modes" {
        if asked.in_time || d.chance(0.1) {
            d.set("analysis.kind", if asked.in_time { "dynamic" } else { "static" });
        }
        // The whole gear's factor takes long for many teeth.
        if d.chance(0.15) && sizes.teeth.iter().all(|z| *z < 60) {
            let way = d.pick(&["auto", "general"]);
            d.set("analysis.reduction", way);
        }
    } else if d.chance(0.1) {
        d.set("analysis.kind", if asked.in_time { "dynamic" } else { "static" });
    }
    let positions = if asked.model == "iso" { d.whole(1, 200) } else { d.whole(1, 4) };
    d.set("analysis.positions_per_cycle", i64::from(positions));
    if !asked.in_time && d.chance(0.4) {
        let cycles = d.whole(1, 2);
        d.set("analysis.cycles", i64::from(cycles));
    }
    if asked.meshed && d.chance(0.12) {
        let window = d.whole(1, 7);
        d.set("analysis.window_teeth", i64::from(window));
    }
}

/// Which files are written beside the three.
pub fn draw_output(d: &mut Draft, asked: &Asked) {
    let stress = asked.meshed && matches!(asked.model, "reduced" | "full") || d.chance(0.02);
    if stress && d.chance(0.1) {
        d.set("output.root_stress", true);
    }
    let lines = asked.meshed && !asked.in_time && d.get("contact.method").is_none_or(|m| m.as_str() == Some("slice"));
    if lines && d.chance(0.3) {
        d.set("output.contact_lines", true);
    }
    if d.chance(0.1) {
        d.set("output.parquet", true);
    }
    if asked.meshed && !asked.in_time && d.chance(0.05) {
        d.set("output.vtu", true);
        let fields = d.some_of(&["displacement", "pressure", "stress"]);
        d.set("output.fields", fields);
        let every = d.whole(1, 3);
        d.set("output.vtu_every", i64::from(every));
    }
    if d.chance(0.05) {
        let name = d.pick(&["pair", "Räder <&> \"quoted\"", "", "a\tb", "長い名前"]);
        d.set("name", name);
    }
}

/// What a loaded pair at rest is differentiated by.
pub fn draw_derivatives(d: &mut Draft, asked: &Asked) {
    let slices = d.get("contact.method").is_none_or(|m| m.as_str() == Some("slice"));
    let asks = asked.meshed && asked.model == "reduced" && !asked.in_time && d.get("accuracy").is_none();
    let own = ["pitch_errors_file", "pitch_errors_um", "modification.drive.topography"];
    let deviates =
        ["pinion", "wheel"].iter().any(|gear| own.iter().any(|key| d.get(&format!("{gear}.{key}")).is_some()));
    if slices && asks && deviates && d.chance(0.3) {
        d.set("output.flank_orders", true);
    }
    if !(slices && asks && d.chance(0.1)) {
        return;
    }
    let keys = ["pair.misalignment.in_plane_of_action_um", "pair.misalignment.deviation_um"];
    let keys = d.some_of(&keys);
    d.set("output.derivatives", keys);
}

/// How exact some number is to be; the model stays that of the scene, which is small. Of a motion only a steady one at
/// constant speed under a constant load has bounds.
pub fn draw_accuracy(d: &mut Draft, asked: &Asked) {
    if !asked.meshed || asked.from.is_some() || !d.chance(0.025) {
        return;
    }
    let of_motion = |q: Quantity| q.is_of_motion() == asked.in_time;
    let all: Vec<Quantity> = Quantity::ALL.iter().copied().filter(|q| of_motion(*q)).collect();
    for _ in 0..d.whole(1, 3) {
        let quantity = d.pick(&all);
        let amount = if d.chance(0.7) {
            format!("{} %", d.log(0.1, 100.0))
        } else {
            format!("{} {}", d.log(1e-3, 10.0), quantity.unit())
        };
        d.set(&format!("accuracy.{}", quantity.key()), amount);
        if quantity.key().ends_with("root_stress") {
            d.set("output.root_stress", true);
        }
    }
    if asked.in_time && d.chance(0.9) {
        ["drive", "load", "motion.ramp", "motion.sweep", "motion.continuation", "motion.basins", "motion.duration_s"]
            .iter()
            .for_each(|key| d.unset(key));
        ["motion.error_tolerance", "motion.checkpoint_every_cycles"].iter().for_each(|key| d.unset(key));
        d.set("motion.run", "steady");
    }
}
