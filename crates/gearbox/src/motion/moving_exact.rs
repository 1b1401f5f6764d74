//! The exact contact as a mesh in motion: it is solved again at every step. Theory (46), (47), (93).

use std::sync::Arc;

use contact::SliceResult;
use contact_map::PairOffsets;
use dynamics::{
    ElasticDisplacement, Extremes, FlankForces, FlankInstant, FlankStates, GearVibration, MeshFlanks, ModalForce,
    SideLoads,
};
use geometry::{Gear, GearPair};
use ltca::{RootStress, StaticOptions};
use nalgebra::DVector;
use reduction::ElasticGear;

use super::{MeshLosses, MovingMesh};
use crate::{GearboxError, MeshElement, MeshForces, Vector12, mesh_element::finite_cycles};

/// Mesh cycles either way over which the change of the energy is taken, as of a pair alone.
const EITHER_WAY: f64 = 1e-4;

/// Flanks of a mesh in motion with the laws of a single pair ([`MeshFlanks`]): friction, a damper on each loaded slice,
/// and contact on the coast flanks if they can touch.
///
/// It includes pitch errors and all other properties of the pair. Rotations of the nominal motion are rotations of the
/// gears, so the derivative of the energy by the mesh cycles follows from the moments about their axes.
#[derive(Debug)]
pub struct MovingExactMesh {
    pair: GearPair,
    flanks: MeshFlanks,
    /// N s/mm a mm of contact line.
    damping_per_length: f64,
    /// Angles of gear 1 and gear 2 a mesh cycle, rad about +z.
    per_cycle: [f64; 2],
    /// Gap of the driving flanks (mm along the normal) beyond which others would touch that are not there.
    room: Option<f64>,
    cycles: f64,
    /// Modes of both gears that are coordinates, and their amplitudes.
    modes: Option<[GearVibration; 2]>,
    amplitudes: DVector<f64>,
    /// Fillets, where their stress is asked for; none with modes.
    roots: Option<Arc<RootStress>>,
    at: Option<Answer>,
}

/// What was asked for last.
#[derive(Debug)]
struct Answer {
    displaced: ElasticDisplacement,
    normal: Vector12,
    friction: Vector12,
    modal: Option<ModalForce>,
    tangents: bool,
}

impl MovingExactMesh {
    /// Takes gears reduced for the driving flanks of `options`, and for their coast flanks if these may touch. Driver
    /// and sense of the options are those of [`crate::Train::meshing`]; the torque is not used. `damping_per_length` is
    /// in N s/mm per mm of contact line; on each slice it is limited by the slice's force.
    ///
    /// # Errors
    /// [`GearboxError::Contact`] for contact of points, or for gears that are not reduced for these flanks.
    pub fn new(
        pair: GearPair,
        driving: Arc<[ElasticGear; 2]>,
        coast: Option<Arc<[ElasticGear; 2]>>,
        options: &StaticOptions,
        damping_per_length: f64,
    ) -> Result<Self, GearboxError> {
        // Each side is a contact of its own.
        let options = options.clone().with_contact(|c| c.both_flanks = false);
        let flanks = MeshFlanks::new(&pair, driving, coast, &options, 0.0)?;
        let per_cycle = flanks.turns_per_cycle(&pair);
        let room = (!flanks.has_coast_flanks()).then(|| pair.backlash() * pair.base_helix_angle().cos());
        let (modes, amplitudes) = (None, DVector::zeros(0));
        let roots = options.root_stress.then(|| Arc::new(flanks.root_fillets(&pair)));
        Ok(Self { pair, flanks, damping_per_length, per_cycle, room, cycles: 0.0, modes, amplitudes, roots, at: None })
    }

    /// The mesh in its initial state, with the same gears and tables and another damper.
    ///
    /// # Errors
    /// [`GearboxError::Contact`].
    pub fn copy_at_start(&self, damping_per_length: f64) -> Result<Self, GearboxError> {
        Ok(Self {
            pair: self.pair.clone(),
            flanks: self.flanks.copy_at_start(&self.pair)?,
            damping_per_length,
            per_cycle: self.per_cycle,
            room: self.room,
            cycles: 0.0,
            modes: self.modes.clone(),
            amplitudes: DVector::zeros(self.amplitudes.len()),
            roots: self.roots.clone(),
            at: None,
        })
    }

