//! Reads CalculiX's `.dat` file.

use super::Deck;

/// Result of CalculiX at one position.
#[derive(Debug, Clone, PartialEq)]
pub struct CalculixResult {
    /// Rotation of the driven gear from the pose at which the gears just touch without load, rad, positive if it lags.
    pub rotation: f64,
    /// Forces of the pairs, in the order of the deck.
    pub pairs: Vec<PairForce>,
}

/// Contact force of one pair on the driver's flank.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct PairForce {
    /// Force, N, global axes.
    pub force: [f64; 3],
    /// Moment about the origin, N mm.
    pub moment: [f64; 3],
}

impl PairForce {
    /// Magnitude of the force, N.
    pub fn size(&self) -> f64 {
        self.force.iter().map(|f| f * f).sum::<f64>().sqrt()
    }
}

impl CalculixResult {
    /// From the text of the file; the last increment counts. `None` when a part is missing.
    pub(super) fn read(text: &str, deck: &Deck<'_>) -> Option<Self> {
        let mut rotation = None;
        let mut pairs: Vec<Option<PairForce>> = vec![None; deck.pairs.len()];
        let mut lines = text.lines();
        while let Some(line) = lines.next() {
            let lower = line.to_ascii_lowercase();
            if lower.contains("displacements") && lower.contains("rotation") {
                // Node, then three values: the rotation vector.
                rotation = lines.by_ref().find_map(|l| values(l).get(3).copied()).or(rotation);
            } else if lower.contains("statistics for slave set") {
                let number = pair_number(&lower)?;
                let six = lines.by_ref().map(values).find(|v| v.len() == 6)?;
                *pairs.get_mut(number)? =
                    Some(PairForce { force: [six[0], six[1], six[2]], moment: [six[3], six[4], six[5]] });
            }
        }
        // A pair that does not touch is not in the file.
        let pairs = pairs.into_iter().map(Option::unwrap_or_default).collect();
        Some(Self { rotation: deck.sense() * rotation? + deck.closing, pairs })
    }
}

/// k of `statistics for slave set PINION_k, master set ...`.
fn pair_number(line: &str) -> Option<usize> {
    let set = line.split("slave set").nth(1)?.split(',').next()?.trim();
    set.rsplit('_').next()?.trim().parse().ok()
}

fn values(line: &str) -> Vec<f64> {
    let numbers: Option<Vec<f64>> = line.split_whitespace().map(|w| w.parse().ok()).collect();
    numbers.unwrap_or_default()
}
