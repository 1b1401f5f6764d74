//! Contact of both sides of the teeth in motion: the forces of a mesh on two gears, whatever supports them. Theory
//! (46), (47).

use std::sync::Arc;

use ale::Station;
use contact::SliceResult;
use geometry::GearPair;
use ltca::{RootStress, StaticError, StaticOptions};
use nalgebra::SMatrix;
use reduction::{ElasticGear, GearModes};

use crate::{
    COORDINATES, Displacement, Extremes, FlankInstant, SideLoads, SideState,
    elastic_displacement::ElasticDisplacement,
    mesh_side::{MeshSide, ModalForce, SideContacts, SideForce},
};

/// Contact of elastic teeth in motion: the driving flanks and, if these may touch, the coast flanks.
///
/// Displacements are the twelve of both gears from their nominal motion, mm and rad. The position in that motion is
/// given in mesh cycles. The last contact is kept, because several callers need it at the end of a step.
#[derive(Debug)]
pub struct MeshFlanks {
    pub(crate) driving: MeshSide,
    pub(crate) coast: Option<MeshSide>,
    last: Option<SideContacts>,
}

/// Forces of both sides at given displacements.
#[derive(Debug, Clone, PartialEq)]
pub struct FlankForces {
    /// Normal forces -dV/dd, N and N mm.
    pub normal: Displacement,
    /// Friction forces, which have no potential.
    pub friction: Displacement,
    /// Stiffness -d(normal + friction)/dd: N/mm, N, N mm; undefined if no tangent was requested.
    pub stiffness: SMatrix<f64, 12, 12>,
    /// Sum of the normal forces on the driving and on the coast flanks, N.
    pub sums: [f64; 2],
    /// Forces on the modes of both gears, with all tangents; `None` for gears that are rigid apart from their teeth.
    pub modal: Option<ModalForce>,
}

/// Forces of the dampers of both sides.
#[derive(Debug, Clone, PartialEq)]
pub struct FlankDamping {
    /// Forces on the displacements, N and N mm.
    pub force: Displacement,
    /// Dissipated power, N mm/s.
    pub dissipated: f64,
    /// -d force/d rates: N s/mm, N s, N mm s.
    pub rate_slope: SMatrix<f64, 12, 12>,
    /// -d force/d displacements, for dampers that are limited by the force of their slice.
    pub slope: SMatrix<f64, 12, 12>,
}

/// Windows of both sides, and their tooth changes so far.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct FlankStates {
    /// State of the driving flanks.
    pub driving: SideState,
    /// State of the coast flanks.
    pub coast: Option<SideState>,
}

impl FlankStates {
    /// Largest magnitude of the running numbers of the windows.
    pub fn farthest_tooth(&self) -> u64 {
        let of = |side: &SideState| side.first.unsigned_abs();
        of(&self.driving).max(self.coast.as_ref().map_or(0, of))
    }
}

impl MeshFlanks {
    /// Flanks at the beginning of a motion, `cycles` mesh cycles after the origin of counting. `driving` are gears
    /// reduced for the driving flanks of `options`; `coast` are gears reduced for those of
    /// [`StaticOptions::driven_backwards`], if these may touch.
    ///
    /// # Errors
    /// [`StaticError`] for contact of points, or for gears that are not reduced for these flanks.
    pub fn new(
        pair: &GearPair,
        driving: Arc<[ElasticGear; 2]>,
        coast: Option<Arc<[ElasticGear; 2]>>,
        options: &StaticOptions,
        cycles: f64,
    ) -> Result<Self, StaticError> {
        let side = |gears, own: StaticOptions| MeshSide::new(pair, gears, own, options, cycles);
        let driving = side(driving, options.clone())?;
        let coast = coast.map(|gears| side(gears, options.driven_backwards())).transpose()?;
        Ok(Self { driving, coast, last: None })
    }

    /// The same flanks in their initial state, with the same gears and tables.
    ///
    /// # Errors
    /// [`StaticError`].
    pub fn copy_at_start(&self, pair: &GearPair) -> Result<Self, StaticError> {
        let driving = self.driving.copy_at_start(pair)?;
        let coast = self.coast.as_ref().map(|side| side.copy_at_start(pair)).transpose()?;
        Ok(Self { driving, coast, last: None })
    }

    /// Enters the windows that are due at a position, without counting tooth changes.
    ///
    /// # Errors
    /// [`StaticError`].
    pub fn begin_at(&mut self, pair: &GearPair, cycles: f64) -> Result<(), StaticError> {
        self.last = None;
        self.sides_mut().try_for_each(|side| side.begin_at(pair, cycles))
    }

