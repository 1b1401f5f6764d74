//! Own error bounds of a chart point, compared with its actual error.

use scene::Quantity;
use study::Answer;

use crate::accuracy::{Accuracy, Bound};

/// Range of the error of a value according to its own bounds, and whether the actual error is within it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OwnBound {
    /// Lower limit of the error, relative to the reference like all errors of a chart: the exact value is larger by at
    /// most this.
    pub least: f64,
    /// Upper limit of the error, relative to the reference.
    pub most: f64,
    /// Whether the reference is within the range.
    pub holds: bool,
}

impl OwnBound {
    /// A bound against what is exact; `exact` in its unit.
    fn new(bound: &Bound, exact: f64) -> Self {
        let Bound { value, below, above, .. } = *bound;
        let scale = exact.abs();
        let holds = (value - below..=value + above).contains(&exact);
        Self { least: -above / scale, most: below / scale, holds }
    }
}

/// Bounds of a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OwnBounds {
    /// Bound of the mean STE.
    pub mean_ste: OwnBound,
    /// Bound of the peak to peak of the STE; `None` if only a part of the cycle was run.
    pub peak_to_peak_ste: Option<OwnBound>,
}

impl OwnBounds {
    /// Bounds of an answer that has every `n`-th position of the reference; `None` without a bound of the mean.
    pub(super) fn new(accuracy: &Accuracy, answer: &Answer, reference: &Answer) -> Option<Self> {
        let of = |quantity| accuracy.bounds.iter().find(|b| b.quantity == quantity);
        let [own, all] = [answer, reference].map(|a| a.ste_um.len());
        let same: Vec<f64> = reference.ste_um.iter().step_by(all.checked_div(own)?.max(1)).copied().collect();
        let swing = (own == all).then(|| study::peak_to_peak(&same));
        Some(Self {
            mean_ste: OwnBound::new(of(Quantity::MeanSte)?, study::mean(&same)),
            peak_to_peak_ste: swing.and_then(|exact| Some(OwnBound::new(of(Quantity::PeakToPeakSte)?, exact))),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A value of 10 that may be 0.5 more and 0.1 less is off by -0.5 .. +0.1; 10.4 lies inside, 10.6 does not.
    #[test]
    fn the_error_has_the_other_sign_of_the_bound() {
        let term = crate::accuracy::Term { cause: crate::accuracy::Cause::Mesh, known: 0.2, amount: 0.3 };
        let bound = Bound::new(Quantity::MeanSte, 10.0, vec![term]);
        let [inside, outside] = [10.4, 10.6].map(|exact| OwnBound::new(&bound, exact));
        let [least, most] = [-0.5, 0.1].map(|off| off / 10.4);
        assert!((inside.least - least).abs() < 1e-12 && (inside.most - most).abs() < 1e-12, "{inside:?}");
        assert!(inside.holds && !outside.holds);
    }
}
