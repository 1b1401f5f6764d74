//! Steps that are too long for an explicit method, and sufficient settings.

use std::f64::consts::TAU;

use integrate::StepLimit;

use crate::refused::Refusal;

/// Most steps that the scene's keys take.
const MOST: f64 = 100_000.0;
/// Share of the limit that the advice makes use of: tangents grow a little on the way.
const WITHIN: f64 = 0.9;

/// Longest steps of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Steps {
    /// Step length, s.
    pub step: f64,
    /// Keys that set the number of steps, each with the frequency (Hz) whose period they divide; 0: none.
    pub keys: [(&'static str, f64); 2],
}

impl Steps {
    /// Steps of a pair: the mesh frequency at this step, and the mesh resonance to which `steps_per_resonance` refers,
    /// Hz; 0: none.
    pub fn of_pair(step: f64, mesh_hz: f64, resonance_hz: f64) -> Self {
        Self { step, keys: [("steps_per_resonance", resonance_hz), ("steps_per_mesh_cycle", mesh_hz)] }
    }

    /// Steps of a gearbox: the frequency of its fastest mesh at this step, Hz.
    pub fn of_gearbox(step: f64, mesh_hz: f64) -> Self {
        Self { step, keys: [("steps_per_cycle", mesh_hz), ("", 0.0)] }
    }
}

/// Steps beyond the stability limit of an explicit method.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UnstableSteps {
    /// The steps.
    pub steps: Steps,
    /// The longest stable step.
    pub limit: StepLimit,
}

impl std::fmt::Display for UnstableSteps {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { steps, limit } = self;
        let (step, fastest, longest) = (steps.step, limit.rate / TAU, limit.step);
        write!(
            f,
            "a step of {step:.3e} s is too long for the explicit method: with the fastest motion of this system \
             ({fastest:.4e} Hz) it is stable up to {longest:.3e} s"
        )
    }
}

impl UnstableSteps {
    /// The steps if an explicit method is unstable with them; `None` if it is stable.
    pub fn of(steps: Steps, limit: StepLimit) -> Option<Self> {
        (steps.step > limit.step).then_some(Self { steps, limit })
    }

    /// The error about these steps.
    pub fn refusal(&self) -> Refusal {
        Refusal::no_result(self.to_string(), Some(self.hint()))
    }

    /// Keys with sufficient values, as far as the keys permit them.
    pub fn hint(&self) -> String {
        let Self { steps, limit } = self;
        let needed = |hz: f64| (1.0 / (WITHIN * limit.step * hz)).ceil();
        let would_do: Vec<String> = steps
            .keys
            .iter()
            .filter(|(_, hz)| *hz > 0.0 && needed(*hz) <= MOST)
            .map(|(key, hz)| format!("`{key} = {:.0}`", needed(*hz)))
            .collect();
        let others = "an `error_tolerance`, or an implicit `method`";
        if would_do.is_empty() {
            format!("take {others}")
        } else {
            format!("{} would do, or {others}", would_do.join(" or "))
        }
    }
}
