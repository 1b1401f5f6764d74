//! Length of a contact line from the contact state.

/// Least deformed gap at one axial station of a tooth pair.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LineSample {
    /// Axial position on body 1, mm.
    pub z: f64,
    /// Least gap there after rotation and deflection, mm; negative between points that touch.
    pub gap: f64,
}

/// Length [mm] over which the samples (ascending in z) touch, i.e. have a gap below `tolerance` [mm].
///
/// Where contact begins or ends between two samples the crossing is interpolated linearly, so the length is continuous in
/// the position of the gears. `along` is the length of line a unit of z, 1/cos(b_b).
pub fn contact_length(samples: &[LineSample], tolerance: f64, along: f64) -> f64 {
    let covered: f64 = samples
        .windows(2)
        .map(|w| {
            let (a, b) = (w[0].gap - tolerance, w[1].gap - tolerance);
            let dz = w[1].z - w[0].z;
            match (a <= 0.0, b <= 0.0) {
                (true, true) => dz,
                (false, false) => 0.0,
                // A gap that jumps to infinity ends at the last sample that touches.
                (true, false) => dz * crossing(-a, b),
                (false, true) => dz * crossing(-b, a),
            }
        })
        .sum();
    covered * along
}

/// Share of a step from -inside to +outside that lies below zero.
fn crossing(inside: f64, outside: f64) -> f64 {
    if outside.is_finite() && inside + outside > 0.0 { inside / (inside + outside) } else { 0.5 }
}

#[cfg(test)]
mod tests {
    use super::{LineSample, contact_length};

    /// A gap that rises linearly through the tolerance gives the exact length, wherever the samples lie.
    #[test]
    fn length_is_continuous() {
        for shift in [0.0, 0.013, 0.04, 0.099] {
            let samples: Vec<LineSample> = (0..=20)
                .map(|i| {
                    let z = f64::from(i);
                    LineSample { z, gap: (z - 7.5 - shift).abs() - 3.0 }
                })
                .collect();
            let length = contact_length(&samples, 0.0, 1.25);
            assert!((length - 7.5).abs() < 1e-12, "{length} at {shift}");
        }
    }
}
