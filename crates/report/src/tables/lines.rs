//! Numbers and settings in words, as tables have them.

use std::fmt::Write;

use scene::{Driver, Model, Scene};

/// One line of a table.
pub fn push_line(t: &mut String, label: &str, value: &str, unit: &str) {
    // Writing to a String cannot fail.
    let _ = writeln!(t, "  {label:<38} {value:>14} {unit}");
}

/// With `decimals` places, or with as many as show four digits where those would show fewer than two.
pub fn fixed(value: f64, decimals: usize) -> String {
    let size = value.abs();
    if size == 0.0 || size >= 10f64.powi(1 - decimals as i32) {
        return format!("{value:.decimals$}");
    }
    if size < 1e-3 {
        return format!("{value:.3e}");
    }
    let places = (3.0 - size.log10().floor()) as usize;
    format!("{value:.places$}")
}

/// A given value with up to six significant digits, without zeros at its end: `153.333`, `150`.
pub fn given(value: f64) -> String {
    let decimals = if value == 0.0 { 0.0 } else { (5.0 - value.abs().log10().floor()).clamp(0.0, 9.0) };
    let written = format!("{value:.*}", decimals as usize);
    if written.contains('.') { written.trim_end_matches('0').trim_end_matches('.').to_owned() } else { written }
}

/// The load in words: `150 N m on the wheel`.
pub fn torque(scene: &Scene) -> String {
    let driven = match scene.operation.driver {
        Driver::Pinion => "wheel",
        Driver::Wheel => "pinion",
    };
    format!("{} N m on the {driven}", given(scene.operation.torque_nm))
}

/// The model's name as in the scene.
pub fn model_name(scene: &Scene) -> &'static str {
    match scene.analysis.model {
        Model::Auto => "auto",
        Model::Iso => "iso",
        Model::Reduced => "reduced",
        Model::ReducedModes => "reduced+modes",
        Model::Mapped => "mapped",
        Model::Full => "full",
        Model::Lumped8 => "lumped8",
        Model::Lumped12 => "lumped12",
        Model::Shaft18 => "shaft18",
        Model::Impact => "impact",
    }
}
