//! Natural frequencies over speed, and their intersections with excitation lines.

use serde::Serialize;

use crate::error::{StudyError, positive};

/// Campbell diagram: natural frequencies and excitation lines over speed.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Campbell {
    /// Speeds, ascending, revolutions per second (Hz).
    pub speeds: Vec<f64>,
    /// `frequencies[m][s]`: mode m at speed s, Hz, ascending in m.
    pub frequencies: Vec<Vec<f64>>,
    /// Orders of excitation: multiples of the speed, above 0 (teeth, twice the teeth, ...).
    pub orders: Vec<f64>,
    /// Intersections of an excitation line with a mode.
    pub resonances: Vec<Resonance>,
}

/// A resonance: an excitation line meets a mode.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Resonance {
    /// Index of the mode, from 0.
    pub mode: usize,
    /// Order of excitation.
    pub order: f64,
    /// Speed, Hz.
    pub speed: f64,
    /// Frequency, Hz.
    pub frequency: f64,
}

/// Diagram over `speeds` (Hz, ascending). `modes` gives the natural frequencies (Hz) at a speed, the same number at
/// each.
///
/// Modes are in ascending order at every speed. Where two modes cross, their numbers swap; the resonances do not
/// change. Between the speeds modes are interpolated linearly.
///
/// # Errors
/// [`StudyError`] for speeds that do not ascend, orders that are not positive, or a number of modes that varies with
/// speed.
pub fn campbell(
    speeds: &[f64],
    orders: &[f64],
    mut modes: impl FnMut(f64) -> Vec<f64>,
) -> Result<Campbell, StudyError> {
    if speeds.is_empty() {
        return Err(StudyError::TooFewSamples { samples: 0, least: 1 });
    }
    for &order in orders {
        positive("order of excitation", order)?;
    }
    if let Some(index) = speeds.windows(2).position(|w| w[1] <= w[0] || !w[1].is_finite() || !w[0].is_finite()) {
        return Err(StudyError::NotAscending { index: index + 1 });
    }
    let mut by_speed = Vec::with_capacity(speeds.len());
    for &speed in speeds {
        let mut all = modes(speed);
        if let Some(index) = all.iter().position(|f| !f.is_finite()) {
            return Err(StudyError::NotFinite { index, value: all[index] });
        }
        all.sort_by(f64::total_cmp);
        by_speed.push(all);
    }
    let count = by_speed[0].len();
    if let Some(other) = by_speed.iter().find(|all| all.len() != count) {
        return Err(StudyError::Lengths { found: other.len(), wanted: count });
    }
    let frequencies: Vec<Vec<f64>> = (0..count).map(|m| by_speed.iter().map(|all| all[m]).collect()).collect();
    let resonances = meetings(speeds, &frequencies, orders);
    Ok(Campbell { speeds: speeds.to_vec(), frequencies, orders: orders.to_vec(), resonances })
}

fn meetings(speeds: &[f64], frequencies: &[Vec<f64>], orders: &[f64]) -> Vec<Resonance> {
    let mut found = Vec::new();
    for (mode, line) in frequencies.iter().enumerate() {
        for &order in orders {
            let apart = |s: usize| order * speeds[s] - line[s];
            if apart(0) == 0.0 {
                found.push(Resonance { mode, order, speed: speeds[0], frequency: line[0] });
            }
            for s in 1..speeds.len() {
                let (a, b) = (apart(s - 1), apart(s));
                if (a < 0.0) != (b < 0.0) && b != a && a != 0.0 || b == 0.0 {
                    let share = if b == 0.0 { 1.0 } else { a / (a - b) };
                    let speed = speeds[s - 1] + share * (speeds[s] - speeds[s - 1]);
                    found.push(Resonance { mode, order, speed, frequency: order * speed });
                }
            }
        }
    }
    found.sort_by(|a, b| a.speed.total_cmp(&b.speed));
    found
}
