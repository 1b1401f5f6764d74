//! How do bounds of motions, and the choice of the cheapest model, do on pairs that the calibration has not seen?
//!
//! `cargo run --release -p verification --bin check_motion_accuracy -- TOLERANCE_PERCENT SEED FIRST COUNT [MESH_RUNG]`
//!
//! Every narrow random pair is moved at one speed with `model = "auto"`, and held against `reduced+modes` with fine
//! steps on a mesh of the rung.
#![allow(clippy::print_stdout, reason = "the figures are what it is for")]

use std::{collections::BTreeMap, error::Error, time::Instant};

use analysis::{
    NoCache, NoObserver,
    accuracy::{
        KeptGears, Rung,
        motion::{AccurateMotion, MotionAnswer, MotionModel, MotionSample, PairAtRest},
    },
};
use scene::{AccuracyScene, Model, Quantity, Tolerance};
use verification::random_motion::{RandomMotion, fine_modes, random_motion};

/// Steps in a period of the highest mode that is kept.
const FINE_STEPS: u32 = 6;

type Failure = Box<dyn Error + Send + Sync>;

/// Bounds and errors of a quantity over all pairs.
#[derive(Debug, Default)]
struct Tally {
    pairs: usize,
    within: usize,
    /// Bound over error.
    sharpness: Vec<f64>,
    /// Said to be kept, kept, and said though it is not.
    met: [usize; 3],
}

fn main() -> Result<(), Failure> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [percent, seed, first, count, rest @ ..] = &words[..] else {
        return Err("TOLERANCE_PERCENT SEED FIRST COUNT [MESH_RUNG] are wanted".into());
    };
    let share = 1e-2 * percent.parse::<f64>()?;
    let (seed, first, count): (u64, u64, u64) = (seed.parse()?, first.parse()?, count.parse()?);
    let rung: u32 = rest.first().map_or(Ok(3), |word| word.parse())?;
    let rung = Rung::ALL.into_iter().find(|r| r.elements_profile == rung).ok_or("no such rung")?;
    let mut tallies: BTreeMap<&str, Tally> = BTreeMap::new();
    for index in first..first + count {
        let Some(pair) = random_motion(seed, index) else { continue };
        let speed = pair.speeds[index as usize % pair.speeds.len()];
        match checked(&pair, speed, rung, share, &mut tallies) {
            Ok(said) => println!("pair {index:4}: {said}"),
            Err(e) => println!("pair {index:4}: {e}"),
        }
    }
    for (key, mut tally) in tallies {
        tally.sharpness.sort_unstable_by(f64::total_cmp);
        let [said, kept, wrong] = tally.met;
        println!(
            "{percent} %: {key:18} within {:3} of {:3} ({:.1} %), median bound over error {:.1}; said to be kept {said}, \
             kept {kept}, said though not so {wrong}",
            tally.within,
            tally.pairs,
            100.0 * tally.within as f64 / tally.pairs as f64,
            tally.sharpness.get(tally.sharpness.len() / 2).copied().unwrap_or(f64::NAN)
        );
    }
    Ok(())
}

/// One pair at one speed, in words.
fn checked(
    pair: &RandomMotion,
    speed: f64,
    rung: Rung,
    share: f64,
    tallies: &mut BTreeMap<&'static str, Tally>,
) -> Result<String, Failure> {
    let kept = KeptGears::new(&NoCache);
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
        let tally = tallies.entry(bound.quantity.key()).or_default();
        tally.pairs += 1;
        let within = -bound.below <= error && error <= bound.above;
        tally.within += usize::from(within);
        tally.sharpness.push(bound.largest() / error.abs().max(1e-6 * exact));
        let (met, is_kept) = (bound.met == Some(true), error.abs() <= share * bound.value);
        tally.met[0] += usize::from(met);
        tally.met[1] += usize::from(is_kept);
        tally.met[2] += usize::from(met && !is_kept);
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
    kept: &KeptGears<'_>,
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
