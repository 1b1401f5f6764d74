//! The table at the end of a run.

use std::fmt::Write;

use super::Headline;
use crate::facts::{Cost, Facts};
use crate::scene::Scene;

/// Headline numbers, degrees of freedom before and after, time and peak memory of each phase.
pub fn closing_table(scene: &Scene, facts: &Facts, cost: &Cost, headline: &Headline, warnings: &[String]) -> String {
    let mut t = String::new();
    let h = headline;
    let g = &facts.geometry;
    let mut line = |label: &str, value: String, unit: &str| push_line(&mut t, label, &value, unit);
    line("contact ratio eps_gamma", format!("{:.4}", g.eps_gamma), "");
    line("mean STE", fixed(h.mean_ste_um, 4), "um");
    line(&format!("peak-to-peak STE ({} positions)", h.samples_per_cycle), fixed(h.peak_to_peak_ste_um, 4), "um");
    line("mean mesh stiffness, secant", fixed(h.mean_mesh_stiffness_n_per_um, 2), "N/um");
    line("mean mesh stiffness, tangent", fixed(h.mean_mesh_stiffness_tangent_n_per_um, 2), "N/um");
    line("mean contact-line length", fixed(h.mean_contact_line_length_mm, 3), "mm");
    line("  unloaded, analytic", fixed(h.mean_geometric_line_length_mm, 3), "mm");
    line("mean sum of normal forces", fixed(h.mean_normal_force_n, 1), "N");
    line("mean axial force on the wheel", fixed(h.mean_wheel_force_n[2], 1), "N");
    line("mean tilting moment on the pinion", fixed(h.mean_pinion_tilting_moment_nmm, 0), "N mm");
    line("largest force of one pair", fixed(h.max_pair_force_n, 1), "N");
    if h.mean_friction_power_loss_w != 0.0 {
        line("mean power lost to friction", fixed(h.mean_friction_power_loss_w, 2), "W");
        line("efficiency of the contact", format!("{:.3}", 100.0 * h.efficiency), "%");
    }
    line("maximum pressure", fixed(h.max_pressure_mpa, 0), "MPa");
    if let Some(root) = &h.root_stress {
        for (name, gear) in [("pinion", &root.pinion), ("wheel", &root.wheel)] {
            let at = gear.max_principal;
            line(&format!("largest root tension, {name}"), fixed(at.stress_mpa, 1), &place(&at));
            line(&format!("largest root von Mises, {name}"), fixed(gear.von_mises.stress_mpa, 1), "MPa");
        }
    }
    line("tooth changes", h.tooth_changes.to_string(), "");
    line("worst torque residual", format!("{:.1e}", h.worst_torque_residual), "");
    line("DOF before reduction, pinion + wheel", sum(facts.dof_before), "");
    line("DOF after reduction, pinion + wheel", sum(facts.dof_after), "");
    for (name, way) in ["pinion", "wheel"].iter().zip(&facts.reduction) {
        line(&format!("reduction, {name}"), (*way).to_owned(), "");
    }

    framed(scene, &t, cost, warnings)
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
fn place(at: &super::Place) -> String {
    format!("MPa (tooth {}, {} fillet, r {:.3} mm, z {:.2} mm)", at.tooth, at.side.name(), at.radius_mm, at.z_mm)
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
