//! The table at the end of a run.

use std::fmt::Write;

use super::{Headline, Place, PressurePlace};
use crate::facts::{Cost, Facts};
use crate::scene::Scene;

/// Headline numbers, degrees of freedom before and after, time and peak memory of each phase.
pub fn closing_table(scene: &Scene, facts: &Facts, cost: &Cost, headline: &Headline, warnings: &[String]) -> String {
    let mut t = Lines::new(facts);
    let h = headline;
    t.number("mean STE", h.mean_ste_um, 4, "um");
    t.number(&format!("peak-to-peak STE ({} positions)", h.samples_per_cycle), h.peak_to_peak_ste_um, 4, "um");
    t.number("mean mesh stiffness, secant", h.mean_mesh_stiffness_n_per_um, 2, "N/um");
    t.number("mean mesh stiffness, tangent", h.mean_mesh_stiffness_tangent_n_per_um, 2, "N/um");
    t.number("mean contact-line length", h.mean_contact_line_length_mm, 3, "mm");
    t.number("  unloaded, analytic", h.mean_geometric_line_length_mm, 3, "mm");
    t.number("mean sum of normal forces", h.mean_normal_force_n, 1, "N");
    t.number("mean axial force on the wheel", h.mean_wheel_force_n[2], 1, "N");
    t.number("mean tilting moment on the pinion", h.mean_pinion_tilting_moment_nmm, 0, "N mm");
    t.number("largest force of one pair", h.max_pair_force_n, 1, "N");
    if h.mean_friction_power_loss_w != 0.0 {
        t.number("mean power lost to friction", h.mean_friction_power_loss_w, 2, "W");
        t.text("efficiency of the contact", format!("{:.3}", 100.0 * h.efficiency), "%");
    }
    t.pressure(h.max_pressure_mpa, h.max_pressure_at.as_ref());
    if let Some(root) = &h.root_stress {
        for (name, gear) in [("pinion", &root.pinion), ("wheel", &root.wheel)] {
            let at = gear.max_principal;
            t.number(&format!("largest root tension, {name}"), at.stress_mpa, 1, &place(&at));
            t.number(&format!("largest root von Mises, {name}"), gear.von_mises.stress_mpa, 1, "MPa");
        }
    }
    t.iso_root_stress(facts);
    t.text("tooth changes", h.tooth_changes, "");
    t.resolution(scene, facts);
    t.science("worst torque residual", h.worst_torque_residual, "");
    t.text("DOF before reduction, pinion + wheel", sum(facts.dof_before), "");
    t.text("DOF after reduction, pinion + wheel", sum(facts.dof_after), "");
    for (name, way) in ["pinion", "wheel"].iter().zip(&facts.reduction) {
        t.text(&format!("reduction, {name}"), *way, "");
    }

    t.framed(scene, cost, warnings)
}

/// The lines of a closing table, each a label, a value and its unit.
#[derive(Debug)]
pub(super) struct Lines(String);

impl Lines {
    /// Begins with what every analysis has: the contact ratio.
    pub(super) fn new(facts: &Facts) -> Self {
        let mut lines = Self(String::new());
        for check in facts.certificate.missed() {
            lines.text("THE RESULT DOES NOT HOLD", "", &check.words());
        }
        lines.text("contact ratio eps_gamma", format!("{:.4}", facts.geometry.eps_gamma), "");
        lines
    }

    /// A value in words.
    pub(super) fn text(&mut self, label: &str, value: impl std::fmt::Display, unit: &str) {
        push_line(&mut self.0, label, &value.to_string(), unit);
    }

    /// A number with `decimals` places (see [`fixed`]), `-` when there is none.
    pub(super) fn number(&mut self, label: &str, value: impl Into<Option<f64>>, decimals: usize, unit: &str) {
        self.text(label, value.into().map_or_else(|| "-".to_owned(), |v| fixed(v, decimals)), unit);
    }

