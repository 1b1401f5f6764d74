//! Results of a gearbox over all positions.

use gearbox::mesh_numbers::{MeshNumbers, mean, mean_force, peak_to_peak};
use std::f64::consts::TAU;

use answer::Remark;
use gearbox::{GearMesh, GearboxPosition, LoadSharing, MeshState, Structure, Train};
use geometry::{GearPair, Side};
use scene::{
    Scene,
    gearbox::{Gearbox, GearboxBearing, GearboxMesh, PlanetMesh},
};

use super::{
    GearboxBranchResult, GearboxMotionResult, RollingLoad, RootBending, VibrationResult,
    bearings::{BearingTurns, LifeLimits, rolling_load},
    clearance::{clearance_remarks, play_remarks},
    meshes::ReducedMesh,
    root_bending::{self, root_bending},
    spectrum::SolvedSpectrum,
};
use crate::{
    accuracy::Accuracy,
    pair_rating::RatingHeadline,
    plausible::effective_modulus,
    results::{GearPattern, on_flank, pressed},
    solution_remarks::large_error,
    waves::waves_on,
};

/// Transmission error, in modules, from which on it is said to be large: shafts and bearings that give way are part of it.
const LARGE: f64 = 0.2;

/// Results of a static gearbox.
#[derive(Debug, Clone)]
pub struct GearboxResult {
    /// Rotations of each shaft in the frame of the carrier per rotation of the input; negative if opposite.
    pub ratios: Vec<f64>,
    /// Rotations of each shaft in space per rotation of the input.
    pub ratios_in_space: Vec<f64>,
    /// Pairs as they run, in the order of the meshes.
    pub pairs: Vec<GearPair>,
    /// Meshes.
    pub meshes: Vec<MeshResult>,
    /// Root fillets of each gear, the one with the larger tension first; `None` for gears without root stress in any
    /// mesh.
    pub root_bending: Vec<Option<[RootBending; 2]>>,
    /// Bearings.
    pub bearings: Vec<BearingLoad>,
    /// Outputs, in the order of the torques.
    pub outputs: Vec<OutputResult>,
    /// Load sharing of the planets in each mesh that they have in common ([`Gearbox::meshes_of_planets`]).
    pub planets: Vec<LoadSharing>,
    /// Largest tilt of the gear of each planet in such a mesh, rad.
    pub planet_tilts: Vec<Vec<f64>>,
    /// Mean torque at the input, N mm about +z.
    pub input_torque: f64,
    /// Worst values of all positions: residual, balance of bodies.
    pub certificate: [f64; 2],
    /// All positions.
    pub positions: Vec<GearboxPosition>,
    /// Vibration about these positions, if requested.
    pub vibration: Option<VibrationResult>,
    /// Remarks for the user.
    pub remarks: Vec<Remark>,
    /// Motion, if the file requests it.
    pub motion: Option<GearboxMotionResult>,
    /// Periodic motions over the speed, if the file requests them.
    pub branch: Option<GearboxBranchResult>,
    /// Accuracy of the static values, if the file requests it.
    pub accuracy: Option<Accuracy>,
    /// Parts of the rating that are available.
    pub rates: Rates,
    /// Power of all outputs at the speed of the ratings, W; 0 without one.
    pub output_power_w: f64,
}

impl GearboxResult {
    /// Output power divided by input power with the losses of meshes and rolling bearings, P/(P + losses). `None` if a
    /// loaded mesh has no loss, and without speed or load. Bearings that are springs have no loss.
    pub fn efficiency(&self) -> Option<f64> {
        let loss = |mesh: &MeshResult| match &mesh.rating {
            Some(rating) => rating.mesh_loss.map(|loss| loss.mesh_loss_w),
            None => (mesh.normal_force == 0.0).then_some(0.0),
        };
        let meshes = self.meshes.iter().map(loss).sum::<Option<f64>>()?;
        let bearings: f64 = self.bearings.iter().filter_map(|b| b.rolling.as_ref()?.loss_w).sum();
        (self.output_power_w > 0.0).then(|| self.output_power_w / (self.output_power_w + meshes + bearings))
    }
}

/// Parts of a gearbox rating.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Rates {
    /// Rating of any mesh.
    pub meshes: bool,
    /// Life of any bearing.
    pub lives: bool,
    /// Lives, or Miner sums, under a load spectrum.
    pub spectrum: bool,
    /// Losses of rolling bearings.
    pub bearing_losses: bool,
    /// Losses of all meshes, and with them the efficiency.
    pub efficiency: bool,
}

