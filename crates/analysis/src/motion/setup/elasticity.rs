//! The gears' lowest elastic frequencies compared with the mesh harmonics, and the normal modes that are kept.

use std::sync::Arc;

use dynamics::{CHANGE_LIMIT, ElasticChange, GearVibration, LOW_FREQUENCY_LIMIT, MeshResonance, rotation_share};
use reduction::{ElasticGear, GearModes, GearReducer, ModeChoice, ReductionError};
use scene::{Boundary, DriveBy, ModesScene, MotionScene, Scene};
use serde::Serialize;
use study::mesh_harmonics;

use super::QuasiStatic;
use crate::{
    AnalysisError, Observer, PhaseWork,
    error::failed_modes,
    motion::step_estimate::{Pace, StepDemand},
    reduced, run_phase,
};

described::described! {
    /// How far mesh harmonics are from the gears' elastic frequencies; units are in the names, pinion first.
    #[derive(Debug, Clone, PartialEq, Serialize)]
    pub struct ElasticHeadline {
        /// lowest natural frequency of pinion and wheel, bore held and flanks free
        pub lowest_elastic_frequency_hz: [f64; 2],
        /// highest mesh frequency of the run
        pub highest_mesh_frequency_hz: f64,
        /// mesh harmonic whose deflection the neglected elastic inertia may change most
        pub mesh_harmonic: usize,
        /// frequency of that harmonic over the lower of the two elastic frequencies
        pub mesh_harmonic_over_elastic: f64,
        /// ratio at which one harmonic alone would change by `limit_of_change`
        pub limit_of_quasi_static: f64,
        /// possible change of the peak to peak of the DTE by the neglected elastic inertia ([theory](theory.md), equation 63); with kept modes by the inertia above the highest of them
        pub change_of_peak_to_peak_um: f64,
        /// that change over the peak to peak of the DTE
        pub change_over_peak_to_peak: f64,
        /// share of the peak to peak from which on a remark gives remedy and price
        pub limit_of_change: f64,
        /// Coriolis and centrifugal forces on the elastic deformation, which are neglected, over the elastic forces, the largest ([theory](theory.md), equation 68)
        pub rotation_over_stiffness: f64,
        /// normal modes of the model `reduced+modes`; `null` of other models
        pub kept_modes: Option<KeptModes>,
    }
}

described::described! {
    /// Normal modes that move beside the rigid bodies.
    #[derive(Debug, Clone, PartialEq, Serialize)]
    pub struct KeptModes {
        /// number of modes of pinion and wheel
        pub count: [usize; 2],
        /// highest natural frequency of these modes, pinion and wheel
        pub highest_frequency_hz: [Option<f64>; 2],
    }
}

/// What is known of the gears' elastic vibration before the motion begins.
#[derive(Debug, Clone)]
pub(crate) struct Elasticity {
    lowest_hz: [f64; 2],
    /// Harmonics of the quasi-static transmission error, um.
    amplitudes_um: Vec<f64>,
    /// Teeth of the gear that turns faster.
    fewest_teeth: u32,
    kept: Option<[GearVibration; 2]>,
    /// What has modes, before the keys of [modes].
    remedy: &'static str,
}

/// What has modes: of a pair, and of a gearbox.
const OF_PAIR: &str = "take the model `reduced+modes` with";
pub(crate) const OF_GEARBOX: &str = "keep modes of the gears in exact contact (`mesh = \"exact\"`) with";

impl Elasticity {
    /// Lowest frequencies of both gears, the modes that the scene keeps, and the harmonics of the static transmission
    /// error.
    ///
    /// # Errors
    /// [`AnalysisError::Reduction`] if the modes cannot be computed, or if the mesh does not permit them.
    pub fn new(
        scene: &Scene,
        gears: &[ElasticGear; 2],
        quasi_static: &QuasiStatic,
        observer: &mut dyn Observer,
    ) -> Result<Self, AnalysisError> {
        let found = run_phase(observer, "frequencies", PhaseWork::Steps(2), |progress| {
            let of = |i: usize| {
                // Motion has reduced gears only; any other one would not vibrate.
                let found = reduced(&gears[i]).map(|reducer| vibration(reducer, scene.modes.as_ref())).transpose();
                progress.tick();
                found.map(|f| f.unwrap_or((f64::INFINITY, None))).map_err(|e| failed_modes(scene, i, e))
            };
            Ok::<_, AnalysisError>([of(0)?, of(1)?])
        })?;
        let lowest_hz = [found[0].0, found[1].0];
        let [(_, pinion), (_, wheel)] = found;
        Self::of((scene, OF_PAIR), lowest_hz, quasi_static, pinion.zip(wheel).map(|(p, w)| [p, w]))
    }

