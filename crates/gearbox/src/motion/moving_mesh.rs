//! What a motion asks of a mesh beside its forces at rest: energy, losses, free flight, tooth changes. Theory (93).

use dynamics::{Extremes, FlankInstant, FlankStates, GearVibration, ModalForce, SideLoads};
use nalgebra::{DVector, SMatrix};

use super::lever_mesh::LeverMesh;
use crate::{GearboxError, MeshElement, MeshForces, Vector12};

/// A mesh whose gears move. All questions are about the place of the last [`MeshElement::go_to`] and the displacements
/// of the last [`MeshElement::evaluate`]; forces without friction are the exact derivative of the energy.
pub trait MovingMesh: MeshElement + Send {
    /// Told once, before all else, where in the mesh cycles the motion begins: for a mesh whose teeth change on the way.
    ///
    /// # Errors
    /// [`GearboxError`] for a place that cannot be.
    fn begin_at(&mut self, _cycles: f64) -> Result<(), GearboxError> {
        Ok(())
    }

    /// Elastic modes of both gears that this mesh has as coordinates; none of gears that are rigid beside their teeth.
    fn modes(&self) -> Option<[GearVibration; 2]> {
        None
    }

    /// Largest normal displacement of a flank by one unit of each mode, t^(-1/2).
    fn mode_sizes(&self) -> Vec<f64> {
        Vec::new()
    }

    /// Angles (rad, the mesh's own axes) of the frames in which amplitudes count, at a place in the mesh cycles, of a mesh
    /// that has modes.
    fn gear_angles(&self, _cycles: f64) -> [f64; 2] {
        [0.0; 2]
    }

    /// Deforms both gears by amplitudes of these modes, mm t^(1/2), from now on.
    fn deform(&mut self, _amplitudes: &DVector<f64>) {}

    /// What the flanks do to these modes where they were evaluated last, with the tangents of all coordinates.
    fn on_modes(&self) -> Option<&ModalForce> {
        None
    }

    /// [`MeshElement::evaluate`] with any tangent: forces alone are wanted.
    ///
    /// # Errors
    /// As of [`MeshElement::evaluate`].
    fn evaluate_forces(&mut self, displacements: &Vector12) -> Result<MeshForces, GearboxError> {
        self.evaluate(displacements)
    }

    /// Elastic energy V, N mm; 0 in free flight.
    fn energy(&self) -> f64;

    /// The same at another place, to twelve digits; where the mesh stands afterwards is open.
    ///
    /// # Errors
    /// As of [`MeshElement::evaluate`].
    fn energy_at(&mut self, cycles: f64, displacements: &Vector12) -> Result<f64, GearboxError> {
        self.go_to(cycles)?;
        self.evaluate_forces(displacements)?;
        Ok(self.energy())
    }

    /// dV/dc: how it follows the mesh cycles with displacements held, N mm a cycle.
    fn energy_rate(&self) -> f64;

    /// The same, with what the stiffness changes by on the way, which is in no force of the flanks: what the energy
    /// follows to the second order of the deflections. Where the mesh stands afterwards is open.
    ///
    /// # Errors
    /// As of [`MeshElement::evaluate`].
    fn energy_change(&mut self) -> Result<f64, GearboxError> {
        Ok(self.energy_rate())
    }

    /// Friction and dampers of the flanks that touch, with the gears moving at `rates` beside their nominal motion (mm/s,
    /// rad/s) and the mesh going on by `cycles` a second.
    fn losses(&mut self, rates: &Vector12, cycles: f64) -> MeshLosses;

    /// How far the undeformed flanks overlap on the side that drives and on the other one, mm along the normal;
    /// negative where they are apart, and minus infinity for a side that this mesh does not have.
    ///
    /// # Errors
    /// [`GearboxError`] when it is not known.
    fn overlaps(&mut self) -> Result<[f64; 2], GearboxError>;

