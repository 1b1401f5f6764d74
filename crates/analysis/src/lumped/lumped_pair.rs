//! The models with eight and twelve coordinates.

use std::f64::consts::TAU;

use ::lumped::{
    HistoryRow, LineSharing, LumpedError, LumpedModel, LumpedPair, MeshClock, MeshFrame, Operation, PlaneOfAction,
    lumped8::{Lumped8, MeshLaw, Motion8},
    lumped12::{Lumped12, Motion12},
    starting_state,
};
use dynamics::RigidBody;
use gearbox::GearboxError;
use geometry::{GearPair, Sense};
use integrate::State;
use nalgebra::DVector;
use scene::{Driver, Law, Lumped8Scene, Lumped12Scene, MeshScene, Scene, Sharing};

use super::{
    LumpedRow,
    bodies::{bodies, supports8, supports12, torques},
    excitation::{MeshExcitation, half_a_cycle_on},
    mechanism::{Formulas, LumpedMechanism, StaticPoint},
};
use crate::{AnalysisError, options};

/// Mesh cycles at t = 0: the pinion begins half a pitch before the middle of pair 0, as everywhere in this program.
const START: f64 = -0.5;

/// Sense in which the driver turns: scenes say how the pinion does.
fn driver_sense(scene: &Scene, pair: &GearPair) -> Sense {
    match (scene.operation.driver, options(scene, pair).contact.sense) {
        (Driver::Pinion, sense) => sense,
        (Driver::Wheel, Sense::Ccw) => Sense::Cw,
        (Driver::Wheel, Sense::Cw) => Sense::Ccw,
    }
}

/// Contact lines of a scene's pair.
pub(super) fn plane(scene: &Scene, pair: &GearPair) -> PlaneOfAction {
    let driver = options(scene, pair).contact.driver;
    PlaneOfAction::of_pair(pair, driver, &MeshFrame::of_pair(pair, driver, driver_sense(scene, pair)))
}

/// What both models have in common: pair with excitation, and its bodies.
///
/// # Errors
/// [`LumpedError`] for what has no meaning.
pub(super) fn lumped_pair(
    scene: &Scene,
    mesh: &MeshScene,
    pair: &GearPair,
    excitation: &MeshExcitation,
) -> Result<(LumpedPair, [RigidBody; 2]), LumpedError> {
    let bodies = bodies(scene.gears(), pair);
    let operation = Operation {
        driver: options(scene, pair).contact.driver,
        sense: driver_sense(scene, pair),
        speed: scene.operation.speed(),
        torque: scene.operation.torque(),
        friction: scene.contact.friction,
    };
    let mut lumped = LumpedPair::new(pair, &operation, bodies, half_a_cycle_on(&excitation.cycle))?;
    lumped.clock = MeshClock { start: START, ..lumped.clock };
    lumped.torques = torques(scene, pair, lumped.torques[0].mean());
    lumped.plane.sharing = match mesh.line_sharing {
        Some(Sharing::Line) => LineSharing::ByLine,
        Some(Sharing::Length) | None => LineSharing::ByLength,
    };
    Ok((lumped, bodies))
}

/// Driver's first.
fn by_role<T>(pair: &LumpedPair, [pinion, wheel]: [T; 2]) -> [T; 2] {
    if pair.pinion_drives { [pinion, wheel] } else { [wheel, pinion] }
}

/// The model with eight coordinates.
pub(super) fn eight(
    scene: &Scene,
    own: &Lumped8Scene,
    mesh: &MeshScene,
    gears: &GearPair,
    mut pair: LumpedPair,
    bodies: &[RigidBody; 2],
) -> Result<Motion8, LumpedError> {
    if let Some(hz) = own.speed_fluctuation_hz {
        pair.clock.fluctuation = own.speed_fluctuation();
        pair.clock.fluctuation_frequency = TAU * hz;
    }
    let law = match own.law {
        Law::Normal => MeshLaw::Normal,
        Law::Projected => MeshLaw::Projected,
    };
    let half_backlash = mesh.half_backlash().unwrap_or_else(|| law.half_backlash(gears));
    let supports = by_role(&pair, supports8(scene.gears(), bodies));
    let ratio = scene.motion.as_ref().and_then(|m| m.mesh_damping_ratio).unwrap_or(0.0);
    Lumped8::new(pair, supports, ratio, half_backlash, law)?.motion()
}

/// The model with twelve.
pub(super) fn twelve(scene: &Scene, own: &Lumped12Scene, mut pair: LumpedPair) -> Result<Motion12, LumpedError> {
    if let Some(orientation) = own.orientation() {
        pair.frame.orientation = orientation;
    }
    let supports = by_role(&pair, supports12(scene.gears()));
    let between = [own.damping_from_hz, own.damping_to_hz].map(|f| TAU * f);
    Lumped12::new(pair, supports, own.damping_ratio, between)?.motion()
}

fn lumped_row(row: HistoryRow) -> LumpedRow {
    LumpedRow {
        time: row.time,
        pinion_angle: Some(row.pinion_angle),
        // Lumped pairs count from the middle of pair 0, files from half a cycle before.
        mesh_phase: (row.mesh_phase - START).rem_euclid(1.0),
        transmission_error_um: 1e3 * row.transmission_error,
        mesh_deflection: Some(row.mesh_deflection),
        mesh_stiffness: Some(row.mesh_stiffness),
        contact_line_length: Some(row.contact_line_length),
        normal_force: row.normal_force,
        friction_force: Some(row.friction_force),
        wrench: row.wrench.map(|w| {
            let ([x, y, z], [mx, my, mz]) = (w.force, w.moment);
            [x, y, z, mx, my, mz]
        }),
        displacement: row.displacement,
        velocity: row.velocity,
        ..LumpedRow::default()
    }
}

/// The parts that both have by their common trait.
macro_rules! lumped_mechanism {
    ($motion:ty, $frequencies:expr) => {
        impl LumpedMechanism for Formulas<$motion> {
            fn start(&mut self) -> Result<State, AnalysisError> {
                Ok(starting_state(&self.0))
            }

            fn scale(&self) -> DVector<f64> {
                LumpedModel::scale(&self.0)
            }

            fn row(&mut self, state: &State) -> Result<LumpedRow, GearboxError> {
                Ok(lumped_row(LumpedModel::row(&self.0, state.time, &state.q, &state.v)))
            }

            fn static_cycle(&self, phases: usize) -> Option<Vec<StaticPoint>> {
                let period = 1.0 / self.pair().clock.mesh_frequency();
                let at = |k: usize| {
                    let share = k as f64 / phases as f64;
                    let q = self.quasi_static(START + share)?;
                    let row = LumpedModel::row(&self.0, share * period, &q, &DVector::zeros(q.len()));
                    Some(StaticPoint { error: row.transmission_error, line_length: Some(row.contact_line_length) })
                };
                (0..phases).map(at).collect()
            }

            fn natural_frequencies_hz(&self, _: f64) -> Vec<f64> {
                $frequencies(&self.0)
            }
        }
    };
}

lumped_mechanism!(Motion8, |_: &Motion8| Vec::new());
lumped_mechanism!(Motion12, frequencies);

/// Natural frequencies of the pair at the start of a mesh cycle, with friction as it then is, Hz.
fn frequencies(model: &Motion12) -> Vec<f64> {
    model.modes(START).map_or_else(Vec::new, |modes| modes.iter().map(|m| m.frequency_hz).collect())
}
