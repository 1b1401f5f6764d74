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
    let mut line = |label: &str, value: String, unit: &str| {
        // Writing to a String cannot fail.
        let _ = writeln!(t, "  {label:<38} {value:>14} {unit}");
    };
    line("contact ratio eps_gamma", format!("{:.4}", g.eps_gamma), "");
    line("mean STE", format!("{:.4}", h.mean_ste_um), "um");
    line(
        &format!("peak-to-peak STE ({} positions)", h.samples_per_cycle),
        format!("{:.4}", h.peak_to_peak_ste_um),
        "um",
    );
    line("mean mesh stiffness, secant", format!("{:.2}", h.mean_mesh_stiffness_n_per_um), "N/um");
    line("mean mesh stiffness, tangent", format!("{:.2}", h.mean_mesh_stiffness_tangent_n_per_um), "N/um");
    line("mean contact-line length", format!("{:.3}", h.mean_contact_line_length_mm), "mm");
    line("  unloaded, analytic", format!("{:.3}", h.mean_geometric_line_length_mm), "mm");
    line("mean sum of normal forces", format!("{:.1}", h.mean_normal_force_n), "N");
    line("mean axial force on the wheel", format!("{:.1}", h.mean_wheel_force_n[2]), "N");
    line("mean tilting moment on the pinion", format!("{:.0}", h.mean_pinion_tilting_moment_nmm), "N mm");
    line("largest force of one pair", format!("{:.1}", h.max_pair_force_n), "N");
    line("maximum pressure", format!("{:.0}", h.max_pressure_mpa), "MPa");
    if let Some(root) = &h.root_stress {
        for (name, gear) in [("pinion", &root.pinion), ("wheel", &root.wheel)] {
            let at = gear.max_principal;
            line(&format!("largest root tension, {name}"), format!("{:.1}", at.stress_mpa), &place(&at));
            line(&format!("largest root von Mises, {name}"), format!("{:.1}", gear.von_mises.stress_mpa), "MPa");
        }
    }
    line("tooth changes", h.tooth_changes.to_string(), "");
    line("worst torque residual", format!("{:.1e}", h.worst_torque_residual), "");
    line("DOF before reduction, pinion + wheel", sum(facts.dof_before), "");
    line("DOF after reduction, pinion + wheel", sum(facts.dof_after), "");
    for (name, way) in ["pinion", "wheel"].iter().zip(&facts.reduction) {
        line(&format!("reduction, {name}"), (*way).to_owned(), "");
    }

    let mut all = format!("{} (model {})\n\n{t}\n", scene.name, model_name(scene));
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
        crate::scene::Model::Full => "full",
    }
}
