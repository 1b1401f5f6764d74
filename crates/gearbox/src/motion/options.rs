//! Options of a motion of a gearbox.

use dynamics::Speed;

/// Drive of the input, in the sense of [`crate::Operation`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Drive {
    /// Prescribed speed of the input, rad/s, constant or from one to another: the inertia of the input coupling counts
    /// as infinite.
    Speed(Speed),
    /// Prescribed speed of the turn of the whole train, rad/s at the input: deviations have no momentum along it, and the
    /// torque of the input balances loads and losses at every instant. Theory (92a), (45b).
    Balanced(Speed),
    /// A torque on the input, which starts at a speed.
    Torque {
        /// Speed at the start, rad/s.
        start: f64,
        /// Torque on the input, N mm; `None`: the one that balances the loads by the ratios of the train.
        torque: Option<f64>,
    },
}

/// Drive, damping of the shafts, and how finely they are reduced.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MotionOptions {
    /// Drive of the input.
    pub drive: Drive,
    /// Damping ratio of every elastic mode about the equilibrium at the start, meshes at their tangent there; beside
    /// what bearings and meshes have.
    pub modal_damping: f64,
    /// Highest frequency that shafts must show, rad/s.
    pub limit: f64,
}

impl Drive {
    /// Speed of the input at the start, rad/s, without its sense.
    pub(super) fn start(&self) -> f64 {
        self.nominal().at(0.0)
    }

    /// Speed of the input by time where it is given, else that of the start.
    #[inline]
    pub(super) fn nominal(&self) -> Speed {
        match *self {
            Self::Speed(speed) | Self::Balanced(speed) => speed,
            Self::Torque { start, .. } => Speed::Constant(start),
        }
    }
}
