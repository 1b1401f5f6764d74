//! Root stress in the result files: largest values, their teeth, and positions.

use gearbox::MeshState;
use geometry::Side;
use ltca::{
    FilletField, FilletStress, ROOT_STRESS_DEFINITION, ROOT_STRESS_RECOVERY, RootPattern, StaticHistory,
    StaticPosition, StressPeak,
};
use serde::Serialize;

described::described! {
    /// Largest root stresses of a run; units are in the names.
    #[derive(Debug, Clone, PartialEq, Serialize)]
    pub struct RootStressHeadline {
        /// definition of root stress
        pub definition: &'static str,
        /// method by which it is recovered from the elements
        pub averaging: &'static str,
        /// largest root stresses of the pinion
        pub pinion: GearRootStress,
        /// largest root stresses of the wheel
        pub wheel: GearRootStress,
    }
}

described::described! {
    /// Largest root stresses of one gear over all positions.
    #[derive(Debug, Clone, Copy, PartialEq, Serialize)]
    pub struct GearRootStress {
        /// largest first principal stress (tension) of all positions
        pub max_principal: Place,
        /// smallest third principal stress (compression, negative)
        pub min_principal: Place,
        /// largest von Mises stress
        pub von_mises: Place,
    }
}

described::described! {
    /// A stress with the place and the position where it is found.
    #[derive(Debug, Clone, Copy, PartialEq, Serialize)]
    pub struct Place {
        /// the stress
        pub stress_mpa: f64,
        /// estimated distance from the stress of an infinitely fine mesh, as in the column of `history.csv`
        pub estimated_error_percent: f64,
        /// number of the tooth, from 0
        pub tooth: u32,
        /// side of the tooth whose fillet it is
        pub side: Side,
        /// distance from the gear's axis
        pub radius_mm: f64,
        /// height from the gear's mid-face
        pub z_mm: f64,
        /// node: the tag of the mesh file; 1, 2, .. of the built-in mesher; of a periodic sector the number in the sector
        pub node: u64,
        /// angle of the pinion at that position
        pub pinion_angle_deg: f64,
        /// phase of the mesh cycle at that position
        pub mesh_phase: f64,
    }
}

/// A stress measure in a fillet; its sign tells which extreme is the worst.
#[derive(Debug, Clone, Copy)]
pub struct Measure {
    /// Name as in column names.
    pub name: &'static str,
    sign: f64,
    peak: fn(&FilletStress) -> &StressPeak,
}

/// Largest first principal stress, tension.
pub const MAX_PRINCIPAL: Measure = Measure { name: "max_principal", sign: 1.0, peak: |f| &f.max_principal };
/// Least third principal stress, compression.
pub const MIN_PRINCIPAL: Measure = Measure { name: "min_principal", sign: -1.0, peak: |f| &f.min_principal };
/// Largest von Mises stress.
pub const VON_MISES: Measure = Measure { name: "von_mises", sign: 1.0, peak: |f| &f.von_mises };

impl Measure {
    /// The worst of some fillets: of which both recoveries see most.
    fn worst<'a>(&self, fillets: impl Iterator<Item = &'a FilletStress>) -> Option<&'a FilletStress> {
        let value = |f: &FilletStress| self.sign * (self.peak)(f).seen();
        fillets.reduce(|best, f| if value(f) > value(best) { f } else { best })
    }

    /// The worst value of several fillets, MPa; of one tooth if it is given. NaN if there is none.
    pub fn stress(&self, fillets: &[FilletStress], tooth: Option<u32>) -> f64 {
        let fillets = fillets.iter().filter(|f| tooth.is_none_or(|tooth| f.tooth == tooth));
        self.worst(fillets).map_or(f64::NAN, |f| (self.peak)(f).stress)
    }

    fn place(&self, history: &StaticHistory, gear: usize) -> Option<Place> {
        let worst_of = |p: &'_ StaticPosition| self.worst(p.root_stress[gear].iter()).copied();
        let all = history.positions.iter().filter_map(|p| Some((p, worst_of(p)?)));
        let value = |f: &FilletStress| self.sign * (self.peak)(f).stress;
        let (position, fillet) = all.reduce(|best, now| if value(&now.1) > value(&best.1) { now } else { best })?;
        let peak = (self.peak)(&fillet);
        Some(Place {
            stress_mpa: peak.stress,
            estimated_error_percent: 100.0 * peak.relative_error(),
            tooth: fillet.tooth,
            side: fillet.side,
            radius_mm: peak.radius,
            z_mm: peak.z,
            node: peak.node,
            pinion_angle_deg: position.pinion_angle.to_degrees(),
            mesh_phase: position.mesh_phase,
        })
    }
}

