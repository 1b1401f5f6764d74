//! Stress that is borne for a number of load cycles: straight lines in logarithms.

use serde::Serialize;

/// Bearable stress over load cycles; between two points a straight line in logarithms of both.
///
/// The first point is where static strength begins to rule, the last one where long life ends (1e10 cycles in ISO 6336). Points are in the order of cycles, and their stress does not rise.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StressLife {
    /// Load cycles and stress (MPa) of each point.
    points: Vec<[f64; 2]>,
}

impl StressLife {
    /// Through two or more points of load cycles and stress (MPa); `None` where cycles do not grow, stress rises, or a number is not positive.
    pub fn new(points: Vec<[f64; 2]>) -> Option<Self> {
        let positive = points.iter().flatten().all(|x| *x > 0.0 && x.is_finite());
        let falls = points.windows(2).all(|p| p[1][0] > p[0][0] && p[1][1] <= p[0][1]);
        (positive && falls && points.len() >= 2).then_some(Self { points })
    }

    /// Stress borne for `cycles`, MPa; before the first and behind the last point as there.
    pub fn stress_at(&self, cycles: f64) -> f64 {
        let (first, last) = (self.points[0], self.points[self.points.len() - 1]);
        if cycles <= first[0] {
            return first[1];
        }
        let segment = self.points.windows(2).find(|p| cycles <= p[1][0]);
        segment.map_or(last[1], |p| p[0][1] * (cycles / p[0][0]).powf(-inverse_slope(p)))
    }

    /// Load cycles that a stress (MPa) is borne for, the lines at both ends drawn on; infinite for no stress, and below a last line that is level.
    ///
    /// A spectrum is counted on lines without an end: above static strength the first one goes on to shorter lives, as in the example of ISO 6336-6:2019, annex C, and no stress is harmless while the last line falls.
    pub fn cycles_at(&self, stress: f64) -> f64 {
        if stress <= 0.0 {
            return f64::INFINITY;
        }
        let lines = self.points.windows(2).filter(|p| inverse_slope(p) > 0.0);
        let mut last = None;
        for p in lines {
            last = Some(p);
            if stress >= p[1][1] {
                break;
            }
        }
        // Below a level line at the end nothing is damaged.
        let level = self.points.windows(2).next_back().is_some_and(|p| inverse_slope(p) == 0.0);
        match last {
            Some(p) if !(level && stress < p[1][1]) => p[0][0] * (stress / p[0][1]).powf(-1.0 / inverse_slope(p)),
            _ => f64::INFINITY,
        }
    }

    /// Damage of `cycles` at a stress (MPa), Palmgren and Miner: `n/N`. Source: ISO 6336-6, Miner's sum.
    pub fn damage(&self, cycles: f64, stress: f64) -> f64 {
        cycles / self.cycles_at(stress)
    }
}

/// Exponent e of `stress = C N^-e` between two points.
fn inverse_slope(p: &[[f64; 2]]) -> f64 {
    (p[0][1] / p[1][1]).ln() / (p[1][0] / p[0][0]).ln()
}
