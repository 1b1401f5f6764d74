//! Bifurcation diagrams: the motion after settling, over a parameter.

use serde::Serialize;

/// The settled motion at one value of the parameter.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Branch {
    /// Value of the parameter.
    pub value: f64,
    /// Points of the section there, in time order.
    pub points: Vec<f64>,
}

/// Both directions of a sweep, each in ascending order of the parameter.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Bifurcation {
    /// Branch with increasing parameter.
    pub forward: Vec<Branch>,
    /// Branch with decreasing parameter, started from the final state of the increasing sweep.
    pub backward: Vec<Branch>,
}

/// One way along `values` in their order, the state carried from each to the next.
fn sweep<S, E>(
    values: &[f64],
    state: &mut S,
    mut run: impl FnMut(f64, &mut S) -> Result<Vec<f64>, E>,
) -> Result<Vec<Branch>, E> {
    values.iter().map(|&value| run(value, state).map(|points| Branch { value, points })).collect()
}

/// Sweeps up along `values` and down again, carrying the state all the way. Where the two results differ there is
/// hysteresis.
///
/// `run` advances a motion at one value until it has settled, leaves its final state, and returns the points of its
/// section.
///
/// # Errors
/// The first error of `run`.
pub fn sweep_both_ways<S, E>(
    values: &[f64],
    state: &mut S,
    mut run: impl FnMut(f64, &mut S) -> Result<Vec<f64>, E>,
) -> Result<Bifurcation, E> {
    let mut ascending = values.to_vec();
    ascending.sort_by(f64::total_cmp);
    let forward = sweep(&ascending, state, &mut run)?;
    ascending.reverse();
    let mut backward = sweep(&ascending, state, &mut run)?;
    backward.reverse();
    Ok(Bifurcation { forward, backward })
}

impl Branch {
    /// Smallest and largest point; `None` if there are no points.
    pub fn extent(&self) -> Option<[f64; 2]> {
        let low = self.points.iter().copied().reduce(f64::min)?;
        let high = self.points.iter().copied().reduce(f64::max)?;
        Some([low, high])
    }

    /// Number of distinct points; points within `tolerance` count as one. It is 1 for a period of one, 2 after a period
    /// doubling, large in chaos.
    pub fn distinct(&self, tolerance: f64) -> usize {
        let mut sorted = self.points.clone();
        sorted.sort_by(f64::total_cmp);
        let gaps = sorted.windows(2).filter(|w| w[1] - w[0] > tolerance).count();
        usize::from(!sorted.is_empty()) + gaps
    }
}

impl Bifurcation {
    /// Ranges of the parameter in which both directions give different results: their extents differ by more than
    /// `tolerance` (in the unit of the points). Each range is given by its first and last value.
    pub fn hysteresis(&self, tolerance: f64) -> Vec<[f64; 2]> {
        let mut bands: Vec<[f64; 2]> = Vec::new();
        let mut inside = false;
        for (up, down) in self.forward.iter().zip(&self.backward) {
            let differ = match (up.extent(), down.extent()) {
                (Some(a), Some(b)) => (0..2).any(|i| (a[i] - b[i]).abs() > tolerance),
                (a, b) => a.is_some() != b.is_some(),
            };
            match (differ, inside, bands.last_mut()) {
                (true, true, Some(band)) => band[1] = up.value,
                (true, ..) => bands.push([up.value; 2]),
                _ => {}
            }
            inside = differ;
        }
        bands
    }
}