    /// Makes normal modes of both gears separate coordinates.
    ///
    /// # Errors
    /// [`contact::ContactError::Reduction`] for modes of another gear.
    pub fn keep_modes(&mut self, modes: &[Arc<GearModes>; 2]) -> Result<(), StaticError> {
        self.last = None;
        self.sides_mut().try_for_each(|side| side.keep_modes(modes.clone()))
    }

    /// Driving flanks, and coast flanks where these may touch.
    pub(crate) fn sides(&self) -> impl Iterator<Item = &MeshSide> {
        std::iter::once(&self.driving).chain(&self.coast)
    }

    fn sides_mut(&mut self) -> impl Iterator<Item = &mut MeshSide> {
        std::iter::once(&mut self.driving).chain(self.coast.as_mut())
    }

    /// Coefficient of friction.
    pub fn friction_coefficient(&self) -> f64 {
        self.driving.friction_coefficient()
    }

    /// Rotations of pinion and wheel in a mesh cycle, rad about +z.
    pub fn turns_per_cycle(&self, pair: &GearPair) -> [f64; 2] {
        self.driving.turns_per_cycle(pair)
    }

    /// Whether the coast flanks may touch.
    pub fn has_coast_flanks(&self) -> bool {
        self.coast.is_some()
    }

    /// Contact of both sides.
    fn contact(
        &mut self,
        pair: &GearPair,
        cycles: f64,
        at: &ElasticDisplacement,
        tangents: bool,
    ) -> Result<&SideContacts, StaticError> {
        let serves = |last: &SideContacts| last.at.0 == cycles && last.at.1 == *at && (last.tangents || !tangents);
        if !self.last.as_ref().is_some_and(serves) {
            self.last = None;
        }
        match &mut self.last {
            Some(known) => Ok(known),
            unknown => {
                let fail = at_station(cycles);
                let driving = self.driving.evaluate(pair, cycles, at, tangents).map_err(fail)?;
                let coast = self.coast.as_mut().map(|side| side.evaluate(pair, cycles, at, tangents));
                let coast = coast.transpose().map_err(fail)?;
                Ok(unknown.insert(SideContacts { at: (cycles, at.clone()), driving, coast, tangents }))
            }
        }
    }

    /// Forces on the gears and on their modes.
    ///
    /// # Errors
    /// [`StaticError::Contact`].
    pub fn forces(
        &mut self,
        pair: &GearPair,
        cycles: f64,
        at: &ElasticDisplacement,
        tangents: bool,
    ) -> Result<FlankForces, StaticError> {
        let SideContacts { driving, coast, .. } = self.contact(pair, cycles, at, tangents)?;
        let SideForce { normal, friction, stiffness, modal } = driving.clone();
        let mut all = FlankForces { normal, friction, stiffness, sums: [0.0; 2], modal };
        if let Some(coast) = coast {
            all.normal += coast.normal;
            all.friction += coast.friction;
            all.stiffness += coast.stiffness;
            if let (Some(all), Some(own)) = (&mut all.modal, &coast.modal) {
                all.add(own);
            }
        }
        all.sums = self.sums();
        Ok(all)
    }

    /// Largest normal displacement of a flank per unit of each mode, t^(-1/2); empty without modes.
    pub fn mode_sizes(&self) -> &[f64] {
        self.driving.contact().modal().map_or(&[], |modal| modal.sizes())
    }

    /// Angles of the gears' own frames in their nominal motion, rad from the pair's axes.
    pub fn angles(&self, pair: &GearPair, cycles: f64) -> [f64; 2] {
        self.driving.angles(pair, cycles)
    }

    /// Sum of the normal forces of the last contact on the driving and on the coast flanks, N.
    fn sums(&self) -> [f64; 2] {
        [self.driving.sum_of_forces(), self.coast.as_ref().map_or(0.0, MeshSide::sum_of_forces)]
    }

    /// Forces of the dampers of the loaded flanks, with the gears moving at `rate`; `per_length` is in N s/mm per mm of
    /// contact line. If slopes are requested, call it after [`MeshFlanks::forces`] with tangents at the same position.
    pub fn damping(
        &mut self,
        pair: &GearPair,
        cycles: f64,
        (d, rate): (&Displacement, &Displacement),
        per_length: f64,
        slopes: bool,
    ) -> FlankDamping {
        let (mut rate_slope, mut slope) = (SMatrix::zeros(), SMatrix::zeros());
        let (mut force, mut dissipated) = (Displacement::zeros(), 0.0);
        for side in self.sides_mut() {
            let placed = side.placed(pair, cycles, d);
            let (own, power) = side.damping(&placed, rate, per_length, slopes.then_some(&mut rate_slope));
            force += own;
            dissipated += power;
            // Modes let slices answer each other: those slopes are left out, as of a pair.
            let is_rigid = side.contact().modal().is_none();
            if slopes
                && is_rigid
                && let Some(held) = side.held_damping(&placed, rate, per_length)
            {
                slope += held;
            }
        }
        FlankDamping { force, dissipated, rate_slope, slope }
    }

