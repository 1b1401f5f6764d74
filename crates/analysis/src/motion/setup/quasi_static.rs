//! The static mesh cycle with which a motion starts.

use ltca::{StaticHistory, StaticPosition};

/// The quasi-static mesh cycle.
#[derive(Debug, Clone)]
pub struct QuasiStatic {
    /// Transmission error, mm, position by position.
    pub transmission_error: Vec<f64>,
    /// Mean tangent stiffness, N/mm on the base circle.
    pub stiffness: f64,
    /// Mean length of the contact lines, mm.
    pub line_length: f64,
    /// Mean sum of the normal forces, N.
    pub normal_force: f64,
}

impl QuasiStatic {
    /// Of the positions of a mesh cycle.
    pub(crate) fn of(history: &StaticHistory) -> Self {
        let all = &history.positions;
        let mean = |f: &dyn Fn(&StaticPosition) -> f64| all.iter().map(f).sum::<f64>() / all.len() as f64;
        Self {
            transmission_error: all.iter().map(|p| p.transmission_error).collect(),
            stiffness: mean(&|p| p.tangent_stiffness),
            line_length: mean(&|p| p.contact_line_length),
            normal_force: mean(&|p| p.pairs.iter().map(|pair| pair.normal_force).sum()),
        }
    }

    /// Mean transmission error, mm.
    pub fn mean_error(&self) -> f64 {
        self.transmission_error.iter().sum::<f64>() / self.transmission_error.len() as f64
    }
}
