//! Possible error of a curve's characteristic value between the solved positions, estimated from these positions.
//!
//! A curve over a mesh cycle is periodic. Between its positions it is taken as a parabola where it is smooth. At a kink
//! it stays below the straight lines that extend it from both sides. Theory (64a).

use crate::mesh_harmonics;

/// Estimate, from the positions of a curve, of the part of a value that they may miss, in the unit of the value.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Between {
    /// Increase of an extreme by parabolas through three positions; 0 for means and harmonics.
    pub shift: f64,
    /// Magnitudes to which the error is proportional. For an extreme: its increase by parabolas and by straight lines
    /// from both sides, with a share of the distance to the nearer neighbour, and the same for the farther neighbour.
    /// For a mean: the harmonics that are barely resolved, and the highest of them. For a harmonic: the harmonic
    /// itself, and the barely resolved ones.
    pub seen: [f64; 2],
}

/// Share of the distance from an extreme to its nearer neighbour that counts as missed at least; that of a plateau is none.
const NEAR: f64 = 0.05;

impl Between {
    /// Estimate for the largest value of a curve; `None` for fewer than four positions.
    pub fn largest(curve: &[f64]) -> Option<Self> {
        let peak = Peak::of(curve)?;
        let [near, far] = peak.beside;
        Some(Self { shift: peak.parabola, seen: [peak.parabola + peak.lines + NEAR * near, far] })
    }

    /// Estimate for the peak to peak of each cycle of a curve, averaged over the cycles; `None` for fewer than four
    /// positions.
    pub fn peak_to_peak(curve: &[f64], cycles: usize) -> Option<Self> {
        let mut sum = Self::default();
        let per_cycle = curve.len() / cycles.max(1);
        for cycle in curve.chunks_exact(per_cycle.max(1)) {
            let upside_down: Vec<f64> = cycle.iter().map(|y| -y).collect();
            let [high, low] = [Self::largest(cycle)?, Self::largest(&upside_down)?];
            sum.shift += high.shift + low.shift;
            sum.seen = [0, 1].map(|i| sum.seen[i] + high.seen[i] + low.seen[i]);
        }
        let share = 1.0 / cycles.max(1) as f64;
        Some(Self { shift: share * sum.shift, seen: sum.seen.map(|x| share * x) })
    }

    /// Estimate for the mean of a curve; `None` if it has no harmonics.
    pub fn mean(curve: &[f64], cycles: usize) -> Option<Self> {
        let amplitudes = amplitudes(curve, cycles)?;
        Some(Self { shift: 0.0, seen: [upper(&amplitudes), *amplitudes.last()?] })
    }

    /// Estimate for a harmonic of a curve, 1 for that of the mesh; `None` if the positions do not resolve it.
    pub fn harmonic(curve: &[f64], cycles: usize, order: usize) -> Option<Self> {
        let amplitudes = amplitudes(curve, cycles)?;
        Some(Self { shift: 0.0, seen: [*amplitudes.get(order.checked_sub(1)?)?, upper(&amplitudes)] })
    }
}

/// All amplitudes that positions tell apart.
fn amplitudes(curve: &[f64], cycles: usize) -> Option<Vec<f64>> {
    let all = mesh_harmonics(curve, cycles, curve.len()).ok()?;
    Some(all.into_iter().map(|h| h.amplitude).collect())
}

/// Root of the sum of squares of the upper half of the harmonics, which higher ones are mistaken for.
fn upper(amplitudes: &[f64]) -> f64 {
    amplitudes[amplitudes.len() / 2..].iter().map(|a| a * a).sum::<f64>().sqrt()
}

/// By how much a curve may rise above its highest position, and how far below it the positions beside it lie, the nearer
/// one first.
struct Peak {
    parabola: f64,
    lines: f64,
    beside: [f64; 2],
}

impl Peak {
    fn of(curve: &[f64]) -> Option<Self> {
        let n = curve.len();
        if n < 4 {
            return None;
        }
        let highest = curve.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let (mut parabola, mut lines) = (highest, highest);
        for i in 0..n {
            let [a, b, c, d] = std::array::from_fn(|k| curve[(i + k) % n]);
            // Of the parabolas that reach over to either side the flatter one: a plateau has no top beside it.
            parabola = parabola.max(top([a, b, c]).min(top([d, c, b])));
            lines = lines.max(meeting([a, b, c, d]));
        }
        let at = curve.iter().position(|y| *y == highest)?;
        let drops = [curve[(at + n - 1) % n], curve[(at + 1) % n]].map(|y| highest - y);
        let beside = [drops[0].min(drops[1]), drops[0].max(drops[1])];
        Some(Self { parabola: parabola - highest, lines: lines - highest, beside })
    }
}

