//! What a point of the chart says of its own error, beside what that is.

use scene::Quantity;
use study::Answer;

use crate::accuracy::{Accuracy, Bound};

/// How far the error of a number may lie by its own bounds, and whether it does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OwnBound {
    /// The error is at least this, relative to the reference as all errors of a chart are: the exact value lies above
    /// by as much at the most.
    pub least: f64,
    /// The error is at most this, likewise.
    pub most: f64,
    /// Whether the reference lies inside.
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
    /// Bound of the peak to peak of the STE; `None` where a part of the cycle was run.
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
