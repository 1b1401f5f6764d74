//! Measured flanks with waves shorter than the band of contact, and what a user hears of them.

use crate::util::Scratch;

const PAIR: &str = "[pinion]\nteeth = 30\nhelix_angle_deg = 0.0\nthickness_allowance_mm = 0.05\n\
                    modification = { topography = \"flank.csv\" }\n[wheel]\nteeth = 30\nthickness_allowance_mm = 0.05\n\
                    [pair]\nnormal_module_mm = 3.0\nface_width_mm = 20.0\n[operation]\ntorque_nm = TORQUE\n\
                    [analysis]\npositions_per_cycle = 1\n";
const MESHER: &str =
    "mesher = { order = 1, elements_profile = 2, elements_thickness = 2, elements_face = 2, elements_rim = 1 }\n";

/// What a run with depths of `um` over the roll angle (rad) says; `more` is for its contact.
fn said(um: impl Fn(f64) -> f64, torque: f64, more: &str) -> String {
    let mut grid = "roll_deg, -10, 10\n".to_owned();
    for i in 0..401 {
        let roll = 10.0 + 0.075 * f64::from(i);
        let depth = um(roll.to_radians());
        grid += &format!("{roll}, {depth}, {depth}\n");
    }
    let scene = PAIR
        .replace("TORQUE", &torque.to_string())
        .replace("thickness_allowance", &format!("{MESHER}thickness_allowance"));
    let scratch = Scratch::new().file("a.toml", scene + more).file("flank.csv", grid);
    let run = scratch.ale_gear(["run", "a.toml", "--out", "o", "--no-cache"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    run.stdout + &run.stderr
}

/// A wave shorter than the contact band is told, with its wave number, the band, its share and the pressure it adds; longer ones, parabolas and points that are pressed by themselves are not.
#[test]
fn waves_shorter_than_the_band_are_told() {
    const TOLD: &str = "waves shorter than the contact band";
    let wave = |order: f64, um: f64| move |roll: f64| um * (order * roll).cos();
    let short = said(wave(150.0, 0.05), 150.0, "");
    assert!(short.contains(TOLD) && short.contains("the topography of the pinion's left flanks"), "{short}");
    let number = |after: &str| {
        let rest = short.split(after).nth(1).unwrap_or_else(|| panic!("no `{after}` in {short}"));
        rest.trim_start().split([' ', ',', ')', ';']).next().unwrap().parse::<f64>().unwrap()
    };
    // Almost all of it; k = O/(r_b u), which grows towards the root.
    assert!(number("the contact band:") > 90.0, "{short}");
    let (base, k, band) = (45.0 * 20f64.to_radians().cos(), number("the largest has k ="), number("half-width a ="));
    let [at_root, at_tip] = [13f64, 30.0].map(|roll| 150.0 / (base * roll.to_radians()));
    assert!((at_tip..at_root).contains(&k), "k {k}, {at_tip} to {at_root}: {short}");
    // p = E* k A/2, over the root of 2.
    let added = number("these waves add");
    assert!(
        (added / (0.25 * 2f64.sqrt() * 2.06e5 / (2.0 * 0.91) * k * 0.05e-3) - 1.0).abs() < 0.2,
        "{added} MPa: {short}"
    );
    // F = 150 N m/r_b on 20 mm, R = r sin 20 deg / 2 at the pitch point: a = sqrt(4 w R/(pi E*)).
    let modulus = 2.06e5 / (2.0 * (1.0 - 0.09));
    let hertz =
        (4.0 * 150e3 / base / 20.0 * 0.5 * 45.0 * 20f64.to_radians().sin() / std::f64::consts::PI / modulus).sqrt();
    assert!((band / hertz - 1.0).abs() < 0.05, "a {band} beside {hertz} mm: {short}");
    for (depth, torque) in [(wave(20.0, 2.0), 150.0), (wave(60.0, 0.05), 1.0)] {
        let said = said(depth, torque, "");
        assert!(!said.contains(TOLD), "{said}");
    }
    assert!(!said(|roll| 200.0 * (roll - 0.4).powi(2), 150.0, "").contains(TOLD));
    assert!(!said(wave(150.0, 0.05), 150.0, "[contact]\nmethod = \"nodal\"\n").contains(TOLD));
}
