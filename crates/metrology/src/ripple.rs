//! Waves on the flanks of all teeth over the rotation of the gear.

use std::collections::BTreeSet;
use std::f64::consts::TAU;
use std::ops::RangeInclusive;

use geometry::Side;
use nalgebra::Complex;
use serde::Serialize;

use crate::MetrologyError;
use crate::least_squares::fit;
use crate::measured_gear::{MeasuredGear, TraceKind};

/// Cosine and sine of an order that are this near to one another cannot be told apart on the traces.
const SINGULAR: f64 = 1e-12;
/// Least share of the square of a wave that is no parabola on the traces.
const LEAST_SEEN: f64 = 1e-3;
/// Points in the period of the shortest wave.
const POINTS: f64 = 4.0;

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
/// tried, each `step`-th of them, up to four points a period: the number of teeth where all teeth are alike, else 1. `count`: how
/// many waves are looked for at the most; a step that finds less than `least_um` ends the search. Waves that differ by the
/// number of teeth are alike on one tooth, so that all teeth are needed.
///
/// # Errors
/// [`MetrologyError::Unusable`] without profiles on that side of all teeth that have a range.
pub fn ripple(
    measured: &MeasuredGear,
    side: Side,
    (orders, step): (RangeInclusive<u32>, u32),
    count: usize,
    least_um: f64,
) -> Result<Vec<Ripple>, MetrologyError> {
    let header = &measured.header;
    let twist = 2.0 * header.helix_angle.tan() / header.reference_diameter();
    let base = 0.5 * header.base_diameter();
    // Rotation and value of each point, trace by trace, and the shapes that are no wave.
    let mut traces: Vec<Flattened> = Vec::new();
    let mut teeth = BTreeSet::new();
    for trace in measured.traces.iter().filter(|t| t.side == side) {
        let TraceKind::Profile(z) = trace.kind else { continue };
        let Some(points) = trace.points(header).filter(|p| p.len() > 4) else { continue };
        let turn = side.sign() * (f64::from(trace.tooth) * header.pitch_angle() + twist * z);
        teeth.insert(trace.tooth);
        traces.push(Flattened::new(points.iter().map(|[x, f]| [x / base - turn, *f]).collect()));
    }
    if teeth.len() != header.teeth as usize {
        return Err(MetrologyError::Unusable { what: "waves need profiles with a measuring range of all teeth" });
    }
    let values: Vec<f64> = traces.iter().flat_map(|t| t.without(t.points.iter().map(|p| p[1]).collect())).collect();
    let shape = |order: u32, wave: fn(f64) -> f64| -> Vec<f64> {
        let of = |t: &Flattened| t.without(t.points.iter().map(|p| wave(f64::from(order) * p[0])).collect());
        traces.iter().flat_map(of).collect()
    };
    let points = values.len() as f64;
    // No more than one period in four points.
    let finest = traces.iter().map(Flattened::per_period).fold(f64::INFINITY, f64::min);
    let orders = (*orders.start()..=(*orders.end()).min(finest as u32)).step_by(step.max(1) as usize);
    let orders: Vec<u32> = orders.collect();
    let norms = norms(&traces, &orders);
    let mut found: Vec<u32> = Vec::new();
    let mut columns: Vec<Vec<f64>> = Vec::new();
    let mut coefficients: Vec<f64> = Vec::new();
    while found.len() < count {
        let mut left = values.clone();
        for (column, c) in columns.iter().zip(&coefficients) {
            left.iter_mut().zip(column).for_each(|(l, x)| *l -= c * x);
        }
        let products = products(traces.iter().flat_map(|t| &t.points).map(|p| p[0]).zip(left), &orders);
        let taken = |((order, &[cc, cs, ss]), &[c, s]): ((u32, &[f64; 3]), &[f64; 2])| {
            let det = cc * ss - cs * cs;
            // Hardly anything of a wave much longer than a trace is left beside its parabola.
            let seen = cc + ss >= LEAST_SEEN * points;
            if found.contains(&order) || !seen || det.is_nan() || det <= SINGULAR * cc * ss {
                return None;
            }
            let [a, b] = [(ss * c - cs * s) / det, (cc * s - cs * c) / det];
            (f64::hypot(a, b) >= least_um).then_some((a * c + b * s, order))
        };
        let all = orders.iter().copied().zip(&norms).zip(&products);
        let Some((_, order)) = all.filter_map(taken).max_by(|a, b| a.0.total_cmp(&b.0)) else { break };
        columns.extend([shape(order, f64::cos), shape(order, f64::sin)]);
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

/// Sums of value times cosine and value times sine of each order over points (rotation, value); orders are evenly spaced.
fn products(points: impl Iterator<Item = (f64, f64)>, orders: &[u32]) -> Vec<[f64; 2]> {
    let mut sums = vec![[0.0; 2]; orders.len()];
    for (theta, value) in points {
        let (mut wave, step) = turned(theta, orders);
        for sum in &mut sums {
            sum[0] += value * wave.re;
            sum[1] += value * wave.im;
            wave *= step;
        }
    }
    sums
}

/// Sums of cosine times cosine, cosine times sine and sine times sine of each order, without the parabolas of the traces.
fn norms(traces: &[Flattened], orders: &[u32]) -> Vec<[f64; 3]> {
    let mut sums = vec![[0.0; 3]; orders.len()];
    for trace in traces {
        for [theta, _] in &trace.points {
            let (mut wave, step) = turned(*theta, orders);
            for sum in &mut sums {
                let (c, s) = (wave.re, wave.im);
                sum.iter_mut().zip([c * c, c * s, s * s]).for_each(|(sum, own)| *sum += own);
                wave *= step;
            }
        }
        for shape in &trace.shapes {
            let along = products(trace.points.iter().map(|p| p[0]).zip(shape.iter().copied()), orders);
            for (sum, [c, s]) in sums.iter_mut().zip(along) {
                sum.iter_mut().zip([c * c, c * s, s * s]).for_each(|(sum, own)| *sum -= own);
            }
        }
    }
    sums
}

/// The wave of the first order at a rotation, and what leads from one order to the next.
fn turned(theta: f64, orders: &[u32]) -> (Complex<f64>, Complex<f64>) {
    let first = orders.first().map_or(0.0, |own| f64::from(*own));
    let step = orders.get(1).map_or(0.0, |own| f64::from(*own)) - first;
    (Complex::cis(first * theta), Complex::cis(step * theta))
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

    /// Order of the wave with four points a period.
    fn per_period(&self) -> f64 {
        let (first, last) = (self.points[0][0], self.points[self.points.len() - 1][0]);
        TAU * (self.points.len() - 1) as f64 / (POINTS * (last - first).abs())
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
