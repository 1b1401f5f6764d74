//! Change of the contact conditions by a small rotation of the driven gear and by a change of the pair, with constant
//! forces.

use contact::{
    ContactSet, Friction, Site,
    slice::{ChangeRates, FlankChange, FlankRates, HeldForces, SameSlices},
};
use geometry::GearPair;

use super::variation::{Neighbour, Variation, merged, smallest};
use crate::{Equilibrium, WindowedPair, equilibrium::poses};

/// Gap (mm) over the approach, and force over the largest one, below which a row is about to touch or to leave.
const UNDECIDED: f64 = 1e-8;
/// Turn of the driven gear by which differences are taken, on its base circle, as one part in so many of the normal
/// module.
const STEP: f64 = 3e5;
/// Change of moments and pressures, over them, that is no kink's.
const SMALLEST_SHARE: f64 = 1e-9;

/// Rows that press or may do so at once, and the forces on them.
pub(super) struct Conditions {
    /// Numbers of the rows among all candidates.
    pub numbers: Vec<usize>,
    pub slices: SameSlices,
    pub forces: Vec<f64>,
    /// Rows that press, and do so whatever the next small change is.
    pub presses: Vec<bool>,
    /// Rows that are about to touch or to leave.
    pub undecided: Vec<usize>,
    /// Rows with the largest pressure of all, and of those at an end face or a tip edge; none where none presses.
    pub hardest: [Option<usize>; 2],
    /// Their pressures, MPa.
    pub pressure: [f64; 2],
}

/// Rates of the conditions at held forces, below and above.
#[derive(Debug)]
pub(super) struct Rates {
    /// Rates of the distances R, mm, an entry a row.
    pub distances: Vec<[f64; 2]>,
    /// Rates of the moment of the forces less that of the load, N mm.
    pub moment: [f64; 2],
    /// Rates of the largest pressures, MPa.
    pub pressure: [[f64; 2]; 2],
    /// Rate of the load on the base circle, N.
    pub load: f64,
}

impl Rates {
    /// Whether moment and pressures have equal derivatives on both sides.
    pub fn is_smooth(&self) -> bool {
        let [a, b] = &self.pressure;
        [&self.moment, a, b].into_iter().all(|[below, above]| below == above)
    }
}

impl Conditions {
    pub fn new(windowed: &WindowedPair, e: &Equilibrium) -> Self {
        let approach = e.approach(windowed.pair);
        let forces = &e.solution.forces;
        let strong = UNDECIDED * forces.iter().fold(0.0f64, |m, f| m.max(*f));
        let near = |i: usize| (e.rows[i].gap + e.solution.openings[i]).abs() <= UNDECIDED * approach;
        let which: Vec<usize> = (0..forces.len()).filter(|&i| forces[i] > 0.0 || near(i)).collect();
        let presses: Vec<bool> = which.iter().map(|&i| forces[i] > strong).collect();
        let hardest = |counts: &dyn Fn(usize) -> bool| {
            let pressures = which.iter().enumerate().filter(|(_, i)| counts(**i));
            pressures
                .map(|(k, &i)| (Some(k), e.states[i].local.pressure))
                .fold((None, 0.0), |best, now| if now.1 > best.1 { now } else { best })
        };
        let [of_all, at_edge] = [hardest(&|_| true), hardest(&|i| e.states[i].site(&e.slices[i]) != Site::Flank)];
        let (hardest, pressure) = ([of_all.0, at_edge.0], [of_all.1, at_edge.1]);
        Self {
            slices: SameSlices::of(&e.rows, &e.slices, &which),
            forces: which.iter().map(|&i| forces[i]).collect(),
            undecided: (0..which.len()).filter(|&k| !presses[k]).collect(),
            presses,
            hardest,
            pressure,
            numbers: which,
        }
    }

    /// Derivatives of the conditions at constant forces by the rotation of the driven gear (per radian), then by the
    /// parameters (per unit). `None` if a relevant slice is not on the flanks of a changed pair.
    pub fn rates(
        &self,
        windowed: &WindowedPair,
        e: &Equilibrium,
        friction: Option<&Friction>,
        variations: &[Variation],
        varied: &[([ContactSet; 2], FlankRates)],
    ) -> Option<Vec<Rates>> {
        let WindowedPair { pair, set, options, .. } = *windowed;
        let driven = options.driven();
        let base_radius = [pair.pinion.base_radius(), pair.wheel.base_radius()][driven];
        let step = pair.pinion.data().normal_module / STEP / base_radius.abs();
        let nothing = FlankRates::default();
        let turned = FlankChange {
            sets: [set; 2],
            poses: [-step, step].map(|turn| poses(windowed, e.station, e.rotation + turn)),
            friction: [friction.copied(); 2],
            steps: [step; 2],
            depths: &nothing,
        };
        let mut changes = vec![turned];
        changes.extend(variations.iter().zip(varied).map(|(variation, (sets, depths))| {
            let beside = |i: usize| {
                let Neighbour { pair, options } = &variation.sides[i];
                let windowed = WindowedPair { pair, options, set: &sets[i], ..*windowed };
                poses(&windowed, e.station, e.rotation)
            };
            let friction = variation.sides.each_ref().map(|n| Friction::new(&n.pair, &n.options.contact));
            let [down, up] = sets;
            FlankChange { sets: [down, up], poses: [beside(0), beside(1)], friction, steps: variation.steps, depths }
        }));
        let (slices, forces) = (&self.slices, &self.forces[..]);
        let held = HeldForces { set, poses: &e.poses, friction, slices, forces, body: driven, pressed: self.hardest };
        let found = held.rates(&changes)?;
        let steps = changes.iter().map(|change| change.steps);
        let with_load = [(0.0, 0.0)].into_iter().chain(variations.iter().map(|variation| {
            let torque = |i: usize| variation.sides[i].options.torque;
            let torque = (torque(1) - torque(0)) / variation.steps.iter().sum::<f64>();
            let gear = [&pair.pinion, &pair.wheel][driven];
            (-options.side().sign() * gear.sign() * torque, torque / base_radius.abs())
        }));
        let of_one = |((found, steps), (moment_more, load))| self.merged(pair, found, steps, moment_more, load);
        Some(found.into_iter().zip(steps).zip(with_load).map(of_one).collect())
    }

    /// Rates either way, those of no kink both in the middle.
    fn merged(&self, pair: &GearPair, found: ChangeRates, steps: [f64; 2], moment_more: f64, load: f64) -> Rates {
        let of_pair = smallest(pair);
        let moment = self.slices.moment(0, &self.forces).abs().max(self.slices.moment(1, &self.forces).abs());
        Rates {
            distances: found.distances.into_iter().map(|rates| merged(rates, steps, of_pair)).collect(),
            moment: merged(found.moment, steps, SMALLEST_SHARE * moment).map(|m| m - moment_more),
            pressure: [0, 1].map(|k| merged(found.pressures[k], steps, SMALLEST_SHARE * self.pressure[k])),
            load,
        }
    }
}
