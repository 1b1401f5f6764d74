//! Interface of a mesh in motion, in addition to its static forces: energy, losses, separated flanks, tooth changes.
//! Theory (93).

use dynamics::{Extremes, FlankInstant, FlankStates, GearVibration, ModalForce, SideLoads};
use nalgebra::{DVector, SMatrix};

use super::lever_mesh::LeverMesh;
use crate::{GearboxError, MeshElement, MeshForces, Vector12};

/// A mesh whose gears move. All methods refer to the position of the last [`MeshElement::go_to`] and the displacements
/// of the last [`MeshElement::evaluate`]. Forces without friction are the exact derivative of the energy.
pub trait MovingMesh: MeshElement + Send {
    /// Called once, before all other methods, with the position in the mesh cycles at which the motion begins; for a
    /// mesh whose teeth change during the motion.
    ///
    /// # Errors
    /// [`GearboxError`] for an impossible position.
    fn begin_at(&mut self, _cycles: f64) -> Result<(), GearboxError> {
        Ok(())
    }

    /// Elastic modes of both gears that are coordinates of this mesh; `None` for gears that are rigid apart from their
    /// teeth.
    fn modes(&self) -> Option<[GearVibration; 2]> {
        None
    }

    /// Largest normal displacement of a flank per unit of each mode, t^(-1/2).
    fn mode_sizes(&self) -> Vec<f64> {
        Vec::new()
    }

    /// Angles (rad, in the mesh's own axes) of the frames of the amplitudes at a position in the mesh cycles, for a
    /// mesh with modes.
    fn gear_angles(&self, _cycles: f64) -> [f64; 2] {
        [0.0; 2]
    }

    /// Sets the amplitudes of these modes, by which both gears are deformed, mm t^(1/2).
    fn deform(&mut self, _amplitudes: &DVector<f64>) {}

    /// Forces of the flanks on these modes at the last evaluation, with the tangents of all coordinates.
    fn on_modes(&self) -> Option<&ModalForce> {
        None
    }

    /// As [`MeshElement::evaluate`], but the tangent need not be accurate: only the forces are needed.
    ///
    /// # Errors
    /// The errors of [`MeshElement::evaluate`].
    fn evaluate_forces(&mut self, displacements: &Vector12) -> Result<MeshForces, GearboxError> {
        self.evaluate(displacements)
    }

    /// Elastic energy V, N mm; 0 if the flanks are separated.
    fn energy(&self) -> f64;

    /// Elastic energy at another position, accurate to twelve digits; the position of the mesh is undefined afterwards.
    ///
    /// # Errors
    /// The errors of [`MeshElement::evaluate`].
    fn energy_at(&mut self, cycles: f64, displacements: &Vector12) -> Result<f64, GearboxError> {
        self.go_to(cycles)?;
        self.evaluate_forces(displacements)?;
        Ok(self.energy())
    }

    /// dV/dc: change of the energy with the mesh cycles at constant displacements, N mm per cycle.
    fn energy_rate(&self) -> f64;

    /// The same, including the change of stiffness with the cycles, which does not appear in the forces of the flanks.
    /// This is the change of energy to second order in the deflections. The position of the mesh is undefined
    /// afterwards.
    ///
    /// # Errors
    /// The errors of [`MeshElement::evaluate`].
    fn energy_change(&mut self) -> Result<f64, GearboxError> {
        Ok(self.energy_rate())
    }

    /// Friction and damper forces of the flanks in contact. The gears move at `rates` relative to their nominal motion
    /// (mm/s, rad/s), and the mesh advances by `cycles` per second.
    fn losses(&mut self, rates: &Vector12, cycles: f64) -> MeshLosses;

    /// Overlap of the undeformed flanks on the driving side and on the other one, mm along the normal. It is negative
    /// if they are apart, and minus infinity for a side that this mesh does not have.
    ///
    /// # Errors
    /// [`GearboxError`] if it is not known.
    fn overlaps(&mut self) -> Result<[f64; 2], GearboxError>;

