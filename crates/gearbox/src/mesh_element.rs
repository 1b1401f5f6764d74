//! Interface of all meshes: force and tangent for displacements of their gears. Theory (81).

use std::any::Any;

use contact::SliceResult;
use ltca::FilletField;
use nalgebra::{DMatrix, DVector, SMatrix, SVector};

use crate::GearboxError;

/// Displacements of gear 1 and gear 2, or forces on them: x, y, z and the rotations about them, for each gear. They are
/// in the mesh's own axes: x from gear 1's axis to gear 2's, z as everywhere.
pub type Vector12 = SVector<f64, 12>;

/// Forces of a mesh and their derivative by the displacements.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshForces {
    /// Forces (N) and moments (N mm, about the gears' own centres) on gear 1 and gear 2. They are conjugate to the
    /// displacements, so the moments of the rotations are those about the gears' own axes
    /// ([`contact::pose::generalised`]).
    pub force: Vector12,
    /// Tangent df/dq: N/mm, N, N mm.
    pub tangent: SMatrix<f64, 12, 12>,
    /// Sum of the normal forces, N.
    pub normal_force: f64,
}

/// Forces of a mesh on its gears and on their elastic modes, with the modes in equilibrium with the flanks; in the axes
/// of the mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct ModalForces {
    /// Amplitudes p of the modes of gear 1, then of gear 2, mm t^(1/2). They are patterns fixed in space
    /// ([`reduction::StandingModes`]); for a gear that is not cyclic, patterns in its own frame.
    pub amplitudes: DVector<f64>,
    /// Forces on the twelve displacements and on the modes: N, N mm, N t^(-1/2).
    pub force: DVector<f64>,
    /// Tangent df/d(q, p), (12 + m) x (12 + m).
    pub tangent: DMatrix<f64>,
}

/// A mesh between two gears with given nominal motion. Displacements are counted from the position, at any phase, at
/// which the unmodified flanks touch without load.
pub trait MeshElement {
    /// Moves the element to a position in the mesh cycles. `cycles` is the rotation of gear 1 in pitches, see
    /// [`crate::Train::cycles`].
    ///
    /// # Errors
    /// [`GearboxError`] if the element cannot follow.
    fn go_to(&mut self, cycles: f64) -> Result<(), GearboxError>;

    /// Forces at given displacements.
    ///
    /// # Errors
    /// [`GearboxError`] if the forces cannot be computed.
    fn evaluate(&mut self, displacements: &Vector12) -> Result<MeshForces, GearboxError>;

    /// The element itself, for those whose slices can be joined with the slices of other meshes of the same gears.
    fn to_join(&mut self) -> Option<&mut dyn Any> {
        None
    }

    /// Checks, once equilibrium is found and after the last [`MeshElement::evaluate`], that no other contact would add
    /// forces.
    ///
    /// # Errors
    /// [`GearboxError`] if other contact would add forces.
    fn check(&mut self) -> Result<(), GearboxError> {
        Ok(())
    }

    /// Forces with the gears' elastic modes as coordinates, for elements with modes; the last evaluation stays valid.
    ///
    /// # Errors
    /// [`GearboxError`] if the modes find no equilibrium.
    fn modal(&mut self, displacements: &Vector12) -> Result<Option<ModalForces>, GearboxError> {
        let _ = displacements;
        Ok(None)
    }

    /// Loaded slices of the last evaluation, for elements with slices.
    fn slices(&self) -> Vec<SliceResult> {
        Vec::new()
    }

    /// Stress in the root fillets of both gears under the forces of the last evaluation, for elements that compute it;
    /// otherwise empty.
    ///
    /// # Errors
    /// [`GearboxError`] if it cannot be recovered.
    fn root_stress(&self) -> Result<[Vec<FilletField>; 2], GearboxError> {
        Ok(Default::default())
    }
}

/// Mesh cycles that are a number.
pub(crate) fn finite_cycles(cycles: f64) -> Result<f64, GearboxError> {
    let wrong = || GearboxError::OutOfRange { part: "mesh".into(), quantity: "mesh cycles", value: cycles };
    if cycles.is_finite() { Ok(cycles) } else { Err(wrong()) }
}

/// Twelve values put where both gears are among the seats.
pub(crate) fn spread(size: usize, at: [usize; 2], values: &Vector12) -> DVector<f64> {
    let mut all = DVector::zeros(size);
    (0..12).for_each(|k| all[at[k / 6] + k % 6] += values[k]);
    all
}
