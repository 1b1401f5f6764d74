//! Nominal pressures and losses against published pairs and closed forms, load factors against what they mean.

use analysis::{
    StaticAnalysis, StaticResult,
    facts::RunInfo,
    results::{StaticHeadline, static_headline},
};
use geometry::Side;
use scene::{Scene, SceneBuilder};

fn close(what: &str, value: f64, wanted: f64, tolerance: f64) {
    assert!((value - wanted).abs() <= tolerance, "{what}: {value}, not {wanted}");
}

fn built(scene: SceneBuilder) -> Scene {
    scene.build().unwrap_or_else(|e| panic!("{e}"))
}

fn solved(scene: &Scene) -> (StaticResult, StaticHeadline) {
    let result = StaticAnalysis::new(scene).solve().unwrap_or_else(|e| panic!("{e}"));
    let headline = static_headline(scene, &result.history).unwrap();
    (result, headline)
}

fn facts(scene: &Scene) -> RunInfo {
    RunInfo::of_pair(scene, &scene.gear_pair().unwrap())
}

/// ISO/TR 6336-30, example 1, with the rounded tip diameters of the report.
fn iso_example() -> Scene {
    let pair = Scene::builder().pinion(17, 15.8).wheel(103).normal_module_mm(8.0).face_width_mm(100.0);
    let pair = pair.torque_nm(9000.0 * 103.0 / 17.0).set("pair.centre_distance_mm", 500.0);
    let pair = pair.set("pinion.profile_shift", 0.145).set("pair.dedendum_coefficient", 1.4);
    let pair = pair.set("pair.root_radius_coefficient", 0.35).set("pinion.bore_diameter_mm", 60.0);
    built(pair.set("pinion.tip_diameter_mm", 159.66).set("wheel.tip_diameter_mm", 872.35))
}

/// ISO/TR 6336-30, example 1: forces, lengths of contact lines and contact stress as printed, to the last digit.
#[test]
fn the_iso_example_has_its_printed_forces_and_stress() {
    let scene = iso_example();
    let nominal = facts(&scene).nominal_pressure.unwrap();
    close("F_t", nominal.tangential_force_n, 127_352.0, 0.5);
    close("F_bn", nominal.normal_force_n, 140_850.0, 5.0);
    close("Z_eps", nominal.contact_ratio_factor, 0.803, 0.0005);
    close("sigma_H0", nominal.iso_contact_stress_mpa, 1206.58, 0.005);
    let pair = scene.gear_pair().unwrap();
    close("L mean", pair.mean_contact_line_length(), 160.27, 0.03);
    let pitch = pair.pinion.pitch_angle();
    let lengths = (0..2000).map(|i| pair.contact_line_length(Side::Left, f64::from(i) / 2000.0 * pitch));
    let [least, most] = lengths.fold([f64::MAX, f64::MIN], |[a, b], l| [a.min(l), b.max(l)]);
    // The report has eps_alpha to four digits; 0.03 mm are as many of L.
    close("L min", least, 155.90, 0.03);
    close("L max", most, 163.86, 0.03);
    let [.., axial] = solved(&built_iso(&scene)).1.mean_wheel_force_n;
    close("F_a", axial.abs(), 36_040.0, 5.0);
}

/// The scene by the model of closed forms.
fn built_iso(scene: &Scene) -> Scene {
    let mut scene = scene.clone();
    scene.analysis.model = scene::Model::Iso;
    scene
}

/// FZG C14: F_bt 5912.1 N; 1347.3 MPa at C, 1442.5 MPa at most, where a single pair begins to carry at the pinion's
/// root.
#[test]
fn the_fzg_pair_has_its_published_pressures() {
    let pair = Scene::builder().pinion(16, 0.0).wheel(24).normal_module_mm(4.5).face_width_mm(14.0).torque_nm(300.0);
    let pair = pair.set("pinion.profile_shift", 0.1817).set("wheel.profile_shift", 0.1715);
    let nominal = facts(&built(pair.set("pair.centre_distance_mm", 91.5))).nominal_pressure.unwrap();
    let at = |name: char| nominal.hertz.iter().find(|p| p.name == name).unwrap().pressure_mpa;
    close("F_bn", nominal.normal_force_n, 5912.1, 0.1);
    close("p at C", at('C'), 1347.3, 0.1);
    close("p at B", at('B'), 1442.5, 0.001 * 1442.5);
    assert!(at('D') < at('C') && at('C') < at('B'), "{nominal:?}");
    // What Z_B is: from the pitch point to B.
    let [z_b, z_d] = nominal.single_contact_factors.unwrap();
    close("Z_B", z_b, at('B') / at('C'), 1e-8);
    close("Z_D", z_d, 1.0, 0.0);
}

fn closed_form(teeth: [u32; 2], helix_deg: f64, width_mm: f64) -> Scene {
    let pair = Scene::builder().pinion(teeth[0], helix_deg).wheel(teeth[1]).normal_module_mm(3.0);
    let pair = pair.face_width_mm(width_mm).torque_nm(200.0).set("analysis.model", "iso");
    built(pair.set("analysis.positions_per_cycle", 2000))
}

