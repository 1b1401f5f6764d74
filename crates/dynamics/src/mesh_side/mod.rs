//! Contact of the flanks on one side of the teeth, in motion. Theory (46), (47).

mod changes;
mod damping;
mod forces;

use std::sync::Arc;

use ale::{SlidingWindow, Station};
use contact::{
    ContactSet, Pose,
    pose::{displaced, frames, generalised, reference_angle},
    slice::MeshContact,
    slice_result,
};
use geometry::{GearPair, Side};
use ltca::{FilletStress, RootStress, StaticError, StaticOptions, WindowedPair};
use nalgebra::{SMatrix, Vector3};
use reduction::{ElasticGear, GearModes};

use super::{COORDINATES, Displacement, FlankInstant, LoadedSlice, SideLoads};

pub use changes::{SideState, ToothChanges};
pub use forces::ModalForce;
pub(super) use forces::{SideContacts, SideForce};

/// One side of the teeth: the flanks that drive, or those that touch when torque reverses.
#[derive(Debug)]
pub(super) struct MeshSide {
    options: StaticOptions,
    gears: Arc<[ElasticGear; 2]>,
    window: SlidingWindow,
    contact: MeshContact,
    /// Flanks and matrices that the first window had: where one set serves all windows, its frames are counted from
    /// there.
    home: (SlidingWindow, ContactSet),
    /// Mesh cycles that this side is ahead of the pair's counting.
    ahead: f64,
    /// Turn of the wheel from where these flanks touch to where the driving ones do, rad: backlash on the coast side.
    slack: f64,
    changes: ToothChanges,
}

impl MeshSide {
    /// The side that carries the load according to `options`, at the beginning of a motion; `reference` are the options
    /// that define the counting of the pairs.
    pub fn new(
        pair: &GearPair,
        gears: Arc<[ElasticGear; 2]>,
        options: StaticOptions,
        reference: &StaticOptions,
        cycles: f64,
    ) -> Result<Self, StaticError> {
        let pitch = pair.pinion.pitch_angle();
        let side_angle = pair.middle_angle(reference.side()) - pair.middle_angle(options.side());
        let ahead = reference.contact.sense.sign() as f64 * side_angle / pitch;
        let own = Station::at_cycles(cycles + ahead);
        let theta = [(own, &options), (Station::at_cycles(cycles), reference)].map(|(station, options)| {
            reference_angle(pair, &options.contact, station.pinion_angle(pair, options.side(), options.contact.sense))
        });
        // Whole teeth apart is the same place.
        let of_wheel = pair.wheel.pitch_angle();
        let slack = (theta[1] - theta[0]) - ((theta[1] - theta[0]) / of_wheel).round() * of_wheel;
        let count = options.window_teeth(pair);
        let teeth = [pair.pinion.teeth(), pair.wheel.teeth()];
        let window = SlidingWindow::at(own, count, teeth, options.contact.sense)?;
        let set = ContactSet::new(pair, &gears, window.window(), &options.contact)?;
        let contact = MeshContact::new(pair, set.clone(), &options.contact)?;
        let home = (window, set);
        Ok(Self { options, gears, window, contact, home, ahead, slack, changes: ToothChanges::default() })
    }

    /// Makes normal modes of both gears separate coordinates.
    pub fn keep_modes(&mut self, modes: [Arc<GearModes>; 2]) -> Result<(), StaticError> {
        Ok(self.contact.keep_modes(&self.gears, modes)?)
    }

    /// A copy of the side in its initial state; gears and tables are shared.
    pub fn copy_at_start(&self, pair: &GearPair) -> Result<Self, StaticError> {
        let (window, set) = self.home.clone();
        let mut copy_at_start = Self {
            options: self.options.clone(),
            gears: Arc::clone(&self.gears),
            contact: MeshContact::new(pair, set.clone(), &self.options.contact)?,
            window,
            home: (window, set),
            ahead: self.ahead,
            slack: self.slack,
            changes: ToothChanges::default(),
        };
        if let Some(modes) = self.contact.modes() {
            copy_at_start.keep_modes(modes.clone())?;
        }
        Ok(copy_at_start)
    }

    /// A copy of the side in its initial state with the micro-geometry of another pair; gears are shared.
    pub fn with_flanks_of(&self, pair: &GearPair) -> Result<Self, StaticError> {
        let set = ContactSet::new(pair, &self.gears, self.home.0.window(), &self.options.contact)?;
        Self { home: (self.home.0, set), ..self.copy_at_start(pair)? }.copy_at_start(pair)
    }