    /// Mesh that has only driving flanks, which may separate by any distance.
    #[must_use]
    pub fn with_driving_flanks_alone(self) -> Self {
        Self { room: None, ..self }
    }

    /// The flanks of the mesh.
    pub fn flanks(&self) -> &MeshFlanks {
        &self.flanks
    }

    /// Elastic modes of gear 1 and gear 2 that are coordinates.
    pub fn kept_modes(&self) -> Option<&[GearVibration; 2]> {
        self.modes.as_ref()
    }

    /// The mesh with elastic modes of gear 1 and gear 2 as coordinates: their share of the compliance gets inertia, the
    /// rest stays quasi-static.
    ///
    /// # Errors
    /// [`GearboxError::Contact`] for modes of other gears, [`GearboxError::OutOfRange`] for an invalid damping ratio.
    pub fn with_modes(mut self, modes: [GearVibration; 2]) -> Result<Self, GearboxError> {
        if let Some(value) = modes.iter().map(|own| own.damping_ratio).find(|zeta| !zeta.is_finite() || *zeta < 0.0) {
            return Err(GearboxError::OutOfRange { part: "gears".into(), quantity: "modal damping ratio", value });
        }
        self.flanks.keep_modes(&modes.each_ref().map(|own| Arc::clone(&own.modes)))?;
        self.amplitudes = DVector::zeros(modes.iter().map(|own| own.modes.count()).sum());
        self.modes = Some(modes);
        // What the modes bend is not in the forces of the flanks.
        self.roots = None;
        Ok(self)
    }

    fn displaced(&self, d: &Vector12) -> ElasticDisplacement {
        ElasticDisplacement { d: *d, q: self.amplitudes.clone() }
    }

    fn answer(&mut self, displacements: &Vector12, tangents: bool) -> Result<MeshForces, GearboxError> {
        self.at = None;
        let displaced = self.displaced(displacements);
        let forces = self.flanks.forces(&self.pair, self.cycles, &displaced, tangents)?;
        let FlankForces { normal, friction, stiffness, sums, modal } = forces;
        self.at = Some(Answer { displaced, normal, friction, modal, tangents });
        Ok(MeshForces { force: normal + friction, tangent: -stiffness, normal_force: sums[0] + sums[1] })
    }

    /// Power of forces on both gears as these turn by a mesh cycle, N mm.
    fn by_cycles(&self, force: &Vector12) -> f64 {
        force[5] * self.per_cycle[0] + force[11] * self.per_cycle[1]
    }
}

impl MeshElement for MovingExactMesh {
    fn go_to(&mut self, cycles: f64) -> Result<(), GearboxError> {
        self.at = None;
        self.cycles = finite_cycles(cycles)?;
        Ok(())
    }

    fn evaluate(&mut self, displacements: &Vector12) -> Result<MeshForces, GearboxError> {
        self.answer(displacements, true)
    }

    fn slices(&self) -> Vec<SliceResult> {
        self.flanks.driving_slices()
    }
}

impl MovingMesh for MovingExactMesh {
    fn period(&self) -> u64 {
        let of = |gear: &Gear| u64::from(if gear.has_own_teeth() { gear.teeth() } else { 1 });
        PairOffsets::cycles([&self.pair.pinion, &self.pair.wheel].map(of))
    }

    fn begin_at(&mut self, cycles: f64) -> Result<(), GearboxError> {
        self.at = None;
        Ok(self.flanks.begin_at(&self.pair, finite_cycles(cycles)?)?)
    }

    fn modes(&self) -> Option<[GearVibration; 2]> {
        self.modes.clone()
    }

    fn mode_sizes(&self) -> Vec<f64> {
        self.flanks.mode_sizes().to_vec()
    }

    fn gear_angles(&self, cycles: f64) -> [f64; 2] {
        self.flanks.angles(&self.pair, cycles)
    }

    fn deform(&mut self, amplitudes: &DVector<f64>) {
        self.at = None;
        self.amplitudes.copy_from(amplitudes);
    }

    fn on_modes(&self) -> Option<&ModalForce> {
        self.at.as_ref()?.modal.as_ref()
    }

