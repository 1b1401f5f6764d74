//! Options of a motion of a gearbox.

/// Drive of the input, in the sense of [`crate::Operation`]. Torque, N mm; `None`: the one that balances the loads by the ratios
/// of the train.
pub type Drive = dynamics::Drive<Option<f64>>;

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
