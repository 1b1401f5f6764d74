//! Displacements of a pair with elastic gears.

use nalgebra::DVector;

use crate::Displacement;

/// Place or velocity of a pair: rigid displacements of both gears and amplitudes q of their modes.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct ElasticDisplacement {
    pub d: Displacement,
    pub q: DVector<f64>,
}
