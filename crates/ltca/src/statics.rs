//! Solves mesh cycles station by station, with tooth changes.

use std::{ops::ControlFlow, sync::Arc};

use ale::{SlidingWindow, Station, ToothWindow};
use contact::{ContactOptions, ContactSet, Method, pose::check_offsets};
use geometry::GearPair;
use reduction::ElasticGear;

use crate::{
    Equilibrium, RootStress, StaticError, StaticHistory, StaticOptions, StaticPosition, ToothChange, ToothChangeRecord,
    cycle,
    cycle_solver::{CycleInputs, CycleSolver},
};

/// A pair of elastic gears under torque.
#[derive(Debug)]
pub struct StaticModel {
    pair: GearPair,
    gears: Arc<[ElasticGear; 2]>,
    options: StaticOptions,
    root: Option<Arc<RootStress>>,
    solver: CycleSolver,
}

impl StaticModel {
    /// First tooth of each gear's window at the start of a run. Reduce the gears at these teeth.
    ///
    /// # Errors
    /// [`StaticError::Window`] if the window has more teeth than a gear.
    pub fn first_teeth(pair: &GearPair, options: &StaticOptions) -> Result<[u32; 2], StaticError> {
        Ok(first_window(pair, options)?.window().first_teeth())
    }

    /// A model at the start of cycle 0. Several models may share their gears and be solved in parallel.
    ///
    /// # Errors
    /// [`StaticError`] if a value is out of range, or if meshes and geometry do not match.
    pub fn new(
        pair: GearPair,
        gears: impl Into<Arc<[ElasticGear; 2]>>,
        options: StaticOptions,
    ) -> Result<Self, StaticError> {
        Self::with_known(pair, gears.into(), options, (None, None))
    }

    /// A model at the start of cycle 0 with the same gears and other micro-geometry, torque, friction, misalignment or
    /// slices.
    ///
    /// The models share the matrices, and the tables of the contact if `options` need the same ones. The results are
    /// those of [`StaticModel::new`], bit by bit.
    ///
    /// # Errors
    /// The errors of [`StaticModel::new`].
    pub fn modified(&self, pair: GearPair, options: StaticOptions) -> Result<Self, StaticError> {
        let (own, asked) = (&self.options.contact, &options.contact);
        let ContactOptions { friction, offsets, slices, .. } = *asked;
        let alike = ContactOptions { friction, offsets, slices, ..own.clone() } == *asked;
        let nominal = |a: &GearPair, b: &GearPair| {
            let place = |pair: &GearPair| [pair.centre_distance(), pair.mid_face_offset()];
            place(a) == place(b) && a.pinion.data() == b.pinion.data() && a.wheel.data() == b.wheel.data()
        };
        let nominal = nominal(&self.pair, &pair);
        let known = (alike && nominal).then(|| self.contact_set());
        let root = self.root.clone().filter(|_| nominal);
        Self::with_known(pair, Arc::clone(&self.gears), options, (known, root))
    }

    /// The same pair under another torque, N mm: [`StaticModel::modified`] without any other difference.
    ///
    /// # Errors
    /// The errors of [`StaticModel::new`].
    pub fn under_torque(&self, torque: f64) -> Result<Self, StaticError> {
        self.modified(self.pair.clone(), StaticOptions { torque, ..self.options.clone() })
    }

    /// Model with matrices and tables of any window of these gears, and with the maps to their root stress, where they are
    /// known.
    fn with_known(
        pair: GearPair,
        gears: Arc<[ElasticGear; 2]>,
        options: StaticOptions,
        (known, root): (Option<&ContactSet>, Option<Arc<RootStress>>),
    ) -> Result<Self, StaticError> {
        let fine = options.torque.is_finite() && options.torque >= 0.0;
        if !fine {
            let value = options.torque;
            return Err(StaticError::OutOfRange { name: "torque [N mm]", value, expected: "0 or more" });
        }
        let whole = gears.iter().any(|g| matches!(g, ElasticGear::Full(_)));
        let limit = if whole { 0.0 } else { 1.0 };
        if !(0.0..=limit).contains(&options.contact.friction) {
            let expected = if whole { "0 with all degrees of freedom kept" } else { "0 to 1" };
            return Err(StaticError::OutOfRange {
                name: "friction coefficient",
                value: options.contact.friction,
                expected,
            });
        }
        if let contact::complementarity::Law::Penalty(value) = options.contact.law
            && !(value.is_finite() && value > 0.0)
        {
            return Err(StaticError::OutOfRange { name: "penalty [MPa/mm]", value, expected: "above 0" });
        }
        if !options.contact.corner_contact && options.contact.method == Method::Nodal {
            return Err(StaticError::NodalCornerContact);
        }
        check_offsets(&pair, &options.contact)?;
        let window = first_window(&pair, &options)?;
        let shared = match known {
            Some(set) => set.modified(&pair, &gears, window.window(), &options.contact)?,
            None => None,
        };
        let set = match shared {
            Some(set) => set,
            None => ContactSet::new(&pair, &gears, window.window(), &options.contact)?,
        };
        let root = options.root_stress.then(|| root.unwrap_or_else(|| Arc::new(RootStress::new(&pair, &gears))));
        let inputs = CycleInputs { pair: &pair, gears: &gears, options: &options, root: root.as_deref() };
        let solver = CycleSolver::new(&inputs, window, set)?;
        Ok(Self { pair, gears, options, root, solver })
    }

    fn split(&mut self) -> (CycleInputs<'_>, &mut CycleSolver) {
        let Self { pair, gears, options, root, solver } = self;
        (CycleInputs { pair, gears, options, root: root.as_deref() }, solver)
    }

