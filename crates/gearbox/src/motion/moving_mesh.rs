//! What a motion asks of a mesh beside its forces at rest: energy, dampers, free flight. Theory (93).

use nalgebra::SMatrix;

use crate::{GearboxError, MeshElement, Vector12};

/// A mesh whose gears move. All questions are about the place of the last [`MeshElement::go_to`] and the displacements
/// of the last [`MeshElement::evaluate`]; forces are the exact derivative of the energy.
pub trait MovingMesh: MeshElement {
    /// Elastic energy V, N mm; 0 in free flight.
    fn energy(&self) -> f64;

    /// dV/dc: how it follows the mesh cycles with displacements held, N mm a cycle.
    fn energy_rate(&self) -> f64;

    /// Dampers of the flanks that touch, with the gears moving at `rates` beside their nominal motion (mm/s, rad/s) and
    /// the mesh going on by `cycles` a second.
    fn damping(&mut self, rates: &Vector12, cycles: f64) -> MeshDamper;

    /// How far the undeformed flanks overlap on the side that drives and on the other one, mm along the normal;
    /// negative where they are apart, and minus infinity for a side that this mesh does not have.
    ///
    /// # Errors
    /// [`GearboxError`] when it is not known.
    fn overlaps(&mut self) -> Result<[f64; 2], GearboxError>;

    /// Forgets what it remembers of earlier places, so that answers depend on the place alone to the last bit. Nothing to
    /// do for a mesh that is a pure function of it.
    fn forget(&mut self) {}

    /// How much of what this mesh holds the last evaluation has used: above 1 it holds no more. 0 for a mesh without
    /// such bounds.
    fn reach(&self) -> f64 {
        0.0
    }
}

/// What dampers of a mesh do.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshDamper {
    /// Forces (N) and moments (N mm) on gear 1 and gear 2, in the mesh's own axes.
    pub force: Vector12,
    /// The same on the mesh cycles, N mm a cycle: what teeth of uneven thickness are held back by.
    pub along_cycles: f64,
    /// -d force/d rates: N s/mm, N s, N mm s.
    pub rate_slope: SMatrix<f64, 12, 12>,
    /// -d force/d displacements, where dampers are held at the force of the flanks.
    pub slope: SMatrix<f64, 12, 12>,
    /// Power that they take, mW (N mm/s).
    pub dissipated: f64,
}

impl Default for MeshDamper {
    fn default() -> Self {
        let [rate_slope, slope] = [SMatrix::zeros(); 2];
        Self { force: Vector12::zeros(), along_cycles: 0.0, rate_slope, slope, dissipated: 0.0 }
    }
}
