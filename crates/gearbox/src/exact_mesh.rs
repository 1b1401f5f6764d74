//! The exact contact of two elastic gears as a mesh of the gearbox. Theory (38), (81).

use std::{any::Any, sync::Arc};

use ale::{SlidingWindow, Station};
use contact::{
    ContactError, ContactSet, MeshForce, Pose, SliceResult,
    line::NeighbourPairs,
    pose::{displaced, frames, generalised, reference_angle},
    slice::MeshContact,
    slice_result,
};
use geometry::GearPair;
use ltca::{FilletField, RootStress, StaticError, StaticOptions, WindowedPair};
use nalgebra::{DMatrix, SMatrix};
use reduction::{ElasticGear, GearModes};

use crate::{
    GearboxError, MeshElement, MeshForces, MeshOfGears, ModalForces, Vector12, mesh_element::finite_cycles,
    modal_contact::ModalContact,
};

/// Slice contact of two reduced gears, station by station, as `ltca` solves it for a single pair.
#[derive(Debug)]
pub struct ExactMesh {
    pair: GearPair,
    pub(crate) gears: Arc<[ElasticGear; 2]>,
    options: StaticOptions,
    pub(crate) contact: MeshContact,
    window: SlidingWindow,
    station: Station,
    pub(crate) poses: [Pose; 2],
    /// Gap up to which the last evaluation has rows, mm; none where the next one looks for all that are near.
    within: Option<f64>,
    /// The contact with elastic modes as coordinates, where some are kept.
    modal: Option<ModalContact>,
    /// Fillets of both gears, where their stress is asked for.
    roots: Option<RootStress>,
}

/// Overlap over that of the last evaluation up to which the search is narrow.
const REACH: f64 = 1.25;

impl ExactMesh {
    /// Takes gears that were reduced at the first window of `options` (`ltca::StaticModel::first_teeth`). Driver and
    /// sense of the options are those of [`crate::Train::meshing`]; the torque is not used.
    ///
    /// # Errors
    /// [`GearboxError::Contact`] for contact of points, or for gears that are not reduced.
    pub fn new(
        pair: GearPair,
        gears: impl Into<Arc<[ElasticGear; 2]>>,
        options: StaticOptions,
    ) -> Result<Self, GearboxError> {
        Self::beside(None, pair, gears, options)
    }

    /// The same beside another mesh of the same gears, as planets have: matrices and tables are its own.
    ///
    /// # Errors
    /// As of [`ExactMesh::new`].
    pub fn beside(
        other: Option<&MeshOfGears>,
        pair: GearPair,
        gears: impl Into<Arc<[ElasticGear; 2]>>,
        options: StaticOptions,
    ) -> Result<Self, GearboxError> {
        let gears = gears.into();
        let teeth = [pair.pinion.teeth(), pair.wheel.teeth()];
        let window = SlidingWindow::at_start(options.window_teeth(&pair), teeth, options.contact.sense)
            .map_err(StaticError::from)?;
        let known = other.map(|other| other.set(&pair, &gears, window.window(), &options.contact)).transpose()?;
        let set = match known.flatten() {
            Some(set) => set,
            None => ContactSet::new(&pair, &gears, window.window(), &options.contact).map_err(StaticError::from)?,
        };
        let contact = MeshContact::new(&pair, set, &options.contact).map_err(StaticError::from)?;
        let station = Station::at_cycles(0.0);
        let roots = options.root_stress.then(|| RootStress::new(&pair, &gears));
        Ok(Self {
            pair,
            gears,
            options,
            contact,
            window,
            station,
            poses: [Pose::identity(); 2],
            within: None,
            modal: None,
            roots,
        })
    }

    /// The mesh with elastic modes of gear 1 and gear 2 kept for [`MeshElement::modal`]; its static behaviour does not
    /// change.
    ///
    /// # Errors
    /// [`GearboxError::Contact`] for modes of other gears.
    pub fn with_modes(mut self, modes: [Arc<GearModes>; 2]) -> Result<Self, GearboxError> {
        let own = ModalContact::new(&self.pair, &self.gears, self.window.window(), modes, &self.options.contact)?;
        self.modal = Some(own);
        Ok(self)
    }