impl Rates {
    /// Parts requested by the file.
    pub fn of(file: &Gearbox) -> Self {
        let rated = |m: &GearboxMesh| m.scene.rating.is_some();
        let oiled = |m: &GearboxMesh| m.scene.rating.as_ref().is_some_and(|r| r.oil_temperature_c.is_some());
        let has_life = |b: &GearboxBearing| b.rolling.as_ref().is_some_and(|r| r.has_life());
        Self {
            meshes: file.meshes.iter().any(rated),
            lives: file.rating.is_some() && file.bearings.iter().any(has_life),
            spectrum: file.rating.as_ref().is_some_and(|r| r.spectrum.is_some()),
            bearing_losses: file.rating.as_ref().is_some_and(|r| r.viscosity.is_some()),
            efficiency: file.meshes.iter().all(oiled),
        }
    }
}

/// Results of a mesh over all positions.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshResult {
    /// Name.
    pub name: String,
    /// Number of slices over the face width.
    pub slices: usize,
    /// Mean of the sum of normal forces, N.
    pub normal_force: f64,
    /// Mean and peak to peak of the transmission error, mm.
    pub transmission_error: [f64; 2],
    /// Largest magnitude of the transmission error, mm.
    pub largest_transmission_error: f64,
    /// Mean misalignment in the plane of action and perpendicular to it, mm over the face width.
    pub misalignment: [f64; 2],
    /// K_Hbeta from the solved load distribution.
    pub face_load_factor: Option<f64>,
    /// Largest pressure, MPa.
    pub max_pressure: f64,
    /// Pressure patterns on the driving flanks of gear 1 and gear 2; `None` if its contact has no slices.
    pub patterns: Option<[GearPattern; 2]>,
    /// Rating of its pair; `None` if not requested, or if the mesh carries no load.
    pub rating: Option<RatingHeadline>,
    /// The largest transmission error divided by the module, and the largest pressure divided by E*.
    pub over_limits: [f64; 2],
    /// Rotation by which gear 2 is set if the train has a closed loop, rad.
    pub timing: f64,
    /// Angles of tooth 0 of gear 1 and gear 2 with the input at its start, rad from +x; they rotate with their shafts.
    pub gear_angles: [f64; 2],
}

/// Results of a bearing over all positions.
#[derive(Debug, Clone, PartialEq)]
pub struct BearingLoad {
    /// Name.
    pub name: String,
    /// Mean force on the shaft, N.
    pub force: [f64; 3],
    /// Mean moment on the shaft, N mm.
    pub moment: [f64; 3],
    /// Largest tilt of the shaft relative to the seat, rad.
    pub tilt: f64,
    /// Results of its rolling elements, if it has any.
    pub rolling: Option<RollingLoad>,
}

/// Results of an output over all positions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OutputResult {
    /// Mean lag of the output, rad.
    pub mean: f64,
    /// Peak to peak of the lag, which is the transmission error from input to output, rad.
    pub peak_to_peak: f64,
}

/// Power of all loads at the speed of ratings, W.
fn output_power_w(file: &Gearbox, train: &Train) -> f64 {
    let Some(asked) = &file.rating else { return 0.0 };
    let turns = |shaft: usize| asked.speed_rpm * train.ratios_in_space()[shaft].abs() * TAU / 60.0;
    file.torques.iter().map(|own| 1e-3 * own.torque * turns(own.shaft)).sum()
}

/// What the positions press on the driving flanks of a mesh.
fn patterns(scene: &Scene, pair: &GearPair, states: &[&MeshState]) -> Option<[GearPattern; 2]> {
    let step = states.windows(2).map(|two| (two[1].cycles - two[0].cycles).abs()).fold(0.0, f64::max);
    let slices = || states.iter().flat_map(|own| &own.slices);
    let of = |gear: usize| {
        let grid = pressed(scene, pair, gear, (slices(), step)).ok()?;
        Some(on_flank(scene, pair, gear, grid))
    };
    scene.has_slices().then(|| Some([of(0)?, of(1)?]))?
}

/// Transmission errors that are too large for linear elasticity.
fn deflections(meshes: &[MeshResult], pairs: &[GearPair]) -> Vec<Remark> {
    let one = |(mesh, pair): (&MeshResult, &GearPair)| {
        let said = large_error(mesh.largest_transmission_error, (LARGE, pair.pinion.data().normal_module));
        said.map(|said| said.about(&mesh.name))
    };
    meshes.iter().zip(pairs).filter_map(one).collect()
}