    /// Distance by which pitch errors bring the flanks of this side closer, mm, for the teeth of both gears in the
    /// order in which they come into mesh.
    pub fn pitch_approaches(&self, pair: &GearPair) -> [Vec<f64>; 2] {
        pair.pitch_approaches(self.options.side(), self.options.contact.sense)
    }

    /// The pinion's flanks of this side.
    pub fn flank_side(&self) -> Side {
        self.options.side()
    }

    /// Coefficient of friction.
    pub fn friction_coefficient(&self) -> f64 {
        self.options.contact.friction
    }

    /// Rotations of pinion and wheel in a mesh cycle, rad about +z.
    pub fn turns_per_cycle(&self, pair: &GearPair) -> [f64; 2] {
        let sense = self.options.contact.sense.sign() as f64;
        [sense * pair.pinion.pitch_angle(), -sense * pair.wheel.pitch_angle()]
    }

    /// A copy of the side at a phase, in mesh cycles; gears and tables are shared.
    pub fn copy_at(&self, pair: &GearPair, cycles: f64) -> Result<Self, StaticError> {
        let mut copy = self.copy_at_start(pair)?;
        copy.begin_at(pair, cycles)?;
        Ok(copy)
    }

    /// Enters the window that is due at a phase, in mesh cycles, without counting a tooth change.
    pub fn begin_at(&mut self, pair: &GearPair, cycles: f64) -> Result<(), StaticError> {
        let teeth = [pair.pinion.teeth(), pair.wheel.teeth()];
        let (count, sense) = (self.window.window().count(), self.options.contact.sense);
        let window = SlidingWindow::at(Station::at_cycles(cycles + self.ahead), count, teeth, sense)?;
        let first = window.window().first();
        self.restore(pair, SideState { first, changes: ToothChanges::default() })
    }

    /// Sum of the normal forces of the last evaluation, N.
    pub fn sum_of_forces(&self) -> f64 {
        self.contact.force().pair_forces.iter().sum()
    }

    /// Deepest overlap of the undeformed flanks with the gears' frames at `poses`, mm; negative if they are apart.
    pub fn undeformed_overlap(&mut self, poses: &[Pose; 2]) -> f64 {
        self.contact.overlap(poses)
    }

    /// Loaded slices of the last evaluation: position (mm), normal force (N), friction on the pinion (N), length (mm),
    /// and number of the tooth pair in the order in which pairs come into mesh.
    pub fn pressed(&self) -> impl Iterator<Item = (Vector3<f64>, f64, Vector3<f64>, f64, i64)> {
        let (set, window) = (self.contact.contact_set(), self.window.window());
        let sign = self.options.contact.sense.sign();
        let rows = self.contact.rows().iter().zip(self.contact.slices()).zip(self.contact.solver().forces());
        rows.filter(|(_, f)| **f > 0.0).map(move |((row, slice), &f)| {
            let pair = -sign * (window.first() + set.pair_of(row.patches.0) as i64);
            (row.position, f, f * (row.traction - row.normal), slice.length, pair)
        })
    }

    /// Discards forces and positions of the last solution, so that later results depend only on the state.
    pub fn forget(&mut self) {
        self.contact.forget_places();
    }

    /// The fillets of both gears, for [`MeshSide::root_stress`].
    pub fn root_fillets(&self, pair: &GearPair) -> RootStress {
        RootStress::new(pair, &self.gears)
    }

    /// Loaded slices of the last evaluation.
    pub fn loaded_slices(&self) -> Vec<LoadedSlice> {
        let (contact, set) = (&self.contact, self.contact.contact_set());
        let loaded = contact
            .rows()
            .iter()
            .zip(contact.slices())
            .zip(contact.solver().forces())
            .zip(contact.states(contact.solver().forces()));
        loaded
            .filter(|((_, f), _)| **f > 0.0)
            .map(|(((row, slice), &f), state)| LoadedSlice {
                pair: self.window.window().first() + set.pair_of(row.patches.0) as i64,
                slice: slice_result(slice, set.side(row.patches.0), f, &state.local),
            })
            .collect()
    }