    /// What another mesh of the same gears needs not make again.
    pub fn of_gears(&self) -> MeshOfGears {
        let (pair, gears, options) = (self.pair.clone(), Arc::clone(&self.gears), self.options.contact.clone());
        MeshOfGears { pair, gears, options, set: self.contact.contact_set().clone() }
    }

    /// The gear pair.
    pub fn pair(&self) -> &GearPair {
        &self.pair
    }

    /// Options of the contact.
    pub fn options(&self) -> &StaticOptions {
        &self.options
    }

    /// Forces at the poses. A step of Newton's method is small: rows stay, and with them the tangent, which is as good as
    /// a new one; where they do not, the search is as wide as the overlap before asks for.
    fn find(&mut self) -> Result<MeshForce, ContactError> {
        if let Some(within) = &mut self.within
            && let Some(found) = self.contact.evaluate_moved(&self.poses, within)
        {
            return Ok(found.clone());
        }
        let overlap = self.contact.deepest_overlap();
        let found = if overlap > 0.0 {
            self.contact.evaluate_within(&self.poses, REACH * overlap)?.clone()
        } else {
            self.contact.evaluate(&self.poses)?.clone()
        };
        self.within = Some(self.contact.deepest_overlap().max(REACH * overlap));
        Ok(found)
    }

    /// Moves the gears to displacements.
    pub(crate) fn place(&mut self, d: &Vector12) {
        let set = self.contact.contact_set();
        let window = self.window.window();
        let nominal = frames(&self.pair, set, window, &self.options.contact, self.station, [d[5], d[11]]);
        self.poses = displaced(nominal, &(*d).into());
    }

    /// Angle of the frame of a gear's matrices from the mesh's own +x where nothing has moved, rad.
    pub(crate) fn frame_angle(&self, end: usize) -> f64 {
        let (set, window) = (self.contact.contact_set(), self.window.window());
        let nominal = frames(&self.pair, set, window, &self.options.contact, self.station, [0.0; 2]);
        let x = nominal[end].rotation * nalgebra::Vector3::x();
        x.y.atan2(x.x)
    }

    /// Forces of the last evaluation, which was at displacements `d`.
    pub(crate) fn forces(&self, d: &Vector12) -> MeshForces {
        self.in_coordinates(found_forces(self.contact.force()), d)
    }

    /// From forces and moments to what does the work of the coordinates; `None` where it is the same.
    pub(crate) fn generalised(&self, d: &Vector12) -> Option<SMatrix<f64, 12, 12>> {
        generalised(&self.poses, &(*d).into())
    }

    fn in_coordinates(&self, found: MeshForces, d: &Vector12) -> MeshForces {
        match self.generalised(d) {
            None => found,
            Some(g) => MeshForces { force: g * found.force, tangent: g * found.tangent * g.transpose(), ..found },
        }
    }

    /// Length of the slices that carried load in the last evaluation, mm.
    pub(crate) fn pressed_length(&self) -> f64 {
        let slices = self.contact.slices().iter().zip(self.contact.solver().forces());
        slices.filter(|(_, f)| **f > 0.0).map(|(slice, _)| slice.length).sum()
    }

    pub(crate) fn failed(&self, source: contact::ContactError) -> GearboxError {
        StaticError::Contact { cycle: self.station.cycle, phase: self.station.phase, source }.into()
    }
}

/// Forces of a contact about the gears' centres.
fn found_forces(found: &MeshForce) -> MeshForces {
    let force = Vector12::from_fn(|i, _| {
        let wrench = &found.wrench[i / 6];
        if i % 6 < 3 { wrench.force[i % 3] } else { wrench.moment[i % 3] }
    });
    let tangent = SMatrix::from_fn(|i, j| found.tangent[i][j]);
    MeshForces { force, tangent, normal_force: found.pair_forces.iter().sum() }
}

impl MeshElement for ExactMesh {
    fn to_join(&mut self) -> Option<&mut dyn Any> {
        Some(self)
    }

