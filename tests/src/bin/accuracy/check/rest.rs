//! Pairs at rest.

use std::time::Instant;

use analysis::{
    StaticAnalysis,
    accuracy::{Quantity, Rung},
};
use scene::{AccuracyScene, Model, Tolerance};
use verification::{measured_pair::MeasuredPair, pairs_done::lines, random_scene::random_scene};

use super::{Failure, Tallies, median};

/// All measured pairs; `words`: their number, and the files.
pub(super) fn check(share: f64, words: &[String], tallies: &mut Tallies) -> Result<(), Failure> {
    let [count, files @ ..] = words else { return Err("COUNT FILE... are wanted".into()) };
    let measured = MeasuredPair::all(&lines(files)?).into_iter().filter(|pair| pair.has_meshes() && pair.has_curves());
    let pairs: Vec<MeasuredPair> = measured.take(count.parse()?).collect();
    let (mut cheapest, mut costs) = (0, Vec::new());
    for pair in &pairs {
        match checked(pair, share, tallies) {
            Ok((cost, is_cheapest, said)) => {
                costs.push(cost);
                cheapest += usize::from(is_cheapest);
                println!("pair {:4}: {said}", pair.index);
            }
            Err(e) => println!("pair {:4}: {e}", pair.index),
        }
    }
    println!("{} pairs, on the cheapest rung {cheapest}, median cost {:.2}", costs.len(), median(&mut costs));
    Ok(())
}

/// One pair: its cost over that of default settings, whether the cheapest rung was taken, and both in words.
fn checked(pair: &MeasuredPair, share: f64, tallies: &mut Tallies) -> Result<(f64, bool, String), Failure> {
    let mut scene = random_scene(pair.seed, pair.index);
    let start = Instant::now();
    StaticAnalysis::new(&scene).solve().map_err(|e| format!("default settings: {e}"))?;
    let default_s = start.elapsed().as_secs_f64();
    scene.analysis.model = Model::Auto;
    scene.accuracy = AccuracyScene::new([(Quantity::MeanSte, Tolerance::Relative(share))]);
    let start = Instant::now();
    let solved = StaticAnalysis::new(&scene).solve()?;
    let cost = start.elapsed().as_secs_f64() / default_s;
    let accuracy = solved.facts.accuracy.as_ref().ok_or("no bounds")?;
    for bound in &accuracy.bounds {
        let Some(exact) = pair.exact(bound.quantity) else { continue };
        tallies.entry(bound.quantity.key()).or_default().add(bound, exact);
    }
    let mean = accuracy.bounds.iter().find(|b| b.quantity == Quantity::MeanSte).ok_or("no bound of the mean")?;
    let taken = Rung::of(&solved.scene).map_or(0, |r| r.elements_profile);
    let least = pair.cheapest(Quantity::MeanSte, share);
    let said = format!(
        "rung {taken} (least {least:?}), {} positions, {} slices, error {:+.3} %, bound {:.3} %, {cost:.2} of {default_s:.2} s, tried {}",
        solved.scene.analysis.positions_per_cycle,
        solved.scene.contact.slices.unwrap_or(0),
        100.0 * (mean.value / pair.exact(Quantity::MeanSte).unwrap_or(f64::NAN) - 1.0),
        100.0 * mean.largest() / mean.value,
        accuracy.rungs.len(),
    );
    Ok((cost, least == Some(taken), said))
}
