//! What all loads of a spectrum together do to the places of flanks and fillets, by stresses solved under each of them.

use geometry::GearPair;
use rating::{Cycles, RatedLoad, RatedSpectrum, StandardRating, local_contact_stress, miner_safety, miner_sum};
use serde::Serialize;
use study::FlankPattern;

use crate::{results::diameter, solved_load::SolvedLoad};

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

/// The worst place of a flank, and all of them.
struct DamagedFlank {
    worst: f64,
    at: FlankPlace,
    safety: f64,
    all: Vec<f64>,
}

impl LocalDamage {
    /// Of a spectrum whose loads are all solved, with pressures on the flanks; `None` otherwise.
    pub(crate) fn of(
        (standard, spectrum): (&StandardRating, &RatedSpectrum),
        loads: &[SolvedLoad],
        pair: &GearPair,
    ) -> Option<Self> {
        let under: Vec<&SolvedLoad> =
            spectrum.loads().iter().map(|own| SolvedLoad::under(loads, &own.load)).collect::<Option<_>>()?;
        let flank = |gear: usize| {
            let grids: Option<Vec<&FlankPattern>> = under.iter().map(|own| Some(&own.flanks.as_ref()?[gear])).collect();
            let base = [&pair.pinion, &pair.wheel][gear].base_radius();
            DamagedFlank::of((standard, spectrum), gear, &grids?, base)
        };
        let flanks = [flank(0)?, flank(1)?];
        let root = |gear: usize| -> Option<Vec<Cycles>> {
            let tensions: Vec<f64> = under.iter().map(|own| Some(own.root_tensions?[gear])).collect::<Option<_>>()?;
            let mut tensions = tensions.into_iter();
            Some(spectrum.cycles(gear, |own| tensions.next().unwrap_or(f64::NAN) * load_factor(own)))
        };
        let roots = root(0).zip(root(1)).map(<[Vec<Cycles>; 2]>::from);
        let gears = standard.gears();
        let of_roots = |number: fn(&rating::StressLife, &[Cycles]) -> f64| {
            roots.as_ref().map(|both| [0, 1].map(|i| number(&gears[i].bending_curve, &both[i])))
        };
        Some(Self {
            pitting_damage: flanks.each_ref().map(|own| own.worst),
            pitting_damage_at: flanks.each_ref().map(|own| own.at),
            pitting_safety: flanks.each_ref().map(|own| own.safety),
            bending_damage: of_roots(miner_sum),
            bending_safety: of_roots(miner_safety),
            flanks: flanks.map(|own| own.all),
        })
    }
}

impl DamagedFlank {
    /// `grids`: largest pressures under each load that works, in their order.
    fn of(
        (standard, spectrum): (&StandardRating, &RatedSpectrum),
        gear: usize,
        grids: &[&FlankPattern],
        base_radius: f64,
    ) -> Option<Self> {
        let (helix, curve) = (standard.helix_angle_factor, &standard.gears()[gear].pitting_curve);
        let cycles = |cell: usize| {
            let mut grids = grids.iter();
            spectrum.cycles(gear, |own| {
                let pressure = grids.next().map_or(f64::NAN, |grid| grid.max_pressure()[cell]);
                local_contact_stress(pressure, helix, load_factor(own))
            })
        };
        let grid = grids.first()?;
        let all: Vec<f64> = (0..grid.max_pressure().len()).map(|cell| miner_sum(curve, &cycles(cell))).collect();
        // Where nothing is damaged the place that is pressed hardest comes nearest to it.
        let hardest = |cell: usize| cycles(cell).iter().map(|(_, stress)| *stress).fold(0.0, f64::max);
        let worst = match all.iter().any(|sum| *sum > 0.0) {
            true => (0..all.len()).reduce(|best, cell| if all[cell] > all[best] { cell } else { best })?,
            false => (0..all.len()).reduce(|best, cell| if hardest(cell) > hardest(best) { cell } else { best })?,
        };
        let (rolls, stations) = (grid.rolls(), grid.stations());
        let at = FlankPlace {
            diameter_mm: diameter(base_radius, rolls[worst % rolls.len()]),
            z_mm: stations[worst / rolls.len()],
        };
        Some(Self { worst: all[worst], at, safety: miner_safety(curve, &cycles(worst)), all })
    }
}

/// K_A K_V of a load.
fn load_factor(own: &RatedLoad) -> f64 {
    own.rating.application_factor * own.rating.dynamic_factor
}