/// Estimated error of the largest tension of several fillets, %; NaN if there is none.
pub fn error_percent(fillets: &[FilletStress]) -> f64 {
    MAX_PRINCIPAL.worst(fillets.iter()).map_or(f64::NAN, |f| 100.0 * f.max_principal.relative_error())
}

/// Remarks about root stresses whose mesh is too coarse.
///
/// `largest` has the largest tension of pinion and wheel (MPa) and its estimated error (%).
pub fn root_stress_remarks(largest: [(f64, f64); 2]) -> impl Iterator<Item = answer::Remark> {
    ["pinion", "wheel"]
        .into_iter()
        .zip(largest)
        .filter(|(_, (_, error))| *error > DOUBTFUL_PERCENT)
        .map(|(gear, (stress, error))| crate::remark::root_stress_coarse(gear, stress, error))
}

/// From this estimate on the user is told, %.
pub(crate) const DOUBTFUL_PERCENT: f64 = 3.0;

/// Largest first principal stresses in the fillets of pinion and wheel over several positions, MPa; `None` if they are
/// not computed.
pub fn largest_tensions<'a>(positions: impl Iterator<Item = &'a [Vec<FilletStress>; 2]> + Clone) -> Option<[f64; 2]> {
    let of = |gear: usize| positions.clone().map(move |both| MAX_PRINCIPAL.stress(&both[gear], None));
    let known = |gear: usize| of(gear).filter(|stress| !stress.is_nan()).reduce(f64::max);
    Some([known(0)?, known(1)?])
}

/// The same of a mesh of a gearbox.
pub(crate) fn mesh_tensions(states: &[&MeshState]) -> Option<[f64; 2]> {
    let peaks: Vec<[Vec<FilletStress>; 2]> =
        states.iter().map(|own| own.root_stress.each_ref().map(|fillets| fillet_peaks(fillets))).collect();
    largest_tensions(peaks.iter())
}

/// Largest tensions at the points of the loaded fillets of a mesh of a gearbox; `None` without root stress.
pub(crate) fn mesh_roots(states: &[&MeshState], side: Side) -> Option<[RootPattern; 2]> {
    let mut both = <[RootPattern; 2]>::default();
    for state in states {
        both.iter_mut().zip(&state.root_stress).for_each(|(own, fields)| own.take(fields, side));
    }
    both.iter().all(|own| !own.places.is_empty()).then_some(both)
}

/// Peaks of the fillets of a mesh of a gearbox.
pub fn fillet_peaks(fillets: &[FilletField]) -> Vec<FilletStress> {
    fillets.iter().map(|own| own.peaks).collect()
}

/// Largest root stresses of a run with root stress.
pub fn root_stress_headline(history: &StaticHistory) -> Option<RootStressHeadline> {
    let gear = |i| {
        Some(GearRootStress {
            max_principal: MAX_PRINCIPAL.place(history, i)?,
            min_principal: MIN_PRINCIPAL.place(history, i)?,
            von_mises: VON_MISES.place(history, i)?,
        })
    };
    let (definition, averaging) = (ROOT_STRESS_DEFINITION, ROOT_STRESS_RECOVERY);
    Some(RootStressHeadline { definition, averaging, pinion: gear(0)?, wheel: gear(1)? })
}

impl RootStressHeadline {
    /// Largest tension (MPa) of pinion and wheel and its estimated error (%).
    pub fn largest_tensions(&self) -> [(f64, f64); 2] {
        [self.pinion, self.wheel].map(|g| (g.max_principal.stress_mpa, g.max_principal.estimated_error_percent))
    }
}
