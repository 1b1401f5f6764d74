//! Torques of outputs and of the input that change with time, and the work of the outputs. Theory (93).

use dynamics::Torque;
use nalgebra::DVector;
use serde::{Deserialize, Serialize};

use super::loops;

/// A torque that acts on a disc by a law over time.
#[derive(Debug, Clone)]
pub(super) struct VaryingTorque {
    /// T(t), N mm about +z.
    pub law: Torque,
    /// Generalised force of a unit torque on the coordinates z, with what a balanced drive answers.
    pub along: DVector<f64>,
    /// Turn of the disc by the coordinates z.
    pub disc: DVector<f64>,
    /// Reduced coordinate of the bodies that it acts on.
    pub at: usize,
    /// Turn of its shaft over the given one of the input; 0 where that is among the coordinates.
    pub ratio: f64,
}

impl VaryingTorque {
    /// Angle of the disc with the input at an angle, rad about +z.
    fn angle(&self, input: f64, q: &DVector<f64>) -> f64 {
        self.ratio * input + loops::along(&self.disc, q)
    }
}

/// All of them; none for a gearbox whose loads are constant.
#[derive(Debug, Clone, Default)]
pub(super) struct VaryingTorques {
    all: Vec<VaryingTorque>,
    /// T(t) on the input, N mm about +z, and the generalised force of a unit of it on the coordinates z.
    input: Option<(Torque, DVector<f64>)>,
    done: TorqueMemory,
}

/// Work of torques that change with time, and the last angles of their discs.
///
/// ```text
/// W += sum over j of T_j(t + h/2) (theta_j(t + h) - theta_j(t))
/// ```
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct TorqueMemory {
    /// Work W, N mm.
    pub work: f64,
    /// Time at the end of the last step, s.
    pub time: f64,
    /// Angles of the discs at that time, rad about +z.
    pub angles: Vec<f64>,
}

impl VaryingTorques {
    /// The same with other output torques.
    pub fn with_outputs(self, all: Vec<VaryingTorque>) -> Self {
        Self { all, ..self }
    }

    /// The same with a torque over time on the input, N mm about +z; `along` is the effect of a unit torque on the
    /// coordinates z.
    pub fn with_input(self, law: Torque, along: DVector<f64>) -> Self {
        Self { input: Some((law, along)), ..self }
    }

    /// Sets another law for an output torque.
    pub fn set_output(&mut self, i: usize, law: Torque) {
        if let Some(own) = self.all.get_mut(i) {
            own.law = law;
        }
    }

    /// Whether there are no such torques.
    pub fn is_empty(&self) -> bool {
        self.all.is_empty() && self.input.is_none()
    }

    /// Output torque at a time, N mm about +z, by its index among these torques.
    pub fn output(&self, i: usize, t: f64) -> f64 {
        self.all.get(i).map_or(0.0, |own| own.law.at(t))
    }

    /// Torque on the input at a time, N mm about +z, if it has a law.
    pub fn input(&self, t: f64) -> Option<f64> {
        self.input.as_ref().map(|(law, _)| law.at(t))
    }

    /// Forces on the coordinates z at a time.
    pub fn forces(&self, t: f64) -> impl Iterator<Item = (f64, &DVector<f64>)> {
        let of_outputs = self.all.iter().map(move |own| (own.law.at(t), &own.along));
        of_outputs.chain(self.input.as_ref().map(move |(law, along)| (law.at(t), along)))
    }

    /// Torque (N mm about +z) on the input that balances these torques at a time.
    pub fn balance(&self, t: f64) -> f64 {
        self.all.iter().map(|own| -own.ratio * own.law.at(t)).sum()
    }

    /// Torque (N mm) on a reduced coordinate of the bodies at a time.
    pub fn on_body(&self, t: f64, coordinate: usize) -> f64 {
        self.all.iter().filter(|own| own.at == coordinate).map(|own| own.law.at(t)).sum()
    }

    fn angles(&self, input: f64, q: &DVector<f64>) -> Vec<f64> {
        self.all.iter().map(|own| own.angle(input, q)).collect()
    }

    /// Begins a motion at a time, with the input at an angle.
    pub fn begin(&mut self, time: f64, input: f64, q: &DVector<f64>) {
        self.done = TorqueMemory { work: 0.0, time, angles: self.angles(input, q) };
    }

    /// Ends a step at a time, with the input at an angle.
    pub fn accept(&mut self, time: f64, input: f64, q: &DVector<f64>) {
        if self.all.is_empty() {
            return;
        }
        if self.done.angles.len() != self.all.len() {
            // No motion has begun: nothing has moved yet.
            self.done.angles = self.angles(input, q);
        }
        let middle = 0.5 * (self.done.time + time);
        let mut work = 0.0;
        for (own, angle) in self.all.iter().zip(&mut self.done.angles) {
            let now = own.angle(input, q);
            work += own.law.at(middle) * (now - *angle);
            *angle = now;
        }
        self.done.work += work;
        self.done.time = time;
    }

    /// Work of the outputs since the beginning, N mm.
    pub fn work(&self) -> f64 {
        self.done.work
    }

    /// State for a checkpoint.
    pub fn memory(&self) -> TorqueMemory {
        self.done.clone()
    }

    /// Continues from a checkpoint.
    pub fn restore(&mut self, memory: &TorqueMemory) {
        self.done = memory.clone();
    }
}
