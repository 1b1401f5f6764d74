//! Motion settings of a scene, in the solvers' types and units.

use dynamics::{Bearing, COORDINATES, Drive, MeshDamping, MotionOptions, RigidBody, Speed, Torque};
use gearbox::motion::SteadyBy;
use geometry::GearPair;
use integrate::Scheme;
use nalgebra::Matrix6;
use scene::{Axis, BearingScene, BodyScene, DriveBy, Driver, MotionScene, Scene, SteadyBy as SteadyWord, TorqueScene};

use crate::{AnalysisError, elastic_gears::material, meshes::SceneMesh};

/// Bodies, bearings, drive and load of the scene; contact as given.
///
/// # Errors
/// [`AnalysisError::Reduction`] if a body has no mass.
pub fn motion_options(
    scene: &Scene,
    pair: &GearPair,
    meshes: &[SceneMesh; 2],
    contact: ltca::StaticOptions,
) -> Result<MotionOptions, AnalysisError> {
    let stated = [0, 1].map(|i| scene.gears()[i].body.clone().unwrap_or_default());
    let bodies = [body(scene, meshes, &stated[0], 0)?, body(scene, meshes, &stated[1], 1)?];
    let free = [0, 1].map(|i| {
        let mut free = [false; COORDINATES];
        stated[i].free.iter().for_each(|axis| free[axis.number()] = true);
        free
    });
    let bearings = [0, 1].map(|i| bearing(&scene.gears()[i].bearing, &stated[i].free, &bodies[i]));
    let damping = match scene.motion.as_ref() {
        Some(MotionScene { mesh_damping_ns_per_mm2: Some(c), .. }) => MeshDamping::PerLength(*c),
        Some(MotionScene { mesh_damping_ratio: Some(zeta), .. }) => MeshDamping::Ratio(*zeta),
        _ => MeshDamping::Ratio(0.0),
    };
    let load = torque(scene.load.as_ref().unwrap_or(&TorqueScene::default()), scene.operation.torque());
    let drive = pair_drive(scene, pair);
    Ok(MotionOptions { statics: contact, bodies, bearings, free, drive, load, damping, start_cycles: 0.0 })
}

/// What drives a pair of elastic gears: as below, but a torque that the scene does not state balances the load at every
/// instant, so that the mean speed is the given one.
pub(crate) fn pair_drive(scene: &Scene, pair: &GearPair) -> Drive {
    let balances = scene.drive.as_ref().is_some_and(|d| d.by == DriveBy::Torque && d.torque.is_none());
    if balances { Drive::Balanced(speed(scene)) } else { drive(scene, pair) }
}

/// Drive of the driver: its speed, or a torque that balances the mean load unless the scene gives another.
pub fn drive(scene: &Scene, pair: &GearPair) -> Drive {
    let start = scene.operation.speed();
    if let Some(drive) = scene.drive.as_ref().filter(|d| d.by == DriveBy::Torque) {
        let teeth = [pair.pinion.teeth(), pair.wheel.teeth()].map(f64::from);
        let ratio = match scene.operation.driver {
            Driver::Pinion => teeth[0] / teeth[1],
            Driver::Wheel => teeth[1] / teeth[0],
        };
        return Drive::Torque { start, torque: torque(&drive.torque, ratio * scene.operation.torque()) };
    }
    Drive::Speed(speed(scene))
}

/// Speed of the driver according to the scene, rad/s.
pub fn speed(scene: &Scene) -> Speed {
    match scene.motion.as_ref().and_then(|m| m.ramp) {
        None => Speed::Constant(scene.operation.speed()),
        Some(ramp) => {
            let [from, to] = ramp.speeds();
            Speed::Ramp { from, to, start: ramp.before_s, duration: ramp.duration_s }
        }
    }
}

/// Torque over time, N mm; `mean` if the scene gives none.
pub fn torque(stated: &TorqueScene, mean: f64) -> Torque {
    let mean = stated.mean().unwrap_or(mean);
    match (stated.table(), stated.harmonic()) {
        (Some([times, values]), _) => Torque::Table { times, values },
        (None, Some([amplitude, frequency_hz, phase])) => Torque::Harmonic { mean, amplitude, frequency_hz, phase },
        (None, None) => Torque::Constant(mean),
    }
}

/// Mass and inertia of the mesh (of the whole gear, where it has a part of the teeth), unless the scene states others.
pub(crate) fn body(
    scene: &Scene,
    meshes: &[SceneMesh; 2],
    stated: &BodyScene,
    i: usize,
) -> Result<RigidBody, AnalysisError> {
    let gear = &meshes[i].gear;
    let own = fem::mass_properties(gear.mesh(), &material(scene, i)?)
        .map_err(|e| AnalysisError::from(e).of_part(&*meshes[i].facts.source))?;
    let meshed = if gear.is_periodic_sector() { 1 } else { gear.teeth().len().max(1) };
    let copies = f64::from(gear.tooth_count()) / meshed as f64;
    let of_mesh = RigidBody::of_tensor(own.mass_t, own.inertia_about_tmm2([0.0; 3]));
    let whole = RigidBody {
        mass: copies * of_mesh.mass,
        transverse_inertia: copies * of_mesh.transverse_inertia,
        polar_inertia: copies * of_mesh.polar_inertia,
    };
    Ok(stated_body(stated, whole))
}

/// Mass and inertia that the scene gives for a body, and those of `own` if it gives none.
pub fn stated_body(stated: &BodyScene, own: RigidBody) -> RigidBody {
    let [transverse, polar] = stated.inertias();
    RigidBody {
        mass: stated.mass().unwrap_or(own.mass),
        transverse_inertia: transverse.unwrap_or(own.transverse_inertia),
        polar_inertia: polar.unwrap_or(own.polar_inertia),
    }
    .with_polar(stated.added_inertia())
}

/// Damping of a direction: as given by the scene, or from the damping ratio, c = 2 zeta sqrt(k m).
pub fn bearing(stated: &BearingScene, free: &[Axis], body: &RigidBody) -> Bearing {
    let whole = |m: &[[f64; 5]; 5]| Matrix6::from_fn(|i, j| if i < 5 && j < 5 { m[i][j] } else { 0.0 });
    let diagonal = |values: [f64; 5]| Matrix6::from_fn(|i, j| if i == j && i < 5 { values[i] } else { 0.0 });
    let stiffness = match &stated.stiffness_matrix_n_mm_rad {
        Some(matrix) => whole(matrix),
        None => diagonal(stated.stiffnesses().map(|k| k.unwrap_or(0.0))),
    };
    let damping = match &stated.damping_matrix_ns_mm_rad {
        Some(matrix) => whole(matrix),
        None => {
            let mass = body.matrix();
            let ratio = stated.damping_ratio.unwrap_or(0.0);
            let own = stated.dampings();
            let of = |axis: Axis| {
                let i = axis.number();
                let by_ratio = 2.0 * ratio * (stiffness[(i, i)] * mass[(i, i)]).sqrt();
                if free.contains(&axis) { own[i].unwrap_or(by_ratio) } else { 0.0 }
            };
            diagonal(Axis::ALL.map(of))
        }
    };
    Bearing { stiffness, damping }
}

/// Integration method of a scene.
pub fn scheme(motion: &MotionScene) -> Scheme {
    motion.scheme()
}

/// Method for steady states.
pub fn steady_by(by: SteadyWord) -> SteadyBy {
    match by {
        SteadyWord::Running => SteadyBy::Running,
        SteadyWord::Shooting => SteadyBy::Shooting,
    }
}
