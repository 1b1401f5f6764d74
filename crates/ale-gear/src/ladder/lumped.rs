//! The models with eight and twelve coordinates.

use std::f64::consts::TAU;

use dynamics::RigidBody;
use geometry::{GearPair, Sense};
use integrate::State;
use lumped::{
    HistoryRow, LineSharing, LumpedError, LumpedModel, LumpedPair, MeshClock, MeshFrame, Operation, PlaneOfAction,
    lumped8::{Lumped8, MeshLaw, Motion8},
    lumped12::{Lumped12, Motion12},
    starting_state,
};
use nalgebra::DVector;

use super::{
    bodies::{bodies, supports8, supports12, torques},
    mesh_cycle::{Fed, half_a_cycle_on},
    model::{LadderModel, StaticPoint},
};
use crate::{
    motion::{GEARS, RPM, WRENCH},
    run,
    scene::{Driver, Law, Lumped8Scene, Lumped12Scene, MeshScene, Scene, Sharing},
};

const LEADING: [&str; 9] = [
    "time_s",
    "pinion_angle_deg",
    "mesh_phase",
    "dte_um",
    "mesh_deflection_um",
    "mesh_stiffness_n_per_um",
    "contact_line_length_mm",
    "normal_force_n",
    "friction_force_n",
];
/// Mesh cycles at t = 0: the pinion begins half a pitch before the middle of pair 0, as everywhere in this program.
const START: f64 = -0.5;

/// Sense in which the driver turns: scenes say how the pinion does.
fn driver_sense(scene: &Scene, pair: &GearPair) -> Sense {
    match (scene.operation.driver, run::options(scene, pair).contact.sense) {
        (Driver::Pinion, sense) => sense,
        (Driver::Wheel, Sense::Ccw) => Sense::Cw,
        (Driver::Wheel, Sense::Cw) => Sense::Ccw,
    }
}

/// Contact lines of a scene's pair.
pub(super) fn plane(scene: &Scene, pair: &GearPair) -> PlaneOfAction {
    let driver = run::options(scene, pair).contact.driver;
    PlaneOfAction::of_pair(pair, driver, &MeshFrame::of_pair(pair, driver, driver_sense(scene, pair)))
}

/// What both models have in common: pair with excitation, and its bodies.
///
/// # Errors
/// [`LumpedError`] for what has no meaning.
pub(super) fn lumped_pair(
    scene: &Scene,
    words: &MeshScene,
    pair: &GearPair,
    fed: &Fed,
) -> Result<(LumpedPair, [RigidBody; 2]), LumpedError> {
    let bodies = bodies(scene, pair);
    let operation = Operation {
        driver: run::options(scene, pair).contact.driver,
        sense: driver_sense(scene, pair),
        speed: scene.operation.speed_rpm * RPM,
        torque: scene.operation.torque(),
        friction: scene.contact.friction,
    };
    let mut made = LumpedPair::new(pair, &operation, bodies, half_a_cycle_on(&fed.cycle))?;
    made.clock = MeshClock { start: START, ..made.clock };
    made.torques = torques(scene, pair, made.torques[0].mean());
    made.plane.sharing = match words.line_sharing {
        Some(Sharing::Line) => LineSharing::ByLine,
        Some(Sharing::Length) | None => LineSharing::ByLength,
    };
    Ok((made, bodies))
}

/// Driver's first.
fn by_role<T>(pair: &LumpedPair, [pinion, wheel]: [T; 2]) -> [T; 2] {
    if pair.pinion_drives { [pinion, wheel] } else { [wheel, pinion] }
}

/// The model with eight coordinates.
pub(super) fn eight(
    scene: &Scene,
    words: &Lumped8Scene,
    mesh: &MeshScene,
    gears: &GearPair,
    mut pair: LumpedPair,
    bodies: &[RigidBody; 2],
) -> Result<Motion8, LumpedError> {
    if let Some(hz) = words.speed_fluctuation_hz {
        pair.clock.fluctuation = words.speed_fluctuation_rpm * RPM;
        pair.clock.fluctuation_frequency = TAU * hz;
    }
    let law = match words.law {
        Law::Normal => MeshLaw::Normal,
        Law::Projected => MeshLaw::Projected,
    };
    let half_backlash = mesh.half_backlash_um.map_or_else(|| law.half_backlash(gears), |b| 1e-3 * b);
    let supports = by_role(&pair, supports8(scene, bodies));
    let ratio = scene.motion.as_ref().and_then(|m| m.mesh_damping_ratio).unwrap_or(0.0);
    Lumped8::new(pair, supports, ratio, half_backlash, law)?.motion()
}

