//! Motion in time: bodies, bearings, torques, integration, runs.

use std::f64::consts::TAU;

use super::{Draft, gears::Sizes, model::Asked};

/// Keys of stiffness and damping of a bearing, one a coordinate.
pub const SUPPORT: [(&str, &str, &str); 6] = [
    ("x", "stiffness_x_n_per_mm", "damping_x_ns_per_mm"),
    ("y", "stiffness_y_n_per_mm", "damping_y_ns_per_mm"),
    ("z", "stiffness_z_n_per_mm", "damping_z_ns_per_mm"),
    ("rx", "stiffness_rx_nmm_per_rad", "damping_rx_nmms_per_rad"),
    ("ry", "stiffness_ry_nmm_per_rad", "damping_ry_nmms_per_rad"),
    ("rz", "stiffness_rz_nmm_per_rad", "damping_rz_nmms_per_rad"),
];

/// Mesh resonance of steel discs on teeth of usual stiffness, Hz, as a scale for speeds.
fn resonance_hz(d: &Draft, sizes: &Sizes) -> f64 {
    let least = sizes.reference[0].min(sizes.reference[1]);
    let sound = |table: &str| {
        let of = |key: &str, usual: f64| d.number(&format!("{table}.{key}")).unwrap_or(usual) / usual;
        (of("young_mpa", 2.06e5) / of("density_kg_m3", 7850.0)).sqrt()
    };
    4e5 / least * sound("material")
}

/// Everything on motion.
pub fn draw_motion(d: &mut Draft, sizes: &Sizes, asked: &Asked) {
    draw_bodies(d, sizes, asked);
    let elastic = asked.model.starts_with("reduced");
    let run = draw_run(d, sizes, asked, elastic);
    draw_torques(d, asked, elastic, run);
    if asked.model == "reduced+modes" {
        draw_modes(d);
    }
    let methods = ["energy", "generalised-alpha", "newmark", "dormand-prince", "rk4"];
    if d.chance(0.7) {
        let method = d.pick(&methods);
        d.set("motion.method", method);
        if method == "generalised-alpha" && d.chance(0.6) {
            let rho = d.pick(&[0.0, 0.3, 0.9, 1.0]);
            d.set("motion.spectral_radius", rho);
        }
    }
    if d.chance(0.15) {
        let tolerance = d.mostly_log([1e-6, 1e-2], [1e-9, 0.1]);
        d.set("motion.error_tolerance", tolerance);
    }
    if d.chance(0.2) {
        d.set("motion.stop_at_events", true);
    }
    let damped = elastic || matches!(asked.model, "lumped8" | "shaft18");
    if damped && d.chance(0.5) {
        let ratio = d.mostly([0.0, 0.15], [0.0, 10.0]);
        d.set("motion.mesh_damping_ratio", ratio);
    } else if elastic && d.chance(0.3) {
        let damping = d.mostly_log([1e-3, 1.0], [1e-9, 1e9]);
        d.set("motion.mesh_damping_ns_per_mm2", damping);
    }
}

fn draw_bodies(d: &mut Draft, sizes: &Sizes, asked: &Asked) {
    let must: &[&str] = match asked.model {
        "lumped8" => &["x", "y", "z"],
        "lumped12" => &["x", "y", "z", "rx", "ry"],
        _ => &[],
    };
    let chosen = asked.model.starts_with("reduced") || asked.model == "impact";
    for (i, gear) in ["pinion", "wheel"].into_iter().enumerate() {
        let free: Vec<&str> = if chosen && d.chance(0.4) {
            ["x", "y", "z", "rx", "ry"].into_iter().filter(|_| d.chance(0.5)).collect()
        } else {
            must.to_vec()
        };
        if chosen && (!free.is_empty() || d.chance(0.1)) {
            d.set(&format!("{gear}.body.free"), free.clone());
        }
        // A steel disc of the reference diameter: kg, kg m^2.
        let mass = 6.2e-6 * sizes.reference[i].powi(2) * sizes.width;
        let inertia = 1e-6 * mass * sizes.reference[i].powi(2) / 8.0;
        for (key, scale) in [
            ("mass_kg", mass),
            ("transverse_inertia_kg_m2", inertia),
            ("polar_inertia_kg_m2", inertia),
            ("added_inertia_kg_m2", inertia),
        ] {
            if d.chance(0.15) {
                let value = scale * d.mostly_log([0.7, 5.0], [1e-3, 1e3]);
                d.set(&format!("{gear}.body.{key}"), value.clamp(1e-9, 1e9));
            }
        }
        draw_bearing(d, gear, &free, mass, asked);
    }
}

