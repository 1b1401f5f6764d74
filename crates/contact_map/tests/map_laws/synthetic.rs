//! Two flanks of elastic foundations: slices whose gaps and stiffness change with the phase, each known in closed form.

use std::convert::Infallible;
use std::f64::consts::TAU;

use contact_map::{ContactSample, LoadedSlice, PhaseContact};

/// Force that the pair carries on average, N.
pub const MEAN_FORCE: f64 = 2000.0;
const SLICES: usize = 200;
const WIDTH: f64 = 20.0;
/// Stiffness per width, N/mm^2.
const STIFFNESS: f64 = 1.2e4;
/// Crown, mm at the ends.
const CROWN: f64 = 2e-3;

/// The contact at one phase.
#[derive(Debug, Clone, Copy)]
pub struct Row {
    stiffness: f64,
    gap: f64,
    shift: f64,
}

impl Row {
    pub fn at(phase: f64) -> Self {
        let (sin, cos) = (TAU * phase).sin_cos();
        Self { stiffness: STIFFNESS * (1.0 + 0.2 * cos), gap: 1e-3 * sin, shift: 2.0 * sin }
    }

    fn slices(&self) -> impl Iterator<Item = (f64, f64)> {
        let Self { gap, shift, .. } = *self;
        (0..SLICES).map(move |i| {
            let z = WIDTH * ((i as f64 + 0.5) / SLICES as f64 - 0.5);
            let out = (z - shift) / (0.5 * WIDTH);
            (z, gap + CROWN * out * out)
        })
    }

    /// Slices that carry load.
    pub fn loaded(&self, approach: f64, tilt: f64) -> Vec<LoadedSlice> {
        let length = WIDTH / SLICES as f64;
        let all = self.slices().map(|(z, gap)| {
            let force = self.stiffness * length * (approach + z * tilt - gap);
            LoadedSlice { force, length, lever: z, pair: 0, friction: [0.0; 3] }
        });
        all.filter(|s| s.force > 0.0).collect()
    }

    /// Approach under a force, by bisection.
    pub fn approach_under(&self, force: f64, tilt: f64) -> f64 {
        let [mut low, mut high] = [-1.0, 1.0];
        for _ in 0..80 {
            let middle = 0.5 * (low + high);
            if self.loaded(middle, tilt).iter().map(|s| s.force).sum::<f64>() > force {
                high = middle
            } else {
                low = middle
            }
        }
        0.5 * (low + high)
    }
}

impl PhaseContact for Row {
    type Error = Infallible;

    fn overlap(&mut self, approach: f64, tilt: f64) -> f64 {
        self.slices().map(|(z, gap)| approach + z * tilt - gap).fold(f64::MIN, f64::max)
    }

    fn sample(&mut self, approach: f64, tilt: f64) -> Result<ContactSample, Infallible> {
        let slices = self.loaded(approach, tilt);
        let stiffness = slices.iter().map(|s| self.stiffness * s.length).sum();
        Ok(ContactSample { force: slices.iter().map(|s| s.force).sum(), stiffness, slices })
    }
}
