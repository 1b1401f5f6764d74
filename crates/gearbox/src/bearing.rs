//! Bearings: springs and dampers, or rolling elements with a nonlinear law. Theory (79), (79c), (101).

use std::sync::Arc;

use nalgebra::{Matrix6, Vector3, Vector6};

use crate::rolling_bearing::RollingBearing;

/// A bearing: springs and dampers, or rolling elements, between a shaft and its seat. The seat is in the housing, in
/// another shaft or, without either, fixed in space.
#[derive(Debug, Clone, PartialEq)]
pub struct Bearing {
    /// Name for messages and tables.
    pub name: String,
    /// Index of the shaft, from 0.
    pub shaft: usize,
    /// Position of its middle, mm from the shaft's z = 0.
    pub position: f64,
    /// Index of the shaft that contains its seat, from 0: a carrier, a pin, or a shaft within the shaft. `None`: the
    /// housing, or fixed in space.
    pub outer: Option<usize>,
    /// Disc of the gear on its shaft in whose bore it is: its rolling elements press that bore itself, which is the outer race,
    /// and the inner one is on the seat. `None`: a bearing on rigid rings, the inner one on the shaft.
    pub bore_of: Option<usize>,
    /// Displacement of its seat from the nominal position, mm: an error of a bore or of a pin.
    pub offset: Vector3<f64>,
    /// Stiffness for displacements x, y, z and rotations about them, symmetric: N/mm, N, N mm. A 5x5 matrix has a zero
    /// row and column for the rotation about z.
    pub stiffness: Matrix6<f64>,
    /// Damping for the same coordinates, symmetric: N s/mm, N s, N mm s.
    pub damping: Matrix6<f64>,
    /// Rolling elements, in addition to the stiffness, in statics and motion; a vibration model replaces them by
    /// springs.
    pub law: Option<Arc<RollingBearing>>,
    /// Force (N) and moment (N mm) on the shaft without displacement and offset; not zero for a spring linearised about
    /// a loaded state.
    pub preload: Vector6<f64>,
    /// Energy without displacement and offset, N mm.
    pub stored: f64,
}

impl Bearing {
    /// A bearing without damping and without coupling between the coordinates: stiffness in x, y, z (N/mm) and about x,
    /// y, z (N mm).
    pub fn diagonal(name: impl Into<String>, shaft: usize, position: f64, stiffness: [f64; 6]) -> Self {
        Self::linear(name, shaft, position, Matrix6::from_diagonal(&Vector6::from(stiffness)))
    }

    /// A bearing with a given stiffness, without damping.
    pub fn linear(name: impl Into<String>, shaft: usize, position: f64, stiffness: Matrix6<f64>) -> Self {
        let (damping, preload, offset) = (Matrix6::zeros(), Vector6::zeros(), Vector3::zeros());
        let (outer, bore_of, law, stored) = (None, None, None, 0.0);
        Self { name: name.into(), shaft, position, outer, bore_of, offset, stiffness, damping, law, preload, stored }
    }

    /// The same bearing with its seat in another shaft.
    pub fn in_shaft(self, outer: usize) -> Self {
        Self { outer: Some(outer), ..self }
    }

    /// The same bearing in the bore of a gear on its shaft.
    pub fn in_bore_of(self, disc: usize) -> Self {
        Self { bore_of: Some(disc), ..self }
    }

    /// A rolling bearing, without damping.
    pub fn rolling(name: impl Into<String>, shaft: usize, position: f64, law: RollingBearing) -> Self {
        Self { law: Some(Arc::new(law)), ..Self::linear(name, shaft, position, Matrix6::zeros()) }
    }

    /// Force (N) and moment (N mm) of its springs on the shaft with nothing displaced.
    ///
    /// ```text
    /// g = g_0 + K_b e,   V = V_0 + g_0 . e + e' K_b e/2        e: offset of the seat
    /// ```
    pub(crate) fn force_at_rest(&self) -> Vector6<f64> {
        self.preload + self.stiffness * self.offset6()
    }

    /// Energy of its springs with nothing displaced, N mm.
    pub(crate) fn energy_at_rest(&self) -> f64 {
        let e = self.offset6();
        self.stored + self.preload.dot(&e) + 0.5 * e.dot(&(self.stiffness * e))
    }

    /// Offset of its seat along the six axes.
    pub(crate) fn offset6(&self) -> Vector6<f64> {
        Vector6::from_fn(|k, _| if k < 3 { self.offset[k] } else { 0.0 })
    }

    /// Whether its springs press with nothing displaced.
    pub(crate) fn is_pressed(&self) -> bool {
        self.force_at_rest().amax() > 0.0
    }

    /// Stiffness of its size, before anything is known of its load but a force (N).
    pub(crate) fn rough_stiffness(&self, force: f64) -> Matrix6<f64> {
        self.law.as_ref().map_or(self.stiffness, |law| self.stiffness + law.rough_stiffness(force))
    }
}
