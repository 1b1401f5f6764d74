//! Displacements of a pair with elastic gears.

use nalgebra::DVector;

use crate::Displacement;

/// Displacement or velocity of a pair: rigid coordinates d of both gears, and amplitudes q of their normal modes.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct ElasticDisplacement {
    pub d: Displacement,
    pub q: DVector<f64>,
}

impl ElasticDisplacement {
    /// Of gears without modes.
    pub fn rigid(d: Displacement) -> Self {
        Self { d, q: DVector::zeros(0) }
    }
}
