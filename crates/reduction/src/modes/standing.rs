//! Modes of a spinning gear as patterns that are fixed in space while the teeth pass. Theory (58a).

use nalgebra::DMatrix;

use super::GearModes;

/// Modes of a cyclic gear as patterns fixed in space: amplitudes p instead of the amplitudes q in the gear's own frame.
///
/// ```text
/// q = e^(theta N) p,   p.. + W G p. + ... ,   W d.' A p beside the kinetic energy
/// ```
/// | name | shape | unit | meaning |
/// |---|---|---|---|
/// | theta | 1 | rad | angle of the gear's own frame from the axes in which p counts, about +z |
/// | G = 2 (N + B) | m x m | 1 | gyroscopic matrix of the modes at unit angular velocity about +z, skew-symmetric |
/// | A = L'N + E | 6 x m | t^(1/2), t^(1/2) mm | gyroscopic coupling with the rigid motion of the gear, likewise |
///
/// A pattern of n waves whose material does not move sideways is observed at omega +- n W. A pattern that is a rigid
/// tilt has exactly the gyroscopic moment of a rigid body. First order in W / omega.
#[derive(Debug, Clone)]
pub struct StandingModes {
    waves: Vec<f64>,
    /// N by waves: a quarter of a wave on.
    quarter: DMatrix<f64>,
    /// Gyroscopic matrix G, m x m.
    pub gyroscopic: DMatrix<f64>,
    /// Coupling matrix A, 6 x m.
    pub coupling: DMatrix<f64>,
}

impl StandingModes {
    /// N, m x m, skew-symmetric.
    pub fn rate(&self) -> DMatrix<f64> {
        let m = self.waves.len();
        DMatrix::from_fn(m, m, |i, j| self.waves[i] * self.quarter[(i, j)])
    }

    /// e^(theta N), m x m, orthogonal. It maps amplitudes fixed in space to amplitudes in the frame of a gear at
    /// `angle` (rad).
    pub fn turned(&self, angle: f64) -> DMatrix<f64> {
        DMatrix::from_fn(self.waves.len(), self.waves.len(), |i, j| {
            let (sin, cos) = (self.waves[i] * angle).sin_cos();
            sin * self.quarter[(i, j)] + if i == j { cos } else { 0.0 }
        })
    }
}

impl GearModes {
    /// The modes as patterns fixed in space. `None` for a gear that is not condensed by sectors, and if some modes of a
    /// repeated frequency are missing.
    ///
    /// Modes without waves stay as they are in the gear's frame, and so do those of z/2 waves, which have opposite
    /// signs on neighbouring teeth.
    pub fn standing(&self) -> Option<StandingModes> {
        let (spin, waves) = (self.spin()?, self.waves()?);
        let turned = self.turned_by_teeth(1)?;
        let m = self.count();
        let phase = |j: usize| self.phase(j).filter(|psi| psi.sin().abs() > f64::EPSILON.sqrt());
        let raw = DMatrix::from_fn(m, m, |i, j| match phase(i) {
            Some(psi) if waves[i] == waves[j] => {
                let own = if i == j { psi.cos() } else { 0.0 };
                spin.way * (turned[(i, j)] - own) / psi.sin()
            }
            _ => 0.0,
        });
        let quarter = 0.5 * (&raw - raw.transpose());
        let waves: Vec<f64> = (0..m).map(|j| phase(j).map_or(0.0, |_| f64::from(waves[j]))).collect();
        let rate = DMatrix::from_fn(m, m, |i, j| waves[i] * quarter[(i, j)]);
        let shared = DMatrix::from_fn(6, m, |axis, j| self.coupling()[j][axis]);
        let swept = DMatrix::from_fn(6, m, |axis, j| spin.swept[j][axis]);
        let (gyroscopic, coupling) = (2.0 * (&rate + &spin.products), shared * &rate + swept);
        Some(StandingModes { waves, quarter, gyroscopic, coupling })
    }
}
