//! Error bounds of headline values, split by cause.

use scene::{Quantity, Tolerance};
use serde::Serialize;

use crate::worse;

/// Cause of the difference between a value and that of the exact pair.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Cause {
    /// Finite element size.
    Mesh,
    /// Finite number of slices of the contact lines.
    Slices,
    /// Finite number of positions of the mesh cycle.
    Positions,
    /// Interpolation of the bulk compliance between heights.
    Interpolation,
    /// Finite number of contact iterations.
    Iteration,
    /// Finite number of elements along the shafts of a vibrating gearbox.
    ShaftElements,
    /// Finite time steps.
    Step,
    /// Neglected inertia of elastic deformation.
    QuasiStaticElasticity,
    /// A model with fewer coordinates than the flanks have.
    Model,
    /// A transient that has not decayed.
    Settling,
}

described::described! {
    /// A share of a bound, in the unit of its quantity.
    #[derive(Debug, Clone, Copy, PartialEq, Serialize)]
    pub struct Term {
        /// `mesh`, `slices`, `positions`, `interpolation`, `iteration`; in motion `mesh`, `step`, `quasi_static_elasticity`, `model`, `settling`
        pub cause: Cause,
        /// known part of the error, which `corrected` is without
        pub known: f64,
        /// possible error beyond the known part, either way
        pub amount: f64,
    }
}

impl Term {
    /// This term, without its known part where that is not worth taking off: one that is no larger than what it may be
    /// off by may make a value worse, and is a part of that. What positions happen to miss has a mean and no known
    /// part: of 70 pairs that took no part in the calibration, taking it off made ten of ten numbers worse.
    fn offered(self) -> Self {
        if self.amount < self.known.abs() && self.cause != Cause::Positions {
            return self;
        }
        Self { known: 0.0, amount: self.known.abs() + self.amount, ..self }
    }
}

described::described! {
    /// What a headline number is off by at the most, with the coverage of the calibration.
    #[derive(Debug, Clone, PartialEq, Serialize)]
    pub struct Bound {
        /// number of the headline
        pub quantity: Quantity,
        /// mesh or bearing of a gearbox that the number is of; missing for a number of the whole
        #[serde(skip_serializing_if = "Option::is_none")]
        pub of: Option<String>,
        /// unit of the number
        pub unit: &'static str,
        /// number as computed
        pub value: f64,
        /// the exact value is at least `value - below`
        pub below: f64,
        /// the exact value is at most `value + above`
        pub above: f64,
        /// value without those known parts of the error that are larger than their own uncertainty
        pub corrected: f64,
        /// distance of the exact value from `corrected`, at most
        pub corrected_within: f64,
        /// parts of the bound, by cause
        pub terms: Vec<Term>,
        /// sum of the amounts before a factor of the calibration of gearboxes
        #[serde(skip)]
        pub uncalibrated: f64,
        /// bound that the scene asks for; missing where it asks for none
        #[serde(skip_serializing_if = "Option::is_none")]
        pub asked: Option<f64>,
        /// whether the asked bound is kept
        #[serde(skip_serializing_if = "Option::is_none")]
        pub met: Option<bool>,
    }
}

impl Bound {
    /// Bound of a value, and the terms of its error.
    ///
    /// `above` and `below` contain the whole known error and its uncertainty. The corrected value contains only those
    /// known parts that are larger than their uncertainty; the others are added to its uncertainty.
    pub fn new(quantity: Quantity, value: f64, terms: Vec<Term>) -> Self {
        let sum = |terms: &[Term]| terms.iter().fold(value, |sum, t| sum + t.known);
        let within: f64 = terms.iter().map(|t| t.amount).sum();
        let expected = sum(&terms);
        let terms: Vec<Term> = terms.into_iter().map(Term::offered).collect();
        Self {
            quantity,
            of: None,
            unit: quantity.unit(),
            value,
            below: worse(value - expected + within, 0.0),
            above: worse(expected + within - value, 0.0),
            corrected: sum(&terms),
            corrected_within: terms.iter().map(|t| t.amount).sum(),
            terms,
            uncalibrated: within,
            asked: None,
            met: None,
        }
    }

    /// This bound as that of a named mesh or bearing.
    #[must_use]
    pub fn of(self, name: Option<String>) -> Self {
        Self { of: name, ..self }
    }

    /// Key of the value, and the part that it belongs to: `face_load_factor of first`.
    pub fn name(&self) -> String {
        let key = self.quantity.key();
        self.of.as_ref().map_or_else(|| key.to_owned(), |of| format!("{key} of {of}"))
    }

    /// This bound compared with the requested tolerance; a share is relative to the value.
    #[must_use]
    pub fn against(self, tolerance: Option<Tolerance>) -> Self {
        let asked = tolerance.map(|t| t.of(self.value));
        let met = asked.map(|most| self.largest() <= most);
        Self { asked, met, ..self }
    }

    /// The larger of both sides.
    pub fn largest(&self) -> f64 {
        worse(self.above, self.below)
    }

    /// How many times the bound is larger than what is asked; 0 where nothing is.
    pub(super) fn over(&self) -> f64 {
        self.largest() / self.asked.unwrap_or(f64::INFINITY)
    }

    /// Contribution of a cause to the bound: its known part, and its uncertainty.
    pub fn by(&self, cause: Cause) -> f64 {
        self.terms.iter().filter(|t| t.cause == cause).map(|t| t.known.abs() + t.amount).sum()
    }

