//! A pair from station to station: window, contact and last solution.

use ale::{SlidingWindow, Station};
use contact::{Beside, ContactSet, WindowContact};
use geometry::GearPair;
use reduction::ElasticGear;

use crate::{
    Change, Equilibrium, FilletStress, Parts, RootStress, StaticError, StaticOptions, StaticPosition,
    equilibrium::equilibrium, kinematic::Unloaded, loads,
};

/// What stays the same from station to station.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Fixed<'a> {
    pub pair: &'a GearPair,
    pub gears: &'a [ElasticGear; 2],
    pub options: &'a StaticOptions,
    pub root: Option<&'a RootStress>,
}

/// What goes from station to station.
#[derive(Debug)]
pub(crate) struct CycleSolver {
    pub window: SlidingWindow,
    pub contact: WindowContact,
    pub last: Option<Equilibrium>,
    pub changes: u64,
}

impl CycleSolver {
    /// At rest, in a window with the given flanks and matrices.
    ///
    /// # Errors
    /// [`StaticError`] when the contact cannot be set up.
    pub fn new(fixed: &Fixed<'_>, window: SlidingWindow, set: ContactSet) -> Result<Self, StaticError> {
        let contact = WindowContact::new(fixed.pair, set, &fixed.options.contact)?;
        Ok(Self { window, contact, last: None, changes: 0 })
    }

    fn parts<'a>(&'a self, fixed: &Fixed<'a>) -> Parts<'a> {
        let Fixed { pair, gears, options, .. } = *fixed;
        Parts { pair, gears, set: &self.contact.set, window: self.window.window(), options }
    }

    /// Solves a station with the window as it stands.
    pub fn solve(&mut self, fixed: &Fixed<'_>, station: Station) -> Result<StaticPosition, StaticError> {
        let Fixed { pair, gears, options, .. } = *fixed;
        if options.torque == 0.0 {
            let root_stress = self.root_stress(fixed, None)?;
            return Ok(StaticPosition { root_stress, ..self.unloaded(fixed, station)? });
        }
        let guess = self.last.take();
        let Self { contact: WindowContact { set, slices }, window, .. } = self;
        let parts = Parts { pair, gears, set, window: window.window(), options };
        let e = equilibrium(&parts, slices.as_mut(), station, guess.as_ref())?;
        let result = self.position(fixed, &e)?;
        let fed = self.check_beside(fixed, &e);
        self.last = Some(e);
        fed.map(|()| result)
    }

    /// Everything the results hold of a solved station.
    fn position(&self, fixed: &Fixed<'_>, e: &Equilibrium) -> Result<StaticPosition, StaticError> {
        let root_stress = self.root_stress(fixed, Some(e))?;
        Ok(StaticPosition { root_stress, ..loads::position(&self.parts(fixed), e, self.changes) })
    }

    /// Stress in the fillets of both windows, when it is asked for.
    fn root_stress(&self, fixed: &Fixed<'_>, e: Option<&Equilibrium>) -> Result<[Vec<FilletStress>; 2], StaticError> {
        let Some(root) = fixed.root else { return Ok(Default::default()) };
        root.of(&self.parts(fixed), e.map(|e| e.displacements_on(&self.contact.set)).as_ref())
    }

    /// Refuses a window beside which a pair overlaps at the loaded pose.
    fn check_beside(&self, fixed: &Fixed<'_>, e: &Equilibrium) -> Result<(), StaticError> {
        let Fixed { pair, options, .. } = *fixed;
        let (set, window) = (&self.contact.set, self.window.window());
        let beside = Beside { pair, options: &options.contact, set, window, station: e.station, poses: &e.poses };
        let allowed = 1e-3 * e.elastic_error().abs();
        Ok(self.window.check_beside(e.station, options.torque, allowed, |running| beside.gap(running))?)
    }

