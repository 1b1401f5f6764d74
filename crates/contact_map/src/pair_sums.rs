//! Integrals over the load of tooth pairs with different approaches. Theory (74a).

use crate::{
    ContactMap, CutPlace,
    load_axis::LoadCurve,
    pair_shares::{CellParts, PairPlace, PairShares, PartsWanted},
    spline::{Splines, splines},
};

/// Sums over the pairs that touch, in units of the spacings of phase and tilt.
///
/// ```text
/// energy = sum of integrals of g X' dnu,   phase_rate: of (g_c X' - g' X_c) dnu,   moment: of (g' X_gamma - g_gamma X') dnu,   g = s F
/// ```
/// nu: place on the load's axis, from 0 to that of the pair; ' its derivative; X(nu): approach; tilting: derivative of the
/// moment's integrand over the tilt.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct PairSums {
    pub energy: f64,
    pub phase_rate: f64,
    pub moment: f64,
    pub tilting: f64,
}

/// Gauss' points and weights between -1 and 1, exact to the seventh power, as products of force, approach and part are.
const GAUSS: [[f64; 2]; 4] = [
    [-0.861_136_311_594_052_6, 0.347_854_845_137_453_8],
    [-0.339_981_043_584_856_3, 0.652_145_154_862_546_1],
    [0.339_981_043_584_856_3, 0.652_145_154_862_546_1],
    [0.861_136_311_594_052_6, 0.347_854_845_137_453_8],
];

impl PairSums {
    /// Sums over the pairs in contact, each with its position on the load axis. `by_phase` is the derivative of the
    /// approach by the phase, if the phase rate is requested; `parted` tells whether another pair of this position is
    /// not in contact.
    pub fn new(
        map: &ContactMap,
        place: &CutPlace,
        by_phase: Option<&LoadCurve>,
        (touching, parted): (&[(&PairPlace, f64)], bool),
    ) -> Self {
        let mut sums = Self::default();
        let whole = |load: f64| (load as usize).min(map.loads);
        let [least, most] =
            touching.iter().fold([map.loads, 0], |[a, b], (_, load)| [a.min(whole(*load)), b.max(whole(*load))]);
        // Up to where all pairs press they are the map.
        let together = if parted || touching.is_empty() { 0 } else { least };
        if together > 0 {
            let end = together as f64;
            let [approach, _] = place.curve.value(end);
            sums.energy = map.load_axis().force(end) * approach - place.curve.integral(end);
            sums.phase_rate = by_phase.map_or(0.0, |curve| -curve.integral(end));
            if let Some(by_tilt) = &place.by_tilt {
                [sums.moment, sums.tilting] = [0, 1].map(|i| by_tilt[i].integral(end));
            }
        }
        let wanted = PartsWanted { phase: by_phase.is_some(), tilt: true };
        for cell in together..=most {
            let mut several = CellParts::default();
            let mut any = false;
            for (own, load) in touching.iter().filter(|(_, load)| *load > cell as f64) {
                let part = load - cell as f64;
                // The last interval of the map is followed by what is beyond its largest force.
                let parts = map.parts(own, &place.tilt, cell.min(map.loads - 1), wanted);
                if cell == map.loads {
                    sums.add_beyond(map, place, by_phase, (&parts, *load));
                } else if part < 1.0 {
                    sums.add(map, place, by_phase, (&parts, cell, part));
                } else {
                    any = true;
                    several.iter_mut().flatten().zip(parts.iter().flatten()).for_each(|(sum, k)| *sum += k);
                }
            }
            if any {
                sums.add(map, place, by_phase, (&several, cell, 1.0));
            }
        }
        sums
    }

