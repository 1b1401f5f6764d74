//! Estimates the steps of a longer analysis, and its time at the pace of the current one.

use std::f64::consts::TAU;

use gearbox::motion::PairModel;
use scene::{
    MotionScene, Run, Scene,
    gearbox::{Gearbox, GearboxMotion},
};

/// A step with twelve normal modes of either gear over one without: measured 2.8.
const MODES_COST: f64 = 2.8;
/// Damping ratio of the modes until they have settled, where the scene says none.
const MODE_DAMPING: f64 = 0.01;
/// Steps in a period of the highest mode that show it, where a file does not say how many.
const STEPS_PER_PERIOD: f64 = 16.0;

/// What the scene asks of a motion, as far as it says how long that takes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct StepDemand {
    rows: f64,
    steps_per_period: f64,
    /// ln(1 / tolerance) of a motion that settles; nothing of any other.
    decay: Option<f64>,
    /// Longest time to settle and time written, of all speeds, in mesh cycles.
    cycles: f64,
    /// Speeds, each one way.
    runs: f64,
    /// Mean mesh frequency, Hz.
    mesh_hz: f64,
    mode_damping: f64,
}

/// How fast this run went.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Pace {
    /// Wall time of a step, s; `None` where that is not known.
    pub step_s: Option<f64>,
}

/// Steps foreseen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct StepEstimate {
    steps: f64,
    cost: f64,
}

impl StepDemand {
    /// `cycles` is the average number of mesh cycles at each speed; `mesh_hz` has the lowest and highest mesh
    /// frequency.
    pub fn new(scene: &Scene, motion: &MotionScene, cycles: f64, mesh_hz: [f64; 2]) -> Self {
        let settles = matches!(motion.run, Run::Steady | Run::Shooting | Run::Sweep);
        let runs = motion.sweep.as_ref().map_or(1.0, |s| f64::from(s.speeds) * s.ways.len() as f64);
        Self {
            rows: f64::from(motion.steps_per_mesh_cycle),
            steps_per_period: f64::from(motion.steps_per_resonance),
            decay: settles.then(|| -motion.periodic_tolerance.unwrap_or(1e-6).ln()),
            cycles,
            runs,
            mesh_hz: 0.5 * (mesh_hz[0] + mesh_hz[1]),
            mode_damping: scene.modes.map_or(MODE_DAMPING, |m| m.damping_ratio),
        }
    }

    /// Demand of a gearbox motion with a number of cycles of its fastest mesh (Hz), including those for settling.
    pub fn of_gearbox((file, motion): (&Gearbox, &GearboxMotion), cycles: f64, mesh_hz: f64) -> Self {
        Self {
            rows: f64::from(motion.steps_per_cycle),
            steps_per_period: STEPS_PER_PERIOD,
            decay: motion.settle.map(|(tolerance, _)| -tolerance.ln()),
            cycles,
            runs: 1.0,
            mesh_hz,
            mode_damping: file.modes.map_or(MODE_DAMPING, |m| m.damping_ratio),
        }
    }

    /// Demand with modes of both gears up to `below_hz`, the lowest at `lowest_hz`: steps must resolve the highest
    /// mode, and the lowest must decay. `already` tells whether this run has modes.
    pub fn with_modes(&self, below_hz: f64, lowest_hz: f64, already: bool) -> StepEstimate {
        let settling = self.decay.map_or(0.0, |d| d / (TAU * self.mode_damping) * self.mesh_hz / lowest_hz);
        let cycles = self.cycles.max(settling) * self.runs;
        let per_cycle = self.rows.max(self.steps_per_period * below_hz / self.mesh_hz);
        StepEstimate { steps: cycles * per_cycle, cost: if already { 1.0 } else { MODES_COST } }
    }

    /// Demand of the scene itself before it begins: steps per cycle times cycles, with the decay of the lowest mode
    /// included.
    pub fn as_it_is(&self, system: &PairModel) -> StepEstimate {
        let fastest = fastest_hz(system);
        let slowest = system.mode_frequencies_hz().into_iter().fold(system.mesh_resonance_hz(), f64::min);
        StepEstimate { cost: 1.0, ..self.with_modes(fastest, slowest, true) }
    }
}

/// The fastest motion that steps have to show, Hz: the mesh resonance, or the highest mode that is kept.
pub(crate) fn fastest_hz(system: &PairModel) -> f64 {
    system.mode_frequencies_hz().into_iter().fold(system.mesh_resonance_hz(), f64::max)
}

impl Pace {
    /// Pace of a number of steps in a wall-clock time, s.
    pub fn of(wall_s: f64, steps: f64) -> Self {
        Self { step_s: (steps > 0.0 && wall_s > 0.0).then(|| wall_s / steps) }
    }
}

impl StepEstimate {
    /// Total number of steps.
    pub fn steps(&self) -> f64 {
        self.steps
    }

    /// Text about the motion.
    pub fn describe(&self, pace: Pace) -> String {
        let steps = format!("some {} steps", grouped(self.steps));
        match pace.step_s.map(|s| s * self.cost * self.steps) {
            Some(s) if s.is_finite() => format!("{steps}, {} at the pace of this run", duration(s)),
            _ => steps,
        }
    }
}

/// Two digits, thousands set apart.
fn grouped(x: f64) -> String {
    let unit = 10f64.powf((x.max(1.0).log10().floor() - 1.0).max(0.0));
    let digits = format!("{:.0}", (x / unit).round() * unit);
    let first = digits.len() % 3;
    let parts = (first > 0).then(|| digits[..first].to_owned()).into_iter();
    let rest = digits.as_bytes()[first..].chunks(3).map(|c| String::from_utf8_lossy(c).into_owned());
    parts.chain(rest).collect::<Vec<_>>().join(",")
}

/// As short as it can be read.
fn duration(s: f64) -> String {
    match s {
        s if s < 90.0 => format!("{:.0} s", s.max(1.0)),
        s if s < 5400.0 => format!("{:.0} min", s / 60.0),
        s => format!("{:.1} h", s / 3600.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prices_are_short() {
        assert_eq!([12_345.0, 999_999.0, 7.0].map(grouped), ["12,000", "1,000,000", "7"]);
        assert_eq!([0.2, 89.0, 600.0, 33_900.0].map(duration), ["1 s", "89 s", "10 min", "9.4 h"]);
        let estimate = StepEstimate { steps: 1e5, cost: 2.0 };
        assert_eq!(estimate.describe(Pace { step_s: Some(1e-3) }), "some 100,000 steps, 3 min at the pace of this run");
        assert_eq!(estimate.describe(Pace { step_s: None }), "some 100,000 steps");
    }

    /// Light damping of a mode decides how long it takes to settle, its frequency how long the steps are.
    #[test]
    fn modes_cost_steps_and_cycles() {
        let demand = StepDemand {
            rows: 64.0,
            steps_per_period: 16.0,
            decay: Some(1e6f64.ln()),
            cycles: 20.0,
            runs: 1.0,
            mesh_hz: 1000.0,
            mode_damping: 0.01,
        };
        // A mode at 20 kHz dies out in 220 of its periods, 11 mesh cycles: less than what the mesh took.
        assert_eq!(demand.with_modes(40_000.0, 20_000.0, false).steps, 20.0 * 640.0);
        let slow = demand.with_modes(40_000.0, 5_000.0, false).steps / 640.0;
        assert!((slow - 1e6f64.ln() / (TAU * 0.01) / 5.0).abs() < 1e-9, "{slow} cycles");
        assert_eq!(StepDemand { decay: None, ..demand }.with_modes(2_000.0, 5_000.0, false).steps, 20.0 * 64.0);
    }
}
