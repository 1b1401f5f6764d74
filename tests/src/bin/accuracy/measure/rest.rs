//! Pairs at rest.

use std::{collections::BTreeMap, time::Instant};

use analysis::{
    NoCache, StaticAnalysis,
    accuracy::{Quantity, Rung, Sample, SolvedCycle},
};
use scene::Scene;
use serde_json::{Value, json};
use verification::{
    measured_pair::{CURVE_POSITIONS, POSITIONS},
    random_scene::random_scene,
};

use super::{Failure, Measure};

/// The finest rung of narrow pairs, and that of others, where it takes minutes.
const FINEST: [u32; 2] = [8, 6];
/// Face width up to which root stress is measured, modules.
const NARROW_MODULES: f64 = 7.0;

/// The line of a pair of a seed; `word`: the finest rung, `curves`, or `spur`.
pub(super) fn measure(seed: u64, word: Option<&str>) -> Result<Measure, Failure> {
    let (what, all) = match word {
        Some("curves") => (Measured::Curves, true),
        Some("spur") => (Measured::Curves, false),
        finest => (Measured::All(finest.map(str::parse).transpose()?), true),
    };
    Ok(Box::new(move |index| {
        let scene = random_scene(seed, index);
        (all || scene.pinion.helix_angle_deg == 0.0).then(|| vec![measured(scene, what)])
    }))
}

/// What is measured of a pair.
#[derive(Debug, Clone, Copy)]
enum Measured {
    /// Meshes up to a rung, slices, positions.
    All(Option<u32>),
    /// Curves at many positions on the coarsest rung.
    Curves,
}

/// The line of a pair; one that cannot be computed says why.
fn measured(mut scene: Scene, what: Measured) -> Value {
    // Stress of wide gears takes longer than all else.
    let narrow = scene.pair.face_width_mm < NARROW_MODULES * scene.pair.normal_module_mm;
    scene.output.root_stress = narrow;
    let solve = |scene: &Scene| {
        let samples = match what {
            Measured::All(finest) => {
                let finest = finest.unwrap_or(if narrow { FINEST[0] } else { FINEST[1] });
                json!(samples(scene, finest)?)
            }
            Measured::Curves => Value::Null,
        };
        Ok::<_, Failure>(json!({ "scene": scene_facts(scene)?, "samples": samples, "curves": curves(scene)? }))
    };
    solve(&scene).unwrap_or_else(|e| json!({ "error": e.to_string() }))
}

fn scene_facts(scene: &Scene) -> Result<Value, Failure> {
    let pair = scene.gear_pair()?;
    let modification = &scene.pinion.modification.drive;
    Ok(json!({
        "teeth": scene.gears().map(|g| g.teeth),
        "beta": scene.pinion.helix_angle_deg,
        "m": scene.pair.normal_module_mm,
        "b": scene.pair.face_width_mm,
        "x": scene.gears().map(|g| g.profile_shift),
        "alpha": scene.pair.normal_pressure_angle_deg,
        "bore": scene.gears().map(|g| g.bore_diameter_mm),
        "torque": scene.operation.torque_nm,
        "eps_alpha": pair.transverse_contact_ratio(),
        "eps_beta": pair.overlap_ratio(),
        "rim": [lumped::iso::rim_ratio(&pair.pinion), lumped::iso::rim_ratio(&pair.wheel)],
        "relief": !modification.is_none(),
        "misaligned": !scene.pair.misalignment.is_none(),
    }))
}

type Samples = BTreeMap<String, Value>;

/// The numbers of a sample.
fn values(sample: &Sample) -> BTreeMap<&'static str, f64> {
    Quantity::ALL.iter().filter_map(|q| Some((q.key(), sample.get(*q)?))).collect()
}

/// Curves on the coarsest rung, with as many slices as the program chooses.
fn curves(scene: &Scene) -> Result<Value, Failure> {
    let mut scene = Rung::ALL[0].scene(scene);
    scene.contact.slices = Some(StaticAnalysis::new(&scene).slices().unwrap_or(32));
    scene.analysis.positions_per_cycle = CURVE_POSITIONS;
    let mut curves = serde_json::to_value(SolvedCycle::new(&scene, &NoCache)?.curves())?;
    short(&mut curves);
    Ok(curves)
}

/// Numbers with as many digits as laws of errors need.
fn short(value: &mut Value) {
    match value {
        Value::Array(all) => all.iter_mut().for_each(short),
        Value::Object(all) => all.values_mut().for_each(short),
        Value::Number(number) if number.is_f64() => {
            let digits = number.as_f64().and_then(|x| format!("{x:.7e}").parse::<f64>().ok());
            *value = json!(digits);
        }
        _ => {}
    }
}

fn samples(scene: &Scene, finest: u32) -> Result<Samples, Failure> {
    let mut scene = scene.clone();
    scene.analysis.positions_per_cycle = POSITIONS;
    let mut all = Samples::new();
    let mut add = |name: String, sample: &Sample, seconds: f64| {
        let mut values = values(sample);
        values.insert("seconds", seconds);
        all.insert(name, json!(values));
    };
    // As many as the program chooses, by its own rule.
    let chosen = StaticAnalysis::new(&scene).slices().unwrap_or(32);
    scene.contact.slices = Some(chosen);
    let timed = |start: Instant| start.elapsed().as_secs_f64();
    let start = Instant::now();
    add("default".into(), &SolvedCycle::new(&scene, &NoCache)?.sample(1)?, timed(start));
    for rung in Rung::ALL.into_iter().filter(|r| r.elements_profile <= finest) {
        let n = rung.elements_profile;
        let start = Instant::now();
        let solved = SolvedCycle::new(&rung.scene(&scene), &NoCache)?;
        add(format!("mesh {n}"), &solved.sample(1)?, timed(start));
    }
    let scene = Rung::ALL[0].scene(&scene);
    // So many slices may be too many for a coarse mesh: their compliance is no longer positive definite.
    let start = Instant::now();
    if let Ok(finer) = SolvedCycle::new(&scene, &NoCache)?.again(4 * chosen, POSITIONS) {
        add(format!("slices {}", 4 * chosen), &finer.sample(1)?, timed(start));
    }
    all.insert("slices".into(), json!(chosen));
    Ok(all)
}