    fn evaluate_forces(&mut self, displacements: &Vector12) -> Result<MeshForces, GearboxError> {
        self.answer(displacements, false)
    }

    fn energy(&self) -> f64 {
        self.flanks.strain_energy()
    }

    fn energy_at(&mut self, cycles: f64, displacements: &Vector12) -> Result<f64, GearboxError> {
        self.go_to(cycles)?;
        let displaced = self.displaced(displacements);
        Ok(self.flanks.energy(&self.pair, self.cycles, &displaced)?)
    }

    fn energy_rate(&self) -> f64 {
        self.at.as_ref().map_or(0.0, |at| -self.by_cycles(&at.normal))
    }

    fn energy_change(&mut self) -> Result<f64, GearboxError> {
        let Some(Answer { displaced, .. }) = self.at.take() else { return Ok(0.0) };
        let mut at = |cycles: f64| {
            self.flanks.forces(&self.pair, cycles, &displaced, false)?;
            Ok::<_, GearboxError>(self.flanks.strain_energy())
        };
        Ok((at(self.cycles + EITHER_WAY)? - at(self.cycles - EITHER_WAY)?) / (2.0 * EITHER_WAY))
    }

    fn losses(&mut self, rates: &Vector12, cycles: f64) -> MeshLosses {
        let Some(Answer { displaced, friction, tangents, .. }) = &self.at else { return MeshLosses::default() };
        let (friction, moving) = (*friction, (&displaced.d, rates));
        let dampers = self.flanks.damping(&self.pair, self.cycles, moving, self.damping_per_length, *tangents);
        let along_cycles = self.by_cycles(&friction);
        MeshLosses {
            friction,
            force: dampers.force,
            along_cycles,
            rate_slope: dampers.rate_slope,
            slope: dampers.slope,
            // Of the whole sliding, that of the nominal turn and that of the deviations.
            dissipated: dampers.dissipated - (friction.dot(rates) + along_cycles * cycles),
        }
    }

    fn overlaps(&mut self) -> Result<[f64; 2], GearboxError> {
        let found = self.at.as_ref().map(|at| self.flanks.overlaps(&self.pair, self.cycles, &at.displaced));
        Ok(found.unwrap_or([f64::NEG_INFINITY; 2]))
    }

    fn check_pace(&self, cycles: f64) -> Result<(), GearboxError> {
        Ok(self.flanks.check_pace(cycles)?)
    }

    /// Moves the windows; refuses one that is too narrow, teeth that have gone through each other, and a place at which
    /// coast flanks would touch that are not there.
    fn accept(&mut self, rates: &dyn Fn() -> Vector12, extremes: &mut Extremes) -> Result<bool, GearboxError> {
        let Some(Answer { displaced, .. }) = &self.at else { return Ok(false) };
        if let Some(backlash_mm) = self.room {
            let gap_mm = -self.flanks.overlaps(&self.pair, self.cycles, displaced)[0];
            if gap_mm > backlash_mm {
                return Err(GearboxError::BeyondBacklash { gap_mm, backlash_mm });
            }
        }
        let moving = (&rates(), self.damping_per_length);
        let moved = self.flanks.accept(&self.pair, self.cycles, displaced, moving, extremes)?;
        if moved {
            self.at = None;
        }
        Ok(moved)
    }

    fn by_side(&mut self, rates: &Vector12, _: f64) -> Result<[FlankInstant; 2], GearboxError> {
        let Some(Answer { displaced, .. }) = &self.at else { return Ok(Default::default()) };
        let moving = (rates, self.damping_per_length);
        Ok(self.flanks.instants(&self.pair, self.cycles, &displaced.d, moving, self.roots.as_deref())?)
    }

    fn loads(&self) -> Vec<SideLoads<'_>> {
        self.at.as_ref().map_or(Vec::new(), |at| self.flanks.loads(&self.pair, self.cycles, &at.displaced.d))
    }

    fn windows(&self) -> Option<FlankStates> {
        Some(self.flanks.state())
    }

    fn restore_windows(&mut self, windows: &FlankStates) -> Result<(), GearboxError> {
        self.at = None;
        Ok(self.flanks.restore(&self.pair, windows)?)
    }

    fn forget(&mut self) {
        self.at = None;
        self.flanks.forget();
    }
}
