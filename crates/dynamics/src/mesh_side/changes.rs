//! Tooth changes of one side: the motion of its window, and its consequences.

use ale::{SlidingWindow, Station, ToothWindow};
use contact::{ContactSet, Pose, line::NeighbourPairs};
use geometry::GearPair;
use ltca::{StaticError, StaticOptions};
use serde::{Deserialize, Serialize};

use super::MeshSide;

/// Round-off of mesh cycles: a change that is due where a step ends is taken there, whatever the last digits say.
const LAST_DIGITS: f64 = 1e-9;

/// Tooth changes of one side so far.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct ToothChanges {
    /// Number of tooth changes.
    pub count: u64,
    /// Largest jump of the sum of normal forces across a change at the same position, N. The contact is solved again in
    /// the new window, so a force that was dropped appears here.
    pub jump: f64,
}

/// Window of one side, and its tooth changes so far.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct SideState {
    /// First running number of the window.
    pub first: i64,
    /// Tooth changes so far.
    pub changes: ToothChanges,
}

impl MeshSide {
    /// The window and its tooth changes, to be restored later.
    pub fn state(&self) -> SideState {
        SideState { first: self.window.window().first(), changes: self.changes }
    }

    /// Restores the window.
    pub fn restore(&mut self, pair: &GearPair, state: SideState) -> Result<(), StaticError> {
        let teeth = [pair.pinion.teeth(), pair.wheel.teeth()];
        let window = ToothWindow::new(state.first, self.window.window().count(), teeth)?;
        self.enter(pair, self.window.with_window(window), self.home.1.clone())?;
        self.changes = state.changes;
        Ok(())
    }

    /// Enters a window, with the matrices of `set` where they serve it.
    fn enter(&mut self, pair: &GearPair, window: SlidingWindow, set: ContactSet) -> Result<(), StaticError> {
        self.contact.enter_window(pair, &self.gears, window.window(), set, &self.options.contact)?;
        self.window = window;
        Ok(())
    }

    /// Returns an error if a neighbouring pair outside the window overlaps at the poses of the last evaluation.
    ///
    /// # Errors
    /// [`ale::AleError::Starved`] if such a pair is found.
    pub fn check_neighbours(&mut self, pair: &GearPair, cycles: f64, poses: &[Pose; 2]) -> Result<(), StaticError> {
        // Without overlap nothing is loaded, and a neighbouring pair outside the window comes into contact last.
        let deepest = self.contact.rows().iter().fold(0.0, |m: f64, row| m.max(-row.gap));
        if deepest == 0.0 {
            return Ok(());
        }
        let Self { options: StaticOptions { contact: options, torque, .. }, window: sliding, ahead, contact, .. } =
            self;
        let (set, window) = (contact.contact_set().clone(), sliding.window());
        let station = Station::at_cycles(cycles + *ahead);
        let gap = |poses: &[Pose; 2]| NeighbourPairs { pair, options, set: &set, window, station, poses }.least_gap();
        if contact.gap_of_neighbours(poses, gap) > -1e-3 * deepest {
            return Ok(());
        }
        let neighbours = NeighbourPairs { pair, options, set: &set, window, station, poses };
        Ok(sliding.check_neighbours(station, *torque, 1e-3 * deepest, |running| neighbours.gap(running))?)
    }

    /// Returns an error if the gears have rotated past the whole window since it last moved.
    ///
    /// # Errors
    /// [`ale::AleError::Leapt`] if the gears have rotated too far.
    pub fn check_pace(&self, cycles: f64) -> Result<(), StaticError> {
        Ok(self.window.check_pace(cycles + self.ahead)?)
    }

    /// Moves the window by one tooth if that is due and the outgoing tooth is unloaded according to the last
    /// evaluation. `cycles` are the mesh cycles that the gears have rotated.
    ///
    /// The rigid coordinates and velocities do not depend on the window, and elastic ones follow from them. So a change
    /// does not affect the motion as long as no force is dropped.
    pub fn follow(&mut self, pair: &GearPair, cycles: f64) -> Result<bool, StaticError> {
        let station = Station::at_cycles(cycles + self.ahead + LAST_DIGITS);
        let Some(next) = self.window.due_change(station, &self.contact.force().pair_forces)? else { return Ok(false) };
        self.enter(pair, next, self.contact.contact_set().clone())?;
        self.changes.count += 1;
        Ok(true)
    }

    /// Records the jump of the sum of normal forces across a change, N.
    pub fn record_jump(&mut self, before: f64) {
        let after = self.contact.force().pair_forces.iter().sum::<f64>();
        self.changes.jump = self.changes.jump.max((after - before).abs());
    }
}
