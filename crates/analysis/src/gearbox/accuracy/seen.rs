//! Error indicators of a solved gearbox, and the bounds of its values.

use std::collections::BTreeSet;

use scene::{Quantity, gearbox::Gearbox};

use super::{
    calibration::GearboxCalibration,
    pairs::{OfPair, bound},
    sample::{Sample, Which, lowest},
};
use crate::{
    accuracy::{Bound, Cause, Term},
    gearbox::GearboxResult,
};

/// Order of the errors of meshes, slices and shaft elements, and that of positions, between which loads jump: theory,
/// section 15.
const ORDER: i32 = 2;
const ORDER_OF_POSITIONS: i32 = 1;
/// Safety of an error that is told from two settings, as in the grid convergence index.
const SAFETY: f64 = 3.0;

/// What the numbers of a run are held against, all at the same positions but those of its own.
pub(super) struct Seen<'a> {
    pub file: &'a Gearbox,
    pub result: &'a GearboxResult,
    pub own: Sample,
    /// At the positions of the others.
    pub sparse: Sample,
    /// At every second position, and at every fourth one, from each that they may begin with.
    pub halved: Vec<Sample>,
    pub quartered: Vec<Sample>,
    /// On meshes of the ladder, and on those a rung coarser, with the least ratio of their numbers of elements.
    pub on_rungs: Sample,
    pub coarser: Sample,
    pub ratio: f64,
    /// With half the slices.
    pub fewer_slices: Sample,
    /// With half the shaft elements, where something vibrates: at rest these are exact.
    pub fewer_elements: Option<Sample>,
    /// Laws of the pairs of the meshes.
    pub pairs: Vec<OfPair>,
}

/// Causes of errors of a gearbox, in the order of tables.
const CAUSES: [Cause; 6] =
    [Cause::Mesh, Cause::Slices, Cause::Positions, Cause::ShaftElements, Cause::Interpolation, Cause::Iteration];

/// Error that is left where a number changes by `d` when elements, or distances, become `ratio` times smaller. Theory (67a).
///
/// ```text
/// e = S |d| / (r^p - 1),   S = 3: the grid convergence index of two grids (Roache 1994), p the order
/// ```
fn left(d: f64, ratio: f64, order: i32) -> f64 {
    SAFETY * d.abs() / (ratio.powi(order) - 1.0)
}

