//! Makes the scenes of the models of a motion.

use scene::{
    AccuracyScene, Axis, BearingScene, BodyScene, DriveBy, DriveScene, Driver, Lumped12Scene, MeshScene, Model,
    ModesScene, Scene, Sharing, StiffnessFrom, TorqueScene,
};

use super::{MotionModel, PairAtRest};

/// Supports that hold a lumped gear as fixed axes do, N/mm and N mm/rad: they yield less than 1e-4 of the teeth.
const HELD: [f64; 2] = [1e10, 1e14];
/// Inertia of a driver whose speed is given over the one that it has: it turns as if nothing could stop it.
const HELD_INERTIA: f64 = 1e6;
/// Lower frequency of Rayleigh damping, Hz: so low that damping goes with stiffness alone, as that of a mesh does.
const NO_MASS_DAMPING_HZ: f64 = 1e-6;
/// t in kg, t mm^2 in kg m^2.
const KILOGRAM: f64 = 1e3;
const KILOGRAM_METRE2: f64 = 1e-3;
/// Lowest normal modes of each gear that the ladder keeps, and their damping ratio, the default of `[modes]`: more of
/// them make steps shorter and hardly change what the teeth do.
const MODES: u32 = 6;
const MODE_DAMPING: f64 = 0.01;

impl MotionModel {
    /// A scene in motion as one of this model without `[accuracy]`, with a given number of steps in a period of the
    /// resonance.
    pub fn scene(self, scene: &Scene, rest: &PairAtRest, steps_per_resonance: u32) -> Scene {
        let mut own = Scene { accuracy: AccuracyScene::default(), ..scene.clone() };
        if let Some(motion) = &mut own.motion {
            motion.steps_per_resonance = steps_per_resonance;
        }
        match self {
            Self::Lumped12 => lumped12(&mut own, rest),
            Self::Reduced => {
                own.analysis.model = Model::Reduced;
                own.modes = None;
            }
            Self::ReducedModes => {
                own.analysis.model = Model::ReducedModes;
                own.modes.get_or_insert(ModesScene {
                    count: Some(MODES),
                    fixed_modes: None,
                    damping_ratio: MODE_DAMPING,
                    ..ModesScene::default()
                });
            }
        }
        own
    }
}

/// The tables that the model of twelve coordinates wants: masses of the meshes, damping of the mesh, fixed axes.
fn lumped12(scene: &mut Scene, rest: &PairAtRest) {
    scene.analysis.model = Model::Lumped12;
    scene.modes = None;
    let driver = usize::from(scene.operation.driver == Driver::Wheel);
    let held = scene.drive.as_ref().is_some_and(|d| d.by == DriveBy::Speed);
    for (i, gear) in [&mut scene.pinion, &mut scene.wheel].into_iter().enumerate() {
        let body = rest.bodies[i];
        let more = if held && i == driver { HELD_INERTIA } else { 1.0 };
        gear.body = Some(BodyScene {
            mass_kg: Some(KILOGRAM * body.mass),
            transverse_inertia_kg_m2: Some(KILOGRAM_METRE2 * body.transverse_inertia),
            polar_inertia_kg_m2: Some(KILOGRAM_METRE2 * more * body.polar_inertia),
            free: Axis::ALL.to_vec(),
            ..BodyScene::default()
        });
        gear.bearing = BearingScene {
            stiffness_x_n_per_mm: Some(HELD[0]),
            stiffness_y_n_per_mm: Some(HELD[0]),
            stiffness_z_n_per_mm: Some(HELD[0]),
            stiffness_rx_nmm_per_rad: Some(HELD[1]),
            stiffness_ry_nmm_per_rad: Some(HELD[1]),
            ..BearingScene::default()
        };
    }
    // Its torques balance each other.
    scene.drive = Some(DriveScene { by: DriveBy::Speed, torque: TorqueScene::default() });
    if let Some(motion) = &mut scene.motion {
        (motion.mesh_damping_ratio, motion.mesh_damping_ns_per_mm2) = (None, None);
        motion.checkpoint_every_cycles = Some(0);
    }
    scene.mesh = Some(MeshScene {
        stiffness_from: StiffnessFrom::Reduced,
        stiffness_n_per_um: None,
        stiffness_cos_n_per_um: Vec::new(),
        stiffness_sin_n_per_um: Vec::new(),
        error_cos_um: Vec::new(),
        error_sin_um: Vec::new(),
        half_backlash_um: None,
        line_sharing: Some(Sharing::Length),
    });
    scene.lumped12 = Some(Lumped12Scene {
        orientation_deg: None,
        damping_ratio: rest.resonance.damping,
        damping_from_hz: NO_MASS_DAMPING_HZ,
        damping_to_hz: rest.resonance.hz,
    });
}
