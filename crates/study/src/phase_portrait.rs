//! Phase portrait: velocity over displacement.

use serde::Serialize;

use crate::error::StudyError;

/// Path of a motion in the plane of a coordinate and its velocity.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PhasePortrait {
    /// Points (x, x') in time order.
    pub points: Vec<[f64; 2]>,
    /// Smallest and largest of x and of x'.
    pub extent: [[f64; 2]; 2],
}

/// Portrait of a coordinate and its velocity, sampled at the same times.
///
/// # Errors
/// [`StudyError`] for lists of different lengths, without samples, or with entries that are not finite.
pub fn phase_portrait(coordinate: &[f64], velocity: &[f64]) -> Result<PhasePortrait, StudyError> {
    if coordinate.len() != velocity.len() {
        return Err(StudyError::Lengths { found: velocity.len(), wanted: coordinate.len() });
    }
    if coordinate.is_empty() {
        return Err(StudyError::TooFewSamples { samples: 0, least: 1 });
    }
    let extent = |list: &[f64]| -> Result<[f64; 2], StudyError> {
        match list.iter().position(|x| !x.is_finite()) {
            Some(index) => Err(StudyError::NotFinite { index, value: list[index] }),
            None => Ok(list.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], &x| [a.min(x), b.max(x)])),
        }
    };
    let extent = [extent(coordinate)?, extent(velocity)?];
    Ok(PhasePortrait { points: coordinate.iter().zip(velocity).map(|(&x, &v)| [x, v]).collect(), extent })
}

impl PhasePortrait {
    /// How far the path is from being closed after `samples` points: largest distance of a point from the point that
    /// many samples later, each direction relative to its extent. It is 0 for a motion with that period and about 1 in
    /// chaos. `None` if the portrait is not longer than that.
    pub fn opening(&self, samples: usize) -> Option<f64> {
        let size = self.extent.map(|[low, high]| if high > low { high - low } else { 1.0 });
        let later = self.points.get(samples..).filter(|rest| !rest.is_empty() && samples > 0)?;
        let apart = |(a, b): (&[f64; 2], &[f64; 2])| ((a[0] - b[0]) / size[0]).hypot((a[1] - b[1]) / size[1]);
        Some(self.points.iter().zip(later).map(apart).fold(0.0, f64::max))
    }

    /// Area inside the path over whole periods by the shoelace formula, in units of x times x': pi a^2 omega for one
    /// period of a sine. It is positive clockwise, which is the direction of every motion.
    pub fn area(&self) -> f64 {
        let next = self.points.iter().cycle().skip(1);
        self.points.iter().zip(next).map(|(a, b)| 0.5 * (b[0] * a[1] - a[0] * b[1])).sum()
    }
}
