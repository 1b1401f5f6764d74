//! Random pairs in motion at constant speed, the same in every run.

use scene::{BodyScene, DriveBy, DriveScene, Flanks, Kind, ModesScene, MotionScene, Scene, TorqueScene};
use testing::Random;

use crate::random_scene::random_scene;

/// Face width of a narrow pair at the most, modules: wide ones take minutes with normal modes.
const NARROW_MODULES: f64 = 8.0;
/// Tooth thinning of either gear over the module: some backlash.
const THINNING: f64 = 0.02;
/// Slices over the narrow face: steps, models and elasticity are compared at the same number of them.
const SLICES: u32 = 10;
/// Mesh frequency over the mesh resonance.
const SPEEDS: [f64; 2] = [0.05, 1.5];
/// Damping ratio of the mesh.
const DAMPING: [f64; 2] = [0.04, 0.12];

/// A pair in motion, and the speeds that it is run at.
#[derive(Debug, Clone)]
pub struct RandomMotion {
    /// At a speed that is to be set.
    pub scene: Scene,
    /// Mesh frequencies over the mesh resonance, one in each third of the logarithmic range.
    pub speeds: [f64; 3],
}

/// The pair of [`random_scene`] in motion, driven by speed or by a torque that balances the load, damping ratio 0.04 to
/// 0.12, backlash of some hundredths of a module; `None` for wide pairs.
pub fn random_motion(seed: u64, index: u64) -> Option<RandomMotion> {
    let mut scene = random_scene(seed, index);
    if scene.pair.face_width_mm > NARROW_MODULES * scene.pair.normal_module_mm {
        return None;
    }
    let mut random = Random::new(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ index.wrapping_mul(0xbf58_476d_1ce4_e5b9));
    let mut log = |[low, high]: [f64; 2]| random.between(low.ln(), high.ln()).exp();
    let damping = log(DAMPING);
    let third = (SPEEDS[1] / SPEEDS[0]).cbrt();
    let speeds = [0, 1, 2].map(|i| SPEEDS[0] * third.powi(i)).map(|low| log([low, third * low]));
    let by = if random.between(0.0, 1.0) < 0.5 { DriveBy::Speed } else { DriveBy::Torque };
    scene.analysis.kind = Kind::Dynamic;
    scene.analysis.cycles = 1;
    scene.contact.flanks = Flanks::Driving;
    scene.contact.slices = Some(SLICES);
    scene.motion = Some(MotionScene {
        spectral_radius: None,
        steps_per_mesh_cycle: 64,
        steps_per_resonance: 16,
        mesh_damping_ratio: Some(damping),
        periodic_tolerance: Some(1e-3),
        warm_up_cycles: Some(300),
        ..MotionScene::default()
    });
    scene.drive = Some(DriveScene { by, torque: TorqueScene::default() });
    scene.load = Some(TorqueScene::default());
    let thinning = THINNING * scene.pair.normal_module_mm;
    for gear in [&mut scene.pinion, &mut scene.wheel] {
        gear.thickness_allowance_mm = thinning;
        gear.body = Some(BodyScene::default());
    }
    Some(RandomMotion { scene, speeds })
}

/// The lowest modes of each gear: six steps in a period of the highest of them are fine ones for the mesh.
pub fn fine_modes() -> ModesScene {
    ModesScene { count: Some(4), fixed_modes: None, damping_ratio: 0.02, ..ModesScene::default() }
}

impl RandomMotion {
    /// The scene at a mesh frequency, Hz.
    pub fn at(&self, mesh_hz: f64) -> Scene {
        let mut scene = self.scene.clone();
        scene.operation.speed_rpm = 60.0 * mesh_hz / f64::from(scene.driver_teeth());
        scene
    }
}
