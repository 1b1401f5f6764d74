//! The table at the end of a run at rest.

use analysis::{
    facts::Facts,
    results::{Place, StaticHeadline},
};
use scene::Scene;

use super::Lines;
use crate::Cost;

/// Headline numbers, degrees of freedom before and after, time and peak memory of each phase.
pub fn closing_table(
    scene: &Scene,
    facts: &Facts,
    cost: &Cost,
    headline: &StaticHeadline,
    warnings: &[String],
) -> String {
    let mut t = Lines::new(facts);
    let h = headline;
    t.accuracy(facts);
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
    for (what, value) in [
        ("tooth loss factor H_VL", h.tooth_loss_factor),
        ("transverse load factor K_Halpha", h.transverse_load_factor),
        ("load sharing ratio", h.load_sharing_ratio),
        ("face load factor K_Hbeta", h.face_load_factor),
    ] {
        if let Some(value) = value {
            t.number(what, value, 3, "");
        }
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
    if h.root_stress.is_none() && !facts.meshes.is_empty() {
        t.text("root stress of the meshes", "-", "(not asked for: `--set output.root_stress=true`)");
    }
    let first = h.tooth_change.as_ref().map_or(String::new(), |change| change.words());
    t.text("tooth changes", h.tooth_changes, &first);
    t.resolution(scene, facts);
    t.science("worst torque residual", h.worst_torque_residual, "");
    t.text("DOF before reduction, pinion + wheel", sum(facts.dof_before), "");
    t.text("DOF after reduction, pinion + wheel", sum(facts.dof_after), "");
    for (name, way) in ["pinion", "wheel"].iter().zip(&facts.reduction) {
        t.text(&format!("reduction, {name}"), *way, "");
    }

    t.framed(scene, cost, warnings)
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