fn draw_bearing(d: &mut Draft, gear: &str, free: &[&str], mass: f64, asked: &Asked) {
    // As soft as keeps the teeth in mesh under the load, most of the time.
    let radius =
        0.5 * d.number("pair.normal_module_mm").unwrap_or(1.0) * d.number(&format!("{gear}.teeth")).unwrap_or(20.0);
    let force = 1e3 * d.number("operation.torque_nm").unwrap_or(0.0) / radius;
    let least = force / (0.02 * d.number("pair.normal_module_mm").unwrap_or(1.0));
    let stiffness = 1e-3 * mass * (TAU * d.log(50.0, 5e3)).powi(2);
    let stiffness = if d.chance(0.9) { stiffness.max(least) } else { stiffness };
    let of = |name: &str| if name.starts_with('r') { 1e3 } else { 1.0 };
    let lumped = matches!(asked.model, "lumped8" | "lumped12");
    let turning = lumped && d.chance(0.3);
    if free.len() == 5 && !lumped && d.chance(0.3) {
        for (key, scale) in [("stiffness_matrix_n_mm_rad", stiffness), ("damping_matrix_ns_mm_rad", 1e-4 * stiffness)] {
            let diagonal = |i: usize| scale.max(1e-6) * if i < 3 { 1.0 } else { 1e3 };
            let coupling = d.between(-0.1, 0.1);
            let entry = |i: usize, j: usize| match (i, j) {
                _ if i == j => diagonal(i),
                (0, 4) | (4, 0) => coupling * (diagonal(0) * diagonal(4)).sqrt(),
                _ => 0.0,
            };
            d.set_rows(
                &format!("{gear}.bearing.{key}"),
                (0..5).map(|i| (0..5).map(|j| entry(i, j)).collect()).collect(),
            );
        }
        return;
    }
    for (name, key, damping) in SUPPORT {
        if !(free.contains(&name) || name == "rz" && turning) {
            continue;
        }
        let value = if d.chance(0.03) { d.log(1e-6, 1e15) } else { stiffness * of(name) * d.between(0.5, 2.0) };
        d.set(&format!("{gear}.bearing.{key}"), value.clamp(1e-6, 1e15));
        let damped = asked.model != "lumped12" && (name != "rz" || asked.model == "lumped8");
        if damped && d.chance(0.2) {
            let value = stiffness * of(name) * d.log(1e-6, 1e-3);
            d.set(&format!("{gear}.bearing.{damping}"), value.clamp(0.0, 1e15));
        }
    }
    if !free.is_empty() && asked.model != "lumped12" && d.chance(0.2) {
        let ratio = d.mostly([0.0, 0.1], [0.0, 10.0]);
        d.set(&format!("{gear}.bearing.damping_ratio"), ratio);
    }
}

