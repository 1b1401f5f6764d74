//! Options of a motion of a gearbox.

/// Drive of the input, in the sense of [`crate::Operation`]. Torque in N mm; `None`: the torque that balances the loads
/// according to the ratios of the train.
pub type Drive = dynamics::Drive<Option<f64>>;

/// Drive, damping of the shafts, and the frequency range of their reduction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MotionOptions {
    /// Drive of the input.
    pub drive: Drive,
    /// Damping ratio of every elastic mode about the initial equilibrium, with the meshes at their tangents there. It
    /// is in addition to the damping of bearings and meshes.
    pub modal_damping: f64,
    /// Highest frequency that shafts must represent, rad/s.
    pub limit: f64,
}
