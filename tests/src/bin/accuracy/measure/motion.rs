//! Pairs in motion, at several speeds each.

use std::time::Instant;

use analysis::{
    NoObserver,
    accuracy::{
        GearMemo, Rung,
        motion::{MotionAnswer, MotionModel, PairAtRest},
    },
};
use serde_json::{Value, json};
use verification::{
    random_motion::{RandomMotion, fine_modes, random_motion},
    rung_of::rung_of,
};

use super::{Failure, Measure};

/// Steps in a period of the fastest motion, of each model.
const STEPS: [(MotionModel, &[u32]); 3] =
    [(MotionModel::Lumped12, &[16]), (MotionModel::Reduced, &[8, 16, 32]), (MotionModel::ReducedModes, &[6])];
/// Steps at the speeds of a pair at which they are not compared.
const ENOUGH: u32 = 16;

/// The lines of a pair of a seed; `word`: the rung of its meshes.
pub(super) fn measure(seed: u64, word: Option<&str>) -> Result<Measure, Failure> {
    let rung = rung_of(word, 2)?;
    Ok(Box::new(move |index| Some(measured(&random_motion(seed, index)?, index, rung))))
}

/// The lines of a pair, one a speed.
fn measured(pair: &RandomMotion, index: u64, rung: Rung) -> Vec<Value> {
    let kept = GearMemo::new(&analysis::NoCache);
    let scene = rung.scene(&pair.scene);
    match PairAtRest::solve(&scene, &kept) {
        Ok(rest) => {
            let compared = index as usize % pair.speeds.len();
            let one = |(i, speed): (usize, &f64)| at_speed(pair, rung, &rest, (*speed, i == compared), &kept);
            let line = |own| one(own).unwrap_or_else(|e| json!({ "error": e.to_string() }));
            pair.speeds.iter().enumerate().map(line).collect()
        }
        Err(e) => vec![json!({ "error": e.to_string() })],
    }
}

fn at_speed(
    pair: &RandomMotion,
    rung: Rung,
    rest: &PairAtRest,
    (speed, compares_steps): (f64, bool),
    kept: &GearMemo<'_>,
) -> Result<Value, Failure> {
    let rest = PairAtRest { mesh_hz: speed * rest.resonance.hz, ..rest.clone() };
    let mut scene = rung.scene(&pair.at(rest.mesh_hz));
    scene.modes = Some(fine_modes());
    let mut runs = serde_json::Map::new();
    for (model, steps) in STEPS {
        for n in steps.iter().filter(|n| compares_steps || model != MotionModel::Reduced || **n == ENOUGH) {
            // As many rows as there are in a mesh cycle are steps whatever is asked: fewer change nothing.
            let rows = scene.motion.as_ref().map_or(0.0, |m| f64::from(m.steps_per_mesh_cycle));
            let same = steps.iter().filter(|s| *s < n && f64::from(*n) <= rows * speed).min();
            let same = same.filter(|_| model != MotionModel::ReducedModes);
            if let Some(told) = same.and_then(|s| runs.get(&format!("{} {s}", model.name())).cloned()) {
                runs.insert(format!("{} {n}", model.name()), told);
                continue;
            }
            let start = Instant::now();
            let answer = MotionAnswer::quietly(&model.scene(&scene, &rest, *n), kept, &mut NoObserver);
            let seconds = start.elapsed().as_secs_f64();
            let told = match answer.map(|a| a.sample()) {
                Ok(s) => json!({
                    "rms_dte": s.rms_um, "peak_to_peak_dte": s.peak_to_peak_um, "least_force": s.least_force,
                    "periodicity": s.periodicity, "seconds": seconds,
                }),
                Err(e) => json!({ "error": e.to_string() }),
            };
            runs.insert(format!("{} {n}", model.name()), told);
        }
    }
    Ok(json!({
        "speed": speed,
        "elastic_ratio": rest.elastic_ratio(),
        "elastic_share": rest.elastic_share(),
        "damping": rest.resonance.damping,
        "resonance_hz": rest.resonance.hz,
        "elastic_hz": rest.elastic_hz,
        "ste": { "rms_dte": rest.ste_um[0], "peak_to_peak_dte": rest.ste_um[1] },
        "amplitudes_um": rest.amplitudes_um.iter().take(8).collect::<Vec<_>>(),
        "runs": runs,
    }))
}