/// Speeds and lengths; few cycles, few steps. Gives the word of `run`.
fn draw_run(d: &mut Draft, sizes: &Sizes, asked: &Asked, elastic: bool) -> &'static str {
    let runs: &[&str] = match asked.model {
        m if m.starts_with("reduced") => {
            &["steady", "steady", "shooting", "span", "span", "ramp", "sweep", "continuation", "basins"]
        }
        "impact" => &["steady", "span", "span", "ramp", "sweep"],
        _ => &["steady", "span", "sweep", "continuation", "basins"],
    };
    let run = d.pick(runs);
    d.set("motion.run", run);
    let driver = if d.get("operation.driver").and_then(|w| w.as_str()) == Some("wheel") { 1 } else { 0 };
    let hz = resonance_hz(d, sizes) * d.log(0.05, 1.6);
    let rpm = (60.0 * hz / f64::from(sizes.teeth[driver])).clamp(1e-6, 1e7);
    let steps = d.whole(8, 14);
    d.set("motion.steps_per_mesh_cycle", i64::from(steps));
    // Any speed at all where the number of steps does not follow it.
    let wild = d.chance(0.05);
    let rpm = if wild { d.log(1e-6, 1e7) } else { rpm };
    d.set("operation.speed_rpm", rpm);
    if asked.model != "impact" || d.chance(0.02) {
        // The highest kept mode makes many more steps.
        let most = if asked.model == "reduced+modes" { 4 } else { 10 };
        let per_resonance = if wild || d.chance(0.3) { 0 } else { d.whole(most / 2, most) };
        d.set("motion.steps_per_resonance", i64::from(per_resonance));
    }
    let cycle_s = 60.0 / (rpm * f64::from(sizes.teeth[driver]));
    match run {
        "ramp" => draw_ramp(d, rpm, cycle_s, elastic),
        "sweep" => draw_sweep(d, rpm, elastic),
        "continuation" => draw_branch(d, rpm),
        "basins" => draw_basins(d),
        "span" if d.chance(0.4) => {
            let cycles = f64::from(d.whole(1, 3));
            d.set("motion.duration_s", (cycles * cycle_s).clamp(1e-9, 1e9));
        }
        _ => {
            let cycles = d.whole(1, 2);
            d.set("analysis.cycles", i64::from(cycles));
        }
    }
    if matches!(run, "steady" | "shooting" | "sweep" | "continuation" | "basins") {
        let waits = d.whole(0, 8);
        d.set("motion.warm_up_cycles", i64::from(waits));
        let tolerance = d.mostly_log([1e-5, 1e-2], [1e-12, 0.5]);
        d.set("motion.periodic_tolerance", tolerance);
    }
    if elastic && matches!(run, "steady" | "span" | "ramp") && d.chance(0.1) {
        let every = d.whole(0, 2);
        d.set("motion.checkpoint_every_cycles", i64::from(every));
    }
    run
}

fn draw_ramp(d: &mut Draft, rpm: f64, cycle_s: f64, elastic: bool) {
    let from = if d.chance(0.2) { 0.0 } else { rpm * d.between(0.5, 1.0) };
    let (to, length) = (rpm * d.between(0.5, 1.5), cycle_s * d.between(5.0, 10.0));
    d.set("motion.ramp.from_rpm", from.clamp(0.0, 1e7));
    d.set("motion.ramp.to_rpm", to.clamp(1e-3, 1e7));
    d.set("motion.ramp.duration_s", length.clamp(1e-6, 1e6));
    for key in ["before_s", "after_s"] {
        if d.chance(0.3) {
            let length = cycle_s * d.between(0.0, 2.0);
            d.set(&format!("motion.ramp.{key}"), length.clamp(0.0, 1e6));
        }
    }
    if elastic {
        let cycles = d.whole(4, 5);
        d.set("motion.ramp.waterfall_cycles", i64::from(cycles));
    }
}

fn draw_sweep(d: &mut Draft, rpm: f64, elastic: bool) {
    let [from, to] = [rpm * d.between(0.6, 0.95), rpm * d.between(1.05, 1.5)];
    d.set("motion.sweep.from_rpm", from.clamp(1e-3, 1e7));
    d.set("motion.sweep.to_rpm", to.clamp(1e-3, 1e7));
    let speeds = d.whole(2, 3);
    d.set("motion.sweep.speeds", i64::from(speeds));
    if d.chance(0.6) {
        let ways = d.some_of(&["up", "down", "apart"]);
        d.set("motion.sweep.ways", ways);
    }
    if elastic && d.chance(0.5) {
        let by = d.pick(&["running", "shooting"]);
        d.set("motion.sweep.steady_by", by);
    }
}

