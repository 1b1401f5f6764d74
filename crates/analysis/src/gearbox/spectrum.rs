//! A gearbox under every load of a spectrum: the inputs of each mesh rating and each bearing life.

use std::collections::BTreeMap;

use gearbox::{GearboxPosition, MeshBears, MeshState, Operation, Torque};
use rating::{LoadBin, Spectrum};

use super::{
    bearings::{BearingTurns, LifeLimits, rolling_load},
    meshes::ReducedMesh,
    solved_positions::{at_all_angles, count},
    vibration::Parts,
};
use crate::{AnalysisError, Observer, PhaseWork, run_phase, solved_load::SolvedLoad};

/// What all loads together do to a bearing.
#[derive(Debug, Clone, Copy, Default)]
struct BearingUse {
    /// Sum over all loads of their share over the life under them, 1/h.
    per_hour: f64,
    /// The worst that formulas of lives meet.
    limits: LifeLimits,
}

/// What is left of the gearbox under all loads.
#[derive(Debug)]
pub(super) struct SolvedSpectrum {
    loads: Spectrum,
    /// Meshes under each torque of the spectrum, in their order.
    meshes: Vec<Vec<SolvedLoad>>,
    /// Torque of each load among these; `None` of loads that do not work.
    torques: Vec<Option<usize>>,
    bearings: Vec<BearingUse>,
}

impl SolvedSpectrum {
    /// Solves the gearbox under each torque of a spectrum; all torques are proportional to the first one.
    ///
    /// # Errors
    /// The [`AnalysisError`] of the equilibrium under one of them.
    pub fn new(
        parts: &Parts<'_>,
        spectrum: &Spectrum,
        reduced: &[ReducedMesh],
        observer: &mut dyn Observer,
    ) -> Result<Self, AnalysisError> {
        // Speeds change nothing at rest: each torque is solved once. Bits of numbers above 0 are in their order.
        let mut torques: BTreeMap<u64, Vec<usize>> = BTreeMap::new();
        let spectrum = &spectrum.without_light(1e-3 * parts.file.torques[0].torque);
        for (k, bin) in spectrum.bins().iter().enumerate().filter(|(_, bin)| bin.works()) {
            torques.entry(bin.torque_nm.to_bits()).or_default().push(k);
        }
        let mut all = Self {
            loads: spectrum.clone(),
            meshes: parts.meshes.iter().map(|_| Vec::new()).collect(),
            torques: vec![None; spectrum.bins().len()],
            bearings: vec![BearingUse::default(); parts.file.bearings.len()],
        };
        let work = PhaseWork::Steps(u64::from(count(parts.file)) * torques.len() as u64);
        run_phase(observer, "load spectrum", work, |progress| {
            for (torque, bins) in &torques {
                let share = 1e3 * f64::from_bits(*torque) / parts.file.torques[0].torque;
                let scaled = |own: &Torque| Torque { torque: share * own.torque, ..*own };
                let torques = parts.operation.torques.iter().map(scaled).collect();
                let operation = Operation { torques, ..parts.operation.clone() };
                let told = |e: AnalysisError| e.of_part(format!("the load of {} N m", f64::from_bits(*torque)));
                let under = Parts { operation: &operation, ..*parts };
                let (positions, _) = at_all_angles(&under, reduced, progress).map_err(told)?;
                let solved = all.meshes.first().map_or(0, Vec::len);
                all.take_meshes(parts, reduced, &positions).map_err(told)?;
                for &k in bins {
                    all.torques[k] = Some(solved);
                    all.take_bearings(k, parts, &positions);
                }
            }
            Ok(all)
        })
    }

    /// Takes what the positions under a torque say of the meshes.
    fn take_meshes(
        &mut self,
        parts: &Parts<'_>,
        reduced: &[ReducedMesh],
        positions: &[GearboxPosition],
    ) -> Result<(), AnalysisError> {
        let bears = MeshBears::of(positions);
        for (i, (own, mesh)) in self.meshes.iter_mut().zip(reduced).enumerate() {
            let states: Vec<&MeshState> = positions.iter().map(|p| &p.meshes[i]).collect();
            let torque = 1e-3 * bears.mean(i, mesh.options.driven()).abs();
            own.push(SolvedLoad::of_mesh(&mesh.scene, &parts.meshes[i].pair, (torque, &states))?);
        }
        Ok(())
    }

    /// Takes what the positions under a load say of the bearings.
    fn take_bearings(&mut self, k: usize, parts: &Parts<'_>, positions: &[GearboxPosition]) {
        let bin = self.loads.bins()[k];
        for (i, own) in self.bearings.iter_mut().enumerate() {
            let (file, law) = (&parts.file.bearings[i], &parts.structure.bearings[i]);
            let turns = BearingTurns::of((parts.file, parts.train), i, bin.speed_rpm);
            let Some(load) = rolling_load(file, law, positions, (i, turns)) else { continue };
            own.limits = own.limits.worse(LifeLimits::of(&load));
            own.per_hour += load.life.and_then(|life| life.rated_hours()).map_or(0.0, |hours| bin.share / hours);
        }
    }

    /// Loads of a mesh (torque on its driven gear, speed of its driver), and the solutions under them.
    pub fn of_mesh(&self, mesh: usize, speed_ratio: f64) -> (Spectrum, &[SolvedLoad]) {
        let solved = &self.meshes[mesh][..];
        let mut torques = self.torques.iter().map(|own| own.map_or(0.0, |own| solved[own].torque_nm));
        let loads = self.loads.with_loads(|bin| LoadBin {
            torque_nm: torques.next().unwrap_or(0.0),
            speed_rpm: bin.speed_rpm * speed_ratio,
            ..*bin
        });
        (loads, solved)
    }

    /// Worst values that the life formulas of a bearing receive.
    pub fn limits(&self, bearing: usize) -> LifeLimits {
        self.bearings[bearing].limits
    }

    /// Life of a bearing, h.
    ///
    /// ```text
    /// 1/L = sum q_k/L_k,   q_k: share of the life with load k, L_k: life under it alone, h
    /// ```
    /// `None` if it has none, if a load has none, or if the bearing does not fatigue. Source: Palmgren-Miner; theory
    /// (101e).
    pub fn bearing_life_h(&self, bearing: usize) -> Option<f64> {
        let own = self.bearings[bearing];
        (own.per_hour > 0.0 && !own.limits.lacks_film).then(|| 1.0 / own.per_hour)
    }
}
