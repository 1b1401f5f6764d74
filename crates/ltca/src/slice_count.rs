//! Number of slices that a pair needs under its load, and the errors of a spring model with that number. Theory (21c).
//!
//! The number is chosen with a cheap model: a row of equal springs along every contact line, over the exact gaps of the
//! flanks at several phases of a mesh cycle. Divided into slices, this model has the same errors as the contact: where
//! load ends within a slice, at tip edges and end faces, near crowning, relief or misalignment.

use geometry::GearPair;

use crate::{NominalLines, StaticOptions, equilibrium::GUESSED_LINE_STIFFNESS, nominal_lines::Line};

/// Counts that are tried, ascending. The first one is what a narrow pair has.
const COUNTS: [usize; 15] = [32, 40, 48, 56, 64, 80, 96, 112, 128, 160, 192, 224, 256, 320, 384];
/// Largest errors of the spring model, relative to infinitely many slices: mean approach; its peak to peak, relative to
/// itself or to a share of the mean where it is small; largest line load. Elastic gears have smaller errors, because
/// teeth share load with their neighbourhood and springs do not: measured on pairs of 5, 8, 15 and 40 modules, crowned
/// and misaligned (`crates/ltca/tests/ltca_laws/width_and_crowning.rs`).
const MEAN: f64 = 0.0125;
const SWING: f64 = 0.025;
const LEAST_SWING: f64 = 0.01;
const PEAK: f64 = 0.04;

/// Number of slices that a pair needs under its load, and the errors of the spring model with it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SliceCount {
    /// Number of slices over the face width.
    pub count: usize,
    /// Errors of the springs with this number of slices.
    pub errors: SpringErrors,
}

/// Relative errors of a row of springs that is divided into slices.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct SpringErrors {
    /// Error of the mean approach.
    pub mean: f64,
    /// Error of the peak-to-peak approach, relative to its peak to peak or, if larger, to a hundredth of the mean.
    pub swing: f64,
    /// Error of the largest line load.
    pub peak: f64,
}

impl SpringErrors {
    /// Whether any error is more than `times` the error permitted for a chosen number.
    pub fn exceed(&self, times: f64) -> bool {
        self.mean > times * MEAN || self.swing > times * SWING || self.peak > times * PEAK
    }
}

/// The smallest number of slices, of those tried, with which a row of springs over the pair's gaps is accurate to 1.25
/// % in the mean approach, 2.5 % in its peak to peak and 4 % in the largest line load; the largest number tried if none
/// is.
///
/// ```text
/// sum over the contact lines of k h max(0, delta - g_i) = F_bn cos b_b,   h = b / n
/// ```
/// k is a typical mesh stiffness, g the gap of the flanks, with micro-geometry and misalignment, at the position of
/// zero transmission error. Both the divided and the undivided row are solved exactly at eight phases. Without torque,
/// or if the flanks face each other nowhere, the result is the first number.
pub fn slices_needed(pair: &GearPair, options: &StaticOptions) -> SliceCount {
    slices_needed_on(&NominalLines::new(pair, options), pair, options)
}

/// The same for nominal contact lines that serve the pair ([`NominalLines::serves`]).
pub fn slices_needed_on(lines: &NominalLines, pair: &GearPair, options: &StaticOptions) -> SliceCount {
    let springs = Springs::new(lines, pair, options);
    let of = |count: usize| SliceCount { count, errors: springs.errors(count) };
    COUNTS.into_iter().map(of).find(|c| !c.errors.exceed(1.0)).unwrap_or_else(|| of(COUNTS[COUNTS.len() - 1]))
}

/// Errors of the springs with a given number of slices: see [`slices_needed`].
pub fn slice_errors(pair: &GearPair, options: &StaticOptions, count: usize) -> SpringErrors {
    Springs::new(&NominalLines::new(pair, options), pair, options).errors(count)
}

/// Gaps of all lines at each phase.
struct Springs {
    phases: Vec<Phase>,
    /// F_bn cos b_b / (k b): mean overlap over the face, mm.
    load: f64,
}

/// The lines of a phase, and how springs at all places share the load.
struct Phase {
    lines: Vec<Line>,
    /// delta, mm.
    approach: f64,
    /// Least gap, mm.
    least: f64,
}

impl Phase {
    fn new(lines: Vec<Line>, load: f64) -> Self {
        let fine: Vec<f64> = lines.iter().flatten().copied().collect();
        let (approach, least) = (approach(&fine, load, lines.first().map_or(0, Vec::len)), least(&fine));
        Self { lines, approach, least }
    }
}