/// The model with twelve.
pub(super) fn twelve(scene: &Scene, words: &Lumped12Scene, mut pair: LumpedPair) -> Result<Motion12, LumpedError> {
    if let Some(degrees) = words.orientation_deg {
        pair.frame.orientation = degrees.to_radians();
    }
    let supports = by_role(&pair, supports12(scene));
    let between = [words.damping_from_hz, words.damping_to_hz].map(|f| TAU * f);
    Lumped12::new(pair, supports, words.damping_ratio, between)?.motion()
}

/// A coordinate of a gear: how its columns end and what a unit of it is in theirs.
type Coordinate = (&'static str, &'static str);

/// Across and along the line of action in the model with eight, global axes in the other.
const EIGHT: [Coordinate; 4] = [
    ("across_um", "across_rate_um_per_s"),
    ("along_um", "along_rate_um_per_s"),
    ("z_um", "z_rate_um_per_s"),
    ("turn_urad", "turn_rate_urad_per_s"),
];
const TWELVE: [Coordinate; 6] = [
    ("x_um", "x_rate_um_per_s"),
    ("y_um", "y_rate_um_per_s"),
    ("z_um", "z_rate_um_per_s"),
    ("tilt_x_urad", "tilt_x_rate_urad_per_s"),
    ("tilt_y_urad", "tilt_y_rate_urad_per_s"),
    ("turn_urad", "turn_rate_urad_per_s"),
];

fn columns(pair: &LumpedPair, coordinates: &[Coordinate]) -> Vec<String> {
    let mut names: Vec<String> = LEADING.iter().map(|&n| n.to_owned()).collect();
    for gear in GEARS {
        names.extend(WRENCH.iter().map(|n| format!("{gear}_{n}")));
    }
    let gears = by_role(pair, GEARS);
    for pick in [|c: &Coordinate| c.0, |c: &Coordinate| c.1] {
        names.extend(gears.iter().flat_map(|g| coordinates.iter().map(move |c| format!("{g}_{}", pick(c)))));
    }
    names
}

fn values(row: &HistoryRow, coordinates: &[Coordinate]) -> Vec<f64> {
    let mut all = vec![
        row.time,
        row.pinion_angle.to_degrees(),
        // Lumped pairs count from the middle of pair 0, files from half a cycle before.
        (row.mesh_phase - START).rem_euclid(1.0),
        1e3 * row.transmission_error,
        1e3 * row.mesh_deflection,
        1e-3 * row.mesh_stiffness,
        row.contact_line_length,
        row.normal_force,
        row.friction_force,
    ];
    all.extend(row.wrench.iter().flat_map(|w| w.force.iter().chain(&w.moment)));
    let unit = |i: usize| if coordinates[i % coordinates.len()].0.ends_with("urad") { 1e6 } else { 1e3 };
    for list in [&row.displacement, &row.velocity] {
        all.extend(list.iter().enumerate().map(|(i, x)| unit(i) * x));
    }
    all
}

/// The parts that both have by their common trait.
macro_rules! ladder_model {
    ($motion:ty, $coordinates:expr, $frequencies:expr) => {
        impl LadderModel for $motion {
            fn start(&mut self) -> Result<State, LumpedError> {
                Ok(starting_state(self))
            }

            fn scale(&self) -> DVector<f64> {
                LumpedModel::scale(self)
            }

            fn columns(&self) -> Vec<String> {
                columns(self.pair(), &$coordinates)
            }

            fn row(&mut self, state: &State) -> Vec<f64> {
                values(&LumpedModel::row(self, state.time, &state.q, &state.v), &$coordinates)
            }

            fn static_cycle(&self, phases: usize) -> Option<Vec<StaticPoint>> {
                let period = 1.0 / self.pair().clock.mesh_frequency();
                let at = |k: usize| {
                    let share = k as f64 / phases as f64;
                    let q = self.quasi_static(START + share)?;
                    let row = LumpedModel::row(self, share * period, &q, &DVector::zeros(q.len()));
                    Some(StaticPoint { error: row.transmission_error, line_length: Some(row.contact_line_length) })
                };
                (0..phases).map(at).collect()
            }

            fn natural_frequencies_hz(&self, _: f64) -> Vec<f64> {
                $frequencies(self)
            }
        }
    };
}

ladder_model!(Motion8, EIGHT, |_: &Motion8| Vec::new());
ladder_model!(Motion12, TWELVE, frequencies);

/// Of the pair at the start of a mesh cycle, with friction as it then is.
fn frequencies(model: &Motion12) -> Vec<f64> {
    model.modes(START).map_or_else(Vec::new, |modes| modes.iter().map(|m| m.frequency_hz).collect())
}