    /// Adds what pairs do from the beginning of an interval to a part of it.
    fn add(
        &mut self,
        map: &ContactMap,
        place: &CutPlace,
        by_phase: Option<&LoadCurve>,
        (parts, cell, to): (&CellParts, usize, f64),
    ) {
        let axis = map.load_axis();
        let curve = place.curve.in_cell(cell);
        let along = by_phase.map(|curve| curve.in_cell(cell));
        let by_tilt = place.by_tilt.as_ref().map(|both| [both[0].in_cell(cell), both[1].in_cell(cell)]);
        for [point, weight] in GAUSS {
            let part = 0.5 * to * (1.0 + point);
            let (w, nu) = (0.5 * to * weight, cell as f64 + part);
            let Splines { values, slopes, .. } = splines(part);
            let [f, df] = [axis.force(nu), axis.force_slope(nu)];
            let [s, ds] = [dot(&parts[0], &values), dot(&parts[0], &slopes)];
            let (dx, dg) = (dot(&curve, &slopes), ds * f + s * df);
            self.energy += w * s * f * dx;
            if let Some(along) = &along {
                self.phase_rate += w * (dot(&parts[1], &values) * f * dx - dg * dot(along, &values));
            }
            if let Some([first, second]) = &by_tilt {
                let ([x1, dx1], x2) = ([dot(first, &values), dot(first, &slopes)], dot(second, &values));
                let ([s1, ds1], s2) = ([dot(&parts[2], &values), dot(&parts[2], &slopes)], dot(&parts[3], &values));
                self.moment += w * (dg * x1 - s1 * f * dx);
                self.tilting += w * ((ds1 * f + s1 * df) * x1 + dg * x2 - s2 * f * dx - s1 * f * dx1);
            }
        }
    }

    /// Adds what a pair does beyond the largest force of the map, where its part stays.
    fn add_beyond(
        &mut self,
        map: &ContactMap,
        place: &CutPlace,
        by_phase: Option<&LoadCurve>,
        (parts, load): (&CellParts, f64),
    ) {
        let (axis, begin) = (map.load_axis(), map.loads as f64);
        let [s, by_c, s1, s2] = parts.map(|own| at_end(&own));
        for [point, weight] in GAUSS {
            let half = 0.5 * (load - begin);
            let (w, nu) = (half * weight, begin + half * (1.0 + point));
            let [f, df] = [axis.force(nu), axis.force_slope(nu)];
            let dx = place.curve.value(nu)[1];
            self.energy += w * s * f * dx;
            if let Some(along) = by_phase {
                self.phase_rate += w * (by_c * f * dx - s * df * along.value(nu)[0]);
            }
            if let Some(by_tilt) = &place.by_tilt {
                let ([x1, dx1], [x2, _]) = (by_tilt[0].value(nu), by_tilt[1].value(nu));
                self.moment += w * (s * df * x1 - s1 * f * dx);
                self.tilting += w * (s1 * df * x1 + s * df * x2 - s2 * f * dx - s1 * f * dx1);
            }
        }
    }
}

/// Value of a spline at the end of an interval.
fn at_end(k: &[f64; 4]) -> f64 {
    (k[1] + 4.0 * k[2] + k[3]) / 6.0
}

impl ContactMap {
    /// Parts of a pair in an interval of the load's axis, with the splines over the tilt.
    fn parts(&self, own: &PairPlace, tilt: &Splines, cell: usize, wanted: PartsWanted) -> CellParts {
        self.pairs.parts(own, (tilt, cell), [self.tilt_axis().coefficients(), self.loads + 3], wanted)
    }

    /// Parts of a pair under a load, and the slope of its part over that; beyond the largest force of the map the parts
    /// stay. In the order of [`CellParts`].
    pub(crate) fn held(&self, own: &PairPlace, tilt: &Splines, load: f64, wanted: PartsWanted) -> ([f64; 4], f64) {
        self.held_of(&self.pairs, (own, tilt), load, wanted)
    }

    /// The same of another table of what pairs have.
    pub(crate) fn held_of(
        &self,
        table: &PairShares,
        (own, tilt): (&PairPlace, &Splines),
        load: f64,
        wanted: PartsWanted,
    ) -> ([f64; 4], f64) {
        let cell = (load as usize).min(self.loads - 1);
        let parts = table.parts(own, (tilt, cell), [self.tilt_axis().coefficients(), self.loads + 3], wanted);
        if load > self.loads as f64 {
            return (parts.map(|own| at_end(&own)), 0.0);
        }
        let Splines { values, slopes, .. } = splines(load - cell as f64);
        (parts.map(|own| dot(&own, &values)), dot(&parts[0], &slopes))
    }
}

#[inline]
fn dot(a: &[f64; 4], b: &[f64; 4]) -> f64 {
    (a[0] * b[0] + a[1] * b[1]) + (a[2] * b[2] + a[3] * b[3])
}