fn draw_branch(d: &mut Draft, rpm: f64) {
    let ways = [0.6, 1.3].map(|share| (rpm * share).clamp(1e-3, 1e7));
    let down = usize::from(d.chance(0.5));
    d.set("motion.continuation.key", "operation.speed_rpm");
    d.set("motion.continuation.from", ways[down]);
    d.set("motion.continuation.to", ways[1 - down]);
    for (key, low, high) in [
        ("motions", 2, 3),
        ("phases", 64, 96),
        ("harmonics", 2, 6),
        ("most_harmonics", 8, 12),
        ("period_cycles", 1, 2),
        ("time_points", 0, 1),
    ] {
        let number = d.whole(low, high);
        d.set(&format!("motion.continuation.{key}"), i64::from(number));
    }
    let (tail, step) = (d.log(1e-3, 0.1), d.log(0.01, 0.2));
    d.set("motion.continuation.tail", tail);
    d.set("motion.continuation.longest_step", step);
}

fn draw_basins(d: &mut Draft) {
    for unit in ["um", "mm_s"] {
        let [from, to] = [-d.log(0.1, 100.0), d.log(0.1, 100.0)];
        d.set(&format!("motion.basins.from_{unit}"), from);
        d.set(&format!("motion.basins.to_{unit}"), to);
    }
    for key in ["columns", "rows"] {
        let number = d.whole(2, 3);
        d.set(&format!("motion.basins.{key}"), i64::from(number));
    }
}

fn draw_torques(d: &mut Draft, asked: &Asked, elastic: bool, run: &str) {
    let torque = d.number("operation.torque_nm").unwrap_or(1.0);
    if d.chance(0.4) {
        let by = d.pick(&["torque", "speed"]);
        d.set("drive.by", by);
    }
    let by = d.get("drive.by").and_then(|w| w.as_str()).unwrap_or(if elastic { "torque" } else { "speed" }).to_owned();
    let own = by == "torque" && matches!(run, "steady" | "span");
    if own && d.chance(0.3) {
        one_torque(d, "drive", torque, asked);
        if d.chance(0.5) && d.get("drive.table_s_nm").is_none() {
            let value = torque * d.between(0.2, 2.0);
            d.set("drive.torque_nm", value.clamp(-1e9, 1e9));
        }
    }
    if d.chance(0.25) {
        one_torque(d, "load", torque, asked);
    }
}

fn one_torque(d: &mut Draft, table: &str, torque: f64, asked: &Asked) {
    if matches!(asked.model, "reduced" | "reduced+modes" | "impact") && d.chance(0.4) {
        let cycle_s = 60.0 / (20.0 * d.number("operation.speed_rpm").unwrap_or(1000.0));
        let rows = d.whole(1, 4);
        let row = |d: &mut Draft, k: u32| vec![f64::from(k) * cycle_s, torque * d.between(-0.5, 2.0)];
        let rows = (0..rows).map(|k| row(d, k)).collect();
        d.set_rows(&format!("{table}.table_s_nm"), rows);
        return;
    }
    let amplitude = torque * d.mostly([0.0, 0.5], [0.0, 5.0]);
    let frequency = d.mostly_log([10.0, 1e4], [1e-9, 1e9]);
    d.set(&format!("{table}.amplitude_nm"), amplitude.clamp(0.0, 1e9));
    d.set(&format!("{table}.frequency_hz"), frequency);
    if d.chance(0.5) {
        let phase = d.between(-360.0, 360.0);
        d.set(&format!("{table}.phase_deg"), phase);
    }
}

fn draw_modes(d: &mut Draft) {
    if d.chance(0.7) {
        let count = d.whole(1, 4);
        d.set("modes.count", i64::from(count));
    } else {
        let below = d.log(100.0, 5e4);
        d.set("modes.below_hz", below);
    }
    if d.chance(0.4) {
        let boundary = d.pick(&["massless", "consistent"]);
        d.set("modes.boundary", boundary);
        if boundary == "consistent" {
            let fixed = d.whole(0, 4);
            d.set("modes.fixed_modes", i64::from(fixed));
        }
    }
    if d.chance(0.4) {
        let ratio = d.mostly([0.0, 0.05], [0.0, 1.0]);
        d.set("modes.damping_ratio", ratio);
    }
}