    /// Without torque the flanks just touch: nominal ones along the analytic lines and without transmission error, others where
    /// their least gap is.
    fn unloaded(&self, fixed: &Fixed<'_>, station: Station) -> Result<StaticPosition, StaticError> {
        let touch = Unloaded::new(fixed.pair, &fixed.options.contact, station)?;
        let error = touch.transmission_error();
        let theta1 = station.pinion_angle(fixed.pair, fixed.options.side(), fixed.options.contact.sense);
        let lines = fixed.pair.contact_lines(fixed.options.side(), theta1);
        let middle = station.middle_pair(fixed.options.contact.sense);
        let mut pairs: Vec<_> = self
            .window
            .window()
            .pairs()
            .map(|running| {
                let nominal = lines.iter().find(|l| l.tooth == running - middle).map_or(0.0, |l| l.length);
                let length = if touch.is_nominal() { nominal } else { touch.line_length(running) };
                let [pinion_tooth, wheel_tooth] = self.window.window().teeth_of(running);
                crate::PairResult {
                    pair: fixed.options.contact.sense.sign() * running,
                    pinion_tooth,
                    wheel_tooth,
                    normal_force: 0.0,
                    max_pressure: 0.0,
                    contact_line_length: length,
                    points_in_contact: 0,
                    slices: Vec::new(),
                }
            })
            .collect();
        pairs.sort_by_key(|p| p.pair);
        Ok(StaticPosition {
            pinion_angle: (station.cycle as f64 + station.phase - 0.5) * fixed.pair.pinion.pitch_angle(),
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
            max_pressure: 0.0,
            friction_work: 0.0,
            strain_energy: 0.0,
            tooth_changes: self.changes,
            certificate: Default::default(),
        })
    }

    /// Moves the window one tooth on at the station just solved, and solves it again.
    ///
    /// # Errors
    /// [`StaticError::Window`] when the outgoing tooth carries load: it is never dropped.
    pub fn change(
        &mut self,
        fixed: &Fixed<'_>,
        before: &StaticPosition,
        station: Station,
    ) -> Result<StaticPosition, StaticError> {
        self.enter(fixed, self.window.change(&self.forces(fixed, before))?)?;
        self.changes += 1;
        // The patches of the window have other numbers now: points are not remembered across a change.
        if let Some(last) = &mut self.last {
            last.solution.active.clear();
        }
        self.solve(fixed, station)
    }

    /// Normal forces of the window's pairs, N, ascending in running numbers; results number pairs in the sense of rotation.
    fn forces(&self, fixed: &Fixed<'_>, position: &StaticPosition) -> Vec<f64> {
        let force = |running: i64| {
            let number = fixed.options.contact.sense.sign() * running;
            position.pairs.iter().find(|p| p.pair == number).map_or(0.0, |p| p.normal_force)
        };
        self.window.window().pairs().map(force).collect()
    }

    /// Back to a window to begin from, nothing remembered: a run does not depend on those before it.
    ///
    /// # Errors
    /// [`StaticError`] when the window cannot be entered.
    pub fn begin(&mut self, fixed: &Fixed<'_>, window: SlidingWindow) -> Result<(), StaticError> {
        if self.window != window {
            self.enter(fixed, window)?;
        }
        if let Some(slices) = &mut self.contact.slices {
            slices.forget();
        }
        (self.last, self.changes) = (None, 0);
        Ok(())
    }

    fn enter(&mut self, fixed: &Fixed<'_>, window: SlidingWindow) -> Result<(), StaticError> {
        let set = self.contact.set.clone();
        self.contact.enter(fixed.pair, fixed.gears, window.window(), set, &fixed.options.contact)?;
        self.window = window;
        Ok(())
    }

    /// Solves a station, with the tooth changes that are due: as soon as another window is nearer to the middle and the
    /// outgoing tooth is free of load. `seen` gets every change.
    ///
    /// # Errors
    /// [`StaticError`].
    pub fn advance(
        &mut self,
        fixed: &Fixed<'_>,
        station: Station,
        mut seen: impl FnMut(&Change),
    ) -> Result<StaticPosition, StaticError> {
        let mut result = self.solve(fixed, station);
        while self.window.teeth_behind(station) > 0 {
            let before = match &result {
                Ok(position) => position.clone(),
                // A pair that comes in early is what the change is for; the outgoing tooth decides.
                Err(e) if e.is_starved() => match &self.last {
                    Some(e) => self.position(fixed, e)?,
                    None => break,
                },
                Err(_) => break,
            };
            if self.window.due_change(station, &self.forces(fixed, &before))?.is_none() {
                break;
            }
            let after = self.change(fixed, &before, station)?;
            seen(&Change { before, after: after.clone(), window: *self.window.window() });
            result = Ok(after);
        }
        result
    }
}