    /// Refuses a place in the mesh cycles to which its teeth cannot be followed from where it stands.
    ///
    /// # Errors
    /// [`GearboxError`] for gears that have turned past all teeth that it knows.
    fn check_pace(&self, _cycles: f64) -> Result<(), GearboxError> {
        Ok(())
    }

    /// Asked at the end of a step, after [`MeshElement::evaluate`], with the gears moving at `rates`: takes the tooth changes
    /// that are due, which leave the forces as they are, and tells whether there was one; the mesh then stands nowhere. Adds
    /// the step to the extremes of the flanks, those of slices where it has some.
    ///
    /// # Errors
    /// [`GearboxError`] when the forces are not all there are.
    fn accept(&mut self, _rates: &dyn Fn() -> Vector12, extremes: &mut Extremes) -> Result<bool, GearboxError> {
        self.check()?;
        extremes.see(self.overlaps()?);
        Ok(false)
    }

    /// Where the windows of teeth stand that it has; none for a mesh that is a function of its place.
    fn windows(&self) -> Option<FlankStates> {
        None
    }

    /// Restores the windows.
    ///
    /// # Errors
    /// [`GearboxError`] for windows that cannot be.
    fn restore_windows(&mut self, _windows: &FlankStates) -> Result<(), GearboxError> {
        Ok(())
    }

    /// Forgets what it remembers of earlier places, so that answers depend on the place alone to the last bit. Nothing to
    /// do for a mesh that is a pure function of it.
    fn forget(&mut self) {}

    /// The combinations of displacements that all forces of this mesh depend on and act along, as rows of 12 each;
    /// `None` for a mesh that depends on more than it can name.
    fn levers(&self) -> Option<Vec<Vector12>> {
        None
    }

    /// The mesh by these levers, of one that answers along them.
    fn by_levers(&mut self) -> Option<&mut dyn LeverMesh> {
        None
    }

    /// What the driving and the coast flanks do where they were evaluated last, with the gears moving as for
    /// [`MovingMesh::losses`].
    ///
    /// # Errors
    /// [`GearboxError`] where stress of the fillets is asked for and not found.
    fn by_side(&mut self, rates: &Vector12, cycles: f64) -> Result<[FlankInstant; 2], GearboxError>;

    /// Loads on the flanks that press where they were evaluated last: the driving ones, and coast ones where these do; none
    /// of a mesh without gears that deform.
    fn loads(&self) -> Vec<SideLoads<'_>> {
        Vec::new()
    }

    /// Mesh cycles after which this mesh comes back: 1 where the teeth of both gears are alike.
    fn period(&self) -> u64 {
        1
    }

    /// How much of what this mesh holds the last evaluation has used: above 1 it holds no more. 0 for a mesh without
    /// such bounds.
    fn reach(&self) -> f64 {
        0.0
    }
}

/// What friction and dampers of a mesh do.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshLosses {
    /// Friction: forces (N) and moments (N mm) on gear 1 and gear 2, in the mesh's own axes. It is among the forces of the
    /// mesh ([`MeshForces::force`]) as what has no potential.
    pub friction: Vector12,
    /// Dampers, likewise.
    pub force: Vector12,
    /// Both on the mesh cycles, N mm a cycle: what the sliding of the turn and teeth of uneven thickness are held back by.
    pub along_cycles: f64,
    /// -d force/d rates: N s/mm, N s, N mm s.
    pub rate_slope: SMatrix<f64, 12, 12>,
    /// -d force/d displacements, where dampers are held at the force of the flanks.
    pub slope: SMatrix<f64, 12, 12>,
    /// Power that both take, mW (N mm/s): f . (rates + nominal turn). Friction is against the sliding of the nominal turn:
    /// where deviations slide the other way for a moment, its part is below 0.
    pub dissipated: f64,
}

impl Default for MeshLosses {
    fn default() -> Self {
        let [rate_slope, slope] = [SMatrix::zeros(); 2];
        let [friction, force] = [Vector12::zeros(); 2];
        Self { friction, force, along_cycles: 0.0, rate_slope, slope, dissipated: 0.0 }
    }
}
