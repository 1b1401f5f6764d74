//! What meshes of any kind have in common: force and tangent for displacements of their gears. Theory (81).

use contact::SliceResult;
use ltca::FilletField;
use nalgebra::{DMatrix, DVector, SMatrix, SVector};

use crate::{ExactMesh, GearboxError};

/// Displacements of gear 1 and gear 2, or forces on them: x, y, z and the turns about them, twice. The mesh's own axes:
/// x from gear 1's axis to gear 2's, z as all axes.
pub type Vector12 = SVector<f64, 12>;

/// Forces of a mesh and how they follow the displacements.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshForces {
    /// Forces (N) and moments (N mm, about the gears' own centres) on gear 1 and gear 2: what does the work of the
    /// displacements, so that the moments of the turns are those about the gears' own axes ([`contact::pose::generalised`]).
    pub force: Vector12,
    /// df/dq: N/mm, N, N mm.
    pub tangent: SMatrix<f64, 12, 12>,
    /// Sum of the normal forces, N.
    pub normal_force: f64,
}

/// Forces of a mesh on its gears and on their elastic modes, the modes in equilibrium with the flanks; axes of the mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct ModalForces {
    /// Amplitudes p of the modes of gear 1, then gear 2, mm t^(1/2): patterns that stand in space
    /// ([`reduction::StandingModes`]), of a gear that is not cyclic those of its own frame.
    pub amplitudes: DVector<f64>,
    /// Forces on the twelve displacements and on the modes: N, N mm, N t^(-1/2).
    pub force: DVector<f64>,
    /// df/d(q, p), (12 + m) x (12 + m).
    pub tangent: DMatrix<f64>,
}

/// A mesh between two gears whose nominal motion is given: displacements count from where the unmodified flanks touch
/// without load, at any phase.
pub trait MeshElement {
    /// Moves the element to a place in the mesh cycles: gear 1 has rotated by this many pitches,
    /// [`crate::Train::cycles`].
    ///
    /// # Errors
    /// [`GearboxError`] when the element cannot follow.
    fn go_to(&mut self, cycles: f64) -> Result<(), GearboxError>;

    /// Forces at displacements.
    ///
    /// # Errors
    /// [`GearboxError`] when there are none.
    fn evaluate(&mut self, displacements: &Vector12) -> Result<MeshForces, GearboxError>;

    /// Its slices, which those of other meshes of the same gears can be joined with ([`crate::StaticGearbox::joined`]); for
    /// elements that are them.
    fn exact(&mut self) -> Option<&mut ExactMesh> {
        None
    }

    /// Asked once equilibrium is found, after the last [`MeshElement::evaluate`]: whether the forces are all there are.
    ///
    /// # Errors
    /// [`GearboxError`] when they are not.
    fn check(&mut self) -> Result<(), GearboxError> {
        Ok(())
    }

    /// The same with the gears' elastic modes as coordinates, for elements that keep some; the last evaluation stays.
    ///
    /// # Errors
    /// [`GearboxError`] where the modes find no equilibrium.
    fn modal(&mut self, displacements: &Vector12) -> Result<Option<ModalForces>, GearboxError> {
        let _ = displacements;
        Ok(None)
    }

    /// Loaded slices of the last evaluation, for elements that know them.
    fn slices(&self) -> Vec<SliceResult> {
        Vec::new()
    }

    /// Stress in the root fillets of both gears under the forces of the last evaluation, for elements that know it; else none.
    ///
    /// # Errors
    /// [`GearboxError`] where it cannot be recovered.
    fn root_stress(&self) -> Result<[Vec<FilletField>; 2], GearboxError> {
        Ok(Default::default())
    }
}

/// Mesh cycles that are a number.
pub(crate) fn finite_cycles(cycles: f64) -> Result<f64, GearboxError> {
    let wrong = || GearboxError::OutOfRange { part: "mesh".into(), quantity: "mesh cycles", value: cycles };
    if cycles.is_finite() { Ok(cycles) } else { Err(wrong()) }
}
