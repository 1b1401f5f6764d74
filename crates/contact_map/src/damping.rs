//! Damping between loaded flanks. Theory (74).

use crate::{
    load_axis::{along, cubic},
    map::{ContactMap, CutPlace, MapContact},
    spline::Axis,
};

/// Force of dampers along approach and tilt.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct MapDamping {
    /// Force against the rates: N, N mm.
    pub force: [f64; 2],
    /// Derivatives of the force by the rates: N s/mm, N s, N mm s.
    pub rate_slope: [[f64; 2]; 2],
    /// Derivative of the force along the approach by the approach, N/mm.
    pub approach_slope: f64,
    /// Loaded length, mm.
    pub length: f64,
}

impl ContactMap {
    /// Damping with coefficient `per_length` (N s/mm^2) at rates of approach (mm/s) and tilt (rad/s).
    pub fn damping(&self, place: &CutPlace, contact: &MapContact, rates: [f64; 2], per_length: f64) -> MapDamping {
        let Some([load, by_approach]) = contact.load else { return MapDamping::default() };
        let [[l0, l1, l2], [d0, ..]] = self.lengths(place, load);
        let force = contact.force;
        if l0 <= 0.0 || force <= 0.0 || per_length == 0.0 {
            return MapDamping { length: l0.max(0.0), ..MapDamping::default() };
        }
        // The rate where the loaded length has its middle stands for all.
        let rate = rates[0] + l1 / l0 * rates[1];
        let w = per_length * rate.abs();
        let sigma = w * l0 / (force + w * l0);
        let [e, by_sigma, by_load] = self.share(place, load, sigma);
        let damped = force * e * sigma;
        // Of w L_0, how much comes through; one where nothing is held.
        let through = if w > 0.0 { damped / (w * l0) } else { e };
        let scale = per_length * through;
        let matrix = [[l0, l1], [l1, l2]].map(|row| row.map(|l| scale * l));
        let along = [0, 1].map(|i| matrix[i][0] * rates[0] + matrix[i][1] * rates[1]);
        // d damped / dw = F (e + sigma e') dsigma/dw.
        let rest = force / (force + w * l0);
        let by_w = force * (e + sigma * by_sigma) * rest * rest * l0 / force;
        let slope = per_length * by_w;
        let of_length = slope / l0.max(f64::MIN_POSITIVE);
        let rate_slope = [[l0, l1], [l1, l2]].map(|row| row.map(|l| of_length * l));
        // Over the load: the force itself, sigma and the table.
        let axis = self.load_axis();
        let df = axis.force_slope(load);
        let sigma_by_load = (w * d0 * force - w * l0 * df) / (force + w * l0).powi(2);
        let by_place = df * e * sigma + force * (by_load * sigma + (e + sigma * by_sigma) * sigma_by_load);
        MapDamping { force: along, rate_slope, approach_slope: by_place * by_approach * rate.signum(), length: l0 }
    }

    /// L_0, L_1, L_2 and their slopes over the load's place.
    fn lengths(&self, place: &CutPlace, load: f64) -> [[f64; 3]; 2] {
        let at = load.min(self.loads as f64);
        let cell = (at as usize).min(self.loads - 1);
        let of = |k: usize| {
            let cubic = cubic(&self.in_cell(&self.damping.lengths[k], place, cell));
            along(&cubic, at - cell as f64)
        };
        // Levers only where the map has a tilt.
        let all = [of(0), if self.tilts > 0 { of(1) } else { [0.0; 2] }, if self.tilts > 0 { of(2) } else { [0.0; 2] }];
        [0, 1].map(|i| all.map(|l| l[i]))
    }

    /// e, its slope over sigma and over the load's place.
    fn share(&self, place: &CutPlace, load: f64, sigma: f64) -> [f64; 3] {
        let (loads, shares) = (self.loads + 3, self.damping.shares + 3);
        let load = self.load_axis().axis().splines_at(load.min(self.loads as f64));
        let own = Axis::Open(self.damping.shares).splines_at(sigma * self.damping.shares as f64);
        let [mut e, mut by_sigma, mut by_load] = [0.0; 3];
        for i in 0..4 {
            let first = ((place.phase.first + i) * loads + load.first) * shares + own.first;
            let rows = self.damping.share[first..].chunks(shares).filter_map(|row| row.first_chunk::<4>());
            for (k, row) in rows.take(4).enumerate() {
                let along = |weights: &[f64; 4]| {
                    (weights[0] * row[0] + weights[1] * row[1]) + (weights[2] * row[2] + weights[3] * row[3])
                };
                let (of_row, [of, slope]) =
                    (along(&own.values), [load.values[k], load.slopes[k]].map(|w| w * place.phase.values[i]));
                e += of * of_row;
                by_sigma += of * along(&own.slopes);
                by_load += slope * of_row;
            }
        }
        [e, by_sigma * self.damping.shares as f64, by_load]
    }
}
