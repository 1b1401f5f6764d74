//! Points of the unit cube, one a sample.

use rand::{Rng, RngExt, SeedableRng, seq::SliceRandom};
use rand_chacha::ChaCha12Rng;
use serde::{Deserialize, Serialize};

use crate::CasesError;

/// How samples are spread.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Design {
    /// Latin hypercube: of each axis every one of as many equal parts as there are samples once (M. McKay, R. Beckman,
    /// W. Conover, Technometrics 21 (1979) 239).
    LatinHypercube,
    /// Sobol's sequence with Owen's scrambling: means fall nearly as the number of samples, not as its root.
    Sobol,
    /// Each by itself: quantiles have the confidence intervals of the books.
    Random,
}

/// How many samples there are, and which.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Sampling {
    /// How they are spread.
    pub design: Design,
    /// How many.
    pub samples: u32,
    /// Other samples for another seed, the same for the same on every machine.
    pub seed: u64,
}

/// Samples and axes that Sobol's sequence has at the most.
const SOBOL: [u32; 2] = [1 << 16, 256];

/// Points of the unit cube.
#[derive(Debug, Clone)]
pub(crate) enum Points {
    /// Sample by sample, axis by axis.
    Known(Vec<f64>),
    Sobol {
        seed: u32,
    },
}

impl Points {
    /// Points on as many axes.
    pub fn new(sampling: &Sampling, axes: usize) -> Result<Self, CasesError> {
        let Sampling { design, samples, seed } = *sampling;
        let mut random = ChaCha12Rng::seed_from_u64(seed);
        match design {
            Design::Sobol => {
                let too_many = |what, asked, most| CasesError::TooMany { what, asked, most: u64::from(most) };
                if samples > SOBOL[0] {
                    return Err(too_many("samples of Sobol's sequence", u64::from(samples), SOBOL[0]));
                }
                if axes as u64 > u64::from(SOBOL[1]) {
                    return Err(too_many("axes of Sobol's sequence", axes as u64, SOBOL[1]));
                }
                Ok(Self::Sobol { seed: random.next_u32() })
            }
            Design::Random => Ok(Self::Known((0..samples as usize * axes).map(|_| random.random()).collect())),
            Design::LatinHypercube => {
                let mut points = vec![0.0; samples as usize * axes];
                let mut parts: Vec<u32> = (0..samples).collect();
                for axis in 0..axes {
                    parts.shuffle(&mut random);
                    for (sample, &part) in parts.iter().enumerate() {
                        let within: f64 = random.random();
                        points[sample * axes + axis] = (f64::from(part) + within) / f64::from(samples);
                    }
                }
                Ok(Self::Known(points))
            }
        }
    }

    /// Coordinate of a sample on axis `axis` of `axes`; 0 .. 1.
    pub fn at(&self, sample: usize, axis: usize, axes: usize) -> f64 {
        match self {
            Self::Known(points) => points[sample * axes + axis],
            Self::Sobol { seed } => f64::from(sobol_burley::sample(sample as u32, axis as u32, *seed)),
        }
    }
}
