//! Periodic motions of a gearbox over the speed of its input, stable and unstable. Theory (71a).

use std::{f64::consts::TAU, ops::ControlFlow};

use integrate::{Mechanism, State};
use periodic::{BalanceOptions, Branch, BranchPlan, Condensed, FourierSeries, PeriodicMotion, PeriodicMotionOf};

use super::{GearboxInstant, GearboxMechanism, speed_family::SpeedFamily};
use crate::GearboxError;

/// Motions whose multipliers are found with all modes as well.
const WITH_ALL_MODES: usize = 8;

/// Periodic motions of a gearbox along the speed of its input, 1/min.
#[derive(Debug)]
pub struct GearboxBranch {
    /// Motions and bifurcations in the displacements on which the meshes depend.
    pub branch: Branch<GearboxError>,
    /// Series of all coordinates, one per motion, in the order of the motions.
    pub motions: Vec<FourierSeries>,
    /// Series of all coordinates at the bifurcations.
    pub bifurcations: Vec<FourierSeries>,
    /// Cycles of the fastest mesh in a period.
    pub period_cycles: u64,
    /// Cycles of each mesh in a period.
    pub mesh_cycles: Vec<u64>,
    /// Number of coordinates of the gearbox, and of those on which the meshes depend.
    pub coordinates: [usize; 2],
    /// Magnitude of the largest multiplier of several motions, spread over the branch: as computed for the branch, and
    /// with the modes above twice the highest frequency that shafts must represent.
    pub with_all_modes: Vec<[f64; 2]>,
}

impl GearboxMechanism {
    /// Changes the nominal speed of the input, rad/s without its sense.
    pub fn set_speed(&mut self, speed: f64) {
        self.drive = self.drive.at_speed(speed);
    }

    /// The branch of a plan over input speeds in 1/min, starting from the motion that Newton's method finds near the
    /// equilibrium `rest` ([`GearboxMechanism::start`]). A motion may repeat after several common periods of all
    /// meshes. The numbers of harmonics and phases in the plan refer to a cycle of the fastest mesh.
    ///
    /// # Errors
    /// [`GearboxError::NoBranch`], [`GearboxError::LongPeriod`] for gearboxes without a branch,
    /// [`GearboxError::Branch`] if no motion is found.
    pub fn branch(
        &mut self,
        rest: &State,
        (plan, periods): (&BranchPlan, u64),
        seen: impl FnMut(&PeriodicMotion) -> ControlFlow<()>,
    ) -> Result<GearboxBranch, GearboxError> {
        let (family, machine, period_cycles) =
            SpeedFamily::new(self, rest, (periods, plan.balance.most_harmonics as u64))?;
        let mesh_cycles = family.mesh_cycles();
        let cycles = period_cycles as usize;
        let own = &plan.balance;
        let balance = BalanceOptions {
            harmonics: cycles * own.harmonics,
            most_harmonics: cycles * own.most_harmonics,
            least_samples: cycles * own.least_samples,
            ..plan.balance
        };
        let start = FourierSeries::at_rest(&machine.levers.tr_mul(&rest.q), 1);
        let coordinates = [machine.mass.nrows(), machine.levers.ncols()];
        let unstable = GearboxError::NoBranch { what: "whose equilibrium is not stable" };
        let mut system = Condensed::new(family, &machine).ok_or(unstable)?;
        let failed = |e| GearboxError::Branch(Box::new(e));
        let plan = BranchPlan { balance, ..*plan };
        let branch = plan.follow(&mut system, &start, seen).map_err(failed)?;
        let of = |motion: &PeriodicMotion| {
            let samples = (balance.samples_per_harmonic * motion.series.harmonics()).max(balance.least_samples);
            (motion.parameter, samples)
        };
        let mut whole = |motion: &PeriodicMotion| {
            let (parameter, samples) = of(motion);
            system.whole(&PeriodicMotionOf { parameter, series: &motion.series, samples }).map_err(failed)
        };
        let motions = branch.motions.iter().map(&mut whole).collect::<Result<_, _>>()?;
        let bifurcations = branch.bifurcations.iter().map(|b| whole(&b.motion)).collect::<Result<_, _>>()?;
        let judged = WITH_ALL_MODES.min(branch.motions.len());
        let with_all_modes = (0..judged).map(|k| {
            let motion = &branch.motions[(2 * k + 1) * branch.motions.len() / (2 * judged)];
            let (parameter, samples) = of(motion);
            let all = system.with_all_modes(&PeriodicMotionOf { parameter, series: &motion.series, samples });
            Ok([motion.floquet.largest(), all.map_err(failed)?.largest()])
        });
        let with_all_modes = with_all_modes.collect::<Result<_, GearboxError>>()?;
        Ok(GearboxBranch { branch, motions, bifurcations, period_cycles, mesh_cycles, coordinates, with_all_modes })
    }

    /// For each mesh, the largest used share of its valid range ([`super::MovingMesh::reach`]).
    pub fn reach(&self) -> &[f64] {
        &self.reach
    }

    /// State at a fraction of the period of a motion (0 .. 1) whose period is `period` s.
    pub fn state_of(series: &FourierSeries, period: f64, share: f64) -> State {
        let (phase, w) = (TAU * share, TAU / period);
        let a = series.acceleration(phase) * (w * w);
        State { a, ..State::new(share * period, series.at(phase), series.rate(phase) * w) }
    }

    /// Quantities at `count` evenly spaced instants of a motion's period, at the motion's speed.
    ///
    /// # Errors
    /// The errors of the meshes, including contact on flanks that a mesh model does not have.
    pub fn instants(
        &mut self,
        (speed, period): (f64, f64),
        series: &FourierSeries,
        count: usize,
    ) -> Result<Vec<GearboxInstant>, GearboxError> {
        self.set_speed(speed);
        let one = |i: usize| {
            let state = Self::state_of(series, period, i as f64 / count as f64);
            self.accepted(state.time, &state.q, &state.v)?;
            self.instant(&state)
        };
        (0..count).map(one).collect()
    }
}