/// Top of the parabola through three positions, where it lies between the last two; else the higher of these.
fn top([a, b, c]: [f64; 3]) -> f64 {
    // b + slope x + bend x^2 / 2
    let (slope, bend) = (0.5 * (c - a), a - 2.0 * b + c);
    let within = bend < 0.0 && slope >= 0.0 && slope <= -bend;
    if within { b - slope * slope / (2.0 * bend) } else { b.max(c) }
}

/// Height at which the line through the first two of four positions meets that through the last two, where they meet
/// between the two in the middle; else the higher of these.
fn meeting([a, b, c, d]: [f64; 4]) -> f64 {
    // b + (b - a) x = c + (d - c) (x - 1)
    let x = (c - b - (d - c)) / ((b - a) - (d - c));
    let high = b.max(c);
    if (0.0..=1.0).contains(&x) { high.max(b + (b - a) * x) } else { high }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    fn curve(n: usize, of: impl Fn(f64) -> f64) -> Vec<f64> {
        (0..n).map(|i| of(i as f64 / n as f64)).collect()
    }

    /// A parabola finds the top of a wave wherever its positions lie, to the fourth order of their distance.
    #[test]
    fn a_wave_has_the_top_of_its_parabola() {
        let missed = |n: usize, phase: f64| {
            let wave = curve(n, |x| (TAU * (x + phase)).cos());
            let between = Between::peak_to_peak(&wave, 1).unwrap();
            let sampled = wave.iter().copied().fold(f64::MIN, f64::max) - wave.iter().copied().fold(f64::MAX, f64::min);
            ((2.0 - sampled - between.shift).abs(), 2.0 - sampled)
        };
        for phase in [0.0, 0.01, 0.03, 0.0625] {
            let [left, finer] = [8, 16].map(|n| missed(n, phase).0);
            assert!(left < 0.06 && finer < 0.01, "phase {phase}: {left:e}, {finer:e}");
        }
        assert!(missed(8, 0.0625).1 > 0.1, "which positions alone miss");
    }

    /// Straight flanks meet at the kink between them.
    #[test]
    fn a_roof_ends_where_its_sides_meet() {
        for top in [0.31, 0.37, 0.42] {
            let roof = curve(16, |x| 1.0 - 2.0 * (x - top).abs());
            let highest = roof.iter().copied().fold(f64::MIN, f64::max);
            let between = Between::largest(&roof).unwrap();
            let peak = Peak::of(&roof).unwrap();
            assert!((highest + peak.lines - 1.0).abs() < 1e-12, "top at {top}: {between:?}");
            assert!(
                between.shift >= 0.0 && between.shift <= peak.lines && between.seen[0] >= peak.lines,
                "{between:?}"
            );
        }
    }

    /// A mean misses what the highest harmonics hide; a plateau rises nowhere.
    #[test]
    fn a_mean_misses_what_the_highest_harmonics_hide() {
        let smooth = Between::mean(&curve(16, |x| 3.0 + (TAU * x).sin()), 1).unwrap();
        assert!(smooth.seen[0] < 1e-14 && smooth.seen[1] < 1e-14, "{smooth:?}");
        let rough = Between::mean(&curve(16, |x| (TAU * x).sin() + 0.1 * (TAU * 8.0 * x).cos()), 1).unwrap();
        assert!((rough.seen[1] - 0.1).abs() < 1e-12, "{rough:?}");
        let first = Between::harmonic(&curve(16, |x| 0.4 * (TAU * x).sin()), 1, 1).unwrap();
        assert!((first.seen[0] - 0.4).abs() < 1e-12, "{first:?}");
        let plateau = Between::largest(&[0.0, 1.0, 1.0, 1.0, 0.0, 0.0]).unwrap();
        assert_eq!(plateau, Between { shift: 0.0, seen: [0.0, 1.0] });
        assert!(Between::largest(&[1.0, 2.0, 1.0]).is_none() && Between::harmonic(&[1.0; 4], 1, 3).is_none());
    }
}