/// Evenly shared, the load of a spur pair loses what the closed form of the sheet says; that of a helical pair whose
/// overlap ratio is 1 lies evenly on the whole path, and loses pi (1/z_1 + 1/z_2) (eps_1^2 + eps_2^2) / (eps_alpha cos
/// b_b). K_Halpha is 1 in both.
#[test]
fn losses_of_an_even_load_are_the_closed_forms() {
    let spur = closed_form([25, 41], 0.0, 20.0);
    let (_, headline) = solved(&spur);
    let sheet = facts(&spur).geometry_sheet.unwrap();
    let (wanted, found) = (sheet.tooth_loss_factor, headline.tooth_loss_factor.unwrap());
    // The load jumps between one pair and two: 2000 positions are off by less than a two-thousandth.
    assert!((found / wanted - 1.0).abs() < 5e-4, "spur: H_VL {found}, not {wanted}");
    close("spur: K_Halpha", headline.transverse_load_factor.unwrap(), 1.0, 1e-12);
    assert_eq!(headline.efficiency, 1.0, "without friction nothing is lost");

    let width = facts(&closed_form([25, 41], 20.0, 20.0)).geometry_sheet.unwrap();
    let width = 20.0 / width.eps_beta;
    let helical = closed_form([25, 41], 20.0, width);
    let (_, headline) = solved(&helical);
    let sheet = facts(&helical).geometry_sheet.unwrap();
    let parts = [sheet.approach_path_mm, sheet.recess_path_mm].map(|g| (g / sheet.transverse_base_pitch_mm).powi(2));
    let teeth = std::f64::consts::PI * (1.0 / 25.0 + 1.0 / 41.0);
    let wanted = teeth * (parts[0] + parts[1]) / sheet.eps_alpha / sheet.base_helix_angle_deg.to_radians().cos();
    let found = headline.tooth_loss_factor.unwrap();
    assert!((found / wanted - 1.0).abs() < 1e-6, "helical: H_VL {found}, not {wanted}");
    close("helical: H_V of the sheet", sheet.tooth_loss_factor, wanted, 1e-12);
    close("helical: K_Halpha", headline.transverse_load_factor.unwrap(), 1.0, 1e-12);
}

fn small(helix_deg: f64) -> SceneBuilder {
    let pair = Scene::builder().pinion(24, helix_deg).wheel(31).normal_module_mm(3.0).face_width_mm(15.0);
    let mut pair = pair.torque_nm(200.0).set("contact.slices", 16);
    for gear in ["pinion", "wheel"] {
        for (key, value) in
            [("elements_profile", 2), ("elements_fillet", 2), ("elements_thickness", 2), ("elements_rim", 2)]
        {
            pair = pair.set(&format!("{gear}.mesher.{key}"), value);
        }
    }
    pair.set("analysis.positions_per_cycle", 16)
}

/// Friction takes its coefficient times the loss factor of the pair without it, to the first order: 3 % are what
/// friction moves the load by, and what it is less near the pitch line, where it changes its sign through zero.
#[test]
fn friction_takes_its_coefficient_times_the_loss_factor() {
    let without = solved(&built(small(15.0))).1;
    assert_eq!(without.efficiency, 1.0);
    let factor = without.tooth_loss_factor.unwrap();
    for friction in [0.01, 0.05] {
        let with = solved(&built(small(15.0).set("contact.friction", friction))).1;
        let lost = 1.0 - with.efficiency;
        assert!((lost / (friction * factor) - 1.0).abs() < 0.03, "mu {friction}: {lost} lost, H_VL {factor}");
    }
}

/// A tooth that stands ahead takes load from its neighbours: the load sharing ratio of a helical pair grows, and with it
/// K_Halpha, which is 1 where the ratio is below. Of a spur pair with a
/// single pair in contact it stays 1: no pair can carry more than all. One per cent is for tips of the next pair that
/// press off the line of action, with a shorter lever and so more force, where one line touches nominally.
#[test]
fn pitch_errors_raise_the_transverse_load_factor() {
    let factor = |helix: f64, ahead_um: f64| {
        let mut errors = vec![0.0; 24];
        errors[0] = ahead_um;
        let scene = built(small(helix).set("pinion.pitch_errors_um", errors).set("analysis.cycles", 3));
        let headline = solved(&scene).1;
        let ratio = headline.load_sharing_ratio.unwrap();
        assert_eq!(headline.transverse_load_factor, Some(ratio.max(1.0)), "K_Halpha is no less than 1");
        ratio
    };
    let all: Vec<f64> = [0.0, 4.0, 8.0].map(|e| factor(25.0, e).max(factor(25.0, -e))).to_vec();
    assert!(all.windows(2).all(|w| w[1] > w[0]), "helical: {all:?}");
    assert!(all[0] < 1.0, "soft ends of lines spread the load: {all:?}");
    for ahead in [0.0, 8.0] {
        let spur = factor(0.0, ahead);
        assert!((spur - 1.0).abs() < 0.01, "spur, {ahead} um: K_Halpha {spur}");
    }
}
