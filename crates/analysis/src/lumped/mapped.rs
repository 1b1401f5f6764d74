//! Reduced gears with a map of their contact.

use std::{convert::Infallible, time::Instant};

use ::lumped::{LumpedError, equilibrium};
use dynamics::{COORDINATES, MapRequest, MappedPair, MeshResonance, PairMotionError};
use geometry::GearPair;
use integrate::{Forces, Mechanism, State};
use nalgebra::{DMatrix, DVector};
use scene::{MotionScene, Operation, Scene};

use super::{
    LumpedHeadline, LumpedRow,
    analysis::motion_of,
    mechanism::{LumpedMechanism, StaticPoint},
    row::gear_coordinates,
};
use crate::{
    AnalysisError, GearCache, Observer, PhaseWork,
    certificate::Check,
    failure::Failure,
    motion::{
        Elasticity, MotionInputs, NoMotionSink, Pace, PreparedMotion, StepDemand, Vibration, mesh_range_hz, pair_drive,
        prepare,
    },
    run_phase,
};

/// Largest force of a map over the mean one: more than a resonance with loss of contact brings.
const OVERLOAD: f64 = 6.0;
/// Error of a map over the mean approach of the flanks, root mean square.
const TOLERANCE: f64 = 2e-4;
/// Contacts that a step of the model "reduced" solves.
const CONTACTS_OF_A_STEP: f64 = 3.0;
/// Part of a mesh cycle either way over which the velocities of a start are taken.
const SPAN: f64 = 1e-3;

/// The gears of a scene and the map of their contact; of every speed.
pub(crate) struct MappedGears {
    pair: MappedPair,
    resonance: MeshResonance,
    /// What is left out of quasi-static elasticity, and what a step with it costs.
    elasticity: Elasticity,
    pace: Pace,
    /// Mean lag of the driven gear at rest, mm.
    lag: f64,
    free: Vec<usize>,
    pub warnings: Vec<String>,
}

/// The scene as far as a mapped pair depends on it: all but the speed. Mesh damping, which [motion] has, is the pair's.
pub(super) fn without_speed(scene: &Scene) -> Scene {
    let operation = Operation { speed_rpm: 1000.0, ..scene.operation };
    Scene { operation, set: Vec::new(), ..scene.clone() }
}

impl MappedGears {
    /// Reduces the gears and maps their contact.
    ///
    /// # Errors
    /// Those of the reduced gears, and of the map.
    pub fn make(scene: &Scene, cache: &dyn GearCache, observer: &mut dyn Observer) -> Result<Self, AnalysisError> {
        let inputs = MotionInputs::new((scene, motion_of(scene)?), None, cache, observer)?;
        let ready = prepare(&inputs, observer, &mut NoMotionSink, None).map_err(|e: Failure| e.into_error(scene))?;
        let PreparedMotion { system, quasi_static, elasticity, warnings, .. } = ready;
        let (resonance, lag) = (system.mesh_resonance(), quasi_static.mean_error());
        let began = Instant::now();
        let request = MapRequest { overload: OVERLOAD, tolerance: TOLERANCE, lag };
        let pair = run_phase(observer, "contact map", PhaseWork::Unknown, |_| MappedPair::new(system, &request));
        let pair = pair.map_err(|source| failed(scene, source))?;
        let contacts: usize = pair.maps().map(|map| map.certificate().contacts).sum();
        let pace = Pace::of(began.elapsed().as_secs_f64(), contacts as f64 / CONTACTS_OF_A_STEP);
        let place = |c: &super::GearCoordinate| {
            let axis = super::row::axis_number(c.axis);
            COORDINATES * c.gear + axis
        };
        let free = gear_coordinates(scene).iter().map(place).collect();
        Ok(Self { pair, resonance, elasticity, pace, lag, free, warnings })
    }

    /// What a user should hear of the elasticity of a motion: it is quasi-static in a map.
    pub fn warnings_of(&self, scene: &Scene, motion: &MotionScene, headline: &LumpedHeadline) -> Vec<String> {
        let mesh_hz = mesh_range_hz(scene, motion, None);
        let found = Vibration { mesh_hz, resonance: self.resonance, peak_to_peak_um: headline.peak_to_peak_dte_um };
        let cycles = (headline.cycles + headline.certificate.warm_up_cycles) as f64;
        let demand = StepDemand::new(scene, motion, cycles, mesh_hz);
        let slow = self.elasticity.warning(&found, &demand, self.pace);
        slow.into_iter().chain(self.elasticity.rotation_warning(&found)).collect()
    }

    /// The pair at the speed of a scene, and its mesh resonance, Hz.
    ///
    /// # Errors
    /// [`AnalysisError::Motion`].
    pub(super) fn model(&self, scene: &Scene, gears: &GearPair) -> Result<(MappedModel, f64), AnalysisError> {
        let pair = self.pair.with_drive(pair_drive(scene, gears)).map_err(|source| failed(scene, source))?;
        let system = pair.system();
        let driven = [&gears.pinion, &gears.wheel][system.options().statics.driven()];
        let scale = system.coordinates().scales(self.lag.abs().max(1e-6), driven.base_radius());
        Ok((MappedModel { pair, lag: self.lag, scale, free: self.free.clone() }, self.resonance.hz))
    }
}

fn failed(scene: &Scene, source: PairMotionError) -> AnalysisError {
    AnalysisError::Motion { file: scene.file.display().to_string(), source: Box::new(source) }
}