    /// The gear pair.
    pub fn pair(&self) -> &GearPair {
        &self.pair
    }

    /// The elastic gears.
    pub fn gears(&self) -> &[ElasticGear; 2] {
        &self.gears
    }

    /// Returns the reduced gears, for a model of the same meshes with another torque or micro-geometry.
    pub fn into_gears(self) -> Arc<[ElasticGear; 2]> {
        self.gears
    }

    /// Options of the model.
    pub fn options(&self) -> &StaticOptions {
        &self.options
    }

    /// The current window.
    pub fn window(&self) -> &ToothWindow {
        self.solver.window.window()
    }

    /// Flanks and matrices of the current window.
    pub fn contact_set(&self) -> &ContactSet {
        &self.solver.contact.set
    }

    /// The last solved contact.
    pub fn last(&self) -> Option<&Equilibrium> {
        self.solver.last.as_deref()
    }

    /// Computes the maps to the root stress of the current window. Otherwise the first position computes them, which
    /// takes most of its time. Does nothing without root stress.
    ///
    /// # Errors
    /// The [`StaticError`] that the first position would return.
    pub fn prepare_root_stress(&self) -> Result<(), StaticError> {
        let Some(root) = &self.root else { return Ok(()) };
        let inputs = CycleInputs { pair: &self.pair, gears: &self.gears, options: &self.options, root: Some(root) };
        self.solver.prepare_root_stress(&inputs)
    }

    /// Solves a station with the current window.
    ///
    /// # Errors
    /// [`StaticError`], including [`ale::AleError::Starved`] if a pair outside the window would touch.
    pub fn solve(&mut self, station: Station) -> Result<StaticPosition, StaticError> {
        let (inputs, solver) = self.split();
        solver.solve(&inputs, station)
    }

    /// Moves the window one tooth further at the station just solved, and solves it again.
    ///
    /// # Errors
    /// [`StaticError::Window`] if the outgoing tooth carries load; no load is ever dropped.
    pub fn change(&mut self, before: &StaticPosition, station: Station) -> Result<StaticPosition, StaticError> {
        let (inputs, solver) = self.split();
        solver.change(&inputs, before, station)
    }

    /// Solves a station and makes the tooth changes that are due: as soon as another window is nearer to the middle and
    /// the outgoing tooth is unloaded. `seen` receives every change.
    ///
    /// # Errors
    /// [`StaticError`] if the station cannot be solved.
    pub fn advance(&mut self, station: Station, seen: impl FnMut(&ToothChange)) -> Result<StaticPosition, StaticError> {
        let (inputs, solver) = self.split();
        solver.advance(&inputs, station, seen)
    }

    /// The tooth changes that are due at a station. A change at the end of a mesh cycle belongs to that cycle; one at
    /// its start belongs to the preceding cycle.
    ///
    /// # Errors
    /// [`StaticError`] if the station cannot be solved.
    pub fn tooth_changes_at(&mut self, station: Station) -> Result<Vec<ToothChangeRecord>, StaticError> {
        let mut made = Vec::new();
        self.advance(station, |change| made.push(change.record(station)))?;
        Ok(made)
    }

    /// Runs `cycles` mesh cycles of `positions` stations each from the start, whatever the current state of the model.
    /// `seen` is called with each result in order (for progress) while the model is in the state of that result.
    ///
    /// Slices on cyclic gears are solved in groups of stations in parallel on all cores (`cycle.rs`). The results are
    /// the same for any number of threads.
    ///
    /// # Errors
    /// [`StaticError`] of the first station that cannot be solved.
    pub fn run(
        &mut self,
        positions: usize,
        cycles: usize,
        mut seen: impl FnMut(usize, &StaticPosition, &Self),
    ) -> Result<StaticHistory, StaticError> {
        self.run_while(positions, cycles, |index, position, model| {
            seen(index, position, model);
            ControlFlow::Continue(())
        })
    }

    /// Solves mesh cycles like [`StaticModel::run`]. `seen` may end the run; the history then has the positions solved
    /// so far.
    ///
    /// # Errors
    /// [`StaticError`] of the first station that cannot be solved.
    pub fn run_while(
        &mut self,
        positions: usize,
        cycles: usize,
        mut seen: impl FnMut(usize, &StaticPosition, &Self) -> ControlFlow<()>,
    ) -> Result<StaticHistory, StaticError> {
        let stations: Vec<Station> = (0..positions * cycles)
            .map(|i| Station { cycle: (i / positions) as i64, phase: (i % positions) as f64 / positions as f64 })
            .collect();
        let start = first_window(&self.pair, &self.options)?;
        let (inputs, solver) = self.split();
        solver.begin(&inputs, start)?;
        let mut history = StaticHistory::default();
        let mut left = &stations[..];
        while !left.is_empty() {
            let (inputs, solver) = self.split();
            let (wave, rest) = left.split_at(cycle::wave(&inputs, solver).min(left.len()));
            left = rest;
            for solved in cycle::solve(&inputs, solver, wave) {
                let (position, mut state) = solved?;
                history.tooth_changes.append(&mut state.made);
                let (inputs, solver) = self.split();
                solver.resume(&inputs, state)?;
                let i = history.positions.len();
                let goes_on = seen(i, &position, self);
                history.push(position, self.options.side());
                if goes_on.is_break() {
                    return Ok(history);
                }
            }
        }
        Ok(history)
    }
}

fn first_window(pair: &GearPair, options: &StaticOptions) -> Result<SlidingWindow, StaticError> {
    let teeth = [pair.pinion.teeth(), pair.wheel.teeth()];
    Ok(SlidingWindow::at_start(options.window_teeth(pair), teeth, options.contact.sense)?)
}