    fn go_to(&mut self, cycles: f64) -> Result<(), GearboxError> {
        let station = Station::at_cycles(finite_cycles(cycles)?);
        let teeth = [self.pair.pinion.teeth(), self.pair.wheel.teeth()];
        let window = SlidingWindow::at(station, self.window.window().count(), teeth, self.options.contact.sense)
            .map_err(StaticError::from)?;
        if window != self.window {
            let set = self.contact.contact_set().clone();
            self.contact
                .enter_window(&self.pair, &self.gears, window.window(), set, &self.options.contact)
                .map_err(StaticError::from)?;
            if let Some(modal) = &mut self.modal {
                let entered = modal.enter_window(&self.pair, &self.gears, window.window(), &self.options.contact);
                entered.map_err(StaticError::from)?;
            }
            self.window = window;
        }
        self.station = station;
        // Another place has rows and a tangent of its own.
        self.within = None;
        Ok(())
    }

    fn evaluate(&mut self, d: &Vector12) -> Result<MeshForces, GearboxError> {
        self.place(d);
        let found = match self.find() {
            Ok(found) => found,
            Err(source) => return Err(self.failed(source)),
        };
        let forces = found_forces(&found);
        Ok(self.in_coordinates(forces, d))
    }

    /// Refuses a window beside which a pair of teeth ought to carry load.
    fn check(&mut self) -> Result<(), GearboxError> {
        let deepest = self.contact.rows().iter().fold(0.0, |m: f64, row| m.max(-row.gap));
        let neighbours = NeighbourPairs {
            pair: &self.pair,
            options: &self.options.contact,
            set: self.contact.contact_set(),
            window: self.window.window(),
            station: self.station,
            poses: &self.poses,
        };
        let torque = self.contact.force().wrench[self.options.driven()].moment[2].abs();
        let served = self.window.check_neighbours(self.station, torque, 1e-3 * deepest, |k| neighbours.gap(k));
        Ok(served.map_err(StaticError::from)?)
    }

    fn modal(&mut self, d: &Vector12) -> Result<Option<ModalForces>, GearboxError> {
        let Some(modal) = &mut self.modal else { return Ok(None) };
        let (options, Station { cycle, phase }) = (&self.options.contact, self.station);
        let window = self.window.window();
        let nominal = frames(&self.pair, modal.contact_set(), window, options, self.station, [d[5], d[11]]);
        let poses = displaced(nominal, &(*d).into());
        // Tooth 0 of gear 1 stands where the cycles count from.
        let cycles = cycle as f64 + phase - 0.5;
        let first = self.pair.middle_angle(options.side())
            + options.sense.sign() as f64 * cycles * self.pair.pinion.pitch_angle();
        let angles = [first, reference_angle(&self.pair, options, first)];
        let failed = |source| GearboxError::from(StaticError::Contact { cycle, phase, source });
        let mut found = modal.solve(&poses, angles, failed)?;
        if let Some(g) = generalised(&poses, &(*d).into()) {
            let mut all = DMatrix::identity(found.force.len(), found.force.len());
            all.view_mut((0, 0), (12, 12)).copy_from(&g);
            found.force = &all * found.force;
            found.tangent = &all * found.tangent * all.transpose();
        }
        Ok(Some(found))
    }

    fn slices(&self) -> Vec<SliceResult> {
        let (contact, set) = (&self.contact, self.contact.contact_set());
        let forces = contact.solver().forces();
        let rows = contact.rows().iter().zip(contact.slices()).zip(forces).zip(contact.states(forces));
        rows.filter(|((_, f), _)| **f > 0.0)
            .map(|(((row, slice), &f), state)| slice_result(slice, set.side(row.patches.0), f, &state.local))
            .collect()
    }

    fn root_stress(&self) -> Result<[Vec<FilletField>; 2], GearboxError> {
        let Some(roots) = &self.roots else { return Ok(Default::default()) };
        let (contact, set) = (&self.contact, self.contact.contact_set());
        let forces = contact.solver().forces();
        let rows = set.supported_rows(&self.poses, contact.rows(), contact.slices(), forces);
        let loads = (!rows.is_empty()).then(|| set.forces_of(&rows, forces)).flatten();
        let Self { pair, gears, options, window, .. } = self;
        let windowed = WindowedPair { pair, gears, set, window: window.window(), options };
        Ok(roots.fields(&windowed, loads.as_ref())?)
    }
}
