//! Cache of a map's positions that are needed more than once.

use crate::{CutPlace, OffsetMap};

/// The last two positions at which a map was evaluated: a step begins at one and ends at the other.
#[derive(Debug, Clone, Default)]
pub struct SplineCache {
    both: [CutPlace; 2],
    /// Index of the place that was used last.
    last: usize,
}

impl SplineCache {
    /// The map at a phase (mesh cycles) and a tilt (rad), for flanks with an approach (mm).
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

    /// The last position.
    pub fn last(&self) -> &CutPlace {
        &self.both[self.last]
    }
}
