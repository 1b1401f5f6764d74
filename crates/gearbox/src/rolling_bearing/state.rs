//! Results of a rolling bearing under load, and the linear bearing that replaces it. Theory (101).

use nalgebra::{Matrix6, Vector6};

use super::RollingReply;

/// State of a rolling bearing at a position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RollingState {
    /// Displacement of the shaft relative to the seat, mm and rad; the rotation about z has no effect.
    pub displacement: Vector6<f64>,
    /// Force and moment on the shaft: N, N mm.
    pub force: Vector6<f64>,
    /// Tangent stiffness: N/mm, N, N mm.
    pub stiffness: Matrix6<f64>,
    /// Elastic energy, N mm.
    pub energy: f64,
    /// Largest force of a rolling element, N.
    pub element_force: f64,
    /// Largest Hertz pressure, MPa.
    pub pressure: f64,
    /// Number of loaded rolling elements.
    pub loaded: usize,
}

impl RollingState {
    /// State of a reply at a displacement, followed over a last small step of the displacements by the reply's tangent.
    pub(crate) fn new(reply: &RollingReply, displacement: Vector6<f64>, step: &Vector6<f64>) -> Self {
        let stiffness = reply.stiffness6();
        Self {
            displacement,
            force: reply.force6() - stiffness * step,
            stiffness,
            energy: reply.energy - reply.force6().dot(step),
            element_force: reply.element_force,
            pressure: reply.pressure,
            loaded: reply.loaded,
        }
    }

    /// A bearing of a shaft that does not move.
    pub(crate) fn at_rest() -> Self {
        Self {
            displacement: Vector6::zeros(),
            force: Vector6::zeros(),
            stiffness: Matrix6::zeros(),
            energy: 0.0,
            element_force: 0.0,
            pressure: 0.0,
            loaded: 0,
        }
    }
}

/// A bearing as a spring about where it stands under load.
///
/// ```text
/// f = g - T u,   g = f_0 + T u_0,   V = u' T u/2 - g . u + V_0,   V(u_0) = E_0
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Tangent {
    /// T.
    pub stiffness: Matrix6<f64>,
    /// g.
    pub preload: Vector6<f64>,
    /// V_0.
    pub stored: f64,
}

impl Tangent {
    /// Mean of several states, with the mean of their tangents; `None` for an empty list.
    pub fn about(states: &[RollingState]) -> Option<Self> {
        let count = states.len();
        if count == 0 {
            return None;
        }
        let share = 1.0 / count as f64;
        let stiffness = share * states.iter().map(|s| s.stiffness).sum::<Matrix6<f64>>();
        let mean = share * states.iter().map(|s| s.displacement).sum::<Vector6<f64>>();
        let force = share * states.iter().map(|s| s.force).sum::<Vector6<f64>>();
        let energy = share * states.iter().map(|s| s.energy).sum::<f64>();
        let stiffness = 0.5 * (stiffness + stiffness.transpose());
        let preload = force + stiffness * mean;
        let stored = energy - 0.5 * mean.dot(&(stiffness * mean)) + preload.dot(&mean);
        Some(Self { stiffness, preload, stored })
    }
}
