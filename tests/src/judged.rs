//! What the bounds of a scene say, and what is true.

use analysis::{
    NoCache, StaticAnalysis, StaticResult,
    accuracy::{Accuracy, Bound, Quantity, Rung, SolvedCycle},
};
use scene::{Method, Model, Reduction, Scene};

/// Numbers that are judged.
pub const JUDGED: [Quantity; 2] = [Quantity::MeanSte, Quantity::PeakToPeakSte];
/// Slices and positions of the finer run over those of the scene.
const FINER: u32 = 4;
/// Slices where a model has none, and of the finer run at the most.
const SLICES: [u32; 2] = [32, 512];

/// The result of a scene that asks for some accuracy, with its bounds.
///
/// # Errors
/// What went wrong.
pub fn accurate(scene: &Scene) -> Result<(Accuracy, StaticResult), String> {
    let solved = StaticAnalysis::new(scene).solve().map_err(|e| e.to_string())?;
    Ok((solved.facts.accuracy.clone().ok_or("no bounds")?, solved))
}

/// The bound of a number.
pub fn bound(accuracy: &Accuracy, quantity: Quantity) -> &Bound {
    let found = accuracy.bounds.iter().find(|b| b.quantity == quantity);
    found.unwrap_or_else(|| panic!("no bound of {}", quantity.key()))
}

/// Whether a value lies inside of a bound.
pub fn holds(bound: &Bound, exact: f64) -> bool {
    (bound.value - bound.below..=bound.value + bound.above).contains(&exact)
}

/// Bound over error; how sharp it is.
pub fn sharpness(bound: &Bound, exact: f64) -> f64 {
    bound.largest() / (exact - bound.value).abs()
}

/// The numbers of [`JUDGED`] of the scene as it was solved on a fine mesh of the ladder, by slices, with four times as
/// many positions, and slices as it has or asks for; teeth of open sectors stay as many.
///
/// # Errors
/// What went wrong.
pub fn exact(solved: &StaticResult, rung: Rung) -> Result<[f64; 2], String> {
    let mut scene = rung.scene(&solved.scene);
    scene.analysis.model = Model::Reduced;
    scene.analysis.reduction = Some(Reduction::Auto);
    scene.analysis.positions_per_cycle *= FINER;
    scene.contact.method = Method::Slice;
    (scene.contact.gap, scene.contact.points_per_face_edge) = (None, None);
    scene.contact.penalty_mpa_per_mm = None;
    scene.contact.corner_contact = Some(true);
    // A number that is too small for the pair is so four times as well.
    let asked = solved.facts.resolution.as_ref().and_then(|r| r.slices_that_would_do);
    let slices = scene.contact.slices.unwrap_or(SLICES[0]).max(asked.unwrap_or(0) as u32);
    scene.contact.slices = Some((FINER * slices).min(SLICES[1]));
    let sample = SolvedCycle::new(&scene, &NoCache).and_then(|solved| solved.sample(1)).map_err(|e| e.to_string())?;
    Ok(JUDGED.map(|quantity| sample.get(quantity).unwrap_or(f64::NAN)))
}
