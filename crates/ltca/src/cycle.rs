//! Solves the stations of a mesh cycle in parallel.
//!
//! Stations are solved in groups, in parallel. Each group starts without history, in the window that its stations need,
//! so results do not depend on the number of threads. Afterwards the tooth changes are reconciled. A change is
//! postponed while its tooth carries load, so a group may have ended in another window than the one in which the next
//! group began. That next group is then solved again from there.

use std::sync::Arc;

use ale::{SlidingWindow, Station, ToothWindow};
use contact::ContactSet;
use rayon::prelude::*;

use crate::{
    Equilibrium, StaticError, StaticPosition, ToothChangeRecord,
    cycle_solver::{CycleInputs, CycleSolver},
};

/// Stations of a group. The first station costs about twice as much as those that start from their neighbour.
const GROUP: usize = 8;
/// Stations that are solved before any is reported.
const WAVE: usize = 8 * GROUP;

/// State of the solver after a station.
#[derive(Debug)]
pub(crate) struct SolverState {
    window: SlidingWindow,
    set: ContactSet,
    last: Option<Arc<Equilibrium>>,
    changes: u64,
    /// Tooth changes made at the station.
    pub made: Vec<ToothChangeRecord>,
}

pub(crate) type Solved = Result<(StaticPosition, SolverState), StaticError>;

impl CycleSolver {
    /// Restores the state after a station, so that the next station continues from there.
    pub fn resume(&mut self, inputs: &CycleInputs<'_>, state: SolverState) -> Result<(), StaticError> {
        let SolverState { window, set, last, changes, .. } = state;
        if self.window != window {
            self.contact.enter(inputs.pair, inputs.gears, window.window(), set, &inputs.options.contact)?;
            self.window = window;
        }
        (self.last, self.changes) = (last, changes);
        Ok(())
    }
}

/// Number of stations to solve at a time: one where each takes long, or where windows have matrices of their own.
pub(crate) fn wave(inputs: &CycleInputs<'_>, solver: &CycleSolver) -> usize {
    let window = solver.window.window();
    let teeth = [inputs.pair.pinion.teeth(), inputs.pair.wheel.teeth()];
    let shared = ToothWindow::new(window.first() + 1, window.count(), teeth)
        .is_ok_and(|next| in_window(inputs, solver, &next).is_some());
    if solver.contact.slices.is_some() && shared { WAVE } else { 1 }
}

/// Results of some stations in order, up to the first that cannot be solved.
pub(crate) fn solve(inputs: &CycleInputs<'_>, solver: &mut CycleSolver, stations: &[Station]) -> Vec<Solved> {
    let groups: Vec<&[Station]> = stations.chunks(GROUP).collect();
    // Where each group but the first begins: in the window of the station before it.
    let starts: Option<Vec<GroupStart>> =
        groups.windows(2).map(|w| w[0].last().and_then(|before| GroupStart::new(inputs, solver, before))).collect();
    let Some(starts) = starts else {
        return solve_in_order(inputs, solver, stations);
    };
    let (first, rest) = groups.split_first().map_or((&[][..], &[][..]), |(f, r)| (*f, r));
    let (mut all, others) = rayon::join(
        || solve_in_order(inputs, solver, first),
        || {
            let fresh = |(group, start): (&&[Station], &GroupStart)| {
                let mut solver = match CycleSolver::new(inputs, start.window, start.set.clone()) {
                    Ok(solver) => solver,
                    Err(e) => return vec![Err(e)],
                };
                solve_in_order(inputs, &mut solver, group)
            };
            rest.par_iter().zip(&starts).map(fresh).collect::<Vec<_>>()
        },
    );
    for ((group, start), mut solved) in rest.iter().zip(&starts).zip(others) {
        let (window, changes) = match all.last() {
            Some(Ok((_, state))) => (state.window, state.changes),
            _ => return all,
        };
        if window == start.window {
            for (position, state) in solved.iter_mut().flatten() {
                position.tooth_changes += changes;
                state.changes += changes;
            }
        } else {
            solver.last = None;
            solved = solve_in_order(inputs, solver, group);
        }
        // The next group may have to be solved again: the solver goes on from here.
        if let Some(Ok((_, state))) = solved.last() {
            let (window, set, changes) = (state.window, state.set.clone(), state.changes);
            if let Err(error) =
                solver.resume(inputs, SolverState { window, set, last: None, changes, made: Vec::new() })
            {
                all.extend(solved);
                all.push(Err(error));
                return all;
            }
        }
        all.extend(solved);
    }
    all
}

fn solve_in_order(inputs: &CycleInputs<'_>, solver: &mut CycleSolver, stations: &[Station]) -> Vec<Solved> {
    let mut all = Vec::with_capacity(stations.len());
    for &station in stations {
        let mut made = Vec::new();
        let solved = solver.advance(inputs, station, |change| made.push(change.record(station))).map(|position| {
            let (window, set, last) = (solver.window, solver.contact.set.clone(), solver.last.clone());
            (position, SolverState { window, set, last, changes: solver.changes, made })
        });
        let failed = solved.is_err();
        all.push(solved);
        if failed {
            break;
        }
    }
    all
}

/// Window and matrices at the start of a group.
struct GroupStart {
    window: SlidingWindow,
    set: ContactSet,
}

impl GroupStart {
    /// Cycle in the window that the station before asks for; `None` where its flanks or matrices are not those at hand.
    fn new(inputs: &CycleInputs<'_>, solver: &CycleSolver, before: &Station) -> Option<Self> {
        let count = solver.window.window().count();
        let teeth = [inputs.pair.pinion.teeth(), inputs.pair.wheel.teeth()];
        let window = SlidingWindow::at(*before, count, teeth, inputs.options.contact.sense).ok()?;
        let set = in_window(inputs, solver, window.window())?;
        Some(Self { window, set })
    }
}

/// Flanks and matrices of another window, where the matrices are those at hand.
fn in_window(inputs: &CycleInputs<'_>, solver: &CycleSolver, window: &ToothWindow) -> Option<ContactSet> {
    solver.contact.set.in_window(inputs.pair, inputs.gears, window, &inputs.options.contact).ok()?
}
