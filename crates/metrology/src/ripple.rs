//! Waves on the flanks of all teeth over the rotation of the gear.

use std::f64::consts::TAU;

use geometry::Side;
use serde::Serialize;

use crate::MetrologyError;
use crate::least_squares::fit;
use crate::measured_gear::{MeasuredGear, TraceKind};

/// One wave: A cos(O theta + phi), theta the rotation at which its flanks are in mesh.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Ripple {
    /// Order O, per turn of the gear.
    pub order: u32,
    /// Amplitude A, um.
    pub amplitude_um: f64,
    /// Phase phi, rad.
    pub phase_rad: f64,
}

/// The largest waves on one side of the teeth, one after the other: at each step the order that takes most of what is
/// left, then all found so far anew by least squares.
///
/// ```text
/// theta = u - s (2 pi k/z + z tan(beta)/r)      roll angle u, tooth k, height z, s = +1 left, -1 right
/// sum over all points of [f - sum_j (a_j cos O_j theta + b_j sin O_j theta) - own parabola of each trace]^2 = min
/// ```
/// Each trace keeps a parabola of its own, which is slope, crowning and pitch and no wave. `orders` are those that are
/// tried, `count` how many waves are looked for at the most; a step that finds less than `least_um` ends the search.
///
/// # Errors
/// [`MetrologyError::Unusable`] without profiles on that side that have a range.
pub fn ripple(
    measured: &MeasuredGear,
    side: Side,
    orders: std::ops::RangeInclusive<u32>,
    count: usize,
    least_um: f64,
) -> Result<Vec<Ripple>, MetrologyError> {
    let header = &measured.header;
    let twist = 2.0 * header.helix_angle.tan() / header.reference_diameter();
    let base = 0.5 * header.base_diameter();
    // Rotation and value of each point, trace by trace, and the shapes that are no wave.
    let mut traces: Vec<Flattened> = Vec::new();
    for trace in measured.traces.iter().filter(|t| t.side == side) {
        let TraceKind::Profile(z) = trace.kind else { continue };
        let Some(points) = trace.points(header).filter(|p| p.len() > 4) else { continue };
        let turn = side.sign() * (f64::from(trace.tooth) * header.pitch_angle() + twist * z);
        traces.push(Flattened::new(points.iter().map(|[x, f]| [x / base - turn, *f]).collect()));
    }
    if traces.is_empty() {
        return Err(MetrologyError::Unusable { what: "there are no profiles with a measuring range on that side" });
    }
    let values: Vec<f64> = traces.iter().flat_map(|t| t.without(t.points.iter().map(|p| p[1]).collect())).collect();
    let shape = |order: u32, wave: fn(f64) -> f64| -> Vec<f64> {
        let of = |t: &Flattened| t.without(t.points.iter().map(|p| wave(f64::from(order) * p[0])).collect());
        traces.iter().flat_map(of).collect()
    };
    let mut found: Vec<u32> = Vec::new();
    let mut columns: Vec<Vec<f64>> = Vec::new();
    let mut coefficients: Vec<f64> = Vec::new();
    let all: Vec<(u32, [Vec<f64>; 2])> = orders.map(|o| (o, [shape(o, f64::cos), shape(o, f64::sin)])).collect();
    while found.len() < count {
        let mut left = values.clone();
        for (column, c) in columns.iter().zip(&coefficients) {
            left.iter_mut().zip(column).for_each(|(l, x)| *l -= c * x);
        }
        let taken = |(order, both): &(u32, [Vec<f64>; 2])| {
            if found.contains(order) {
                return None;
            }
            let [a, b] = fit(both, &left)?.try_into().ok()?;
            let gone = both[0].iter().zip(&both[1]).map(|(c, s)| (a * c + b * s).powi(2)).sum::<f64>();
            (f64::hypot(a, b) >= least_um).then_some((gone, *order))
        };
        let best = all.iter().filter_map(taken).max_by(|a, b| a.0.total_cmp(&b.0));
        let Some((_, order)) = best else { break };
        let Some((_, both)) = all.iter().find(|own| own.0 == order) else { break };
        columns.extend(both.iter().cloned());
        let Some(next) = fit(&columns, &values) else {
            columns.truncate(columns.len() - 2);
            break;
        };
        found.push(order);
        coefficients = next;
    }
    let wave = |(i, &order): (usize, &u32)| {
        let [a, b] = [coefficients[2 * i], coefficients[2 * i + 1]];
        Ripple { order, amplitude_um: a.hypot(b), phase_rad: (-b).atan2(a).rem_euclid(TAU) }
    };
    let mut all: Vec<Ripple> = found.iter().enumerate().map(wave).collect();
    all.sort_by(|a, b| b.amplitude_um.total_cmp(&a.amplitude_um));
    Ok(all)
}

/// A trace over the rotation, with the parabolas of its range made orthonormal.
struct Flattened {
    points: Vec<[f64; 2]>,
    shapes: Vec<Vec<f64>>,
}

impl Flattened {
    fn new(points: Vec<[f64; 2]>) -> Self {
        let (from, to) = (points[0][0], points[points.len() - 1][0]);
        let mut shapes: Vec<Vec<f64>> = Vec::new();
        for k in 0..3 {
            let mut own: Vec<f64> = points.iter().map(|[x, _]| ((2.0 * x - from - to) / (to - from)).powi(k)).collect();
            for shape in &shapes {
                take(&mut own, shape);
            }
            let norm = own.iter().map(|x| x * x).sum::<f64>().sqrt();
            own.iter_mut().for_each(|x| *x /= norm);
            shapes.push(own);
        }
        Self { points, shapes }
    }

    /// Values without their parabola.
    fn without(&self, mut values: Vec<f64>) -> Vec<f64> {
        self.shapes.iter().for_each(|shape| take(&mut values, shape));
        values
    }
}

fn take(values: &mut [f64], shape: &[f64]) {
    let part: f64 = values.iter().zip(shape).map(|(v, s)| v * s).sum();
    values.iter_mut().zip(shape).for_each(|(v, s)| *v -= part * s);
}
