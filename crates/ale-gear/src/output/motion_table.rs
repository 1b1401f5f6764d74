//! The table at the end of a motion and of a sweep.

use super::table::{fixed, framed, push_line};
use crate::facts::{Cost, Facts};
use crate::motion::{ElasticHeadline, MotionHeadline, SweepHeadline};
use crate::scene::{Scene, SweepWay};

/// Headline numbers of a motion, its certificate, time and peak memory of each phase.
pub(crate) fn motion_table(
    scene: &Scene,
    facts: &Facts,
    cost: &Cost,
    headline: &MotionHeadline,
    warnings: &[String],
) -> String {
    let mut t = String::new();
    let (h, c) = (headline, &headline.certificate);
    let mut line = |label: &str, value: String, unit: &str| push_line(&mut t, label, &value, unit);
    line("contact ratio eps_gamma", format!("{:.4}", facts.geometry.eps_gamma), "");
    line("mean speed of the driver", fixed(h.speed_rpm, 2), "1/min");
    line("mesh frequency", fixed(h.mesh_frequency_hz, 1), "Hz");
    line("mesh resonance (mean stiffness)", fixed(h.mesh_resonance_hz, 1), "Hz");
    elastic_lines(&mut line, &h.elasticity);
    line("mean DTE", fixed(h.mean_dte_um, 4), "um");
    line("  quasi-static", fixed(h.mean_ste_um, 4), "um");
    line("peak-to-peak DTE", fixed(h.peak_to_peak_dte_um, 4), "um");
    line("  quasi-static", fixed(h.peak_to_peak_ste_um, 4), "um");
    line("mean contact-line length", fixed(h.mean_contact_line_length_mm, 3), "mm");
    line("mean sum of normal forces", fixed(h.mean_normal_force_n, 1), "N");
    line("dynamic factor", fixed(h.dynamic_factor, 4), "");
    line("mean axial force on the wheel", fixed(h.mean_wheel_force_n[2], 1), "N");
    line("mean tilting moment on the pinion", fixed(h.mean_pinion_tilting_moment_nmm, 0), "N mm");
    if h.max_bearing_force_n > 0.0 {
        line("largest force of a bearing", fixed(h.max_bearing_force_n, 1), "N");
    }
    line("maximum pressure", fixed(h.max_pressure_mpa, 0), "MPa");
    if let Some([pinion, wheel]) = h.max_root_tension_mpa {
        line("largest root tension, pinion, wheel", format!("{}, {}", fixed(pinion, 1), fixed(wheel, 1)), "MPa");
    }
    line("mesh cycles, settling and written", format!("{} + {}", c.warm_up_cycles, h.cycles), "");
    line("tooth changes", h.tooth_changes.to_string(), "");
    line("contact lost, times", c.contact_losses.to_string(), "");
    let science = |x: Option<f64>| x.map_or_else(|| "-".to_owned(), |x| format!("{x:.1e}"));
    line("repeats itself to", science(c.periodicity), &format!("after {} cycle(s)", c.period_cycles.unwrap_or(1)));
    line("energy open, over work through pair", science(Some(c.ledger_residual_over_work)), "");
    line("least force of a slice in contact", science(c.least_contact_force_n), "N");
    line("largest force dropped", science(Some(c.dropped_force_n)), "N");
    line("steps", c.steps.to_string(), "");
    framed(scene, &t, cost, warnings)
}

/// Where quasi-static elasticity ends.
fn elastic_lines(line: &mut impl FnMut(&str, String, &str), e: &ElasticHeadline) {
    let [pinion, wheel] = e.lowest_elastic_frequency_hz.map(|hz| fixed(hz, 0));
    line("lowest elastic frequencies", format!("{pinion}, {wheel}"), "Hz");
    let of = format!("(harmonic {} of {} Hz)", e.mesh_harmonic, fixed(e.highest_mesh_frequency_hz, 1));
    line("mesh harmonic over elastic frequency", fixed(e.mesh_harmonic_over_elastic, 4), &of);
}

/// The largest answers of a sweep, time and peak memory of each phase.
pub(crate) fn sweep_table(
    scene: &Scene,
    facts: &Facts,
    cost: &Cost,
    headline: &SweepHeadline,
    warnings: &[String],
) -> String {
    let mut t = String::new();
    let mut line = |label: &str, value: String, unit: &str| push_line(&mut t, label, &value, unit);
    line("contact ratio eps_gamma", format!("{:.4}", facts.geometry.eps_gamma), "");
    line("mesh resonance (mean stiffness)", fixed(headline.mesh_resonance_hz, 1), "Hz");
    line("  at a speed of the driver of", fixed(headline.mesh_resonance_rpm, 1), "1/min");
    elastic_lines(&mut line, &headline.elasticity);
    line("peak-to-peak STE", fixed(headline.peak_to_peak_ste_um, 4), "um");
    for row in &headline.largest {
        let way = match row.way {
            SweepWay::Apart => "each by itself",
            SweepWay::Up => "upwards",
            SweepWay::Down => "downwards",
        };
        let at = format!("um at {:.1}/min", row.speed_rpm);
        line(&format!("largest peak-to-peak DTE, {way}"), fixed(row.peak_to_peak_dte_um, 4), &at);
        line("  dynamic factor there", fixed(row.dynamic_factor, 4), "");
    }
    framed(scene, &t, cost, warnings)
}
