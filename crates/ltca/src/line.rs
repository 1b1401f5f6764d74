//! The contact line of a pair of the window.

use contact::line::{line_station, nodal_contact_line, slice_line};

use crate::{Equilibrium, WindowedPair};

/// Axial intervals over which window pair `k` touches.
pub(crate) fn contact_line(windowed: &WindowedPair, e: &Equilibrium, k: usize) -> Vec<[f64; 2]> {
    let WindowedPair { pair, set, options, .. } = *windowed;
    let side = options.side();
    let (Some(first), Some(second)) = (set.patch_of(0, k, side), set.patch_of(1, k, side)) else {
        return Vec::new();
    };
    let face = pair.common_face();
    if set.slices().is_some() {
        let of_rows = e.rows.iter().zip(&e.slices).zip(e.solution.openings.iter().zip(&e.states));
        let of_pair = of_rows.filter(|((row, _), _)| row.patches == (first, second));
        let stations = of_pair.map(|((row, slice), (&o, state))| {
            (row.point, line_station(row.gap, o, state.local.approach, 0.0), slice.at[0][0])
        });
        return slice_line(set, &e.poses, (first, second), stations, face, || e.displacements_on(set));
    }
    nodal_contact_line(set, &options.contact, &e.poses, &e.displacements, (first, second), (face, e.approach(pair)))
}
