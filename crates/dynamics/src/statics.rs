//! Station by station through mesh cycles, with tooth changes.

use ale::{ToothWindow, teeth_needed};
use geometry::GearPair;

use crate::{
    ContactSet, ElasticGear, Equilibrium, FilletStress, MeshContact, Method, StaticError, StaticHistory, StaticOptions,
    StaticPosition, Station, equilibrium::equilibrium, kinematic::Unloaded, line, loads, parts::Parts, pose,
    root_stress::RootStress,
};

/// A tooth change as it happened: the same station solved with the window before and the one after.
#[derive(Debug, Clone)]
pub struct Change {
    /// Result with the old window.
    pub before: StaticPosition,
    /// Result with the new window.
    pub after: StaticPosition,
    /// The new window.
    pub window: ToothWindow,
}

/// A pair of elastic gears under torque.
#[derive(Debug)]
pub struct StaticModel {
    pair: GearPair,
    gears: [ElasticGear; 2],
    options: StaticOptions,
    window: ToothWindow,
    set: ContactSet,
    /// Solver of slices on reduced gears.
    mesh: Option<MeshContact>,
    root: Option<RootStress>,
    last: Option<Equilibrium>,
    changes: u64,
}

impl StaticModel {
    /// Teeth of the window that `options` ask of `pair`.
    pub fn window_teeth(pair: &GearPair, options: &StaticOptions) -> usize {
        options.window.unwrap_or_else(|| teeth_needed(pair.total_contact_ratio()))
    }

    /// First tooth of each gear's window at the start of a run: reduce the gears there.
    ///
    /// # Errors
    /// [`StaticError::Window`] when the window is wider than a gear.
    pub fn first_teeth(pair: &GearPair, options: &StaticOptions) -> Result<[u32; 2], StaticError> {
        Ok(first_window(pair, options)?.first_teeth())
    }

    /// A model at the start of cycle 0.
    ///
    /// # Errors
    /// [`StaticError`] when a value has no meaning, or meshes and geometry do not fit.
    pub fn new(pair: GearPair, gears: [ElasticGear; 2], options: StaticOptions) -> Result<Self, StaticError> {
        let fine = options.torque.is_finite() && options.torque >= 0.0;
        if !fine {
            let value = options.torque;
            return Err(StaticError::OutOfRange { name: "torque [N mm]", value, expected: "0 or more" });
        }
        let whole = gears.iter().any(|g| matches!(g, ElasticGear::Full(_)));
        let limit = if whole { 0.0 } else { 1.0 };
        if !(0.0..=limit).contains(&options.friction) {
            let expected = if whole { "0 with all degrees of freedom kept" } else { "0 to 1" };
            return Err(StaticError::OutOfRange { name: "friction coefficient", value: options.friction, expected });
        }
        if let contact::Law::Penalty(value) = options.law
            && !(value.is_finite() && value > 0.0)
        {
            return Err(StaticError::OutOfRange { name: "penalty [MPa/mm]", value, expected: "above 0" });
        }
        if !options.corner_contact && options.method == Method::Nodal {
            let expected = "1 (on): points cannot tell an edge from a flank";
            return Err(StaticError::OutOfRange { name: "corner contact", value: 0.0, expected });
        }
        pose::check_offsets(&pair, &options)?;
        let window = first_window(&pair, &options)?;
        let set = ContactSet::new(&pair, &gears, &window, &options)?;
        let mesh = mesh_contact(&pair, &set, &options)?;
        let root = options.root_stress.then(|| RootStress::new(&pair, &gears));
        Ok(Self { pair, gears, options, window, set, mesh, root, last: None, changes: 0 })
    }

