//! Station by station through mesh cycles, with tooth changes.

use ale::{Station, ToothWindow};
use contact::{ContactSet, Method, check_offsets};
use geometry::GearPair;
use reduction::ElasticGear;

use crate::{
    Equilibrium, RootStress, StaticError, StaticHistory, StaticOptions, StaticPosition, cycle,
    walk::{Fixed, Walk},
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
    root: Option<RootStress>,
    walk: Walk,
}

impl StaticModel {
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
        if !(0.0..=limit).contains(&options.contact.friction) {
            let expected = if whole { "0 with all degrees of freedom kept" } else { "0 to 1" };
            return Err(StaticError::OutOfRange {
                name: "friction coefficient",
                value: options.contact.friction,
                expected,
            });
        }
        if let contact::Law::Penalty(value) = options.contact.law
            && !(value.is_finite() && value > 0.0)
        {
            return Err(StaticError::OutOfRange { name: "penalty [MPa/mm]", value, expected: "above 0" });
        }
        if !options.contact.corner_contact && options.contact.method == Method::Nodal {
            let expected = "1 (on): points cannot tell an edge from a flank";
            return Err(StaticError::OutOfRange { name: "corner contact", value: 0.0, expected });
        }
        check_offsets(&pair, &options.contact)?;
        let window = first_window(&pair, &options)?;
        let set = ContactSet::new(&pair, &gears, &window, &options.contact)?;
        let root = options.root_stress.then(|| RootStress::new(&pair, &gears));
        let fixed = Fixed { pair: &pair, gears: &gears, options: &options, root: root.as_ref() };
        let walk = Walk::new(&fixed, window, set)?;
        Ok(Self { pair, gears, options, root, walk })
    }

    fn split(&mut self) -> (Fixed<'_>, &mut Walk) {
        let Self { pair, gears, options, root, walk } = self;
        (Fixed { pair, gears, options, root: root.as_ref() }, walk)
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
        &self.walk.window
    }

    /// Flanks and matrices of the window as it stands.
    pub fn contact_set(&self) -> &ContactSet {
        &self.walk.set
    }

    /// The last solved contact.
    pub fn last(&self) -> Option<&Equilibrium> {
        self.walk.last.as_ref()
    }

    /// Solves a station with the window as it stands.
    ///
    /// # Errors
    /// [`StaticError`], among them [`StaticError::Starved`] when a pair outside the window would touch.
    pub fn solve(&mut self, station: Station) -> Result<StaticPosition, StaticError> {
        let (fixed, walk) = self.split();
        walk.solve(&fixed, station)
    }

    /// Moves the window one tooth on at the station just solved, and solves it again.
    ///
    /// # Errors
    /// [`StaticError::Window`] when the outgoing tooth carries load: it is never dropped.
    pub fn change(&mut self, before: &StaticPosition, station: Station) -> Result<StaticPosition, StaticError> {
        let (fixed, walk) = self.split();
        walk.change(&fixed, before, station)
    }

    /// Solves a station, with the tooth changes that are due: as soon as another window is nearer to the middle and the
    /// outgoing tooth is free of load. `seen` gets every change.
    ///
    /// # Errors
    /// [`StaticError`].
    pub fn advance(&mut self, station: Station, seen: impl FnMut(&Change)) -> Result<StaticPosition, StaticError> {
        let (fixed, walk) = self.split();
        walk.advance(&fixed, station, seen)
    }

    /// Runs `cycles` mesh cycles of `positions` stations each from the start, wherever the model stands; `seen` is told of each result in order (for progress), the model standing
    /// where that result was found.
    ///
    /// Slices on cyclic gears are solved in groups of stations side by side on all cores (`cycle.rs`); the results are the same for any number of
    /// threads.
    ///
    /// # Errors
    /// [`StaticError`] of the first station that cannot be solved.
    pub fn run(
        &mut self,
        positions: usize,
        cycles: usize,
        mut seen: impl FnMut(usize, &StaticPosition, &Self),
    ) -> Result<StaticHistory, StaticError> {
        let stations: Vec<Station> = (0..positions * cycles)
            .map(|i| Station { cycle: (i / positions) as i64, phase: (i % positions) as f64 / positions as f64 })
            .collect();
        let start = first_window(&self.pair, &self.options)?;
        let (fixed, walk) = self.split();
        walk.begin(&fixed, start)?;
        let mut history = StaticHistory::default();
        let mut left = &stations[..];
        while !left.is_empty() {
            let (fixed, walk) = self.split();
            let (wave, rest) = left.split_at(cycle::wave(&fixed, walk).min(left.len()));
            left = rest;
            for solved in cycle::solve(&fixed, walk, wave) {
                let (position, stood) = solved?;
                self.walk.stand(stood);
                let i = history.positions.len();
                seen(i, &position, self);
                history.positions.push(position);
            }
        }
        Ok(history)
    }
}

fn first_window(pair: &GearPair, options: &StaticOptions) -> Result<ToothWindow, StaticError> {
    let count = options.window_teeth(pair);
    let start = Station { cycle: 0, phase: 0.0 };
    let teeth = [pair.pinion.teeth(), pair.wheel.teeth()];
    // Half a pitch is a tie between two windows; the first one serves the cycle that starts.
    let inward = -1e-9 * options.contact.sense.sign() as f64;
    Ok(ToothWindow::new(ToothWindow::nominal_first(start.centre(options.contact.sense) + inward, count), count, teeth)?)
}
