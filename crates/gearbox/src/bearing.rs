//! Bearings: springs and dampers, or rolling elements whose force follows a law. Theory (79), (101).

use std::sync::Arc;

use nalgebra::{Matrix6, Vector6};

use crate::rolling_bearing::RollingBearing;

/// A bearing: springs and dampers between a place of a shaft and its seat in the housing, or the ground without one; or
/// rolling elements.
#[derive(Debug, Clone, PartialEq)]
pub struct Bearing {
    /// Name for messages and tables.
    pub name: String,
    /// Shaft, from 0.
    pub shaft: usize,
    /// Position of its middle, mm from the shaft's z = 0.
    pub position: f64,
    /// Stiffness for displacements x, y, z and turns about them, symmetric: N/mm, N, N mm. A 5x5 matrix has a zero row
    /// and column for the turn about z.
    pub stiffness: Matrix6<f64>,
    /// Damping of the same, symmetric: N s/mm, N s, N mm s.
    pub damping: Matrix6<f64>,
    /// Rolling elements beside that stiffness, at rest and in motion; a vibration has springs in their place.
    pub law: Option<Arc<RollingBearing>>,
    /// Force (N) and moment (N mm) on the shaft with nothing displaced: of a spring about a loaded state.
    pub preload: Vector6<f64>,
    /// Energy with nothing displaced, N mm.
    pub stored: f64,
}

impl Bearing {
    /// A bearing without coupling between the coordinates and without damping: stiffness of x, y, z (N/mm) and of the
    /// turns about x, y, z (N mm).
    pub fn diagonal(name: impl Into<String>, shaft: usize, position: f64, stiffness: [f64; 6]) -> Self {
        Self::linear(name, shaft, position, Matrix6::from_diagonal(&Vector6::from(stiffness)))
    }

    /// A bearing of a stiffness, without damping.
    pub fn linear(name: impl Into<String>, shaft: usize, position: f64, stiffness: Matrix6<f64>) -> Self {
        let (damping, preload) = (Matrix6::zeros(), Vector6::zeros());
        Self { name: name.into(), shaft, position, stiffness, damping, law: None, preload, stored: 0.0 }
    }

    /// A rolling bearing, without damping.
    pub fn rolling(name: impl Into<String>, shaft: usize, position: f64, law: RollingBearing) -> Self {
        Self { law: Some(Arc::new(law)), ..Self::linear(name, shaft, position, Matrix6::zeros()) }
    }

    /// Stiffness of its size, before anything is known of its load but a force (N).
    pub(crate) fn rough_stiffness(&self, force: f64) -> Matrix6<f64> {
        self.law.as_ref().map_or(self.stiffness, |law| self.stiffness + law.rough_stiffness(force))
    }
}
