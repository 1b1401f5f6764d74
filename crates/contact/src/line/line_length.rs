//! Length of a contact line from the contact state. Theory (21).

use crate::bracketing::last_inside;

/// Bisections to an end of contact: to a 10^4th of a step.
const END_BISECTIONS: usize = 14;

/// Axial intervals [from, to], mm, over which a tooth pair is in contact: where `gap(z)` (mm), the smallest deformed
/// gap at height z, is at most `tolerance`.
///
/// The ends of contact are located between `samples` equally spaced stations of `range`. Each end is then bisected to a
/// 10^4th of a step, so the length is a continuous function of the position of the gears. An interval of contact
/// shorter than a step can be missed.
pub fn contact_intervals(gap: impl Fn(f64) -> f64, range: [f64; 2], samples: usize, tolerance: f64) -> Vec<[f64; 2]> {
    let touches = |z: f64| gap(z) <= tolerance;
    let step = (range[1] - range[0]) / (samples.max(2) - 1) as f64;
    let end = |inside: f64, outside: f64| last_inside(touches, [inside, outside], END_BISECTIONS, 0.0);
    let mut intervals = Vec::new();
    let mut open: Option<f64> = None;
    let mut before = None;
    for i in 0..samples.max(2) {
        let z = (range[0] + step * i as f64).min(range[1]);
        match (open, touches(z)) {
            (None, true) => open = Some(before.map_or(z, |b| end(z, b))),
            (Some(from), false) => {
                intervals.push([from, end(before.unwrap_or(z), z)]);
                open = None;
            }
            _ => {}
        }
        before = Some(z);
    }
    if let Some(from) = open {
        intervals.push([from, range[1]]);
    }
    intervals
}

/// Length of the part of the intervals within `range`, in the unit of z.
pub fn covered(intervals: &[[f64; 2]], range: [f64; 2]) -> f64 {
    intervals.iter().map(|i| (i[1].min(range[1]) - i[0].max(range[0])).max(0.0)).sum()
}

#[cfg(test)]
mod tests {
    use super::{contact_intervals, covered};

    /// Wherever the samples lie, and however steeply the gap rises at the ends, the length is the exact one.
    #[test]
    fn length_is_continuous() {
        for shift in [0.0, 0.013, 0.04, 0.099] {
            for steepness in [1.0, 1e6] {
                let gap = |z: f64| {
                    let out = (z - 7.5 - shift).abs() - 3.0;
                    if out > 0.0 { steepness * out } else { out }
                };
                let intervals = contact_intervals(gap, [0.0, 20.0], 21, 0.0);
                let length = covered(&intervals, [0.0, 20.0]);
                assert!((length - 6.0).abs() < 1e-3, "{length} at {shift}");
                assert!((covered(&intervals, [7.5 + shift, 20.0]) - 3.0).abs() < 1e-3);
            }
        }
    }

    /// A tolerance widens contact to where the gap has that size.
    #[test]
    fn a_tolerance_counts_as_contact() {
        let intervals = contact_intervals(|z: f64| 0.1 * (z - 2.0).abs(), [0.0, 4.0], 41, 0.05);
        assert!((covered(&intervals, [0.0, 4.0]) - 1.0).abs() < 1e-3, "{intervals:?}");
    }

    /// Contact over the whole range, at its ends only, and nowhere.
    #[test]
    fn whole_and_empty() {
        let of = |gap: fn(f64) -> f64| covered(&contact_intervals(gap, [-1.0, 1.0], 9, 0.0), [-1.0, 1.0]);
        assert_eq!(of(|_| -1.0), 2.0);
        assert_eq!(of(|_| f64::INFINITY), 0.0);
        assert!((of(|z| 0.5 - z.abs()) - 1.0).abs() < 1e-4);
    }
}
