//! The gears' lowest elastic frequencies, the mesh harmonics beside them, and the normal modes that are kept.

use std::sync::Arc;

use dynamics::{
    ElasticGear,
    pair_motion::{ElasticRatio, GearVibration, LOW_FREQUENCY_LIMIT, harmonic_that_matters},
};
use reduction::{GearModes, GearReducer, ModeChoice, ReductionError};
use serde::Serialize;
use study::mesh_harmonics;

use super::{Columns, prepare::QuasiStatic};
use crate::{
    error::CommandError,
    phases::Phases,
    run,
    scene::{Boundary, DriveBy, Driver, ModesScene, MotionScene, Scene},
};

/// How far mesh harmonics are from the gears' elastic frequencies; units are in the names, pinion first.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[allow(missing_docs)] // the names say what they are, `docs/outputs.md` how they are formed
pub(crate) struct ElasticHeadline {
    pub lowest_elastic_frequency_hz: [f64; 2],
    pub highest_mesh_frequency_hz: f64,
    pub mesh_harmonic: usize,
    pub mesh_harmonic_over_elastic: f64,
    pub limit_of_quasi_static: f64,
    pub kept_modes: Option<KeptModes>,
}

/// Normal modes that move beside the rigid bodies.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[allow(missing_docs)] // as above
pub(crate) struct KeptModes {
    pub count: [usize; 2],
    pub highest_frequency_hz: [Option<f64>; 2],
}

/// What is known of the gears' elastic vibration before the motion begins.
#[derive(Debug, Clone)]
pub(super) struct Elasticity {
    lowest_hz: [f64; 2],
    harmonic: usize,
    kept: Option<[GearVibration; 2]>,
}

impl Elasticity {
    /// Lowest frequencies of both gears, the modes that the scene keeps, and the highest harmonic of the static transmission error that matters.
    ///
    /// # Errors
    /// Exit status 1 when the modes are not found, 2 when the mesh cannot have them.
    pub fn new(
        scene: &Scene,
        gears: &[ElasticGear; 2],
        quasi_static: &QuasiStatic,
        phases: &mut Phases,
    ) -> Result<Self, CommandError> {
        let samples = &quasi_static.transmission_error;
        // Half of the positions a cycle is as high as they can tell.
        let harmonics = mesh_harmonics(samples, 1, samples.len() / 2).map_err(super::no_statistics)?;
        let amplitudes: Vec<f64> = harmonics.iter().map(|h| h.amplitude).collect();
        let harmonic = harmonic_that_matters(&amplitudes);
        let found = phases.run_steps("frequencies", 2, |progress| {
            let of = |i: usize| {
                // Motion has reduced gears only; any other one would not vibrate.
                let found = run::reduced(&gears[i]).map(|reducer| vibration(reducer, scene.modes.as_ref())).transpose();
                progress.tick();
                found.map(|f| f.unwrap_or((f64::INFINITY, None))).map_err(|e| complaint(scene, i, &e))
            };
            Ok::<_, CommandError>([of(0)?, of(1)?])
        })?;
        let lowest_hz = [found[0].0, found[1].0];
        let [(_, pinion), (_, wheel)] = found;
        Ok(Self { lowest_hz, harmonic, kept: pinion.zip(wheel).map(|(p, w)| [p, w]) })
    }

    /// The modes that the scene keeps.
    pub fn kept(&self) -> Option<[GearVibration; 2]> {
        self.kept.clone()
    }

    /// For the results of a run whose mesh frequency is `mesh_hz` at the most.
    pub fn headline(&self, mesh_hz: f64) -> ElasticHeadline {
        ElasticHeadline {
            lowest_elastic_frequency_hz: self.lowest_hz,
            highest_mesh_frequency_hz: mesh_hz,
            mesh_harmonic: self.harmonic,
            mesh_harmonic_over_elastic: self.beside(mesh_hz, self.lowest_hz).largest(),
            limit_of_quasi_static: LOW_FREQUENCY_LIMIT,
            kept_modes: self.kept.as_ref().map(|kept| KeptModes {
                count: kept.each_ref().map(|g| g.modes.count()),
                highest_frequency_hz: kept.each_ref().map(highest),
            }),
        }
    }

