//! What a small turn of the driven gear, and a neighbour of the pair, change of the conditions of contact, forces held.

use contact::{ContactSet, Friction, Pose, Site, TableWork, slice::SameSlices};

use geometry::GearPair;

use super::variation::{Neighbour, Variation, rates, smallest};
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

/// Distances, moment and pressures at one place.
type Sample = (Vec<f64>, f64, [f64; 2]);

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
        }
    }

    fn sample(
        &self,
        windowed: &WindowedPair,
        (set, poses): (&ContactSet, &[Pose; 2]),
        friction: Option<&Friction>,
        work: &mut [TableWork],
    ) -> Option<Sample> {
        let found = set.same_slices(friction, poses, &self.slices)?;
        let moment = found.moment(windowed.options.driven(), &self.forces);
        let pressure = self.hardest.map(|row| row.map_or(0.0, |row| found.pressure(row, self.forces[row])));
        Some((found.distances(set, &self.forces, work), moment, pressure))
    }

    /// `pair`: the one in the middle.
    fn rates(&self, pair: &GearPair, samples: [&Sample; 3], steps: [f64; 2], [moment_more, load]: [f64; 2]) -> Rates {
        let of_pair = smallest(pair);
        let [less, here, more] = samples;
        let distance = |i: usize| rates([less.0[i], here.0[i], more.0[i]], steps, of_pair);
        let moment = rates([less.1, here.1, more.1], steps, SMALLEST_SHARE * here.1.abs());
        Rates {
            distances: (0..here.0.len()).map(distance).collect(),
            moment: moment.map(|m| m - moment_more),
            pressure: [0, 1].map(|k| rates([less.2[k], here.2[k], more.2[k]], steps, SMALLEST_SHARE * here.2[k])),
            load,
        }
    }

    /// Derivatives of the conditions with respect to the rotation of the driven gear, per radian.
    pub fn by_rotation(
        &self,
        windowed: &WindowedPair,
        e: &Equilibrium,
        friction: Option<&Friction>,
        work: &mut [TableWork],
    ) -> Option<Rates> {
        let WindowedPair { pair, set, options, .. } = *windowed;
        let step = pair.pinion.data().normal_module
            / STEP
            / [pair.pinion.base_radius(), pair.wheel.base_radius()][options.driven()];
        let mut at = |turn: f64| {
            let poses = poses(windowed, e.station, e.rotation + turn);
            self.sample(windowed, (set, &poses), friction, work)
        };
        Some(self.rates(pair, [&at(-step)?, &at(0.0)?, &at(step)?], [step; 2], [0.0; 2]))
    }

    /// Derivatives of the conditions with respect to a parameter, per unit.
    pub fn by_variation(
        &self,
        windowed: &WindowedPair,
        e: &Equilibrium,
        variation: &Variation,
        varied: &[ContactSet; 2],
        work: &mut [TableWork],
    ) -> Option<Rates> {
        let WindowedPair { pair, set, options, .. } = *windowed;
        let friction = Friction::new(pair, &options.contact);
        let here = self.sample(windowed, (set, &e.poses), friction.as_ref(), work)?;
        let mut of_side = |i: usize| {
            let Neighbour { pair, options } = &variation.sides[i];
            let beside = WindowedPair { pair, options, set: &varied[i], ..*windowed };
            let poses = poses(&beside, e.station, e.rotation);
            let friction = Friction::new(pair, &options.contact);
            self.sample(&beside, (&varied[i], &poses), friction.as_ref(), work)
        };
        let samples = [of_side(0)?, of_side(1)?];
        let torque = |i: usize| variation.sides[i].options.torque;
        let torque = (torque(1) - torque(0)) / variation.steps.iter().sum::<f64>();
        let load = torque / [pair.pinion.base_radius(), pair.wheel.base_radius()][options.driven()].abs();
        let moment = -options.side().sign() * [&pair.pinion, &pair.wheel][options.driven()].sign() * torque;
        Some(self.rates(pair, [&samples[0], &here, &samples[1]], variation.steps, [moment, load]))
    }
}
