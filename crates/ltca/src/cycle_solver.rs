//! A pair that moves from station to station: window, contact and last solution.

use std::sync::Arc;

use ale::{SlidingWindow, Station};
use contact::{ContactSet, WindowContact, line::NeighbourPairs};
use geometry::GearPair;
use reduction::ElasticGear;

use crate::{
    Equilibrium, FilletField, RootStress, StaticError, StaticOptions, StaticPosition, ToothChange, WindowedPair,
    equilibrium::equilibrium, kinematic::Unloaded, loads,
};

/// What all stations have in common.
#[derive(Debug, Clone, Copy)]
pub(crate) struct CycleInputs<'a> {
    pub pair: &'a GearPair,
    pub gears: &'a [ElasticGear; 2],
    pub options: &'a StaticOptions,
    pub root: Option<&'a RootStress>,
}

/// State that goes from station to station.
#[derive(Debug)]
pub(crate) struct CycleSolver {
    pub window: SlidingWindow,
    pub contact: WindowContact,
    pub last: Option<Arc<Equilibrium>>,
    pub changes: u64,
}

impl CycleSolver {
    /// Solver without a solution yet, in a window with the given flanks and matrices.
    ///
    /// # Errors
    /// [`StaticError`] if the contact cannot be set up.
    pub fn new(inputs: &CycleInputs<'_>, window: SlidingWindow, set: ContactSet) -> Result<Self, StaticError> {
        let contact = WindowContact::new(inputs.pair, set, &inputs.options.contact)?;
        Ok(Self { window, contact, last: None, changes: 0 })
    }

    fn windowed<'a>(&'a self, inputs: &CycleInputs<'a>) -> WindowedPair<'a> {
        let CycleInputs { pair, gears, options, .. } = *inputs;
        WindowedPair { pair, gears, set: &self.contact.set, window: self.window.window(), options }
    }

    /// Solves a station in the current window.
    pub fn solve(&mut self, inputs: &CycleInputs<'_>, station: Station) -> Result<StaticPosition, StaticError> {
        let CycleInputs { pair, gears, options, .. } = *inputs;
        if options.torque == 0.0 {
            let roots = self.root_stress(inputs, None)?;
            return Ok(self.unloaded(inputs, station)?.with_roots(roots));
        }
        let guess = self.last.take();
        let Self { contact: WindowContact { set, slices }, window, .. } = self;
        let windowed = WindowedPair { pair, gears, set, window: window.window(), options };
        let e = equilibrium(&windowed, slices.as_mut(), station, guess.as_deref())?;
        let result = self.position(inputs, &e)?;
        let window_serves = self.check_neighbours(inputs, &e);
        self.last = Some(Arc::new(e));
        window_serves.map(|()| result)
    }

    /// Everything the results hold of a solved station.
    fn position(&self, inputs: &CycleInputs<'_>, e: &Equilibrium) -> Result<StaticPosition, StaticError> {
        let roots = self.root_stress(inputs, Some(e))?;
        Ok(loads::position(&self.windowed(inputs), e, self.changes).with_roots(roots))
    }

    /// Stress in the fillets of both windows, when it is asked for.
    /// Makes the maps to the root stress of the window as it stands.
    pub(crate) fn prepare_root_stress(&self, inputs: &CycleInputs<'_>) -> Result<(), StaticError> {
        inputs.root.map_or(Ok(()), |root| root.prepare(&self.windowed(inputs)))
    }

    fn root_stress(
        &self,
        inputs: &CycleInputs<'_>,
        e: Option<&Equilibrium>,
    ) -> Result<[Vec<FilletField>; 2], StaticError> {
        let Some(root) = inputs.root else { return Ok(Default::default()) };
        root.fields(&self.windowed(inputs), e.map(|e| e.loads_on(&self.contact.set)).as_ref())
    }

    /// Refuses the window if a neighbouring pair outside it overlaps at the loaded pose.
    fn check_neighbours(&self, inputs: &CycleInputs<'_>, e: &Equilibrium) -> Result<(), StaticError> {
        let CycleInputs { pair, options, .. } = *inputs;
        let (set, window) = (&self.contact.set, self.window.window());
        let neighbours =
            NeighbourPairs { pair, options: &options.contact, set, window, station: e.station, poses: &e.poses };
        let allowed = 1e-3 * e.elastic_error().abs();
        Ok(self.window.check_neighbours(e.station, options.torque, allowed, |running| neighbours.gap(running))?)
    }

