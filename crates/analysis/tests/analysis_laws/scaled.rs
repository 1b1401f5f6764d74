//! A scene with all of its lengths times a number, torque times the cube, speed over it: by similarity of elastic
//! bodies it is the same problem.
//!
//! ```text
//! lengths s, stresses 1, forces s^2, torques s^3, stiffnesses s, times s, masses s^3
//! ```

use std::path::Path;

use scene::Scene;

/// What flanks bear: a name, keys that are lengths, and other words.
pub type Flanks = (&'static str, &'static [(&'static str, f64)], &'static str);

/// What the flanks of the pinion bear.
pub const FLANKS: [Flanks; 5] = [
    ("nominal", &[], ""),
    ("linear tip relief", &[("tip_relief_um", 20.0)], "tip_relief_start_roll_deg = 24.0\n"),
    (
        "parabolic tip relief",
        &[("tip_relief_um", 20.0)],
        "tip_relief_start_roll_deg = 24.0\ntip_relief_shape = \"parabolic\"\n",
    ),
    ("crownings", &[("profile_crowning_um", 5.0), ("lead_crowning_um", 6.0), ("lead_slope_um", 4.0)], ""),
    (
        "end relief",
        &[
            ("end_relief_lower_um", 12.0),
            ("end_relief_lower_length_mm", 4.0),
            ("end_relief_upper_um", 8.0),
            ("end_relief_upper_length_mm", 3.0),
        ],
        "",
    ),
];

/// The text of a pair of so many times the size, with some of [`FLANKS`], and `rest` behind it.
pub fn text(size: f64, (_, lengths, words): Flanks, rest: &str) -> String {
    let mesher = "order = 1\nelements_profile = 2\nelements_fillet = 2\nelements_thickness = 2\nelements_face = 4\n\
                  elements_rim = 1\n";
    let lengths: String = lengths.iter().map(|(key, value)| format!("{key} = {:?}\n", size * value)).collect();
    format!(
        "[pinion]\nteeth = 21\nhelix_angle_deg = 12.0\nthickness_allowance_mm = {allowance:?}\n[pinion.mesher]\n{mesher}\
         [pinion.modification]\n{lengths}{words}\
         [wheel]\nteeth = 34\nthickness_allowance_mm = {allowance:?}\n[wheel.mesher]\n{mesher}\
         [pair]\nnormal_module_mm = {module:?}\nface_width_mm = {width:?}\n\
         [operation]\ntorque_nm = {torque:?}\nspeed_rpm = {speed:?}\n{rest}",
        allowance = 0.04 * size,
        module = 3.0 * size,
        width = 18.0 * size,
        torque = 120.0 * size.powi(3),
        speed = 3000.0 / size,
    )
}

/// The scene of [`text`].
pub fn scene(size: f64, flanks: Flanks, rest: &str) -> Scene {
    let text = text(size, flanks, rest);
    Scene::parse(&text, Path::new("scaled.toml")).unwrap_or_else(|e| panic!("{e}\n{text}"))
}

/// Sizes over that of the pair.
pub const SIZES: [f64; 2] = [0.1, 10.0];

/// Largest difference of two rows of equal length over `scale`; NaN where one is none.
pub fn apart(a: &[f64], b: &[f64], scale: f64) -> f64 {
    assert!(a.len() == b.len() && !a.is_empty() && scale > 0.0, "{} and {} values, {scale}", a.len(), b.len());
    a.iter().zip(b).map(|(a, b)| (a - b).abs() / scale).reduce(analysis::worse).unwrap_or(f64::NAN)
}

/// The largest value without sign; NaN where one is none.
pub fn largest(values: &[f64]) -> f64 {
    values.iter().map(|x| x.abs()).reduce(analysis::worse).unwrap_or(f64::NAN)
}
