//! Reduced gears in motion, with solved or mapped contact, in the form that runs of cheaper models need.

use answer::Remark;
use std::time::Instant;

use contact_map::MapWatch;
use dynamics::{COORDINATES, MapFailure, MapRequest, MeshFlanks, MeshResonance};
use gearbox::{
    GearboxError,
    motion::{MappedMesh, PairModel},
};
use geometry::GearPair;
use scene::{Model, MotionScene, Scene};

use super::{
    LumpedHeadline,
    elastic_frame::ElasticFrame,
    flank_pair::{FlankPair, worst_map},
    mechanism::BoxedMechanism,
    row::{GearCoordinate, axis_number, gear_coordinates},
};
use crate::{
    AnalysisError, GearCache, MapKey, Observer, PhaseWork,
    contact_maps::{map_teller, map_words, pitch_errors_told},
    error::in_scene,
    failure::Failure,
    inputs::motion_of,
    motion::{
        Elasticity, MotionInputs, NoMotionSink, Pace, PreparedMotion, StepDemand, Vibration, mesh_range_hz,
        motion_length, pair_drive, prepare,
    },
    run_phase,
};

/// Largest force of a map over the mean one: more than a resonance with loss of contact brings.
const OVERLOAD: f64 = 6.0;
/// Error of a map over the mean approach of the flanks, root mean square, that is aimed at: at rest the approach of a
/// smooth pair swings by a few per cent of its mean, and a hundredth of that is to be seen.
const MAP_TOLERANCE: f64 = 3e-5;
/// Contacts that a step of the model "reduced" solves.
const CONTACTS_OF_A_STEP: f64 = 3.0;

/// The gears of a scene, of every speed; with the map of their contact where the model takes one.
pub(crate) struct ElasticPair {
    pair: PairModel,
    resonance: MeshResonance,
    /// What is left out of quasi-static elasticity, and what a step with it costs; nothing where modes move.
    elasticity: Elasticity,
    pace: Pace,
    frame: ElasticFrame,
    pub remarks: Vec<Remark>,
}

impl ElasticPair {
    /// Reduces the gears and, for the model "mapped", makes maps of their contact.
    ///
    /// # Errors
    /// The errors of the reduced gears and of the map.
    pub fn make(scene: &Scene, cache: &dyn GearCache, observer: &mut dyn Observer) -> Result<Self, AnalysisError> {
        let inputs = MotionInputs::new((scene, motion_of(scene)?), None, cache, observer)?;
        let ready = prepare(&inputs, observer, &mut NoMotionSink, None).map_err(|e: Failure| e.into_error(scene))?;
        let PreparedMotion { system, quasi_static, elasticity, mut remarks, keys, .. } = ready;
        let (resonance, lag) = (system.mesh_resonance(), quasi_static.mean_error());
        let length = motion_length(&system, &quasi_static);
        let place = |c: &GearCoordinate| COORDINATES * c.gear + axis_number(c.axis);
        let free = gear_coordinates(scene).iter().map(place).collect();
        let frame = ElasticFrame { length, free, at_rest: quasi_static.transmission_error };
        let began = Instant::now();
        let (pair, contacts) = match scene.analysis.model {
            Model::Mapped => {
                let worst = worst_map(scene.contact.friction);
                let request = system.map_request(OVERLOAD, [MAP_TOLERANCE, worst]).map_err(in_scene(scene))?;
                let asked = (OVERLOAD, MAP_TOLERANCE, worst, lag);
                let key = cache.is_on().then(|| MapKey::new(&keys, &map_words(scene, &inputs.pair, &asked)));
                let flanks = solved_flanks(scene, &system)?;
                let made = run_phase(observer, "contact map", PhaseWork::Unknown, |progress| {
                    let watch = map_teller(progress, "");
                    mapped(scene, (flanks, &inputs.pair), (&request, &watch), (cache, key.as_ref()), &mut remarks)
                });
                let made = made?;
                let off = made.pitch_error(flanks, &inputs.pair, &request).map_err(in_scene(scene))?;
                remarks.extend(off.zip(made.maps().next()).map(|(error, map)| pitch_errors_told(&error, map)));
                let contacts: usize = made.maps().map(|map| map.certificate().contacts).sum();
                (system.on_map(made), contacts)
            }
            _ => (system, 0),
        };
        let pace = Pace::of(began.elapsed().as_secs_f64(), contacts as f64 / CONTACTS_OF_A_STEP);
        Ok(Self { pair, resonance, elasticity, pace, frame, remarks })
    }

    /// Remarks about the elasticity of a motion, which is quasi-static except for modes that are coordinates.
    pub fn remarks_of(&self, scene: &Scene, motion: &MotionScene, headline: &LumpedHeadline) -> Vec<Remark> {
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
    /// [`AnalysisError::Gearbox`].
    pub(super) fn model(&self, scene: &Scene, gears: &GearPair) -> Result<(BoxedMechanism, f64), AnalysisError> {
        let pair = self.pair.with_drive(pair_drive(scene, gears));
        let model = FlankPair::new(pair, self.frame.clone()).map_err(in_scene(scene))?;
        Ok((BoxedMechanism::new(model), self.resonance.hz))
    }
}

/// The flanks of a pair that is to be mapped.
fn solved_flanks<'a>(scene: &Scene, pair: &'a PairModel) -> Result<&'a MeshFlanks, AnalysisError> {
    let what = "a pair without flanks that are solved";
    pair.flanks().ok_or_else(|| in_scene(scene)(GearboxError::Unmapped { what }))
}

/// The flanks of a pair by their maps: those of the cache, or new ones.
fn mapped(
    scene: &Scene,
    (flanks, pair): (&MeshFlanks, &GearPair),
    (request, watch): (&MapRequest, MapWatch<'_>),
    (cache, key): (&dyn GearCache, Option<&MapKey>),
    remarks: &mut Vec<Remark>,
) -> Result<MappedMesh, AnalysisError> {
    let complain = |e: MapFailure| in_scene(scene)(GearboxError::from(e));
    flanks.check_mapped(pair, request).map_err(complain)?;
    if let Some(key) = key {
        let (kept, said) = cache.load_maps(key);
        remarks.extend(said);
        if let Some(Ok(made)) =
            kept.and_then(|kept| kept.of(key)).map(|maps| MappedMesh::on(flanks, pair, request, maps))
        {
            return Ok(made);
        }
    }
    let made = flanks.maps(pair, request, watch).map_err(complain)?;
    remarks.extend(key.and_then(|key| cache.save_maps(key, &made.iter().collect::<Vec<_>>())));
    MappedMesh::on(flanks, pair, request, made).map_err(in_scene(scene))
}

impl std::fmt::Debug for ElasticPair {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("ElasticPair").field("resonance_hz", &self.resonance.hz).finish_non_exhaustive()
    }
}
