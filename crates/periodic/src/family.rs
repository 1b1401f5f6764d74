//! Interface of a system to the search for periodic motions.

use integrate::Mechanism;
use nalgebra::DVector;

/// A mechanism that is driven with a period, and one parameter of it: speed, load, damping, clearance.
pub trait PeriodicFamily: Mechanism {
    /// Sets the parameter.
    ///
    /// # Errors
    /// The system's own, for values that it cannot have.
    fn set_parameter(&mut self, value: f64) -> Result<(), Self::Error>;

    /// Period of the motion that is looked for, s, with the parameter as it is: that of the excitation, or a whole
    /// multiple of it where subharmonic motions are asked for.
    fn period(&self) -> f64;

    /// What counts as a large motion of each coordinate, > 0.
    fn scale(&self) -> DVector<f64>;

    /// Whether the parameter moves the system through the frequency 2 pi / T alone, forces being functions of the phase
    /// t / T: the frequency's derivative by the parameter then. None where it does more.
    fn frequency_slope(&self) -> Option<f64> {
        None
    }

    /// A motion of the whole that nothing holds, such as both gears turning on together: its mean is free, and the
    /// forces along it must balance by themselves. None unless a system has one.
    fn free_direction(&self) -> Option<DVector<f64>> {
        None
    }
}
