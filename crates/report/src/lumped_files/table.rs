//! The table at the end of a run of a cheaper model.

use analysis::{facts::Facts, lumped::LumpedHeadline};
use scene::Scene;

use crate::{Cost, tables::Lines};

/// Headline numbers, certificate, time and peak memory of each phase.
pub fn lumped_table(
    scene: &Scene,
    facts: &Facts,
    cost: &Cost,
    headline: &LumpedHeadline,
    warnings: &[String],
) -> String {
    let mut t = Lines::new(facts);
    let (h, c) = (headline, &headline.certificate);
    t.accuracy(facts);
    t.text("coordinates", h.coordinates, "");
    t.resolution(scene, facts);
    t.number("mesh frequency", h.mesh_frequency_hz, 1, "Hz");
    t.number("mesh resonance (mean stiffness)", h.mesh_resonance_hz, 1, "Hz");
    t.errors([h.mean_dte_um, h.peak_to_peak_dte_um], [h.mean_ste_um, h.peak_to_peak_ste_um]);
    if let Some(ramp) = &h.ramp {
        let largest = &ramp.peak_to_peak_dte_um;
        t.number("largest peak-to-peak DTE of the ramp", largest.value, 4, &format!("um {}", largest.place()));
        if let Some(factor) = &ramp.dynamic_factor {
            t.number("  dynamic factor", factor.value, 4, &factor.place());
        }
    }
    t.number("mean contact-line length", h.mean_contact_line_length_mm, 3, "mm");
    t.number("normal force of the mean load", h.static_normal_force_n, 1, "N");
    t.number("mean normal force", h.mean_normal_force_n, 1, "N");
    t.number("dynamic factor", h.dynamic_factor, 4, "");
    t.number("mean axial force on the wheel", h.mean_wheel_force_n[2], 1, "N");
    t.cycles([c.warm_up_cycles, h.cycles], c.periodicity, c.period_cycles);
    t.science("energy open, over that of the vibration", c.energy_open_over_vibration, "");
    t.text("rows without contact", c.rows_without_contact, "");
    t.text("steps", c.steps, "");
    t.framed(scene, cost, warnings)
}
