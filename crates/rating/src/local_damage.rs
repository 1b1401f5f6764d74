//! What all loads of a spectrum together do to the places of flanks and fillets, by stresses solved under each of them.

use serde::Serialize;

use crate::{RatedLoad, RatedSpectrum, StressLife, local_contact_stress, miner_safety, miner_sum};

described::described! {
    /// Place of a flank or a fillet.
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
        /// largest Miner's sum for tooth root breakage of all points of the loaded fillet. At a point each load counts with the largest first principal stress that it puts there, times K_A K_V of that load; missing without root stress
        #[serde(skip_serializing_if = "Option::is_none")]
        pub bending_damage: Option<[f64; 2]>,
        /// point with that sum; missing without root stress
        #[serde(skip_serializing_if = "Option::is_none")]
        pub bending_damage_at: Option<[FlankPlace; 2]>,
        /// factor on all root stresses that makes the sum of that point 1; missing without root stress
        #[serde(skip_serializing_if = "Option::is_none")]
        pub bending_safety: Option<[f64; 2]>,
        /// Miner's sum for pitting of every place, in the order of the contact pattern.
        #[serde(skip)]
        pub flanks: [Vec<f64>; 2],
        /// Miner's sum for tooth root breakage of every point of the fillets.
        #[serde(skip)]
        pub roots: Option<[Vec<f64>; 2]>,
    }
}

/// Solved stresses of pinion and wheel under a load.
#[derive(Debug, Clone, Copy)]
pub struct SolvedStress<'a> {
    /// Largest pressures on the places of their flanks, MPa.
    pub pressures: [&'a [f64]; 2],
    /// Largest first principal stresses at the points of their fillets, MPa; `None` where they are not computed.
    pub tensions: Option<[&'a [f64]; 2]>,
}

/// The worst place of a flank or a fillet, and all of them.
struct Damaged {
    worst: usize,
    safety: f64,
    all: Vec<f64>,
}

impl LocalDamage {
    /// Damage by the stresses under each load that works, in the order of [`RatedSpectrum::loads`]; `place` and `root`: of a gear and the number of a place on its flanks, and of a point of its fillets. `None` where there are fewer stresses than loads, or no places.
    pub fn new(
        spectrum: &RatedSpectrum,
        under: &[SolvedStress<'_>],
        place: impl Fn(usize, usize) -> FlankPlace,
        root: impl Fn(usize, usize) -> FlankPlace,
    ) -> Option<Self> {
        if under.len() != spectrum.loads().len() {
            return None;
        }
        let helix = spectrum.nominal().helix_angle_factor;
        let flank = |gear: usize| {
            let stress = |own: &RatedLoad, pressure: f64| local_contact_stress(pressure, helix, load_factor(own));
            let all: Vec<&[f64]> = under.iter().map(|own| own.pressures[gear]).collect();
            Damaged::of(spectrum, &all, gear, &spectrum.nominal().gears()[gear].pitting_curve, stress)
        };
        let flanks = [flank(0)?, flank(1)?];
        let tensions: Option<Vec<[&[f64]; 2]>> = under.iter().map(|own| own.tensions).collect();
        let fillet = |gear: usize| {
            let all: Vec<&[f64]> = tensions.as_ref()?.iter().map(|both| both[gear]).collect();
            let stress = |own: &RatedLoad, tension: f64| tension.max(0.0) * load_factor(own);
            Damaged::of(spectrum, &all, gear, &spectrum.nominal().gears()[gear].bending_curve, stress)
        };
        let roots = fillet(0).zip(fillet(1)).map(|(pinion, wheel)| [pinion, wheel]);
        let of_roots = |number: fn(&Damaged) -> f64| roots.as_ref().map(|both| both.each_ref().map(number));
        Some(Self {
            pitting_damage: flanks.each_ref().map(|own| own.all[own.worst]),
            pitting_damage_at: [0, 1].map(|gear| place(gear, flanks[gear].worst)),
            pitting_safety: flanks.each_ref().map(|own| own.safety),
            bending_damage: of_roots(|own| own.all[own.worst]),
            bending_damage_at: roots.as_ref().map(|both| [0, 1].map(|gear| root(gear, both[gear].worst))),
            bending_safety: of_roots(|own| own.safety),
            flanks: flanks.map(|own| own.all),
            roots: roots.map(|both| both.map(|own| own.all)),
        })
    }
}

impl Damaged {
    /// Of the places of a gear by a curve; `stresses`: what each load puts on each place, `counted`: with the factors of the load, MPa.
    fn of(
        spectrum: &RatedSpectrum,
        stresses: &[&[f64]],
        gear: usize,
        curve: &StressLife,
        counted: impl Fn(&RatedLoad, f64) -> f64,
    ) -> Option<Self> {
        let cycles = |at: usize| {
            let loads = spectrum.loads().iter().zip(stresses);
            spectrum.cycles(gear, loads.map(|(own, all)| counted(own, all[at])))
        };
        let places = stresses.iter().map(|own| own.len()).min()?;
        let all: Vec<f64> = (0..places).map(|at| miner_sum(curve, &cycles(at))).collect();
        // Where nothing is damaged the place with the largest stress comes nearest to it.
        let hardest = |at: usize| cycles(at).iter().map(|(_, stress)| *stress).fold(0.0, f64::max);
        let worst = match all.iter().any(|sum| *sum > 0.0) {
            true => (0..places).reduce(|best, at| if all[at] > all[best] { at } else { best })?,
            false => (0..places).reduce(|best, at| if hardest(at) > hardest(best) { at } else { best })?,
        };
        Some(Self { worst, safety: miner_safety(curve, &cycles(worst)), all })
    }
}

/// K_A K_V of a load.
fn load_factor(own: &RatedLoad) -> f64 {
    own.rating.application_factor * own.rating.dynamic_factor
}