    /// What a user should hear at this mesh frequency: what is not kept as a mode is quasi-static, in the whole gear or above its highest kept mode.
    pub fn warning(&self, mesh_hz: f64) -> Option<String> {
        let Some(kept) = &self.kept else { return self.beside(mesh_hz, self.lowest_hz).warning() };
        let bounds = [0, 1].map(|i| highest(&kept[i]).unwrap_or(self.lowest_hz[i]));
        let beside = self.beside(mesh_hz, bounds);
        let ratio = beside.largest();
        (ratio > LOW_FREQUENCY_LIMIT).then(|| {
            format!(
                "mesh harmonic {} at {:.0} Hz is {ratio:.2} of a gear's highest kept mode; what is not kept is quasi-static, which holds up to \
                 {LOW_FREQUENCY_LIMIT}: keep more modes (`count` or `below_hz` in [modes])",
                beside.harmonic,
                beside.harmonic as f64 * mesh_hz
            )
        })
    }

    fn beside(&self, mesh_hz: f64, elastic_hz: [f64; 2]) -> ElasticRatio {
        ElasticRatio { mesh_hz, harmonic: self.harmonic, elastic_hz }
    }
}

fn highest(gear: &GearVibration) -> Option<f64> {
    gear.modes.frequencies_hz().last().copied()
}

/// Lowest frequency of a gear, bore held and flanks free, Hz, and the modes that `words` keep.
fn vibration(
    reducer: &GearReducer,
    words: Option<&ModesScene>,
) -> Result<(f64, Option<GearVibration>), ReductionError> {
    let first = |modes: &GearModes| modes.frequencies_hz().first().copied();
    let lowest = || reducer.lowest_elastic_hz();
    let Some(words) = words else { return Ok((lowest()?, None)) };
    let choice = match (words.below_hz, words.count) {
        (Some(hz), _) => ModeChoice::Below { hz },
        (None, count) => ModeChoice::Count(count.unwrap_or(0) as usize),
    };
    let modes = match words.boundary {
        Boundary::Massless => reducer.modes(choice)?,
        Boundary::Consistent => reducer.craig_bampton_modes(choice, words.fixed_modes.unwrap_or(0) as usize)?,
    };
    // The gear's own frequencies: those of a Craig-Bampton model lie above.
    let own = first(&modes).filter(|_| words.boundary == Boundary::Massless);
    let hz = own.map_or_else(lowest, Ok)?;
    Ok((hz, Some(GearVibration { modes: Arc::new(modes), damping_ratio: words.damping_ratio })))
}

fn complaint(scene: &Scene, i: usize, error: &ReductionError) -> CommandError {
    let message = format!("{}: modes of the {}: {error}", scene.file.display(), ["pinion", "wheel"][i]);
    match error {
        ReductionError::LargeBoundary { .. } => CommandError::input(message, error.hint()),
        _ => CommandError::failed(message, error.hint()),
    }
}

/// The highest mesh frequency of a run, Hz: of the given speeds, and where a torque drives of the rows as well.
pub(super) fn highest_mesh_hz(scene: &Scene, words: &MotionScene, rows: Option<&Columns>) -> f64 {
    let (driver, column) = match scene.operation.driver {
        Driver::Pinion => (scene.pinion.teeth, "pinion_speed_rpm"),
        Driver::Wheel => (scene.wheel.teeth, "wheel_speed_rpm"),
    };
    let by_torque = scene.drive.as_ref().is_some_and(|d| d.by == DriveBy::Torque);
    let rpm = match (words.ramp, &words.sweep, rows.filter(|_| by_torque)) {
        (Some(ramp), ..) => ramp.from_rpm.max(ramp.to_rpm),
        (_, Some(sweep), _) => sweep.to_rpm,
        (.., Some(rows)) => rows.get(column).iter().fold(scene.operation.speed_rpm, |most, n| most.max(n.abs())),
        _ => scene.operation.speed_rpm,
    };
    rpm * f64::from(driver) / 60.0
}