    /// Text with the bound and the requested tolerance.
    pub fn shortfall(&self) -> String {
        format!("{} is known to {}, {} is asked", self.name(), self.of_unit(self.largest()), self.asked_words())
    }

    /// Text of the requested tolerance: three digits and the unit.
    pub fn asked_words(&self) -> String {
        self.of_unit(self.asked.unwrap_or(f64::NAN))
    }

    /// Three significant digits of an amount, with the unit of the number.
    fn of_unit(&self, amount: f64) -> String {
        format!("{} {}", answer::digits(amount), self.unit).trim_end().to_owned()
    }

    /// Text of value and bounds: `9.37 +0.04 -0.01 um`.
    pub fn words(&self) -> String {
        let Self { value, above, below, unit, .. } = self;
        // Two digits of the larger side say enough, and so do six of the value.
        let places = |digits: f64, of: f64| digits - 1.0 - of.log10().floor();
        let most = if *value == 0.0 { 9.0 } else { places(6.0, value.abs()).clamp(0.0, 9.0) };
        let wanted = places(2.0, self.largest());
        let places = wanted.clamp(0.0, most) as usize;
        // Where the digits of the value do not reach down to the bound, the bound has its own.
        let side = |x: &f64| if wanted > most { format!("{x:.1e}") } else { format!("{x:.places$}") };
        let [up, down] = [side(above), side(below)];
        let words = match up == down {
            true => format!("{value:.places$} +-{up} {unit}"),
            false => format!("{value:.places$} +{up} -{down} {unit}"),
        };
        words.trim_end().to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Where the known error is above, the bound is larger above; both together hold the corrected band.
    #[test]
    fn bounds_hold_the_band_of_the_corrected_value() {
        let terms = |known| {
            let mesh = Term { cause: Cause::Mesh, known, amount: 0.02 };
            vec![mesh, Term { cause: Cause::Slices, known: 0.0, amount: 0.005 }]
        };
        let b = Bound::new(Quantity::MeanSte, 9.37, terms(0.03));
        assert!((b.value + b.above - 9.425).abs() < 1e-12 && b.below == 0.0, "{b:?}");
        assert!((b.corrected - 9.40).abs() < 1e-12 && (b.corrected_within - 0.025).abs() < 1e-12, "{b:?}");
        let b = Bound::new(Quantity::MeanSte, 9.37, terms(0.015));
        assert!((b.value + b.above - 9.41).abs() < 1e-12 && (b.value - b.below - 9.36).abs() < 1e-12, "{b:?}");
        assert_eq!(b.words(), "9.370 +0.040 -0.010 um");
        // Digits of the number end where its bound begins, and are six at the most; of what is asked there are three.
        let of = |value, amount| {
            Bound::new(Quantity::MaxPairForce, value, vec![Term { cause: Cause::Mesh, known: 0.0, amount }])
        };
        assert_eq!(of(2485.0123, 17.77).words(), "2485 +-18 N");
        assert_eq!(of(2485.0123, 1.7e-9).words(), "2485.01 +-1.7e-9 N");
        assert_eq!(of(2485.0123, 0.0).words(), "2485.01 +-0.0e0 N");
        let asked = |share| of(2485.0123, 17.77).against(Some(Tolerance::Relative(share))).asked_words();
        assert_eq!([asked(1.0 / 3.0), asked(1e-6), asked(1e-12)], ["828 N", "0.00249 N", "2.49e-9 N"]);
        // A value that lies outside of the band is within its bounds all the same.
        let far = Bound::new(Quantity::MeanSte, 9.0, terms(0.385));
        assert!(far.below == 0.0 && (far.above - 0.41).abs() < 1e-12, "{far:?}");
        let [loose, tight] = [0.05, 0.04].map(|share| far.clone().against(Some(Tolerance::Relative(share))).met);
        assert_eq!([loose, tight], [Some(true), Some(false)]);
        let unknown = Bound::new(Quantity::MeanSte, 9.0, terms(f64::NAN));
        assert_eq!(unknown.against(Some(Tolerance::Relative(1.0))).met, Some(false));
    }

    /// A known part that is smaller than its own uncertainty is not taken off: the value stays, the band around it holds
    /// what it held before, and `above` and `below` stay as sharp as they were.
    #[test]
    fn what_is_known_worse_than_it_is_large_is_no_correction() {
        let term = |cause, known, amount| Term { cause, known, amount };
        let b = Bound::new(
            Quantity::PeakToPeakSte,
            0.16,
            vec![term(Cause::Mesh, 0.01, 0.004), term(Cause::Positions, 0.05, 0.2)],
        );
        assert!((b.corrected - 0.17).abs() < 1e-12, "the mesh alone is known: {b:?}");
        assert!((b.corrected_within - (0.004 + 0.25)).abs() < 1e-12, "{b:?}");
        assert!((b.above - (0.06 + 0.204)).abs() < 1e-12 && (b.below - (0.204 - 0.06)).abs() < 1e-12, "{b:?}");
        let band = [b.corrected - b.corrected_within, b.corrected + b.corrected_within];
        assert!(band[0] <= b.value - b.below && band[1] >= b.value + b.above - 1e-12, "{band:?} holds the bounds");
        let sum: f64 = b.terms.iter().map(|t| t.amount).sum();
        assert!((sum - b.corrected_within).abs() < 1e-15, "terms add up: {b:?}");
    }
}
