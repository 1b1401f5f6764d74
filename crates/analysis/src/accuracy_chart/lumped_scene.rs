//! The scene of the chart for a cheaper model: the same pair, torque and speed, with the additional keys of that model.

use scene::{
    AccuracyScene, Axis, BearingScene, BodyScene, DriveBy, DriveScene, GearScene, ImpactScene, Kind, Law, Lumped8Scene,
    Lumped12Scene, MeshScene, Model, MotionScene, Scene, Shaft18Scene, ShaftScene, Sharing, StiffnessFrom,
    SupportScene, TorqueScene,
};

/// Supports that hold as the reduced model's fixed axes do, N/mm and N mm/rad: they yield less than 1e-4 of the teeth.
const HELD: [f64; 2] = [1e10, 1e14];
/// Length of a shaft over the face width, its gear in the middle.
const SHAFT_WIDTHS: f64 = 3.0;

/// In motion at constant speed.
pub(super) fn in_motion(scene: &mut Scene) {
    scene.analysis.kind = Kind::Dynamic;
    scene.accuracy = AccuracyScene::default();
    scene.motion = Some(MotionScene {
        spectral_radius: None,
        steps_per_mesh_cycle: 64,
        steps_per_resonance: 16,
        mesh_damping_ratio: Some(0.05),
        periodic_tolerance: Some(1e-4),
        warm_up_cycles: Some(400),
        ..MotionScene::default()
    });
    scene.drive = Some(DriveScene { by: DriveBy::Speed, torque: TorqueScene::default() });
    scene.load = Some(TorqueScene::default());
    for gear in [&mut scene.pinion, &mut scene.wheel] {
        gear.body.get_or_insert_with(BodyScene::default);
    }
}

/// The tables of a model with lumped gears, held at their centres.
fn lumped(scene: &mut Scene, model: Model, free: &[Axis], from: StiffnessFrom) {
    in_motion(scene);
    scene.analysis.model = model;
    scene.modes = None;
    if from != StiffnessFrom::Reduced {
        scene.analysis.reduction = None;
    }
    let held = |axis: Axis, k: f64| free.contains(&axis).then_some(k);
    for gear in [&mut scene.pinion, &mut scene.wheel] {
        gear.body = Some(BodyScene { free: free.to_vec(), ..gear.body.take().unwrap_or_default() });
        gear.bearing = BearingScene {
            stiffness_x_n_per_mm: held(Axis::X, HELD[0]),
            stiffness_y_n_per_mm: held(Axis::Y, HELD[0]),
            stiffness_z_n_per_mm: held(Axis::Z, HELD[0]),
            stiffness_rx_nmm_per_rad: held(Axis::Rx, HELD[1]),
            stiffness_ry_nmm_per_rad: held(Axis::Ry, HELD[1]),
            ..BearingScene::default()
        };
    }
    scene.mesh = Some(MeshScene {
        stiffness_from: from,
        stiffness_n_per_um: None,
        stiffness_cos_n_per_um: Vec::new(),
        stiffness_sin_n_per_um: Vec::new(),
        error_cos_um: Vec::new(),
        error_sin_um: Vec::new(),
        half_backlash_um: None,
        line_sharing: matches!(model, Model::Lumped8 | Model::Lumped12).then_some(Sharing::Length),
    });
}

/// Eight coordinates, ISO's stiffness on the contact lines.
pub(super) fn lumped8(scene: &mut Scene) {
    lumped(scene, Model::Lumped8, &Axis::ALL[..3], StiffnessFrom::Iso);
    scene.lumped8 = Some(Lumped8Scene { law: Law::Normal, speed_fluctuation_rpm: 0.0, speed_fluctuation_hz: None });
}

/// Twelve likewise.
pub(super) fn lumped12(scene: &mut Scene) {
    lumped(scene, Model::Lumped12, &Axis::ALL, StiffnessFrom::Iso);
    twelve(scene);
}

/// Twelve, fed by the reduced model.
pub(super) fn lumped12_fed(scene: &mut Scene) {
    lumped(scene, Model::Lumped12, &Axis::ALL, StiffnessFrom::Reduced);
    twelve(scene);
}

fn twelve(scene: &mut Scene) {
    scene.lumped12 = Some(Lumped12Scene {
        orientation_deg: None,
        damping_ratio: 0.05,
        damping_from_hz: 500.0,
        damping_to_hz: 10_000.0,
    });
}

/// Solid shafts of the bores' diameters, three face widths long, supported at both ends.
pub(super) fn shaft18(scene: &mut Scene) {
    lumped(scene, Model::Shaft18, &[], StiffnessFrom::Iso);
    scene.shaft18 =
        Some(Shaft18Scene { mass_damping_per_s: 20.0, stiffness_damping_s: 2e-7, gravity_m_per_s2: [0.0; 3] });
    let widths = scene.face_widths_mm();
    for (gear, width) in [&mut scene.pinion, &mut scene.wheel].into_iter().zip(widths) {
        gear.shaft = Some(shaft(gear, width));
    }
}

fn shaft(gear: &GearScene, width: f64) -> ShaftScene {
    let length = SHAFT_WIDTHS * width;
    let end = |at_mm: f64| SupportScene {
        at_mm,
        stiffness_x_n_per_mm: HELD[0],
        stiffness_y_n_per_mm: HELD[0],
        stiffness_z_n_per_mm: HELD[0],
        stiffness_rx_nmm_per_rad: 0.0,
        stiffness_ry_nmm_per_rad: 0.0,
        stiffness_rz_nmm_per_rad: 0.0,
        damping_x_ns_per_mm: 0.0,
        damping_y_ns_per_mm: 0.0,
        damping_z_ns_per_mm: 0.0,
        damping_rx_nmms_per_rad: 0.0,
        damping_ry_nmms_per_rad: 0.0,
        damping_rz_nmms_per_rad: 0.0,
    };
    ShaftScene {
        segments_mm: vec![[length, gear.bore_diameter_mm, 0.0]],
        gear_at_mm: 0.5 * length,
        torque_at_mm: 0.5 * length,
        nodes_mm: Vec::new(),
        run_out_um: 0.0,
        run_out_phase_deg: 0.0,
        discs: Vec::new(),
        supports: vec![end(0.0), end(length)],
    }
}

/// Rigid gears; the stiffness by the formula for two balls.
pub(super) fn impact(scene: &mut Scene) {
    in_motion(scene);
    scene.analysis.model = Model::Impact;
    scene.analysis.reduction = None;
    scene.modes = None;
    scene.impact = Some(ImpactScene {
        stiffness_n_per_mm_to_exponent: None,
        exponent: 1.5,
        damping_ns_per_mm: 50.0,
        damping_depth_mm: 0.1,
        static_friction: 0.0,
        dynamic_friction: 0.0,
        static_speed_mm_per_s: 0.1,
        dynamic_speed_mm_per_s: 10.0,
    });
}
