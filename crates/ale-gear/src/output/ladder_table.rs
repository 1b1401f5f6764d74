//! The table at the end of a run of a cheaper model.

use super::table::{fixed, framed, push_line};
use crate::facts::{Cost, Facts};
use crate::ladder::LadderHeadline;
use crate::scene::Scene;

/// Headline numbers, certificate, time and peak memory of each phase.
pub(crate) fn ladder_table(
    scene: &Scene,
    facts: &Facts,
    cost: &Cost,
    headline: &LadderHeadline,
    warnings: &[String],
) -> String {
    let mut t = String::new();
    let (h, c) = (headline, &headline.certificate);
    let mut line = |label: &str, value: String, unit: &str| push_line(&mut t, label, &value, unit);
    let some = |x: Option<f64>, decimals| x.map_or_else(|| "-".to_owned(), |x| fixed(x, decimals));
    line("contact ratio eps_gamma", format!("{:.4}", facts.geometry.eps_gamma), "");
    line("coordinates", h.coordinates.to_string(), "");
    line("mesh frequency", fixed(h.mesh_frequency_hz, 1), "Hz");
    line("mesh resonance (mean stiffness)", some(h.mesh_resonance_hz, 1), "Hz");
    line("mean DTE", fixed(h.mean_dte_um, 4), "um");
    line("  quasi-static", some(h.mean_ste_um, 4), "um");
    line("peak-to-peak DTE", fixed(h.peak_to_peak_dte_um, 4), "um");
    line("  quasi-static", some(h.peak_to_peak_ste_um, 4), "um");
    line("mean contact-line length", some(h.mean_contact_line_length_mm, 3), "mm");
    line("normal force of the mean load", fixed(h.static_normal_force_n, 1), "N");
    line("mean normal force", fixed(h.mean_normal_force_n, 1), "N");
    line("dynamic factor", some(h.dynamic_factor, 4), "");
    line("mean axial force on the wheel", fixed(h.mean_wheel_force_n[2], 1), "N");
    line("mesh cycles, settling and written", format!("{} + {}", c.warm_up_cycles, h.cycles), "");
    let science = |x: Option<f64>| x.map_or_else(|| "-".to_owned(), |x| format!("{x:.1e}"));
    line("repeats itself to", science(c.periodicity), &format!("after {} cycle(s)", c.period_cycles.unwrap_or(1)));
    line("energy open, over all work", science(Some(c.ledger_residual_over_turnover)), "");
    line("rows without contact", c.rows_without_contact.to_string(), "");
    line("steps", c.steps.to_string(), "");
    framed(scene, &t, cost, warnings)
}
