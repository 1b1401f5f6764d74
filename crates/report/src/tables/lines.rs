//! Lines of a table at the end of a run.

use std::fmt::Write;

use analysis::{facts::Facts, results::PressurePlace};
use scene::{Driver, Model, Scene};

use crate::Cost;

/// The lines of a closing table, each a label, a value and its unit.
#[derive(Debug)]
pub struct Lines(String);

impl Lines {
    /// Begins with what every analysis has: the contact ratio.
    pub fn new(facts: &Facts) -> Self {
        let mut lines = Self(String::new());
        for check in facts.certificate.missed() {
            lines.text("THE RESULT DOES NOT HOLD", "", &check.words());
        }
        lines.text("contact ratio eps_gamma", format!("{:.4}", facts.geometry.eps_gamma), "");
        lines
    }

    /// A value in words.
    pub fn text(&mut self, label: &str, value: impl std::fmt::Display, unit: &str) {
        push_line(&mut self.0, label, &value.to_string(), unit);
    }

    /// A number with `decimals` places (see [`fixed`]), `-` when there is none.
    pub fn number(&mut self, label: &str, value: impl Into<Option<f64>>, decimals: usize, unit: &str) {
        self.text(label, value.into().map_or_else(|| "-".to_owned(), |v| fixed(v, decimals)), unit);
    }

    /// A small number as power of ten, `-` when there is none.
    pub fn science(&mut self, label: &str, value: impl Into<Option<f64>>, unit: &str) {
        self.text(label, value.into().map_or_else(|| "-".to_owned(), |v| format!("{v:.1e}")), unit);
    }

    /// The largest pressure, and where it is.
    pub fn pressure(&mut self, pressure_mpa: f64, at: Option<&PressurePlace>) {
        let unit = at.map_or_else(|| "MPa".to_owned(), |at| format!("MPa ({})", at.describe()));
        self.number("maximum pressure", pressure_mpa, 0, &unit);
    }

    /// Headline numbers with their bounds, and what was asked of them.
    pub fn accuracy(&mut self, facts: &Facts) {
        let Some(accuracy) = &facts.accuracy else { return };
        self.text("how exact", "", "value with bounds");
        for bound in &accuracy.bounds {
            let asked = match (bound.asked, bound.met) {
                (Some(asked), Some(true)) => format!("(within {asked:.3}, as asked)"),
                (Some(asked), _) => format!("({asked:.3} WAS ASKED)"),
                _ => String::new(),
            };
            let label = format!("  {}", bound.quantity.key().replace('_', " "));
            push_line(&mut self.0, &label, &bound.words(), &asked);
        }
        for rung in &accuracy.rungs {
            let mesh = rung.elements_profile.map_or("meshes of the scene".into(), |n| format!("{n} elements"));
            let slices = rung.slices.map_or(String::new(), |n| format!(", {n} slices"));
            let why = rung.left_because.as_ref().map_or("taken".into(), |why| format!("left: {why}"));
            let of = format!("{mesh}{slices}, {} positions", rung.positions_per_cycle);
            self.text("tried", of, &why);
        }
        for tried in &accuracy.models {
            let mesh = tried.elements_profile.map_or("meshes of the scene".into(), |n| format!("{n} elements"));
            let slices = tried.slices.map_or(String::new(), |n| format!(", {n} slices"));
            let why = tried.left_because.as_ref().map_or("taken".into(), |why| format!("left: {why}"));
            let of = format!("{}, {mesh}{slices}, {} steps", tried.model.name(), tried.steps_per_resonance);
            self.text("tried", of, &why);
        }
        for what in &accuracy.not_covered {
            self.text("not covered", "", what);
        }
    }

    /// Slices and elements along the face, and whether the program chose them.
    pub fn resolution(&mut self, scene: &Scene, facts: &Facts) {
        let Some(r) = &facts.resolution else { return };
        if let Some(slices) = r.slices {
            self.text("slices over the face", slices, if r.slices_chosen { "(chosen)" } else { "(of the scene)" });
        }
        if let [Some(pinion), Some(wheel)] = r.face_elements {
            let chosen = ["pinion.mesher.elements_face", "wheel.mesher.elements_face"]
                .map(|key| scene.place_of(&[key]).is_none());
            let by = if chosen == [true; 2] { "(chosen)" } else { "(of the scene)" };
            self.text("elements along the face, pinion, wheel", format!("{pinion}, {wheel}"), by);
        }
    }

    /// The transmission errors of a motion beside those of the quasi-static cycle: means, then peak to peak, um.
    pub fn errors(&mut self, dynamic: [f64; 2], quasi_static: [Option<f64>; 2]) {
        for (k, label) in ["mean DTE", "peak-to-peak DTE"].into_iter().enumerate() {
            self.number(label, dynamic[k], 4, "um");
            self.number("  quasi-static", quasi_static[k], 4, "um");
        }
    }

    /// Nominal root stresses of the standard, where there are some.
    pub fn iso_root_stress(&mut self, facts: &Facts) {
        if let Some(iso) = &facts.iso_root_stress {
            let [pinion, wheel] = [&iso.pinion, &iso.wheel].map(|g| fixed(g.nominal_root_stress_mpa, 1));
            self.text("nominal root stress by ISO 6336-3", format!("{pinion}, {wheel}"), "MPa (pinion, wheel)");
        }
    }

    /// Mesh cycles of a motion, and how nearly it repeats itself.
    pub fn cycles(&mut self, [settling, written]: [u64; 2], periodicity: Option<f64>, period: Option<usize>) {
        self.text("mesh cycles, settling and written", format!("{settling} + {written}"), "");
        self.science("repeats itself to", periodicity, &format!("after {} cycle(s)", period.unwrap_or(1)));
    }

    /// The table: the case above the lines, phases and warnings below.
    pub fn framed(self, scene: &Scene, cost: &Cost, warnings: &[String]) -> String {
        framed(scene, &self.0, cost, warnings)
    }
}

/// Headline lines with the case above them, phases and warnings below.
pub fn framed(scene: &Scene, lines: &str, cost: &Cost, warnings: &[String]) -> String {
    let mut all = format!("{} (model {})\n\n{lines}\n", scene.name, model_name(scene));
    // Writing to a String cannot fail.
    let _ = writeln!(all, "  {:<14} {:>10} {:>14}", "phase", "wall s", "peak MB");
    let mb = |m: Option<f64>| m.map_or_else(|| "-".to_owned(), |m| format!("{m:.0}"));
    for phase in &cost.phases {
        let _ = writeln!(all, "  {:<14} {:>10.2} {:>14}", phase.name, phase.wall_s, mb(phase.peak_memory_mb));
    }
    let _ = writeln!(all, "  {:<14} {:>10.2} {:>14}", "total", cost.wall_s, mb(cost.peak_memory_mb));
    for warning in warnings {
        let _ = writeln!(all, "\nwarning: {warning}");
    }
    all
}

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

/// The load in words: `150 N m on the wheel`.
pub fn torque(scene: &Scene) -> String {
    let driven = match scene.operation.driver {
        Driver::Pinion => "wheel",
        Driver::Wheel => "pinion",
    };
    format!("{} N m on the {driven}", scene.operation.torque_nm)
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
