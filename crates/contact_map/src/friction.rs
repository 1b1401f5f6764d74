//! Friction between flanks in contact. Theory (74b).

use crate::{
    ContactMap, CutPlace, LoadedSlice, MapContact, OffsetMap,
    column::rubbing,
    friction_table::FrictionTable,
    pair_shares::{PairPlace, PartsWanted},
};

/// Friction at one state.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct MapFriction {
    /// Force on gear 1 along the sliding direction (N), its moments along the path of contact and over the face (N mm),
    /// and the part of the normal forces' moment along the tilt that is not in -dV/d tilt (N mm).
    pub force: [f64; 4],
    /// Their derivatives by approach and tilt.
    pub slopes: [[f64; 2]; 4],
}

const PARTS: PartsWanted = PartsWanted { phase: false, tilt: true };

impl ContactMap {
    /// Whether the flanks have friction.
    pub fn has_friction(&self) -> bool {
        self.friction.is_some()
    }

    /// Adds what a pair under a load does.
    fn add_rubbing(
        &self,
        table: &FrictionTable,
        place: &CutPlace,
        (own, load): (&PairPlace, f64),
        all: &mut MapFriction,
    ) {
        let axis = self.load_axis();
        let [f, df] = [axis.force(load), axis.force_slope(load)];
        let slope = place.curve.value(load)[1];
        let per_tilt = self.per_tilt();
        let by_tilt = place.by_tilt.as_ref().map(|both| both[0].value(load)[0]);
        for (k, column) in table.columns.iter().enumerate() {
            let ([t, _, t1, _], dt) = self.held_of(column, (own, &place.tilt), load, PARTS);
            let grows = dt * f + t * df;
            all.force[k] += t * f;
            all.slopes[k][0] += grows / slope;
            if let Some(x1) = by_tilt {
                all.slopes[k][1] += per_tilt * (t1 * f - grows * x1 / slope);
            }
        }
    }

    /// How far what the map has at a place over load is off that of slices: the largest of its parts, each over its length.
    pub(crate) fn friction_error(
        &self,
        (phase, tilt, load): (f64, f64, f64),
        slices: &[LoadedSlice],
        lengths: [f64; 4],
    ) -> f64 {
        let Some(table) = &self.friction else { return 0.0 };
        let mut pairs = Vec::new();
        self.pairs.places(self.phases, phase, &mut pairs);
        let (place, mut found) = (self.place(phase, tilt), MapFriction::default());
        pairs.iter().for_each(|own| self.add_rubbing(table, &place, (own, load), &mut found));
        let sums = slices.iter().map(rubbing).fold([0.0; 4], |sum, own| [0, 1, 2, 3].map(|k| sum[k] + own[k]));
        // Without a tilt nobody asks for what goes along it.
        let counted = if self.tilts > 0 { 4 } else { 3 };
        (0..counted).map(|k| ((found.force[k] - sums[k]) / lengths[k]).abs()).fold(0.0, f64::max)
    }
}

impl OffsetMap {
    /// Friction at a position of this map and an approach (mm) with its contact; zero if the flanks are apart or have
    /// no friction.
    pub fn friction(&self, place: &CutPlace, approach: f64, contact: &MapContact) -> MapFriction {
        let (map, mut all) = (self.map(), MapFriction::default());
        let Some(table) = map.friction.as_ref().filter(|_| contact.force > 0.0) else { return all };
        if self.offsets().is_some() {
            for (own, e) in self.pairs(place) {
                if let Some(load) = map.load(place, approach + e) {
                    map.add_rubbing(table, place, (own, load), &mut all);
                }
            }
        } else if let Some([load, _]) = contact.load {
            place.pairs.iter().for_each(|own| map.add_rubbing(table, place, (own, load), &mut all));
        }
        // Where gaps close by approach + lever tilt, normal forces have minus their moment along the tilt.
        all.force[3] = -all.force[3] - contact.moment;
        all.slopes[3] = [0, 1].map(|i| contact.stiffness[1][i] - all.slopes[3][i]);
        all
    }
}
