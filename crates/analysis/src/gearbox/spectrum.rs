//! A gearbox under every load of a spectrum: what the rating of each mesh and the life of each bearing read of it.

use std::collections::BTreeMap;

use gearbox::{GearboxPosition, MeshState, Operation, Torque};
use rating::{LoadBin, Spectrum};

use super::{
    bearings::{BearingTurns, LifeLimits, rolling_load},
    mesh_numbers::MeshNumbers,
    meshes::ReducedMesh,
    solved_positions::{at_all_angles, count},
    vibration::Parts,
};
use crate::{AnalysisError, Observer, PhaseWork, run_phase};

/// A mesh under a load.
#[derive(Debug, Clone, Copy)]
struct MeshLoad {
    /// Mean torque on the driven gear, N m without sign.
    torque_nm: f64,
    /// K_Hbeta of the solved distribution of the load.
    face_load_factor: Option<f64>,
}

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
    /// Meshes under each load, in their order.
    meshes: Vec<Vec<MeshLoad>>,
    bearings: Vec<BearingUse>,
}

impl SolvedSpectrum {
    /// Solves the gearbox under each torque of a spectrum; all torques go with the first one.
    ///
    /// # Errors
    /// [`AnalysisError`] as the equilibrium under one of them.
    pub fn new(
        parts: &Parts<'_>,
        spectrum: &Spectrum,
        reduced: &[ReducedMesh],
        observer: &mut dyn Observer,
    ) -> Result<Self, AnalysisError> {
        // Speeds change nothing at rest: each torque is solved once. Bits of numbers above 0 are in their order.
        let mut torques: BTreeMap<u64, Vec<usize>> = BTreeMap::new();
        for (k, bin) in spectrum.bins().iter().enumerate().filter(|(_, bin)| bin.works()) {
            torques.entry(bin.torque_nm.to_bits()).or_default().push(k);
        }
        let none = MeshLoad { torque_nm: 0.0, face_load_factor: None };
        let mut all = Self {
            loads: spectrum.clone(),
            meshes: vec![vec![none; parts.meshes.len()]; spectrum.bins().len()],
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
                for &k in bins {
                    all.take(k, parts, reduced, &positions);
                }
            }
            Ok(all)
        })
    }

    /// Takes a load with the positions under it.
    fn take(&mut self, k: usize, parts: &Parts<'_>, reduced: &[ReducedMesh], positions: &[GearboxPosition]) {
        let bin = self.loads.bins()[k];
        for (i, (own, mesh)) in self.meshes[k].iter_mut().zip(reduced).enumerate() {
            let driven = mesh.options.driven();
            let moment = |p: &GearboxPosition| -> f64 {
                let MeshState { moment, .. } = &p.meshes[i];
                moment[driven][2]
            };
            let mean = positions.iter().map(moment).sum::<f64>() / positions.len().max(1) as f64;
            let numbers = MeshNumbers::of(positions, i, mesh.options.contact.slices);
            *own = MeshLoad { torque_nm: 1e-3 * mean.abs(), face_load_factor: numbers.face_load_factor };
        }
        for (i, own) in self.bearings.iter_mut().enumerate() {
            let (file, law) = (&parts.file.bearings[i], &parts.structure.bearings[i]);
            let turns = BearingTurns::of((parts.file, parts.train), i, bin.speed_rpm);
            let Some(load) = rolling_load(file, law, positions, (i, turns)) else { continue };
            own.limits = own.limits.worse(LifeLimits::of(&load));
            own.per_hour += load.life.and_then(|life| life.rated_hours()).map_or(0.0, |hours| bin.share / hours);
        }
    }

    /// Loads of a mesh: torque on its driven gear, speed of its driver, K_Hbeta unless the scene states one.
    pub fn of_mesh(&self, mesh: usize, (speed_ratio, is_stated): (f64, bool)) -> Spectrum {
        let mut loads = self.meshes.iter().map(|all| all[mesh]);
        self.loads.with_loads(|bin| {
            let own = loads.next();
            LoadBin {
                torque_nm: own.map_or(0.0, |own| own.torque_nm),
                speed_rpm: bin.speed_rpm * speed_ratio,
                face_load_factor: own.and_then(|own| own.face_load_factor).filter(|_| !is_stated),
                ..*bin
            }
        })
    }

    /// The worst that formulas of lives meet at a bearing.
    pub fn limits(&self, bearing: usize) -> LifeLimits {
        self.bearings[bearing].limits
    }

    /// Life of a bearing, h.
    ///
    /// ```text
    /// 1/L = sum q_k/L_k,   q_k: share of the life with load k, L_k: life under it alone, h
    /// ```
    /// `None` where it has none, where some load has none, or where it does not tire. Source: Palmgren-Miner; theory (101e).
    pub fn bearing_life_h(&self, bearing: usize) -> Option<f64> {
        let own = self.bearings[bearing];
        (own.per_hour > 0.0 && !own.limits.lacks_film).then(|| 1.0 / own.per_hour)
    }
}
