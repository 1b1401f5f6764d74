//! How do bounds, and the choice of the cheapest rung or model, do on pairs that the calibration has not seen?
//!
//! `laws`: the committed laws on measured pairs, without a run. `rest`: every measured pair is solved with `model = "auto"` and
//! with the program's default settings. `motion`: every narrow random pair is moved at one speed with `model = "auto"`, and held
//! against `reduced+modes` with fine steps on a mesh of the rung. `gearbox`: narrow random pairs on elastic shafts, against fine
//! meshes, slices, positions and shaft elements.

mod gearbox;
mod laws;
mod motion;
mod rest;

use std::collections::BTreeMap;

use analysis::accuracy::Bound;
use verification::measured_pair::LEAST_ERROR;

use super::Failure;

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

/// By the key of the quantity.
type Tallies = BTreeMap<&'static str, Tally>;

impl Tally {
    /// One bound more beside the exact value; whether that is within.
    fn add(&mut self, bound: &Bound, exact: f64) -> bool {
        let error = exact - bound.value;
        let within = -bound.below <= error && error <= bound.above;
        self.pairs += 1;
        self.within += usize::from(within);
        self.sharpness.push(bound.largest() / error.abs().max(LEAST_ERROR * exact.abs()));
        let (said, is_kept) = (bound.met == Some(true), bound.asked.is_some_and(|asked| error.abs() <= asked));
        self.met[0] += usize::from(said);
        self.met[1] += usize::from(is_kept);
        self.met[2] += usize::from(said && !is_kept);
        within
    }
}

/// `words`: `laws`, `rest`, `motion` or `gearbox`, and what these want.
pub(super) fn run(words: &[String]) -> Result<(), Failure> {
    let [kind, words @ ..] = words else { return Err("laws, rest, motion or gearbox is wanted".into()) };
    if kind == "laws" {
        return laws::check(words);
    }
    let [percent, more @ ..] = words else { return Err("rest|motion|gearbox TOLERANCE_PERCENT are wanted".into()) };
    let share = 1e-2 * percent.parse::<f64>()?;
    let mut tallies = Tallies::new();
    match kind.as_str() {
        "rest" => rest::check(share, more, &mut tallies)?,
        "motion" => motion::check(share, more, &mut tallies)?,
        "gearbox" => gearbox::check(share, more, &mut tallies)?,
        _ => return Err("`laws`, `rest`, `motion` or `gearbox` is wanted first".into()),
    }
    for (key, mut tally) in tallies {
        let [said, kept, wrong] = tally.met;
        println!(
            "{percent} %: {key:24} within {:3} of {:3} ({:.1} %), median bound over error {:.1}; said to be kept {said}, \
             kept {kept}, said though not so {wrong}",
            tally.within,
            tally.pairs,
            100.0 * tally.within as f64 / tally.pairs as f64,
            median(&mut tally.sharpness)
        );
    }
    Ok(())
}

fn median(all: &mut [f64]) -> f64 {
    all.sort_unstable_by(f64::total_cmp);
    all.get(all.len() / 2).copied().unwrap_or(f64::NAN)
}