/// A pair on its map, as the run of a cheaper model asks for it.
pub(super) struct MappedModel {
    pair: MappedPair,
    lag: f64,
    scale: DVector<f64>,
    free: Vec<usize>,
}

impl MappedModel {
    /// Where forces on a copy of the pair balance at a time, the driver's own turn held.
    fn stands(
        &self,
        pair: Result<MappedPair, PairMotionError>,
        t: f64,
        from: Option<&DVector<f64>>,
    ) -> Result<DVector<f64>, LumpedError> {
        let Ok(mut pair) = pair else { return Err(LumpedError::NoEquilibrium) };
        let coordinates = pair.system().coordinates();
        let mut guess = DVector::zeros(self.scale.len());
        guess[coordinates.lag()] = self.lag;
        let held: Vec<usize> = coordinates.driver_turn().into_iter().collect();
        let Ok(found) = equilibrium(&mut pair, t, from.unwrap_or(&guess), &held, &self.scale);
        found.ok_or(LumpedError::NoEquilibrium)
    }
}

impl Mechanism for MappedModel {
    type Error = Infallible;

    fn mass(&self) -> &DMatrix<f64> {
        self.pair.mass()
    }

    fn forces(&mut self, t: f64, q: &DVector<f64>, v: &DVector<f64>, out: &mut Forces) -> Result<(), Infallible> {
        self.pair.forces(t, q, v, out)
    }

    fn potential(&mut self, t: f64, q: &DVector<f64>) -> Result<f64, Infallible> {
        self.pair.potential(t, q)
    }

    fn accepted(&mut self, t: f64, q: &DVector<f64>, v: &DVector<f64>) -> Result<(), Infallible> {
        self.pair.accepted(t, q, v)
    }

    fn events(&self) -> usize {
        self.pair.events()
    }

    fn event_values(&mut self, t: f64, q: &DVector<f64>, v: &DVector<f64>, out: &mut [f64]) -> Result<(), Infallible> {
        self.pair.event_values(t, q, v, out)
    }
}

impl LumpedMechanism for MappedModel {
    fn start(&mut self) -> Result<State, LumpedError> {
        let now = |t: f64, from: Option<&DVector<f64>>| self.stands(self.pair.again(), t, from);
        let q = now(0.0, None)?;
        let mut v = DVector::zeros(q.len());
        let hz = self.pair.mesh_hz(0.0);
        if hz > 0.0 {
            let dt = SPAN / hz;
            v = (now(dt, Some(&q))? - now(-dt, Some(&q))?) / (2.0 * dt);
        }
        Ok(State::new(0.0, q, v))
    }

    fn scale(&self) -> DVector<f64> {
        self.scale.clone()
    }

    fn row(&mut self, state: &State) -> LumpedRow {
        let State { time, q, v, .. } = state;
        let system = self.pair.system();
        let [driving, coast] = self.pair.instant(*time, q, v);
        let (d, rate) = (system.coordinates().displacement(q), system.coordinates().displacement(v));
        let (cycles, speeds) = self.pair.turning(*time, q, v);
        let wrench = driving.wrench + coast.wrench;
        let lag = system.coordinates().lag();
        LumpedRow {
            time: *time,
            pinion_angle: Some((cycles - 0.5) * system.pair().pinion.pitch_angle()),
            mesh_phase: cycles.rem_euclid(1.0),
            speeds: Some(speeds),
            transmission_error_um: 1e3 * q[lag],
            contact_line_length: Some(driving.line_length),
            normal_force: driving.force + driving.damping,
            coast_normal_force: Some(coast.force + coast.damping),
            wrench: [0, 1].map(|g| std::array::from_fn(|i| wrench[COORDINATES * g + i])),
            displacement: self.free.iter().map(|&i| d[i]).collect(),
            velocity: self.free.iter().map(|&i| rate[i]).collect(),
            ..LumpedRow::default()
        }
    }

    fn static_cycle(&self, phases: usize) -> Option<Vec<StaticPoint>> {
        let hz = self.pair.mesh_hz(0.0);
        let lag = self.pair.system().coordinates().lag();
        let mut from: Option<DVector<f64>> = None;
        let mut at = |k: usize| {
            let t = k as f64 / (phases as f64 * hz);
            let q = self.stands(self.pair.under_mean_load(), t, from.as_ref()).ok()?;
            let line_length = self.pair.instant(t, &q, &DVector::zeros(q.len()))[0].line_length;
            let point = StaticPoint { error: q[lag], line_length: Some(line_length) };
            from = Some(q);
            Some(point)
        };
        (0..phases).map(&mut at).collect()
    }

    fn natural_frequencies_hz(&self, _: f64) -> Vec<f64> {
        Vec::new()
    }

    fn checks(&self) -> Vec<Check> {
        let excess = self.pair.excess();
        let worst = self.pair.maps().map(|m| m.certificate()).map(|c| c.rms_error_mm / c.deflection_mm);
        vec![
            Check {
                name: "map_error",
                value: worst.fold(0.0, f64::max),
                bound: TOLERANCE,
                way_out: "use `model = \"reduced\"`, which solves the contact itself",
            },
            Check {
                name: "map_excess",
                value: excess.force.max(excess.tilt),
                bound: 1.0,
                way_out: "forces or tilts leave what the map holds: use `model = \"reduced\"`, or more damping",
            },
        ]
    }
}

impl std::fmt::Debug for MappedGears {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("MappedGears").field("resonance_hz", &self.resonance.hz).finish_non_exhaustive()
    }
}