    /// Strain energy of the last contact, N mm.
    pub fn strain_energy(&self) -> f64 {
        let of = |side: &MeshSide| side.contact().strain_energy();
        of(&self.driving) + self.coast.as_ref().map_or(0.0, of)
    }

    /// Strain energy of both sides at a position with the gears displaced, N mm, accurate to twelve digits; the last
    /// contact is discarded.
    ///
    /// # Errors
    /// [`StaticError::Contact`].
    pub fn energy(&mut self, pair: &GearPair, cycles: f64, at: &ElasticDisplacement) -> Result<f64, StaticError> {
        self.last = None;
        let fail = at_station(cycles);
        self.sides_mut().try_fold(0.0, |sum, side| Ok(sum + side.energy(pair, cycles, at).map_err(fail)?))
    }

    /// Deepest overlap of the undeformed flanks at the position of the last contact, mm, negative if they are apart: of
    /// the driving flanks, and of the coast flanks (minus infinity if there are none). With modes the last contact is
    /// discarded.
    pub fn overlaps(&mut self, pair: &GearPair, cycles: f64, at: &ElasticDisplacement) -> [f64; 2] {
        let driving = self.driving.overlap(pair, cycles, at);
        let coast = self.coast.as_mut().map_or(f64::NEG_INFINITY, |side| side.overlap(pair, cycles, at));
        if !at.q.is_empty() {
            self.last = None;
        }
        [driving, coast]
    }

    /// Moves the windows as far as is due and outgoing teeth carry nothing; whether one has moved. Several teeth may be due
    /// after a long step.
    fn follow(&mut self, pair: &GearPair, cycles: f64, at: &ElasticDisplacement) -> Result<bool, StaticError> {
        let mut any = false;
        loop {
            self.contact(pair, cycles, at, false)?;
            let sums = self.sums();
            let moved = [
                self.driving.follow(pair, cycles)?,
                self.coast.as_mut().map_or(Ok(false), |side| side.follow(pair, cycles))?,
            ];
            if moved == [false; 2] {
                return Ok(any);
            }
            any = true;
            self.last = None;
            self.contact(pair, cycles, at, false)?;
            for ((side, moved), sum) in self.sides_mut().zip(moved).zip(sums) {
                if moved {
                    side.record_jump(sum);
                }
            }
        }
    }

    /// Returns an error if the gears have rotated past a whole window since it last moved.
    ///
    /// # Errors
    /// [`ale::AleError::Leapt`] if the gears have rotated too far.
    pub fn check_pace(&self, cycles: f64) -> Result<(), StaticError> {
        self.sides().try_for_each(|side| side.check_pace(cycles))
    }

    /// Called at the end of a step with the gears moving at `rate`. It moves the windows that are due, as long as
    /// outgoing teeth are unloaded, and adds the step to the extremes. It returns an error if teeth are at impossible
    /// positions, or if a pair next to a window should carry load. Returns whether a window has moved.
    ///
    /// # Errors
    /// [`StaticError::PassedThrough`], [`ale::AleError::Starved`].
    pub fn accept(
        &mut self,
        pair: &GearPair,
        cycles: f64,
        at: &ElasticDisplacement,
        (rate, per_length): (&Displacement, f64),
        extremes: &mut Extremes,
    ) -> Result<bool, StaticError> {
        self.check_passage(pair, cycles, &at.d)?;
        let moved = self.follow(pair, cycles, at)?;
        let mut least = f64::INFINITY;
        for (coasts, side) in self.sides_mut().enumerate().filter(|(_, side)| side.presses()) {
            let placed = side.placed(pair, cycles, &at.d);
            side.check_neighbours(pair, cycles, &placed.poses)?;
            let [sum, smallest] = side.normal_forces(&placed, rate, per_length);
            least = least.min(smallest);
            if coasts == 0 {
                extremes.largest_force = extremes.largest_force.max(sum);
            } else {
                extremes.steps_on_coast += 1;
            }
        }
        if !self.driving.presses() {
            extremes.steps_apart += 1;
            let gap = -self.driving.overlap(pair, cycles, at);
            if !at.q.is_empty() {
                self.last = None;
            }
            extremes.largest_gap = extremes.largest_gap.max(gap);
        }
        if least.is_finite() {
            extremes.least_force = Some(extremes.least_force.map_or(least, |f| f.min(least)));
        }
        Ok(moved)
    }

