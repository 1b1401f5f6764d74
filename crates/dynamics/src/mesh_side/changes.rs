//! Tooth changes of one side: when the window moves, and what that leaves behind.

use ale::{Station, ToothWindow};
use contact::{Beside, ContactSet, MeshContact, Pose};
use geometry::GearPair;
use ltca::StaticError;
use serde::{Deserialize, Serialize};

use super::MeshSide;

/// Tooth changes of one side so far.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Changes {
    /// How many.
    pub count: u64,
    /// Largest difference of the sum of normal forces before and after a change at the same place, N: contact is solved anew on the new window, so a force that
    /// was dropped shows here.
    pub jump: f64,
}

/// Where the window of one side stands; all that contact remembers from step to step.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct SidePlace {
    /// First running number of the window.
    pub first: i64,
    /// Tooth changes so far.
    pub changes: Changes,
}

impl MeshSide {
    /// Where the window stands.
    pub fn place(&self) -> SidePlace {
        SidePlace { first: self.window.first(), changes: self.changes }
    }

    /// Puts the window where it stood.
    pub fn stand(&mut self, pair: &GearPair, place: SidePlace) -> Result<(), StaticError> {
        let teeth = [pair.pinion.teeth(), pair.wheel.teeth()];
        let window = ToothWindow::new(place.first, self.window.count(), teeth)?;
        self.enter(pair, window, self.home.1.clone())?;
        self.changes = place.changes;
        Ok(())
    }

    /// Goes over to a window, with the matrices of `set` where they serve it.
    fn enter(&mut self, pair: &GearPair, window: ToothWindow, mut set: ContactSet) -> Result<(), StaticError> {
        if set.move_to(&self.gears, &window)? {
            self.contact.enter(set);
        } else {
            let set = ContactSet::new(pair, &self.gears, &window, &self.options.contact)?;
            self.contact = MeshContact::new(pair, set, &self.options.contact)?;
        }
        self.window = window;
        self.enter_modes()
    }

    /// A pair beside the window whose undeformed flanks overlap, by the poses of the last evaluation.
    ///
    /// # Errors
    /// [`StaticError::Starved`].
    pub fn check_beside(&mut self, pair: &GearPair, cycles: f64, poses: &[Pose; 2]) -> Result<(), StaticError> {
        // Nothing is pressed where nothing overlaps, and a pair beside the window comes last.
        let deepest = self.contact.rows().iter().fold(0.0, |m: f64, row| m.max(-row.gap));
        if deepest == 0.0 {
            return Ok(());
        }
        let Self { options, window, ahead, contact, .. } = self;
        let set = contact.contact_set().clone();
        let station = Station::at_cycles(cycles + *ahead);
        let gap = |poses: &[Pose; 2]| {
            Beside { pair, options: &options.contact, set: &set, window, station, poses }.gap_beside()
        };
        if contact.gap_beside(poses, gap) > -1e-3 * deepest {
            return Ok(());
        }
        let standing = Beside { pair, options: &options.contact, set: &set, window, station, poses };
        match standing.overlap_beside(1e-3 * deepest) {
            None => Ok(()),
            Some((running, overlap)) => Err(StaticError::Starved {
                cycle: station.cycle,
                phase: station.phase,
                pair: running,
                window: window.count(),
                overlap_um: 1e3 * overlap,
                torque_nm: 1e-3 * options.torque,
            }),
        }
    }

    /// Refuses gears that have turned past the whole window since it moved last: it follows tooth by tooth, and what happened in between nobody has seen.
    ///
    /// # Errors
    /// [`StaticError::Leapt`].
    pub fn check_pace(&self, cycles: f64) -> Result<(), StaticError> {
        let (station, window) = (Station::at_cycles(cycles + self.ahead), self.window.count());
        let due = ToothWindow::nominal_first(station.centre(self.options.contact.sense), window);
        // Running numbers as floats: a turn that is no number is far from any of them.
        let teeth = (due as f64 - self.window.first() as f64).abs();
        if teeth <= window as f64 && cycles.is_finite() {
            return Ok(());
        }
        Err(StaticError::Leapt { cycle: station.cycle, phase: station.phase, teeth, window })
    }

    /// Moves the window by one tooth where that is due and the outgoing tooth carries nothing, by the forces of the last evaluation; `cycles` are those that
    /// the gears have turned.
    ///
    /// The rigid coordinates and velocities do not depend on the window, and elastic ones follow from them: a change leaves no trace
    /// in the motion as long as no force is dropped.
    pub fn follow(&mut self, pair: &GearPair, cycles: f64) -> Result<bool, StaticError> {
        let station = Station::at_cycles(cycles + self.ahead);
        let due = ToothWindow::nominal_first(station.centre(self.options.contact.sense), self.window.count());
        let sense = self.options.contact.sense;
        if due == self.window.first() {
            return Ok(false);
        }
        let back = (due - self.window.first()) * sense.sign() > 0;
        let going = if back { opposite(sense) } else { sense };
        let outgoing = self.window.outgoing(going);
        let forces = self.contact.force().pair_forces.clone();
        let index = usize::try_from(outgoing - self.window.first()).unwrap_or(0);
        let carried = forces.get(index).copied().unwrap_or(0.0);
        if carried != 0.0 {
            return Ok(false);
        }
        let next = self.window.change(going, &forces)?;
        self.enter(pair, next, self.contact.contact_set().clone())?;
        self.changes.count += 1;
        Ok(true)
    }

    /// Books what a change has done to the sum of normal forces, N.
    pub fn book_jump(&mut self, before: f64) {
        let after = self.contact.force().pair_forces.iter().sum::<f64>();
        self.changes.jump = self.changes.jump.max((after - before).abs());
    }
}

fn opposite(sense: geometry::Sense) -> geometry::Sense {
    match sense {
        geometry::Sense::Ccw => geometry::Sense::Cw,
        geometry::Sense::Cw => geometry::Sense::Ccw,
    }
}