    fn parts(&self) -> Parts<'_> {
        let Self { pair, gears, set, window, options, .. } = self;
        Parts { pair, gears, set, window, options }
    }

    /// The pair.
    pub fn pair(&self) -> &GearPair {
        &self.pair
    }

    /// The elastic gears.
    pub fn gears(&self) -> &[ElasticGear; 2] {
        &self.gears
    }

    /// The gears back, reduced as they are: for a model of the same meshes with another torque or micro-geometry.
    pub fn into_gears(self) -> [ElasticGear; 2] {
        self.gears
    }

    /// The options.
    pub fn options(&self) -> &StaticOptions {
        &self.options
    }

    /// The window as it stands.
    pub fn window(&self) -> &ToothWindow {
        &self.window
    }

    /// Flanks and matrices of the window as it stands.
    pub fn contact_set(&self) -> &ContactSet {
        &self.set
    }

    /// The last solved contact.
    pub fn last(&self) -> Option<&Equilibrium> {
        self.last.as_ref()
    }

    /// Solves a station with the window as it stands.
    ///
    /// # Errors
    /// [`StaticError`], among them [`StaticError::Starved`] when a pair outside the window would touch.
    pub fn solve(&mut self, station: Station) -> Result<StaticPosition, StaticError> {
        if self.options.torque == 0.0 {
            let root_stress = self.root_stress(None)?;
            return Ok(StaticPosition { root_stress, ..self.unloaded(station)? });
        }
        let guess = self.last.take();
        let Self { pair, gears, set, window, options, mesh, .. } = self;
        let parts = Parts { pair, gears, set, window, options };
        let e = equilibrium(&parts, mesh.as_mut(), station, guess.as_ref())?;
        let result = self.position(&e)?;
        let starved = self.starved(&e);
        self.last = Some(e);
        starved.map_or(Ok(result), Err)
    }

    /// Everything the results hold of a solved station.
    fn position(&self, e: &Equilibrium) -> Result<StaticPosition, StaticError> {
        let root_stress = self.root_stress(Some(e))?;
        Ok(StaticPosition { root_stress, ..loads::position(&self.parts(), e, self.changes) })
    }

    /// Stress in the fillets of both windows, when it is asked for.
    fn root_stress(&self, e: Option<&Equilibrium>) -> Result<[Vec<FilletStress>; 2], StaticError> {
        let Some(root) = &self.root else { return Ok(Default::default()) };
        root.of(&self.parts(), e.map(|e| self.set.displacements(e)).as_ref())
    }

    /// A pair beside the window that overlaps at the loaded pose.
    fn starved(&self, e: &Equilibrium) -> Option<StaticError> {
        let pairs = self.window.pairs();
        let least = 1e-3 * e.elastic_error().abs();
        [pairs.start - 1, pairs.end].into_iter().find_map(|running| {
            let gap = line::outside_gap(&self.parts(), e, running);
            (gap < -least).then(|| StaticError::Starved {
                cycle: e.station.cycle,
                phase: e.station.phase,
                pair: running,
                window: self.window.count(),
                overlap_um: -1e3 * gap,
                torque_nm: 1e-3 * self.options.torque,
            })
        })
    }

    /// Without torque the flanks just touch: nominal ones along the analytic lines and without transmission error, others where
    /// their least gap is.
    fn unloaded(&self, station: Station) -> Result<StaticPosition, StaticError> {
        let touch = Unloaded::new(&self.pair, &self.options, station)?;
        let error = touch.transmission_error();
        let theta1 = station.pinion_angle(&self.pair, &self.options);
        let lines = self.pair.contact_lines(self.options.side(), theta1);
        let middle = station.middle_pair(&self.options);
        let mut pairs: Vec<_> = self
            .window
            .pairs()
            .map(|running| {
                let nominal = lines.iter().find(|l| l.tooth == running - middle).map_or(0.0, |l| l.length);
                let length = if touch.is_nominal() { nominal } else { touch.line_length(running) };
                let [pinion_tooth, wheel_tooth] = self.window.teeth_of(running);
                crate::PairResult {
                    pair: self.options.sense.sign() * running,
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
            pinion_angle: (station.cycle as f64 + station.phase - 0.5) * self.pair.pinion.pitch_angle(),
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
    pub fn change(&mut self, before: &StaticPosition, station: Station) -> Result<StaticPosition, StaticError> {
        let forces: Vec<f64> = self.window.pairs().map(|running| self.force_of(before, running)).collect();
        let next = self.window.change(self.options.sense, &forces)?;
        self.enter(next)?;
        self.changes += 1;
        // The patches of the window have other numbers now: points are not remembered across a change.
        if let Some(last) = &mut self.last {
            last.solution.active.clear();
        }
        self.solve(station)
    }

    /// Normal force of the pair of a running number, N; results number pairs in the sense of rotation.
    fn force_of(&self, position: &StaticPosition, running: i64) -> f64 {
        let number = self.options.sense.sign() * running;
        position.pairs.iter().find(|p| p.pair == number).map_or(0.0, |p| p.normal_force)
    }

    fn enter(&mut self, window: ToothWindow) -> Result<(), StaticError> {
        if self.set.move_to(&self.gears, &window)? {
            if let Some(mesh) = &mut self.mesh {
                mesh.enter(self.set.clone());
            }
        } else {
            self.set = ContactSet::new(&self.pair, &self.gears, &window, &self.options)?;
            self.mesh = mesh_contact(&self.pair, &self.set, &self.options)?;
        }
        self.window = window;
        Ok(())
    }

    /// Solves a station, with the tooth changes that are due: as soon as another window is nearer to the middle and the
    /// outgoing tooth is free of load. `seen` gets every change.
    ///
    /// # Errors
    /// [`StaticError`].
    pub fn advance(&mut self, station: Station, mut seen: impl FnMut(&Change)) -> Result<StaticPosition, StaticError> {
        let due = ToothWindow::nominal_first(station.centre(&self.options), self.window.count());
        let mut result = self.solve(station);
        while (due - self.window.first()) * self.options.sense.sign() < 0 {
            let before = match &result {
                Ok(position) => position.clone(),
                // A pair that comes in early is what the change is for; the outgoing tooth decides.
                Err(StaticError::Starved { .. }) => match &self.last {
                    Some(e) => self.position(e)?,
                    None => break,
                },
                Err(_) => break,
            };
            if self.force_of(&before, self.window.outgoing(self.options.sense)) != 0.0 {
                break;
            }
            let after = self.change(&before, station)?;
            seen(&Change { before, after: after.clone(), window: self.window });
            result = Ok(after);
        }
        result
    }

    /// Runs `cycles` mesh cycles of `positions` stations each; `seen` is told of each result (for progress).
    ///
    /// # Errors
    /// [`StaticError`] of the first station that cannot be solved.
    pub fn run(
        &mut self,
        positions: usize,
        cycles: usize,
        mut seen: impl FnMut(usize, &StaticPosition, &Self),
    ) -> Result<StaticHistory, StaticError> {
        let mut history = StaticHistory::default();
        for i in 0..positions * cycles {
            let station = Station { cycle: (i / positions) as i64, phase: (i % positions) as f64 / positions as f64 };
            let position = self.advance(station, |_| ())?;
            seen(i, &position, self);
            history.positions.push(position);
        }
        Ok(history)
    }
}

fn mesh_contact(
    pair: &GearPair,
    set: &ContactSet,
    options: &StaticOptions,
) -> Result<Option<MeshContact>, StaticError> {
    let sliced = set.slices().is_some() && set.windows().is_some();
    sliced.then(|| MeshContact::new(pair, set.clone(), options)).transpose()
}

fn first_window(pair: &GearPair, options: &StaticOptions) -> Result<ToothWindow, StaticError> {
    let count = StaticModel::window_teeth(pair, options);
    let start = Station { cycle: 0, phase: 0.0 };
    let teeth = [pair.pinion.teeth(), pair.wheel.teeth()];
    // Half a pitch is a tie between two windows; the first one serves the cycle that starts.
    let inward = -1e-9 * options.sense.sign() as f64;
    Ok(ToothWindow::new(ToothWindow::nominal_first(start.centre(options) + inward, count), count, teeth)?)
}
