//! ISO 6336-1 stiffness against the standard's own worked example and against its structure.

use lumped::LumpedError;
use lumped::iso::{IsoPair, mean_transmission_error_um, stiffness};

/// ISO/TR 6336-30:2022, example 1 (helical, solid discs). The report rounds the tip diameters to 0.01 mm
/// (159.66 and 872.35 mm) before it computes eps_alpha, hence the last digits.
fn example_1() -> IsoPair {
    let beta = 15.8_f64.to_radians();
    let alpha_n = 20_f64.to_radians();
    let alpha_t = (alpha_n.tan() / beta.cos()).atan();
    let base_radius = |z: f64| 8.0 * z / (2.0 * beta.cos()) * alpha_t.cos();
    let (rb1, rb2) = (base_radius(17.0), base_radius(103.0));
    let half_path = |tip: f64, rb: f64| ((0.5 * tip).powi(2) - rb * rb).sqrt();
    let working = ((rb1 + rb2) / 500.0).acos();
    let path = half_path(159.66, rb1) + half_path(872.35, rb2) - 500.0 * working.sin();
    let base_pitch = std::f64::consts::PI * 8.0 * alpha_t.cos() / beta.cos();
    IsoPair {
        internal: false,
        teeth: [17, 103],
        profile_shift: [0.145, 0.0],
        helix_angle: beta,
        normal_pressure_angle: alpha_n,
        dedendum_coefficient: [1.4, 1.4],
        young: [2.06e5; 2],
        eps_alpha: path / base_pitch,
        line_load: 127_352.0 / 100.0,
    }
}

/// All four published figures to all published digits.
#[test]
fn the_worked_example_of_the_standard_comes_out() {
    let s = stiffness(&example_1()).unwrap();
    let published = [
        (s.c_theoretical, 17.85584, "c'_th"),
        (s.c_single, 12.37047, "c'"),
        (s.c_mesh, 17.46485, "c_gamma_alpha"),
        (s.c_mesh_beta, 14.84512, "c_gamma_beta"),
    ];
    for (ours, theirs, name) in published {
        assert!((ours - theirs).abs() < 0.6e-5, "{name}: {ours:.6}, published {theirs}");
    }
}

/// Deflection is proportional to load above 100 N/mm, grows with its 3/4th power below, and is continuous there.
#[test]
fn light_load_softens_the_mesh_continuously() {
    let at = |line_load: f64| stiffness(&IsoPair { line_load, ..example_1() }).unwrap().c_mesh;
    assert_eq!(at(200.0), at(1000.0));
    assert!((at(100.0 * (1.0 - 1e-12)) / at(100.0) - 1.0).abs() < 1e-11);
    assert!((at(100.0 / 16.0) / at(100.0) - 0.5).abs() < 1e-12);
}

/// Twice the modulus of both gears halves the transmission error; one rigid gear halves it too.
#[test]
fn stiffness_is_proportional_to_the_mean_compliance_of_the_materials() {
    let te = |young: [f64; 2]| {
        mean_transmission_error_um(&stiffness(&IsoPair { young, ..example_1() }).unwrap(), 1e4, 100.0)
    };
    let steel = te([2.06e5; 2]);
    assert!((te([4.12e5; 2]) / steel - 0.5).abs() < 1e-12);
    assert!((te([2.06e5, 1e30]) / steel - 0.5).abs() < 1e-12);
}

/// The hand of the helix changes nothing.
#[test]
fn mirroring_the_pair_changes_nothing() {
    let pair = example_1();
    let mirrored = IsoPair { helix_angle: -pair.helix_angle, ..pair };
    assert_eq!(stiffness(&pair), stiffness(&mirrored));
}

#[test]
fn inputs_outside_of_the_standard_are_named() {
    let steep = IsoPair { helix_angle: 1.0, ..example_1() };
    assert!(matches!(stiffness(&steep), Err(LumpedError::OutOfRange { quantity: "helix angle in degrees", .. })));
    let nothing = IsoPair { line_load: f64::NAN, ..example_1() };
    assert!(matches!(stiffness(&nothing), Err(LumpedError::OutOfRange { quantity: "line load in N/mm", .. })));
}

/// Index 1 of ISO 6336-1 is the smaller gear, whatever a scene calls pinion: exchanged names leave every bit, also where
/// both gears have as many teeth and different profile shifts.
#[test]
fn names_of_the_gears_change_nothing() {
    for (teeth, shift) in
        [([17, 103], [0.145, 0.0]), ([36, 18], [0.0, 0.0]), ([25, 25], [0.4, -0.2]), ([60, 20], [-0.1, 0.5])]
    {
        let pair = IsoPair { teeth, profile_shift: shift, ..example_1() };
        let other = IsoPair { teeth: [teeth[1], teeth[0]], profile_shift: [shift[1], shift[0]], ..pair };
        assert_eq!(stiffness(&pair).unwrap(), stiffness(&other).unwrap(), "{teeth:?}");
    }
    // Of the order of the standard's example, which is named as it should be.
    let wrong = IsoPair { teeth: [103, 17], ..example_1() };
    assert!((stiffness(&wrong).unwrap().c_mesh / stiffness(&example_1()).unwrap().c_mesh - 1.0).abs() > 1e-3);
}
