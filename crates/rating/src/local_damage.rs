//! What all loads of a spectrum together do to the places of flanks and fillets, by stresses solved under each of them.

use serde::Serialize;

use crate::{Cycles, RatedLoad, RatedSpectrum, StressLife, local_contact_stress, miner_safety, miner_sum};

described::described! {
    /// Place of a flank.
    #[derive(Debug, Clone, Copy, PartialEq, Serialize)]
    pub struct FlankPlace {
        /// diameter of the gear there
        pub diameter_mm: f64,
        /// height from the gear's mid-face
        pub z_mm: f64,
    }
}

described::described! {
    /// Damage over the life by stresses that are solved under each load; units are in the names, pairs are pinion and wheel.
    #[derive(Debug, Clone, PartialEq, Serialize)]
    pub struct LocalDamage {
        /// largest Miner's sum for pitting of all places of the driving flank. At a place each load counts with the largest pressure that it puts there, times Z_beta and the root of K_A K_V of that load
        pub pitting_damage: [f64; 2],
        /// place with that sum
        pub pitting_damage_at: [FlankPlace; 2],
        /// factor on all pressures that makes the sum of that place 1
        pub pitting_safety: [f64; 2],
        /// Miner's sum for tooth root breakage, each load with the largest first principal stress in the fillets under it, wherever that is, times K_A K_V of the load; missing without root stress
        #[serde(skip_serializing_if = "Option::is_none")]
        pub bending_damage: Option<[f64; 2]>,
        /// factor on all root stresses that makes that sum 1; missing without root stress
        #[serde(skip_serializing_if = "Option::is_none")]
        pub bending_safety: Option<[f64; 2]>,
        /// Miner's sum for pitting of every place, in the order of the contact pattern.
        #[serde(skip)]
        pub flanks: [Vec<f64>; 2],
    }
}

/// Solved stresses of pinion and wheel under a load.
#[derive(Debug, Clone, Copy)]
pub struct SolvedStress<'a> {
    /// Largest pressures on the places of their flanks, MPa.
    pub pressures: [&'a [f64]; 2],
    /// Largest first principal stresses in their fillets, MPa; `None` where they are not computed.
    pub tensions: Option<[f64; 2]>,
}

/// The worst place of a flank, and all of them.
struct DamagedFlank {
    worst: usize,
    safety: f64,
    all: Vec<f64>,
}

impl LocalDamage {
    /// Damage by the stresses under each load that works, in the order of [`RatedSpectrum::loads`]; `place` of a gear and the number of a place. `None` where there are fewer stresses than loads, or no places.
    pub fn new(
        spectrum: &RatedSpectrum,
        under: &[SolvedStress<'_>],
        place: impl Fn(usize, usize) -> FlankPlace,
    ) -> Option<Self> {
        if under.len() != spectrum.loads().len() {
            return None;
        }
        let flanks = [DamagedFlank::of(spectrum, under, 0)?, DamagedFlank::of(spectrum, under, 1)?];
        let tensions: Option<Vec<[f64; 2]>> = under.iter().map(|own| own.tensions).collect();
        let roots = |number: fn(&StressLife, &[Cycles]) -> f64| {
            let tensions = tensions.as_ref()?;
            let of = |gear: usize| {
                let stresses = spectrum.loads().iter().zip(tensions).map(|(own, both)| both[gear] * load_factor(own));
                number(&spectrum.nominal().gears()[gear].bending_curve, &spectrum.cycles(gear, stresses))
            };
            Some([of(0), of(1)])
        };
        Some(Self {
            pitting_damage: flanks.each_ref().map(|own| own.all[own.worst]),
            pitting_damage_at: [0, 1].map(|gear| place(gear, flanks[gear].worst)),
            pitting_safety: flanks.each_ref().map(|own| own.safety),
            bending_damage: roots(miner_sum),
            bending_safety: roots(miner_safety),
            flanks: flanks.map(|own| own.all),
        })
    }
}

impl DamagedFlank {
    fn of(spectrum: &RatedSpectrum, under: &[SolvedStress<'_>], gear: usize) -> Option<Self> {
        let curve = &spectrum.nominal().gears()[gear].pitting_curve;
        let helix = spectrum.nominal().helix_angle_factor;
        let cycles = |cell: usize| {
            let loads = spectrum.loads().iter().zip(under);
            let stress = |(own, solved): (&RatedLoad, &SolvedStress<'_>)| {
                local_contact_stress(solved.pressures[gear][cell], helix, load_factor(own))
            };
            spectrum.cycles(gear, loads.map(stress))
        };
        let places = under.iter().map(|own| own.pressures[gear].len()).min()?;
        let all: Vec<f64> = (0..places).map(|cell| miner_sum(curve, &cycles(cell))).collect();
        // Where nothing is damaged the place that is pressed hardest comes nearest to it.
        let hardest = |cell: usize| cycles(cell).iter().map(|(_, stress)| *stress).fold(0.0, f64::max);
        let worst = match all.iter().any(|sum| *sum > 0.0) {
            true => (0..places).reduce(|best, cell| if all[cell] > all[best] { cell } else { best })?,
            false => (0..places).reduce(|best, cell| if hardest(cell) > hardest(best) { cell } else { best })?,
        };
        Some(Self { worst, safety: miner_safety(curve, &cycles(worst)), all })
    }
}

/// K_A K_V of a load.
fn load_factor(own: &RatedLoad) -> f64 {
    own.rating.application_factor * own.rating.dynamic_factor
}