    /// The same from known data of the gears; `remedy` names the model that has modes.
    ///
    /// # Errors
    /// [`AnalysisError::Statistics`] if the transmission error is not a finite number.
    pub fn of(
        (scene, remedy): (&Scene, &'static str),
        lowest_hz: [f64; 2],
        quasi_static: &QuasiStatic,
        kept: Option<[GearVibration; 2]>,
    ) -> Result<Self, AnalysisError> {
        let samples = &quasi_static.transmission_error;
        // Half of the positions a cycle is as high as they can tell.
        let harmonics = mesh_harmonics(samples, 1, samples.len() / 2)?;
        let amplitudes_um = harmonics.iter().map(|h| 1e3 * h.amplitude).collect();
        let fewest_teeth = scene.pinion.teeth.min(scene.wheel.teeth);
        Ok(Self { lowest_hz, amplitudes_um, fewest_teeth, kept, remedy })
    }

    /// The modes that the scene keeps.
    pub fn kept(&self) -> Option<[GearVibration; 2]> {
        self.kept.clone()
    }

    /// Frequencies of the gears with their bores held, Hz, and their names: the kept modes, otherwise the lowest
    /// frequency of either gear.
    pub fn frequencies_hz(&self) -> Vec<(f64, String)> {
        let gears = ["pinion", "wheel"];
        match &self.kept {
            None => (0..2).map(|i| (self.lowest_hz[i], format!("{} elastic", gears[i]))).collect(),
            Some(kept) => (0..2)
                .flat_map(|i| {
                    let all = kept[i].modes.frequencies_hz().into_iter().enumerate();
                    all.map(move |(k, hz)| (hz, format!("{} mode {}", gears[i], k + 1)))
                })
                .collect(),
        }
    }

    /// Possible change of a motion by the neglected inertia of elastic deformation.
    pub fn beside(&self, found: &Vibration) -> ElasticChange {
        let bounds = match &self.kept {
            None => self.lowest_hz,
            Some(kept) => [0, 1].map(|i| highest(&kept[i]).unwrap_or(self.lowest_hz[i])),
        };
        ElasticChange::of(&self.amplitudes_um, found.mesh_hz, bounds, found.resonance)
    }

    /// Values for the results of a run.
    pub fn headline(&self, found: &Vibration) -> ElasticHeadline {
        let change = self.beside(found);
        let lowest = self.lowest_hz[0].min(self.lowest_hz[1]);
        ElasticHeadline {
            lowest_elastic_frequency_hz: self.lowest_hz,
            highest_mesh_frequency_hz: found.mesh_hz[1],
            mesh_harmonic: change.harmonic,
            mesh_harmonic_over_elastic: change.harmonic_hz() / lowest,
            limit_of_quasi_static: LOW_FREQUENCY_LIMIT,
            change_of_peak_to_peak_um: change.share * found.peak_to_peak_um,
            change_over_peak_to_peak: change.share,
            limit_of_change: CHANGE_LIMIT,
            rotation_over_stiffness: self.rotation(found),
            kept_modes: self.kept.as_ref().map(|kept| KeptModes {
                count: kept.each_ref().map(|g| g.modes.count()),
                highest_frequency_hz: kept.each_ref().map(highest),
            }),
        }
    }

    /// What rotation does to the elastic bodies and is left out, over their stiffness.
    fn rotation(&self, found: &Vibration) -> f64 {
        let change = self.beside(found);
        let lowest = self.lowest_hz[0].min(self.lowest_hz[1]);
        let turns = found.mesh_hz[1] / f64::from(self.fewest_teeth);
        rotation_share(turns, change.harmonic_hz().max(found.mesh_hz[1]), lowest)
    }

    /// Warning about the effect of rotation on the modes.
    pub fn rotation_warning(&self, found: &Vibration) -> Option<answer::Remark> {
        let share = self.rotation(found);
        (share > CHANGE_LIMIT).then(|| crate::remark::fast_rotation(100.0 * share, 100.0 * CHANGE_LIMIT))
    }

    /// Warning about a run: elasticity that is not kept as a mode is quasi-static, in the whole gear or above its
    /// highest kept mode. The remedy is given with its cost, at the pace of this run.
    pub fn warning(&self, found: &Vibration, demand: &StepDemand, pace: Pace) -> Option<answer::Remark> {
        let change = self.beside(found);
        if !change.matters() {
            return None;
        }
        let [pinion, wheel] = change.ratios();
        let (gear, i) = if pinion >= wheel { ("pinion", 0) } else { ("wheel", 1) };
        let which = match &self.kept {
            None => format!("lowest elastic frequency, {:.0} Hz (bore held, flanks free)", self.lowest_hz[i]),
            Some(_) => "highest kept mode".to_owned(),
        };
        // Modes up to twice the harmonic: what lies above is quasi-static to it, to a third.
        let below_hz = nice(2.0 * change.harmonic_hz().max(self.lowest_hz[0].max(self.lowest_hz[1])));
        let lowest = self.lowest_hz[0].min(self.lowest_hz[1]);
        let remedy = match &self.kept {
            None => format!("{} `below_hz = {below_hz:.0}` in [modes]", self.remedy),
            Some(_) => format!("keep more modes (`below_hz = {below_hz:.0}` in [modes])"),
        };
        Some(crate::remark::quasi_static_elasticity(
            change.harmonic,
            change.harmonic_hz(),
            change.largest_ratio(),
            gear,
            which,
            change.share * found.peak_to_peak_um,
            100.0 * change.share,
            100.0 * CHANGE_LIMIT,
            remedy,
            demand.with_modes(below_hz, lowest, self.kept.is_some()).describe(pace),
        ))
    }
}

/// What has been found of a motion, to be held against the elastic frequencies.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Vibration {
    /// Least and highest mesh frequency, Hz.
    pub mesh_hz: [f64; 2],
    pub resonance: MeshResonance,
    /// Peak to peak of the DTE, um.
    pub peak_to_peak_um: f64,
}