    /// Stress in the root fillets of the window under the forces of the last evaluation, which was at these poses.
    pub fn root_stress(
        &mut self,
        pair: &GearPair,
        poses: &[Pose; 2],
        roots: &RootStress,
    ) -> Result<[Vec<FilletStress>; 2], StaticError> {
        let (contact, set) = (&self.contact, self.contact.contact_set());
        let forces = contact.solver().forces();
        let rows = set.supported_rows(poses, contact.rows(), contact.slices(), forces);
        let loads = (!rows.is_empty()).then(|| set.forces_of(&rows, forces)).flatten();
        let parts =
            WindowedPair { pair, gears: &self.gears, set, window: self.window.window(), options: &self.options };
        roots.of(&parts, loads.as_ref())
    }

    /// Angles of the gears' own frames relative to the common one in their nominal motion, rad.
    pub fn angles(&self, pair: &GearPair, cycles: f64) -> [f64; 2] {
        let poses = self.poses(pair, cycles, &Displacement::zeros());
        let pitches = [pair.pinion.pitch_angle(), pair.wheel.pitch_angle()];
        [0, 1].map(|g| {
            let turn = poses[g].rotation.into_inner();
            let shift = self.contact.contact_set().windows().map_or(0, |w| w[g].shift);
            2.0 * turn.k.atan2(turn.w) - f64::from(shift) * pitches[g]
        })
    }

    /// Frames of the matrices with the gears displaced by `d` from their nominal positions.
    pub fn poses(&self, pair: &GearPair, cycles: f64, d: &Displacement) -> [Pose; 2] {
        let station = Station::at_cycles(cycles + self.ahead);
        let turns = [d[COORDINATES - 1], d[2 * COORDINATES - 1] + self.slack];
        let set = self.contact.contact_set();
        let nominal = frames(pair, set, self.window.window(), &self.options.contact, station, turns);
        displaced(nominal, &(*d).into())
    }

    /// Frames of the matrices with the gears displaced, and the effect of forces there on the displacements.
    pub fn placed(&self, pair: &GearPair, cycles: f64, d: &Displacement) -> Placed {
        let poses = self.poses(pair, cycles, d);
        Placed { work: generalised(&poses, &(*d).into()), poses }
    }

    /// The last evaluation.
    pub fn contact(&self) -> &MeshContact {
        &self.contact
    }

    /// Whether any slice was loaded in the last evaluation.
    pub fn presses(&self) -> bool {
        self.contact.solver().forces().iter().any(|f| *f > 0.0)
    }

    /// State of the flanks at the last evaluation, with the gears moving at `rate`; without stress of the fillets.
    pub fn instant(&self, pair: &GearPair, placed: &Placed, rate: &Displacement, per_length: f64) -> FlankInstant {
        let force = self.sum_of_forces();
        FlankInstant {
            force,
            damping: self.normal_forces(placed, rate, per_length)[0] - force,
            line_length: self.contact.line_length(pair, &placed.poses),
            pair_forces: self.contact.force().pair_forces.clone(),
            first_pair: self.window.window().first(),
            slices: self.loaded_slices(),
            tooth_changes: self.changes.count,
            root_stress: Default::default(),
        }
    }

    /// Loads on the flanks in the last evaluation.
    pub fn loads(&self, pair: &GearPair, cycles: f64, d: &Displacement) -> SideLoads<'_> {
        let (poses, contact) = (self.poses(pair, cycles, d), &self.contact);
        let (set, forces) = (contact.contact_set(), contact.solver().forces());
        let rows = set.supported_rows(&poses, contact.rows(), contact.slices(), forces);
        SideLoads { gears: &self.gears, set, poses, rows, forces }
    }
}

/// Where both gears of a side stand.
#[derive(Debug)]
pub(crate) struct Placed {
    /// Frames of the matrices.
    pub poses: [Pose; 2],
    /// What forces and moments in common axes do to the displacements ([`generalised`]); none: what they are.
    work: Option<SMatrix<f64, 12, 12>>,
}

impl Placed {
    /// Forces on the displacements from forces and moments about the gears' centres, common axes.
    fn generalised(&self, force: Displacement) -> Displacement {
        self.work.as_ref().map_or(force, |g| g * force)
    }

    /// How they follow the displacements.
    fn generalised_slope(&self, slope: SMatrix<f64, 12, 12>) -> SMatrix<f64, 12, 12> {
        self.work.as_ref().map_or(slope, |g| g * slope * g.transpose())
    }
}