pub(super) fn result(
    (file, structure): (&Gearbox, &Structure),
    (meshes, ratings): (Vec<GearMesh>, Vec<Option<RatingHeadline>>),
    train: &Train,
    reduced: &[ReducedMesh],
    (positions, vibration, loads): (Vec<GearboxPosition>, Option<VibrationResult>, Option<&SolvedSpectrum>),
    remarks: Vec<Remark>,
) -> GearboxResult {
    let all = &positions;
    let mesh = |i: usize| {
        let own = || all.iter().map(move |p| &p.meshes[i]);
        let slices = reduced[i].options.contact.slices;
        let MeshNumbers { transmission_error, misalignment, face_load_factor, max_pressure } =
            MeshNumbers::of(all, i, slices);
        let largest = own().map(|m| m.transmission_error.abs()).fold(0.0, f64::max);
        MeshResult {
            name: meshes[i].name.clone(),
            slices,
            normal_force: mean(own().map(|m| m.normal_force)),
            transmission_error,
            largest_transmission_error: largest,
            over_limits: [
                largest / meshes[i].pair.pinion.data().normal_module,
                max_pressure / effective_modulus(&reduced[i].scene),
            ],
            misalignment,
            face_load_factor,
            max_pressure,
            patterns: patterns(&reduced[i].scene, &meshes[i].pair, &own().collect::<Vec<_>>()),
            rating: ratings.get(i).cloned().flatten(),
            timing: train.meshing()[i].timing,
            gear_angles: train.meshing()[i].gear_angles(&meshes[i].pair),
        }
    };
    let turns = |i: usize| BearingTurns::of((file, train), i, file.rating.as_ref()?.speed_rpm);
    let bearing = |i: usize| {
        let own = || all.iter().map(move |p| &p.bearings[i]);
        BearingLoad {
            name: file.bearings[i].name.clone(),
            force: mean_force(all, i),
            moment: std::array::from_fn(|k| mean(own().map(|b| b.moment[k]))),
            tilt: own().map(|b| b.displacement[3].hypot(b.displacement[4])).fold(0.0, f64::max),
            rolling: rolling_load(&file.bearings[i], &structure.bearings[i], all, (i, turns(i)))
                .map(|own| RollingLoad { spectrum_life_h: loads.and_then(|loads| loads.bearing_life_h(i)), ..own }),
        }
    };
    let output = |i: usize| {
        let own = || all.iter().map(move |p| p.output_lags[i]);
        OutputResult { mean: mean(own()), peak_to_peak: peak_to_peak(own()) }
    };
    let tilts = |mesh: &PlanetMesh| {
        let largest = |i: &usize| all.iter().map(|p| p.meshes[*i].tilt(mesh.planet)).fold(0.0, f64::max);
        mesh.of_planets.iter().map(largest).collect()
    };
    let worst = |of: &dyn Fn(&GearboxPosition) -> f64| all.iter().map(of).fold(0.0, crate::worse);
    let of_meshes: Vec<MeshResult> = (0..meshes.len()).map(mesh).collect();
    let pairs: Vec<GearPair> = meshes.iter().map(|m| m.pair.clone()).collect();
    let mut remarks = remarks;
    let bearings: Vec<BearingLoad> = (0..file.bearings.len()).map(bearing).collect();
    let rolling = bearings.iter().filter_map(|own| Some((own.name.as_str(), own.rolling.as_ref()?)));
    remarks.extend(super::bearings::estimates(rolling));
    for (i, (own, load)) in file.bearings.iter().zip(&bearings).enumerate() {
        let is_held = file.shafts[own.shaft].held;
        let told = |r| {
            let worst = LifeLimits::of(r).worse(loads.map_or_else(LifeLimits::default, |loads| loads.limits(i)));
            super::bearings::remarks(&own.name, is_held, (load.tilt, r), worst)
        };
        remarks.extend(load.rolling.iter().flat_map(told));
    }
    remarks.extend(clearance_remarks(file, &pairs).into_iter().chain(deflections(&of_meshes, &pairs)));
    remarks.extend(play_remarks(file, structure, &meshes));
    let root_bending = root_bending(file, all);
    remarks.extend(root_bending::remarks(file, &root_bending));
    for (i, pair) in pairs.iter().enumerate() {
        let slices = || all.iter().flat_map(move |p| &p.meshes[i].slices);
        let widest = slices().map(|s| s.half_width).fold(0.0, f64::max);
        let side = slices().next().map_or(Side::Left, |s| s.side);
        let said = waves_on(pair, side, widest, effective_modulus(&reduced[i].scene));
        remarks.extend(said.into_iter().map(|said| said.about(&of_meshes[i].name)));
    }
    GearboxResult {
        ratios: train.ratios().to_vec(),
        ratios_in_space: train.ratios_in_space().to_vec(),
        meshes: of_meshes,
        root_bending,
        bearings,
        outputs: (0..file.torques.len()).map(output).collect(),
        planets: file.meshes_of_planets().map(|(_, mesh)| LoadSharing::of(all, &mesh.of_planets)).collect(),
        planet_tilts: file.meshes_of_planets().map(|(_, mesh)| tilts(mesh)).collect(),
        input_torque: mean(all.iter().map(|p| p.input_torque)),
        certificate: [worst(&|p| p.certificate.residual), worst(&|p| p.certificate.body_balance)],
        pairs,
        positions,
        vibration,
        remarks,
        motion: None,
        branch: None,
        accuracy: None,
        rates: Rates::of(file),
        output_power_w: output_power_w(file, train),
    }
}