    /// Returns an error for a position in the mesh cycles to which its teeth cannot be followed from the current one.
    ///
    /// # Errors
    /// [`GearboxError`] if the gears have rotated past all teeth of the windows.
    fn check_pace(&self, _cycles: f64) -> Result<(), GearboxError> {
        Ok(())
    }

    /// Called at the end of a step, after [`MeshElement::evaluate`], with the gears moving at `rates`. It makes the
    /// tooth changes that are due, which do not change the forces, and returns whether there was one; the mesh then has
    /// no position. It adds the step to the extremes of the flanks, and to those of the slices if there are any.
    ///
    /// # Errors
    /// [`GearboxError`] if other contact would add forces.
    fn accept(&mut self, _rates: &dyn Fn() -> Vector12, extremes: &mut Extremes) -> Result<bool, GearboxError> {
        self.check()?;
        extremes.see(self.overlaps()?);
        Ok(false)
    }

    /// Positions of its windows of teeth; `None` for a mesh that is a function of its position alone.
    fn windows(&self) -> Option<FlankStates> {
        None
    }

    /// Restores the windows.
    ///
    /// # Errors
    /// [`GearboxError`] for impossible windows.
    fn restore_windows(&mut self, _windows: &FlankStates) -> Result<(), GearboxError> {
        Ok(())
    }

    /// Discards its memory of earlier positions, so that results depend only on the position, to the last bit. Does
    /// nothing for a mesh that is a pure function of its position.
    fn forget(&mut self) {}

    /// The combinations of displacements on which all forces of this mesh depend and along which they act, as rows of
    /// 12 each; `None` for a mesh that depends on more.
    fn levers(&self) -> Option<Vec<Vector12>> {
        None
    }

    /// Access to this mesh by its levers, if it has levers.
    fn by_levers(&mut self) -> Option<&mut dyn LeverMesh> {
        None
    }

    /// Loads of the driving and the coast flanks at the last evaluation, with the gears moving as for
    /// [`MovingMesh::losses`].
    ///
    /// # Errors
    /// [`GearboxError`] if stress of the fillets is requested and cannot be computed.
    fn by_side(&mut self, rates: &Vector12, cycles: f64) -> Result<[FlankInstant; 2], GearboxError>;

    /// Loads on the flanks in contact at the last evaluation: the driving ones, and the coast ones if they are in
    /// contact; empty for a mesh without deformable gears.
    fn loads(&self) -> Vec<SideLoads<'_>> {
        Vec::new()
    }

    /// Number of mesh cycles after which this mesh repeats: 1 if the teeth of both gears are equal.
    fn period(&self) -> u64 {
        1
    }

    /// Share of this mesh's valid range used in the last evaluation; above 1 the position is outside the range. 0 for a
    /// mesh without such limits.
    fn reach(&self) -> f64 {
        0.0
    }
}

/// Friction and damping of a mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshLosses {
    /// Friction: forces (N) and moments (N mm) on gear 1 and gear 2, in the mesh's own axes. It is included in the
    /// forces of the mesh ([`MeshForces::force`]) as the part without a potential.
    pub friction: Vector12,
    /// Dampers, in the same form.
    pub force: Vector12,
    /// Work of both per mesh cycle, N mm per cycle: their resistance to the sliding of the nominal rotation and to
    /// unevenly placed teeth.
    pub along_cycles: f64,
    /// -d force/d rates: N s/mm, N s, N mm s.
    pub rate_slope: SMatrix<f64, 12, 12>,
    /// -d force/d displacements, where dampers are limited by the force of the flanks.
    pub slope: SMatrix<f64, 12, 12>,
    /// Power dissipated by both, mW (N mm/s): f . (rates + nominal rotation). Friction acts against the sliding of the
    /// nominal rotation. If deviations temporarily slide in the opposite direction, its part is negative.
    pub dissipated: f64,
}

impl Default for MeshLosses {
    fn default() -> Self {
        let [rate_slope, slope] = [SMatrix::zeros(); 2];
        let [friction, force] = [Vector12::zeros(); 2];
        Self { friction, force, along_cycles: 0.0, rate_slope, slope, dissipated: 0.0 }
    }
}