/// Rounded up to two digits.
fn nice(hz: f64) -> f64 {
    let unit = 10f64.powf(hz.log10().floor() - 1.0);
    (hz / unit).ceil() * unit
}

fn highest(gear: &GearVibration) -> Option<f64> {
    gear.modes.frequencies_hz().last().copied()
}

/// Lowest frequency of a gear, bore held and flanks free, Hz, and the modes that the scene keeps.
fn vibration(
    reducer: &GearReducer,
    modes: Option<&ModesScene>,
) -> Result<(f64, Option<GearVibration>), ReductionError> {
    let first = |of: &GearModes| of.frequencies_hz().first().copied();
    let lowest = || reducer.lowest_elastic_hz();
    let Some(asked) = modes else { return Ok((lowest()?, None)) };
    let found = kept_modes(reducer, asked)?;
    // The gear's own frequencies: those of a Craig-Bampton model lie above.
    let own = first(&found).filter(|_| asked.boundary == Boundary::Massless);
    let hz = own.map_or_else(lowest, Ok)?;
    Ok((hz, Some(GearVibration { modes: Arc::new(found), damping_ratio: asked.damping_ratio })))
}

/// The modes of a gear that a scene keeps.
pub(crate) fn kept_modes(reducer: &GearReducer, asked: &ModesScene) -> Result<GearModes, ReductionError> {
    let choice = match (asked.below_hz, asked.count) {
        (Some(hz), _) => ModeChoice::Below { hz },
        (None, count) => ModeChoice::Count(count.unwrap_or(0) as usize),
    };
    match asked.boundary {
        Boundary::Massless => reducer.modes(choice),
        Boundary::Consistent => reducer.craig_bampton_modes(choice, asked.fixed_modes.unwrap_or(0) as usize),
    }
}

/// Least and highest mesh frequency of a run, Hz: of the given speeds, and where a torque of its own drives of those
/// that came of it as well, 1/min.
pub(crate) fn mesh_range_hz(scene: &Scene, motion: &MotionScene, driver_rpm: Option<&[f64]>) -> [f64; 2] {
    let teeth = scene.driver_teeth();
    let by_torque = scene.drive.as_ref().is_some_and(|d| d.by == DriveBy::Torque && !d.torque.is_none());
    let given = scene.operation.speed_rpm;
    let rpm = match (motion.ramp, &motion.sweep, driver_rpm.filter(|_| by_torque)) {
        (Some(ramp), ..) => [ramp.from_rpm.min(ramp.to_rpm), ramp.from_rpm.max(ramp.to_rpm)],
        (_, Some(sweep), _) => [sweep.from_rpm, sweep.to_rpm],
        (.., Some(speeds)) => speeds.iter().fold([given; 2], |[l, h], n| [l.min(n.abs()), h.max(n.abs())]),
        _ => [given; 2],
    };
    rpm.map(|n| n * f64::from(teeth) / 60.0)
}
