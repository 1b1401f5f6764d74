//! The table at the end of a motion and of a sweep.

use super::table::{Lines, fixed};
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
    let mut t = Lines::new(facts);
    let (h, c) = (headline, &headline.certificate);
    t.number("mean speed of the driver", h.speed_rpm, 2, "1/min");
    t.number("mesh frequency", h.mesh_frequency_hz, 1, "Hz");
    t.number("mesh resonance (mean stiffness)", h.mesh_resonance_hz, 1, "Hz");
    elastic_lines(&mut t, &h.elasticity);
    t.errors([h.mean_dte_um, h.peak_to_peak_dte_um], [Some(h.mean_ste_um), Some(h.peak_to_peak_ste_um)]);
    t.number("mean contact-line length", h.mean_contact_line_length_mm, 3, "mm");
    t.number("mean sum of normal forces", h.mean_normal_force_n, 1, "N");
    t.number("dynamic factor", h.dynamic_factor, 4, "");
    t.number("mean axial force on the wheel", h.mean_wheel_force_n[2], 1, "N");
    t.number("mean tilting moment on the pinion", h.mean_pinion_tilting_moment_nmm, 0, "N mm");
    if h.max_bearing_force_n > 0.0 {
        t.number("largest force of a bearing", h.max_bearing_force_n, 1, "N");
    }
    t.pressure(h.max_pressure_mpa, h.max_pressure_at.as_ref());
    if let Some([pinion, wheel]) = h.max_root_tension_mpa {
        t.text("largest root tension, pinion, wheel", format!("{}, {}", fixed(pinion, 1), fixed(wheel, 1)), "MPa");
    }
    t.cycles([c.warm_up_cycles, h.cycles], c.periodicity, c.period_cycles);
    t.text("tooth changes", h.tooth_changes, "");
    t.resolution(scene, facts);
    t.text("contact lost, times", c.contact_losses, "");
    t.science("energy open, over work through pair", c.ledger_residual_over_work, "");
    t.science("least force of a slice in contact", c.least_contact_force_n, "N");
    t.science("largest jump of the force at a tooth change", c.force_jump_at_tooth_change_n, "N");
    t.text("steps", c.steps, "");
    t.framed(scene, cost, warnings)
}

/// Where quasi-static elasticity ends.
fn elastic_lines(t: &mut Lines, e: &ElasticHeadline) {
    let [pinion, wheel] = e.lowest_elastic_frequency_hz.map(|hz| fixed(hz, 0));
    t.text("lowest elastic frequencies", format!("{pinion}, {wheel}"), "Hz");
    let of = format!("(harmonic {} of {} Hz)", e.mesh_harmonic, fixed(e.highest_mesh_frequency_hz, 1));
    t.number("mesh harmonic over elastic frequency", e.mesh_harmonic_over_elastic, 4, &of);
}

/// The largest answers of a sweep, time and peak memory of each phase.
pub(crate) fn sweep_table(
    scene: &Scene,
    facts: &Facts,
    cost: &Cost,
    headline: &SweepHeadline,
    warnings: &[String],
) -> String {
    let mut t = Lines::new(facts);
    t.number("mesh resonance (mean stiffness)", headline.mesh_resonance_hz, 1, "Hz");
    t.number("  at a speed of the driver of", headline.mesh_resonance_rpm, 1, "1/min");
    elastic_lines(&mut t, &headline.elasticity);
    t.number("peak-to-peak STE", headline.peak_to_peak_ste_um, 4, "um");
    for row in &headline.largest {
        let way = match row.way {
            SweepWay::Apart => "each by itself",
            SweepWay::Up => "upwards",
            SweepWay::Down => "downwards",
        };
        let at = format!("um at {:.1}/min", row.speed_rpm);
        t.number(&format!("largest peak-to-peak DTE, {way}"), row.peak_to_peak_dte_um, 4, &at);
        t.number("  dynamic factor there", row.dynamic_factor, 4, "");
    }
    t.framed(scene, cost, warnings)
}
