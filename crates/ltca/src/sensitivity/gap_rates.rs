//! Derivatives of the transmission error by the gap at each place of contact.

use contact::Friction;

use super::{conditions::Conditions, direction::Directions};
use crate::{Equilibrium, WindowedPair};

/// Derivatives of the transmission error (mm) by the gap (mm) of each candidate of a solved position: 0 where nothing
/// presses. `None` without load, and for points and gears with all their degrees of freedom.
///
/// What a deviation of a flank adds to the transmission error is, to first order, the sum of these times its mean over the
/// band of each slice (26a); an equal deviation of all gaps f adds f/cos beta_b.
pub(crate) fn gap_rates(windowed: &WindowedPair, e: &Equilibrium) -> Option<Vec<f64>> {
    let WindowedPair { pair, set, options, .. } = *windowed;
    if options.torque == 0.0 || set.slices().is_none() || set.windows().is_none() {
        return None;
    }
    let friction = Friction::new(pair, &options.contact);
    let at = Conditions::new(windowed, e);
    let here = set.same_slices(friction.as_ref(), &e.poses, &at.slices)?;
    let at = Conditions { slices: here, ..at };
    let rates = at.rates(windowed, e, friction.as_ref(), &[], &[])?;
    let mut work = set.table_work(set.candidate_count());
    let turns = Directions::new(windowed, &at, rates.first()?, &mut work).turns_by_gap();
    let base_radius = [pair.pinion.base_radius(), pair.wheel.base_radius()][options.driven()];
    let mut all = vec![0.0; e.rows.len()];
    for (&number, turn) in at.numbers.iter().zip(turns) {
        all[number] = options.side().sign() * base_radius * turn;
    }
    Some(all)
}