    /// Without torque the flanks just touch: nominal ones along the analytic lines and without transmission error,
    /// others where their least gap is.
    fn unloaded(&self, inputs: &CycleInputs<'_>, station: Station) -> Result<StaticPosition, StaticError> {
        let touch = Unloaded::new(inputs.pair, &inputs.options.contact, station)?;
        let error = touch.transmission_error();
        let theta1 = station.pinion_angle(inputs.pair, inputs.options.side(), inputs.options.contact.sense);
        let lines = inputs.pair.contact_lines(inputs.options.side(), theta1);
        let middle = station.middle_pair(inputs.options.contact.sense);
        let mut pairs: Vec<_> = self
            .window
            .window()
            .pairs()
            .map(|running| {
                let nominal = lines.iter().find(|l| l.tooth == running - middle).map_or(0.0, |l| l.length);
                let length = if touch.is_nominal() { nominal } else { touch.line_length(running) };
                let [pinion_tooth, wheel_tooth] = self.window.window().teeth_of(running);
                crate::PairResult {
                    pair: inputs.options.contact.sense.sign() * running,
                    pinion_tooth,
                    wheel_tooth,
                    normal_force: 0.0,
                    max_pressure: 0.0,
                    contact_line_length: length,
                    geometric_line_length: nominal,
                    points_in_contact: 0,
                    slices: Vec::new(),
                    gap_rates: Vec::new(),
                }
            })
            .collect();
        pairs.sort_by_key(|p| p.pair);
        Ok(StaticPosition {
            pinion_angle: (station.cycle as f64 + station.phase - 0.5) * inputs.pair.pinion.pitch_angle(),
            mesh_phase: station.phase,
            transmission_error: error,
            kinematic_transmission_error: error,
            secant_stiffness: f64::NAN,
            tangent_stiffness: 0.0,
            contact_line_length: pairs.iter().map(|p| p.contact_line_length).sum(),
            geometric_line_length: lines.iter().map(|l| l.length).sum(),
            pairs,
            wrench: Default::default(),
            root_stress: Default::default(),
            root_fields: Default::default(),
            max_pressure: 0.0,
            friction_work: 0.0,
            sliding_work: 0.0,
            strain_energy: 0.0,
            tooth_changes: self.changes,
            certificate: Default::default(),
        })
    }

    /// Moves the window one tooth further at the station just solved, and solves it again.
    ///
    /// # Errors
    /// [`StaticError::Window`] if the outgoing tooth carries load; no load is ever dropped.
    pub fn change(
        &mut self,
        inputs: &CycleInputs<'_>,
        before: &StaticPosition,
        station: Station,
    ) -> Result<StaticPosition, StaticError> {
        self.enter(inputs, self.window.change(&self.forces(inputs, before))?)?;
        self.changes += 1;
        // The patches of the window have other numbers now: points are not remembered across a change.
        if let Some(last) = &mut self.last {
            Arc::make_mut(last).solution.active.clear();
        }
        self.solve(inputs, station)
    }

    /// Normal forces of the window's pairs, N, ascending in running numbers; results number pairs in the sense of
    /// rotation.
    fn forces(&self, inputs: &CycleInputs<'_>, position: &StaticPosition) -> Vec<f64> {
        let force = |running: i64| {
            let number = inputs.options.contact.sense.sign() * running;
            position.pairs.iter().find(|p| p.pair == number).map_or(0.0, |p| p.normal_force)
        };
        self.window.window().pairs().map(force).collect()
    }

    /// Begins in a given window without any history, so a run does not depend on earlier ones.
    ///
    /// # Errors
    /// [`StaticError`] if the window cannot be entered.
    pub fn begin(&mut self, inputs: &CycleInputs<'_>, window: SlidingWindow) -> Result<(), StaticError> {
        if self.window != window {
            self.enter(inputs, window)?;
        }
        if let Some(slices) = &mut self.contact.slices {
            slices.forget();
        }
        (self.last, self.changes) = (None, 0);
        Ok(())
    }

    fn enter(&mut self, inputs: &CycleInputs<'_>, window: SlidingWindow) -> Result<(), StaticError> {
        let set = self.contact.set.clone();
        self.contact.enter(inputs.pair, inputs.gears, window.window(), set, &inputs.options.contact)?;
        self.window = window;
        Ok(())
    }

    /// Solves a station and makes the tooth changes that are due: as soon as another window is nearer to the middle and
    /// the outgoing tooth is unloaded. `seen` receives every change.
    ///
    /// # Errors
    /// [`StaticError`] if the station cannot be solved.
    pub fn advance(
        &mut self,
        inputs: &CycleInputs<'_>,
        station: Station,
        mut seen: impl FnMut(&ToothChange),
    ) -> Result<StaticPosition, StaticError> {
        let mut result = self.solve(inputs, station);
        while self.window.teeth_behind(station) > 0 {
            let before = match &result {
                Ok(position) => position.clone(),
                // An early contact of the oncoming pair is a reason to change; the outgoing tooth decides whether the
                // change is allowed.
                Err(e) if e.is_starved() => match &self.last {
                    Some(e) => self.position(inputs, e)?,
                    None => break,
                },
                Err(_) => break,
            };
            if self.window.due_change(station, &self.forces(inputs, &before))?.is_none() {
                break;
            }
            let after = self.change(inputs, &before, station)?;
            seen(&ToothChange { before, after: after.clone(), window: *self.window.window() });
            result = Ok(after);
        }
        result
    }
}
