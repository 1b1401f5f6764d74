//! Stations of a mesh cycle side by side.
//!
//! Groups of stations start afresh, each in the window that its stations ask for; so they can be solved at the same time, and what
//! comes out does not depend on how many are. Tooth changes are then brought into order: where a change had to wait for its tooth to be free,
//! so that the next group began in another window than the one before ended in, it is solved again from there.

use ale::{Station, ToothWindow};
use contact::ContactSet;
use rayon::prelude::*;

use crate::{
    Equilibrium, StaticError, StaticPosition,
    walk::{Fixed, Walk},
};

/// Stations of a group: the first one costs about twice as much as those that start from their neighbour.
const GROUP: usize = 8;
/// Stations that are solved before any is reported.
const WAVE: usize = 8 * GROUP;

/// Where a walk stood when a station was solved.
#[derive(Debug)]
pub(crate) struct Stood {
    window: ToothWindow,
    set: ContactSet,
    last: Option<Equilibrium>,
    changes: u64,
}

pub(crate) type Solved = Result<(StaticPosition, Stood), StaticError>;

impl Walk {
    /// Stands where a station was solved, so that the next one goes on from there.
    pub fn stand(&mut self, stood: Stood) {
        let Stood { window, set, last, changes } = stood;
        if self.window != window {
            if let Some(mesh) = &mut self.mesh {
                mesh.enter(set.clone());
            }
            (self.window, self.set) = (window, set);
        }
        (self.last, self.changes) = (last, changes);
    }
}

/// How many stations to solve at a time: one where each takes long or windows have matrices of their own.
pub(crate) fn wave(fixed: &Fixed<'_>, walk: &Walk) -> usize {
    let next = walk.window.first() + 1;
    let teeth = [fixed.pair.pinion.teeth(), fixed.pair.wheel.teeth()];
    let shared = ToothWindow::new(next, walk.window.count(), teeth)
        .is_ok_and(|window| walk.set.clone().move_to(fixed.gears, &window).is_ok_and(|moved| moved));
    if walk.mesh.is_some() && shared { WAVE } else { 1 }
}

/// Results of some stations in order, up to the first that cannot be solved.
pub(crate) fn solve(fixed: &Fixed<'_>, walk: &mut Walk, stations: &[Station]) -> Vec<Solved> {
    let groups: Vec<&[Station]> = stations.chunks(GROUP).collect();
    // Where each group but the first begins: in the window of the station before it.
    let starts: Option<Vec<Start>> =
        groups.windows(2).map(|w| w[0].last().and_then(|before| Start::new(fixed, walk, before))).collect();
    let Some(starts) = starts else {
        return one_by_one(fixed, walk, stations);
    };
    let (first, rest) = groups.split_first().map_or((&[][..], &[][..]), |(f, r)| (*f, r));
    let (mut all, others) = rayon::join(
        || one_by_one(fixed, walk, first),
        || {
            let fresh = |(group, start): (&&[Station], &Start)| {
                let mut walk = match Walk::new(fixed, start.window, start.set.clone()) {
                    Ok(walk) => walk,
                    Err(e) => return vec![Err(e)],
                };
                one_by_one(fixed, &mut walk, group)
            };
            rest.par_iter().zip(&starts).map(fresh).collect::<Vec<_>>()
        },
    );
    for ((group, start), mut solved) in rest.iter().zip(&starts).zip(others) {
        let (window, changes) = match all.last() {
            Some(Ok((_, stood))) => (stood.window, stood.changes),
            _ => return all,
        };
        if window == start.window {
            for (position, stood) in solved.iter_mut().flatten() {
                position.tooth_changes += changes;
                stood.changes += changes;
            }
        } else {
            walk.last = None;
            solved = one_by_one(fixed, walk, group);
        }
        // The walk goes on from here, should the next group have to be solved again.
        if let Some(Ok((_, stood))) = solved.last() {
            let (window, set, changes) = (stood.window, stood.set.clone(), stood.changes);
            walk.stand(Stood { window, set, last: None, changes });
        }
        all.extend(solved);
    }
    all
}

fn one_by_one(fixed: &Fixed<'_>, walk: &mut Walk, stations: &[Station]) -> Vec<Solved> {
    let mut all = Vec::with_capacity(stations.len());
    for &station in stations {
        let solved = walk.advance(fixed, station, |_| ()).map(|position| {
            let (window, set, last) = (walk.window, walk.set.clone(), walk.last.clone());
            (position, Stood { window, set, last, changes: walk.changes })
        });
        let failed = solved.is_err();
        all.push(solved);
        if failed {
            break;
        }
    }
    all
}

/// Where a group begins.
struct Start {
    window: ToothWindow,
    set: ContactSet,
}

impl Start {
    /// In the window that the station before asks for; `None` where its flanks or matrices are not those at hand.
    fn new(fixed: &Fixed<'_>, walk: &Walk, before: &Station) -> Option<Self> {
        let count = walk.window.count();
        let teeth = [fixed.pair.pinion.teeth(), fixed.pair.wheel.teeth()];
        let window = ToothWindow::new(
            ToothWindow::nominal_first(before.centre(fixed.options.contact.sense), count),
            count,
            teeth,
        )
        .ok()?;
        let mut set = walk.set.clone();
        set.move_to(fixed.gears, &window).ok()?.then_some(Self { window, set })
    }
}
