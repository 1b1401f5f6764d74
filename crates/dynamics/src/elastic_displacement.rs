//! Displacements of a pair with elastic gears.

use nalgebra::DVector;

use crate::Displacement;

/// Displacement or velocity of a pair: rigid coordinates d of both gears, and amplitudes q of their normal modes.
#[derive(Debug, Clone, PartialEq)]
pub struct ElasticDisplacement {
    /// Displacements of both gears, mm and rad, or their rates.
    pub d: Displacement,
    /// Amplitudes of the modes of pinion and wheel, mm t^(1/2); empty without modes.
    pub q: DVector<f64>,
}

impl ElasticDisplacement {
    /// Displacement of gears without modes.
    pub fn rigid(d: Displacement) -> Self {
        Self { d, q: DVector::zeros(0) }
    }
}