impl Seen<'_> {
    /// Bounds of all values, compared with the requested accuracy.
    pub fn bounds(&self) -> Vec<Bound> {
        let asked = &self.file.accuracy;
        let all = self.own.all().filter(|(_, value)| value.is_finite());
        all.map(|(which, value)| {
            let (terms, uncalibrated) = self.terms(which, value);
            let own = Bound { uncalibrated, ..Bound::new(which.quantity, value, terms) };
            own.of(which.name(self.file)).against(asked.of(which.quantity))
        })
        .collect()
    }

    /// Parts of the bound of a value: by laws of pairs, or by what is wider, of which errors of gearboxes like this one fill a
    /// share. Theory (67c). Beside them the sum of the amounts without that share.
    fn terms(&self, which: Which, value: f64) -> (Vec<Term>, f64) {
        let covered = GearboxCalibration::covers(self.file);
        let factor = if covered { GearboxCalibration::committed().factor(which.quantity) } else { 1.0 };
        let mut uncalibrated = 0.0;
        let is_largest = matches!(which.quantity, Quantity::PeakToPeakSte | Quantity::MaxPressure);
        let term = |cause| {
            let law = self.law(which, value, cause);
            // What positions miss of a largest value is just what its law is about, and sharper.
            let is_known = law.is_some() && is_largest && cause == Cause::Positions;
            let seen = if is_known { 0.0 } else { self.seen(which, value, cause) };
            let [known, law] = law.unwrap_or_default();
            let whole = crate::worse(law, seen);
            uncalibrated += whole;
            // Where laws are stretched to a pair unlike those of their calibration, gearboxes know better.
            let least = if self.is_calibrated(which) { law } else { 0.0 };
            Term { cause, known, amount: crate::worse(least, factor * whole) }
        };
        (CAUSES.map(term).to_vec(), uncalibrated)
    }

    /// What differences between settings say of a cause.
    ///
    /// Positions: a difference may be small by chance, so the largest of all halves and quarters counts.
    fn seen(&self, which: Which, value: f64, cause: Cause) -> f64 {
        let of = |sample: &Sample| sample.get(which);
        let worst_of_pairs = |cause: Cause| {
            let share = |own: &OfPair| {
                let stiffness = bound(own, Quantity::MeshStiffness)?;
                Some(stiffness.by(cause) / stiffness.value.abs())
            };
            self.pairs.iter().filter_map(share).fold(0.0, f64::max)
        };
        match cause {
            Cause::Mesh => {
                let given = (of(&self.on_rungs) - of(&self.sparse)).abs();
                given + left(of(&self.on_rungs) - of(&self.coarser), self.ratio, ORDER)
            }
            Cause::Slices => left(of(&self.sparse) - of(&self.fewer_slices), 2.0, ORDER),
            Cause::Positions => {
                let worst = |all: &[Sample], ratio: f64| {
                    let one = |own: &Sample| left(value - of(own), ratio, ORDER_OF_POSITIONS);
                    all.iter().map(one).fold(0.0, crate::worse)
                };
                crate::worse(worst(&self.halved, 2.0), worst(&self.quartered, 4.0))
            }
            Cause::ShaftElements => {
                let fewer = self.fewer_elements.as_ref().filter(|_| which.quantity == Quantity::NaturalFrequency);
                fewer.map_or(0.0, |fewer| left(of(&self.sparse) - of(fewer), 2.0, ORDER))
            }
            Cause::Interpolation => worst_of_pairs(cause) * value.abs(),
            _ => self.result.certificate[0] * value.abs(),
        }
    }

    /// Whether the pairs that a number goes with are like those of their calibration.
    fn is_calibrated(&self, which: Which) -> bool {
        let own = |pair: &OfPair| pair.as_ref().is_ok_and(|own| own.is_calibrated);
        match which.quantity {
            Quantity::NaturalFrequency => self.pairs.iter().all(own),
            _ => self.pairs.get(which.place).is_some_and(own),
        }
    }

    /// What laws of pairs say of a cause: known part and amount; `None` where they say nothing.
    ///
    /// An error of the teeth's compliance is one of their transmission error whatever stands in series with them, so its
    /// amount holds in the gearbox; of the pressure its share holds. A natural frequency is off by half of what the
    /// stiffness of each mesh is, times the share of strain energy in it.
    fn law(&self, which: Which, value: f64, cause: Cause) -> Option<[f64; 2]> {
        let of_pair = |quantity: Quantity, scale: &dyn Fn(&Bound) -> f64| {
            let own = bound(&self.pairs[which.place], quantity)?;
            let term = own.terms.iter().find(|term| term.cause == cause)?;
            Some([term.known, term.amount].map(|x| scale(own) * x))
        };
        match which.quantity {
            Quantity::MeanSte | Quantity::PeakToPeakSte => of_pair(which.quantity, &|_| 1.0),
            Quantity::MaxPressure => of_pair(which.quantity, &|own| value / own.value),
            Quantity::NaturalFrequency => self.frequency(cause).map(|share| [0.0, share * value]),
            _ => None,
        }
    }

    /// What errors of the mesh stiffnesses make of the lowest natural frequency, over itself. Theory (67b).
    fn frequency(&self, cause: Cause) -> Option<f64> {
        let (_, shares) = lowest(self.result.vibration.as_ref()?)?;
        let of = |(own, share): (&OfPair, f64)| {
            let stiffness = bound(own, Quantity::MeshStiffnessTangent)?;
            Some(0.5 * share * stiffness.by(cause) / stiffness.value.abs())
        };
        Some(self.pairs.iter().zip(shares).filter_map(of).sum())
    }

    /// Effects that the bounds do not cover, one text each.
    pub fn not_covered(&self) -> Vec<String> {
        let mut all: Vec<String> = Vec::new();
        let mut known = BTreeSet::new();
        for (mesh, own) in self.file.meshes.iter().zip(&self.pairs) {
            let lines = match own {
                Ok(own) => own.not_covered.clone(),
                Err(why) => vec![format!("laws of pairs, whose pair does not stand alone: {why}")],
            };
            for line in lines {
                // What is said of every pair is said once.
                let everywhere =
                    self.pairs.iter().all(|own| own.as_ref().is_ok_and(|own| own.not_covered.contains(&line)));
                let line = if everywhere { line } else { format!("mesh {}: {line}", mesh.name) };
                if known.insert(line.clone()) {
                    all.push(line);
                }
            }
        }
        if !GearboxCalibration::covers(self.file) {
            all.push(
                "gearboxes of other than one external mesh: bounds of misalignment, face load factor, bearing force and \
                 natural frequency are differences between settings, times what the grid convergence index says"
                    .into(),
            );
        }
        all.push("shafts, bearings and housing as they are given".into());
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of a number whose error falls with the order p, the bound is three times the error, for any ratio of sizes.
    #[test]
    fn the_bound_is_three_times_an_error_of_its_order() {
        for (order, fine, coarse) in [(2, 6.0f64, 4.0f64), (2, 3.0, 2.0), (1, 32.0, 16.0), (1, 32.0, 8.0)] {
            let error = |n: f64| -0.4 / n.powi(order);
            let bound = left(error(fine) - error(coarse), fine / coarse, order);
            assert!((bound / error(fine).abs() - 3.0).abs() < 1e-12, "{bound} beside {}", error(fine));
        }
        assert!(left(f64::NAN, 2.0, 2).is_nan(), "what is not known is not kept");
    }
}