    /// A small number as power of ten, `-` when there is none.
    pub(super) fn science(&mut self, label: &str, value: impl Into<Option<f64>>, unit: &str) {
        self.text(label, value.into().map_or_else(|| "-".to_owned(), |v| format!("{v:.1e}")), unit);
    }

    /// The largest pressure, and where it is.
    pub(super) fn pressure(&mut self, pressure_mpa: f64, at: Option<&PressurePlace>) {
        let unit = at.map_or_else(|| "MPa".to_owned(), |at| format!("MPa ({})", at.said()));
        self.number("maximum pressure", pressure_mpa, 0, &unit);
    }

    /// Slices and elements along the face, and whether the program chose them.
    pub(super) fn resolution(&mut self, scene: &Scene, facts: &Facts) {
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
    pub(super) fn errors(&mut self, dynamic: [f64; 2], quasi_static: [Option<f64>; 2]) {
        for (k, label) in ["mean DTE", "peak-to-peak DTE"].into_iter().enumerate() {
            self.number(label, dynamic[k], 4, "um");
            self.number("  quasi-static", quasi_static[k], 4, "um");
        }
    }

    /// Nominal root stresses of the standard, where there are some.
    pub(super) fn iso_root_stress(&mut self, facts: &Facts) {
        if let Some(iso) = &facts.iso_root_stress {
            let [pinion, wheel] = [&iso.pinion, &iso.wheel].map(|g| fixed(g.nominal_root_stress_mpa, 1));
            self.text("nominal root stress by ISO 6336-3", format!("{pinion}, {wheel}"), "MPa (pinion, wheel)");
        }
    }

    /// Mesh cycles of a motion, and how nearly it repeats itself.
    pub(super) fn cycles(&mut self, [settling, written]: [u64; 2], periodicity: Option<f64>, period: Option<usize>) {
        self.text("mesh cycles, settling and written", format!("{settling} + {written}"), "");
        self.science("repeats itself to", periodicity, &format!("after {} cycle(s)", period.unwrap_or(1)));
    }

    /// The table: the case above the lines, phases and warnings below.
    pub(super) fn framed(self, scene: &Scene, cost: &Cost, warnings: &[String]) -> String {
        framed(scene, &self.0, cost, warnings)
    }
}

/// Headline lines with the case above them, phases and warnings below.
pub(super) fn framed(scene: &Scene, lines: &str, cost: &Cost, warnings: &[String]) -> String {
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
pub(super) fn push_line(t: &mut String, label: &str, value: &str, unit: &str) {
    // Writing to a String cannot fail.
    let _ = writeln!(t, "  {label:<38} {value:>14} {unit}");
}

/// With `decimals` places, or with as many as show four digits where those would show fewer than two.
pub(super) fn fixed(value: f64, decimals: usize) -> String {
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

/// Unit, tooth and place of a root stress.
fn place(at: &Place) -> String {
    let Place { tooth, radius_mm, z_mm, estimated_error_percent, .. } = at;
    let side = at.side.name();
    format!(
        "MPa, within about {estimated_error_percent:.1} % (tooth {tooth}, {side} fillet, r {radius_mm:.3} mm, z {z_mm:.2} mm)"
    )
}

fn sum([pinion, wheel]: [usize; 2]) -> String {
    (pinion + wheel).to_string()
}

/// The model's name as in the scene.
pub(super) fn model_name(scene: &Scene) -> &'static str {
    match scene.analysis.model {
        crate::scene::Model::Iso => "iso",
        crate::scene::Model::Reduced => "reduced",
        crate::scene::Model::ReducedModes => "reduced+modes",
        crate::scene::Model::Full => "full",
        crate::scene::Model::Lumped8 => "lumped8",
        crate::scene::Model::Lumped12 => "lumped12",
        crate::scene::Model::Shaft18 => "shaft18",
        crate::scene::Model::Impact => "impact",
    }
}
