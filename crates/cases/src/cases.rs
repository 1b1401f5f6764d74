//! The cases of a plan by number.

use crate::{Axis, CasesError, Sampling, sampling::Points};

/// Cases of a plan at the most.
const MOST_CASES: u64 = 10_000_000;
/// Numbers that samples may take in all.
const MOST_NUMBERS: u64 = 100_000_000;

/// The cases of a plan.
///
/// ```text
/// case = sample G + k,   G: combinations of what is gone through, k: the number of one, the last axis fastest
/// ```
#[derive(Debug, Clone)]
pub struct Cases {
    axes: Vec<Axis>,
    points: Points,
    samples: usize,
    drawn: usize,
    combinations: usize,
}

impl Cases {
    /// Cases of axes; without an axis that is drawn there is one sample.
    ///
    /// # Errors
    /// [`CasesError`].
    pub fn new(axes: Vec<Axis>, sampling: &Sampling) -> Result<Self, CasesError> {
        let mut combinations: u64 = 1;
        for (axis, of) in axes.iter().enumerate() {
            match of {
                Axis::Each(values) if values.is_empty() => return Err(CasesError::NoValues { axis }),
                Axis::Each(values) => combinations = combinations.saturating_mul(values.len() as u64),
                Axis::Drawn(distribution) => {
                    if let Some(what) = distribution.fault() {
                        return Err(CasesError::NoDistribution { axis, what });
                    }
                }
            }
        }
        let drawn = axes.iter().filter(|axis| matches!(axis, Axis::Drawn(_))).count();
        let samples = if drawn == 0 { 1 } else { sampling.samples };
        let too_many = |what, asked, most| Err(CasesError::TooMany { what, asked, most });
        let asked = combinations.saturating_mul(u64::from(samples));
        if asked > MOST_CASES {
            return too_many("cases", asked, MOST_CASES);
        }
        let numbers = drawn as u64 * u64::from(samples);
        if numbers > MOST_NUMBERS {
            return too_many("samples times axes", numbers, MOST_NUMBERS);
        }
        let points = Points::new(&Sampling { samples, ..*sampling }, drawn)?;
        Ok(Self { axes, points, samples: samples as usize, drawn, combinations: combinations as usize })
    }

    /// How many.
    pub fn count(&self) -> usize {
        self.samples * self.combinations
    }

    /// Samples of what is drawn.
    pub fn samples(&self) -> usize {
        self.samples
    }

    /// The axes.
    pub fn axes(&self) -> &[Axis] {
        &self.axes
    }

    /// Value of every axis in a case, 0 .. [`Cases::count`].
    pub fn values(&self, case: usize) -> Vec<f64> {
        let (sample, mut rest) = (case / self.combinations, case % self.combinations);
        let mut values = vec![0.0; self.axes.len()];
        let mut drawn = self.drawn;
        for (value, axis) in values.iter_mut().zip(&self.axes).rev() {
            *value = match axis {
                Axis::Each(all) => {
                    let own = rest % all.len();
                    rest /= all.len();
                    all[own]
                }
                Axis::Drawn(distribution) => {
                    drawn -= 1;
                    distribution.quantile(self.points.at(sample, drawn, self.drawn))
                }
            };
        }
        values
    }
}
