//! Elastic modes of a gear, in addition to the motion of its disc. Theory (58a), (62), (86a).

use nalgebra::{DMatrix, DVector, Matrix6, Vector6};
use reduction::GearModes;

use crate::GearboxError;

/// Normal modes of a gear with its bore held, as coordinates p of a structure in addition to the six of its disc.
///
/// ```text
/// T = (M d. d. + 2 p. L d. + p. p.)/2,   V = p Omega^2 p/2,   gyroscopic forces at the angular velocity W about +z:
///     W G p. + W A' d. on the modes with the sign of kinetic energy W d. A p
/// ```
/// | name | shape | unit | meaning |
/// |---|---|---|---|
/// | p | m | mm t^(1/2) | amplitudes, common axes ([`reduction::StandingModes`]) |
/// | L | m x 6 | t^(1/2), t^(1/2) mm | inertia that modes share with displacements and turns of the disc |
///
/// Mass and inertia M of the whole gear are those of the disc. A gear that is not cyclic has the modes of its own frame
/// at one angle; these modes have no gyroscopic forces and do not rotate past the mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct ElasticBody {
    /// Index of the gear's disc.
    pub disc: usize,
    /// Squared angular frequency omega^2 of every mode, (rad/s)^2.
    pub squares: DVector<f64>,
    /// Coupling L, m x 6.
    pub coupling: DMatrix<f64>,
    /// Gyroscopic matrix G, m x m, skew-symmetric.
    pub gyroscopic: DMatrix<f64>,
    /// How patterns turn in the gear's frame, N, m x m, skew-symmetric: q = e^(theta N) p. Zero where they do not.
    pub turning: DMatrix<f64>,
    /// Gyroscopic coupling A with the rigid motion, 6 x m.
    pub rigid_gyroscopic: DMatrix<f64>,
}

/// Eigenvalue of the inertia that modes leave to the disc, over the largest, down to which it is round-off.
const ROUND_OFF: f64 = 1e-9;

impl ElasticBody {
    /// The modes of the gear on a disc that is at `angle` (rad, its tooth 0 from +x) when the input is at its start.
    pub fn new(disc: usize, modes: &GearModes, angle: f64) -> Self {
        let m = modes.count();
        let squares = DVector::from_column_slice(modes.squares());
        match modes.standing() {
            Some(standing) => Self {
                disc,
                squares,
                coupling: modes.coupling_at(0.0),
                turning: standing.rate(),
                gyroscopic: standing.gyroscopic,
                rigid_gyroscopic: standing.coupling,
            },
            None => {
                let (gyroscopic, rigid_gyroscopic) = (DMatrix::zeros(m, m), DMatrix::zeros(6, m));
                let (turning, coupling) = (gyroscopic.clone(), modes.coupling_at(angle));
                Self { disc, squares, coupling, gyroscopic, turning, rigid_gyroscopic }
            }
        }
    }

    /// Number of modes m.
    pub fn count(&self) -> usize {
        self.squares.len()
    }

    /// Checks the sizes, and that the disc of this name has at least the inertia (t, t mm^2, by coordinate) that its modes
    /// move.
    pub(crate) fn check(&self, name: &str, inertia: [f64; 6]) -> Result<(), GearboxError> {
        let m = self.count();
        let sizes = [
            (self.coupling.shape(), (m, 6)),
            (self.gyroscopic.shape(), (m, m)),
            (self.turning.shape(), (m, m)),
            (self.rigid_gyroscopic.shape(), (6, m)),
        ];
        if let Some((found, wanted)) = sizes.into_iter().find(|(found, wanted)| found != wanted) {
            let (found, wanted) = (found.0 * found.1, wanted.0 * wanted.1);
            return Err(GearboxError::Count { what: "entries of the matrices of an elastic gear", found, wanted });
        }
        if let Some(&value) = self.squares.iter().find(|s| !(s.is_finite() && **s > 0.0)) {
            let quantity = "square of a frequency of a gear, (rad/s)^2";
            return Err(GearboxError::OutOfRange { part: name.into(), quantity, value });
        }
        let own = Matrix6::from_diagonal(&Vector6::from(inertia));
        let left = own - self.coupling.tr_mul(&self.coupling);
        // Turns and displacements differ by the square of a length.
        let scale = inertia.map(|x| if x > 0.0 { x.sqrt().recip() } else { 0.0 });
        let scaled = Matrix6::from_fn(|i, j| scale[i] * left[(i, j)] * scale[j]);
        let least = if scale.contains(&0.0) { -1.0 } else { scaled.symmetric_eigenvalues().min() };
        if least > ROUND_OFF { Ok(()) } else { Err(GearboxError::LessThanModes { gear: name.into(), share: least }) }
    }
}
