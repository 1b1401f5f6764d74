//! Places of a map that are asked for more than once.

use crate::{CutPlace, OffsetMap};

/// The last two places at which a map was asked: a step begins at one and ends at the other.
#[derive(Debug, Clone, Default)]
pub struct SplineCache {
    both: [CutPlace; 2],
    /// Index of the place that was used last.
    last: usize,
}

impl SplineCache {
    /// The place at a phase (mesh cycles) and a tilt (rad), for the flanks at an approach (mm).
    pub fn at(&mut self, map: &OffsetMap, phase: f64, [approach, tilt]: [f64; 2]) -> &CutPlace {
        let wanted = [phase, if map.map().tilts().is_some() { tilt } else { 0.0 }];
        if self.both[self.last].at != wanted {
            self.last = 1 - self.last;
            let place = &mut self.both[self.last];
            if place.at != wanted {
                map.move_place(place, wanted);
            }
        }
        map.make_curves(&mut self.both[self.last], approach);
        &self.both[self.last]
    }

    /// The place that was asked for last.
    pub fn last(&self) -> &CutPlace {
        &self.both[self.last]
    }
}