impl Springs {
    fn new(lines: &NominalLines, pair: &GearPair, options: &StaticOptions) -> Self {
        let base_radius = [pair.pinion.base_radius(), pair.wheel.base_radius()][options.driven()].abs();
        let load = options.torque / (base_radius * GUESSED_LINE_STIFFNESS * pair.face_width());
        if !(load.is_finite() && load > 0.0) {
            return Self { phases: Vec::new(), load: 0.0 };
        }
        let phases = lines.gaps(pair, options).filter(|lines| !lines.is_empty());
        Self { phases: phases.map(|lines| Phase::new(lines, load)).collect(), load }
    }

    /// The worst of three counts next to each other: an error that comes and goes with the place of the stations is not
    /// missed where it happens to be zero.
    fn errors(&self, count: usize) -> SpringErrors {
        let of = [count - count / 8, count, count + count / 8].map(|n| self.errors_of(n.max(1)));
        let worst = |value: fn(&SpringErrors) -> f64| of.iter().map(value).fold(0.0, f64::max);
        SpringErrors { mean: worst(|e| e.mean), swing: worst(|e| e.swing), peak: worst(|e| e.peak) }
    }

    fn errors_of(&self, count: usize) -> SpringErrors {
        if self.phases.is_empty() {
            return SpringErrors::default();
        }
        let whole: Vec<f64> = self.phases.iter().map(|phase| phase.approach).collect();
        let mut cut = Vec::new();
        let mut peak = 0.0f64;
        for phase in &self.phases {
            let of_slices: Vec<f64> = phase.lines.iter().flat_map(|line| sliced(line, count)).collect();
            let b = approach(&of_slices, self.load, count);
            let (most, seen) = (phase.approach - phase.least, b - least(&of_slices));
            peak = peak.max((seen / most - 1.0).abs());
            cut.push(b);
        }
        let touch: f64 = self.phases.iter().map(|phase| phase.least).sum();
        let phases = whole.len() as f64;
        let mean = whole.iter().sum::<f64>() / phases;
        let elastic = mean - touch / phases;
        let [swing, of_cut] = [&whole, &cut].map(|all| span(all));
        let off: Vec<f64> = whole.iter().zip(&cut).map(|(a, b)| b - a).collect();
        // What errors at single positions may do to the peak to peak, and what they have done here.
        let lost = span(&off).max((of_cut - swing).abs());
        SpringErrors {
            mean: (off.iter().sum::<f64>() / phases / elastic).abs(),
            swing: lost / swing.max(LEAST_SWING * elastic),
            peak,
        }
    }
}

fn least(gaps: &[f64]) -> f64 {
    gaps.iter().copied().fold(f64::INFINITY, f64::min)
}

fn span(values: &[f64]) -> f64 {
    let most = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    most - values.iter().copied().fold(f64::INFINITY, f64::min)
}

/// Gaps at the stations of `count` slices, straight between the places of a line.
fn sliced(line: &[f64], count: usize) -> impl Iterator<Item = f64> + '_ {
    let places = line.len() as f64;
    (0..count).map(move |i| {
        let place = ((i as f64 + 0.5) / count as f64 * places - 0.5).clamp(0.0, places - 1.0);
        let (below, share) = (place.floor() as usize, place.fract());
        let [a, b] = [line[below], line[(below + 1).min(line.len() - 1)]];
        match (a.is_finite(), b.is_finite()) {
            (true, true) => a + share * (b - a),
            _ => {
                if share < 0.5 {
                    a
                } else {
                    b
                }
            }
        }
    })
}

/// delta of springs that share a load: sum of max(0, delta - g) over `count` slices a face = `load` times `count`. Without
/// the springs that are not reached delta is less, until all of them are.
fn approach(gaps: &[f64], load: f64, count: usize) -> f64 {
    let mut loaded: Vec<f64> = gaps.iter().copied().filter(|g| g.is_finite()).collect();
    let target = load * count as f64;
    loop {
        let (springs, sum) = (loaded.len(), loaded.iter().sum::<f64>());
        let approach = (target + sum) / springs.max(1) as f64;
        loaded.retain(|gap| *gap < approach);
        if loaded.len() == springs || loaded.is_empty() {
            return approach;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{approach, sliced};

    /// The load of springs with gaps 0, 1, 2, ... is carried by the first of them.
    #[test]
    fn springs_balance_their_load() {
        let gaps: Vec<f64> = (0..10).map(f64::from).collect();
        for load in [0.01, 0.3, 2.0, 50.0] {
            let delta = approach(&gaps, load, 10);
            let carried: f64 = gaps.iter().map(|g| (delta - g).max(0.0)).sum();
            assert!((carried / (10.0 * load) - 1.0).abs() < 1e-12, "{load}: {carried}");
        }
        assert!(sliced(&gaps, 5).zip([0.5, 2.5, 4.5, 6.5, 8.5]).all(|(a, b)| (a - b).abs() < 1e-12));
    }
}