    /// Both sides at the last evaluation, with the gears moving at `rate`; `roots` are the fillets of the driving side,
    /// if their stress is requested.
    ///
    /// # Errors
    /// [`StaticError`] of the root stress.
    pub fn instants(
        &mut self,
        pair: &GearPair,
        cycles: f64,
        d: &Displacement,
        (rate, per_length): (&Displacement, f64),
        roots: Option<&RootStress>,
    ) -> Result<[FlankInstant; 2], StaticError> {
        let mut both = <[FlankInstant; 2]>::default();
        for (out, side) in both.iter_mut().zip(self.sides_mut()) {
            *out = side.instant(pair, &side.placed(pair, cycles, d), rate, per_length);
        }
        if let Some(roots) = roots {
            let poses = self.driving.poses(pair, cycles, d);
            both[0].root_stress = self.driving.root_stress(pair, &poses, roots)?;
        }
        Ok(both)
    }

    /// Loads on the flanks of each side in contact at the last evaluation; the driving side is always included.
    pub fn loads(&self, pair: &GearPair, cycles: f64, d: &Displacement) -> Vec<SideLoads<'_>> {
        let pressed = self.sides().enumerate().filter(|(coasts, side)| *coasts == 0 || side.presses());
        pressed.map(|(_, side)| side.loads(pair, cycles, d)).collect()
    }

    /// The fillets of the gears of the driving flanks.
    pub fn root_fillets(&self, pair: &GearPair) -> RootStress {
        self.driving.root_fillets(pair)
    }

    /// Refuses a state in which teeth are nearer by half a base pitch than flanks that touch, or farther apart by the
    /// backlash and as much again: on their line of action teeth are half a base pitch thick, so that they have gone
    /// through each other. A step that leaps so far finds an equilibrium between other teeth, and nothing else would
    /// tell.
    ///
    /// # Errors
    /// [`StaticError::PassedThrough`].
    fn check_passage(&self, pair: &GearPair, cycles: f64, d: &Displacement) -> Result<(), StaticError> {
        let thickness_mm = 0.5 * pair.transverse_base_pitch();
        let distance_mm = approach(pair, self.driving.flank_side().sign(), d);
        let apart = thickness_mm + pair.backlash().max(0.0);
        if distance_mm < thickness_mm && distance_mm > -apart {
            return Ok(());
        }
        let Station { cycle, phase, .. } = Station::at_cycles(cycles);
        Err(StaticError::PassedThrough { cycle, phase, distance_mm, thickness_mm })
    }

    /// Driving slices that carried load in the last contact.
    pub fn driving_slices(&self) -> Vec<SliceResult> {
        self.driving.loaded_slices().into_iter().map(|loaded| loaded.slice).collect()
    }

    /// Windows of both sides, to be restored later.
    pub fn state(&self) -> FlankStates {
        FlankStates { driving: self.driving.state(), coast: self.coast.as_ref().map(MeshSide::state) }
    }

    /// Restores the windows.
    ///
    /// # Errors
    /// [`StaticError`].
    pub fn restore(&mut self, pair: &GearPair, state: &FlankStates) -> Result<(), StaticError> {
        self.last = None;
        self.driving.restore(pair, state.driving)?;
        match (&mut self.coast, state.coast) {
            (Some(side), Some(coast)) => side.restore(pair, coast),
            _ => Ok(()),
        }
    }

    /// Discards the last contact and the memory of the search. Later results then depend only on position and windows,
    /// bit by bit.
    pub fn forget(&mut self) {
        self.sides_mut().for_each(MeshSide::forget);
        self.last = None;
    }
}

/// How far displacements bring the flanks nearer at the pitch point, along the transverse line of action, mm.
///
/// ```text
/// x = n . (u_1 - u_2) + s (r_b1 theta_1 + r_b2 theta_2),   n = (sin a_wt, s cos a_wt, 0)
/// ```
/// s: the side that drives. Theory (45).
fn approach(pair: &GearPair, side: f64, d: &Displacement) -> f64 {
    let (sin, cos) = pair.working_pressure_angle().sin_cos();
    let base = [pair.pinion.base_radius(), pair.wheel.base_radius()];
    let turns: f64 = (0..2).map(|g| base[g] * d[COORDINATES * (g + 1) - 1]).sum();
    sin * (d[0] - d[COORDINATES]) + side * (cos * (d[1] - d[COORDINATES + 1]) + turns)
}

/// Names the place of what went wrong in a contact.
fn at_station(cycles: f64) -> impl Fn(contact::ContactError) -> StaticError + Copy {
    let Station { cycle, phase, .. } = Station::at_cycles(cycles);
    move |source| StaticError::Contact { cycle, phase, source }
}
