//! Pairs in motion.

use std::time::Instant;

use analysis::{
    NoCache, NoObserver,
    accuracy::{
        GearMemo, Rung,
        motion::{AccurateMotion, MotionAnswer, MotionModel, MotionSample, PairAtRest},
    },
};
use scene::{AccuracyScene, Model, Quantity, Tolerance};
use verification::{
    random_motion::{RandomMotion, fine_modes, random_motion},
    rung_of::rung_of,
};

use super::{Failure, Tallies};

/// Steps in a period of the highest mode that is kept.
const FINE_STEPS: u32 = 6;

/// Random pairs; `words`: seed, first, count, and the rung of the meshes.
pub(super) fn check(share: f64, words: &[String], tallies: &mut Tallies) -> Result<(), Failure> {
    let [seed, first, count, more @ ..] = words else { return Err("SEED FIRST COUNT [MESH_RUNG] are wanted".into()) };
    let (seed, first, count): (u64, u64, u64) = (seed.parse()?, first.parse()?, count.parse()?);
    let rung = rung_of(more.first().map(String::as_str), 3)?;
    for index in first..first + count {
        let Some(pair) = random_motion(seed, index) else { continue };
        let speed = pair.speeds[index as usize % pair.speeds.len()];
        match checked(&pair, speed, rung, share, tallies) {
            Ok(said) => println!("pair {index:4}: {said}"),
            Err(e) => println!("pair {index:4}: {e}"),
        }
    }
    Ok(())
}

/// One pair at one speed, in words.
fn checked(pair: &RandomMotion, speed: f64, rung: Rung, share: f64, tallies: &mut Tallies) -> Result<String, Failure> {
    let kept = GearMemo::new(&NoCache);
    let (exact, scene) = reference(pair, speed, rung, &kept)?;
    let mut scene = scene;
    scene.analysis.model = Model::Auto;
    scene.accuracy = AccuracyScene::new(Quantity::OF_MOTION.map(|q| (q, Tolerance::Relative(share))));
    let start = Instant::now();
    let solved = AccurateMotion::new(&scene).solve()?;
    let seconds = start.elapsed().as_secs_f64();
    let accuracy = solved.answer.facts().accuracy.as_ref().ok_or("no bounds")?;
    let mut said = format!("speed {speed:.3}, {seconds:.1} s,");
    for tried in &accuracy.models {
        let (mesh, slices) = (tried.elements_profile.unwrap_or(0), tried.slices.unwrap_or(0));
        said += &format!(" {} (mesh {mesh}, {slices} slices, {} steps)", tried.model.name(), tried.steps_per_resonance);
    }
    for bound in &accuracy.bounds {
        let exact = exact.get(bound.quantity);
        let error = exact - bound.value;
        let within = tallies.entry(bound.quantity.key()).or_default().add(bound, exact);
        let of = |x: f64| 100.0 * x / bound.value;
        said += &format!(
            "; {} {:+.2} % in -{:.2} +{:.2}{}",
            bound.quantity.key(),
            of(error),
            of(bound.below),
            of(bound.above),
            if within { "" } else { " OUTSIDE" }
        );
        let terms = bound.terms.iter().map(|t| format!("{:.2}", of(t.amount)));
        said += &format!(" ({})", terms.collect::<Vec<_>>().join(" "));
    }
    Ok(said)
}

/// `reduced+modes` with fine steps, and the scene at that speed.
fn reference(
    pair: &RandomMotion,
    speed: f64,
    rung: Rung,
    kept: &GearMemo<'_>,
) -> Result<(MotionSample, scene::Scene), Failure> {
    let still = rung.scene(&pair.scene);
    let rest = PairAtRest::solve(&still, kept)?;
    let rest = PairAtRest { mesh_hz: speed * rest.resonance.hz, ..rest };
    let scene = pair.at(rest.mesh_hz);
    let mut fine = rung.scene(&scene);
    fine.modes = Some(fine_modes());
    let fine = MotionModel::ReducedModes.scene(&fine, &rest, FINE_STEPS);
    Ok((MotionAnswer::quietly(&fine, kept, &mut NoObserver)?.sample(), scene))
}
