//! Plan of a branch, and its checks.

use periodic::{BalanceOptions, Branch, BranchPlan};

use super::BranchPoint;
use crate::certificate::{Check, Checks};

/// Residual of the balance of forces that Newton's method ends with: twelve digits of a contact solver are not to be
/// had over many harmonics.
const TOLERANCE: f64 = 1e-9;
/// Phases for each harmonic.
const SAMPLES_PER_HARMONIC: usize = 8;
/// Share of the range that a branch may leave out.
const LEFT_OUT: f64 = 1e-2;

/// Words of a document about the accuracy of a branch.
pub(crate) struct BranchWords {
    pub range: [f64; 2],
    /// First and largest number.
    pub harmonics: [u32; 2],
    pub tail: f64,
    pub phases: u32,
    pub longest_step: f64,
    pub motions: u32,
}

impl BranchWords {
    /// The plan of the requested branch.
    pub fn plan(&self) -> BranchPlan {
        let balance = BalanceOptions {
            harmonics: self.harmonics[0] as usize,
            most_harmonics: self.harmonics[1] as usize,
            tail: self.tail,
            samples_per_harmonic: SAMPLES_PER_HARMONIC,
            least_samples: self.phases as usize,
            tolerance: TOLERANCE,
        };
        let ([from, to], most) = (self.range, self.motions as usize);
        BranchPlan { from, to, balance, longest_step: self.longest_step, most }
    }
}

/// What must hold of a branch.
pub(crate) fn checks<E>(branch: &Branch<E>, plan: &BranchPlan) -> Checks {
    let largest = |of: fn(&periodic::PeriodicMotion) -> f64| branch.motions.iter().map(of).fold(0.0, crate::worse);
    Checks::new([
        Check {
            name: "harmonic_residual".into(),
            value: largest(|m| m.residual),
            bound: 10.0 * TOLERANCE,
            hint: "give more `phases`",
        },
        Check {
            name: "harmonic_tail".into(),
            value: largest(|m| m.tail),
            bound: plan.balance.tail,
            hint: "give more `most_harmonics`",
        },
        Check {
            name: "range_left_out".into(),
            value: plan.left_out(branch),
            bound: LEFT_OUT,
            hint: "give more `motions`, a larger `longest_step` or more damping in [motion.continuation] and [motion]; the remarks \
                  say where the branch ended",
        },
    ])
}

/// Motions to be integrated in time: stable ones, spread over the branch.
pub(crate) fn stable_ones<'a>(points: impl Iterator<Item = &'a BranchPoint>, most: usize) -> Vec<usize> {
    let stable: Vec<usize> = points.enumerate().filter(|(_, p)| p.is_stable).map(|(i, _)| i).collect();
    let count = most.min(stable.len());
    // In the middle of as many equal parts.
    (0..count).map(|k| stable[(2 * k + 1) * stable.len() / (2 * count)]).collect()
}
