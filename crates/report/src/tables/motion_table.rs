//! The table at the end of a motion and of a sweep.

use analysis::{
    facts::Facts,
    motion::{ElasticHeadline, InertiaHeadline, MotionHeadline, SweepHeadline},
};
use scene::{Scene, SweepWay};

use super::{Lines, fixed};
use crate::Cost;

/// Headline numbers of a motion, its certificate, time and peak memory of each phase.
pub fn motion_table(
    scene: &Scene,
    facts: &Facts,
    cost: &Cost,
    headline: &MotionHeadline,
    warnings: &[String],
) -> String {
    let mut t = Lines::new(facts);
    let (h, c) = (headline, &headline.certificate);
    t.accuracy(facts);
    t.number("mean speed of the driver", h.speed_rpm, 2, "1/min");
    t.number("mesh frequency", h.mesh_frequency_hz, 1, "Hz");
    t.number("mesh resonance (mean stiffness)", h.mesh_resonance_hz, 1, "Hz");
    inertia_line(&mut t, &h.inertia);
    elastic_lines(&mut t, &h.elasticity);
    t.errors([h.mean_dte_um, h.peak_to_peak_dte_um], [Some(h.mean_ste_um), Some(h.peak_to_peak_ste_um)]);
    if let Some(ramp) = &h.ramp {
        t.text("  largest peak-to-peak DTE", ramp.peak_to_peak_dte_um.place(), "");
        t.number("  mean of all mesh cycles", ramp.mean_peak_to_peak_dte_um, 4, "um");
        for (k, order) in ramp.dte_harmonics_um.iter().take(2).enumerate() {
            t.number(
                &format!("largest mesh harmonic {} of DTE", k + 1),
                order.value,
                4,
                &format!("um {}", order.place()),
            );
        }
        if let Some(pair) = &ramp.pair_normal_force_n {
            t.number("largest force of one pair", pair.value, 1, &format!("N {}", pair.place()));
        }
    }
    t.number("mean contact-line length", h.mean_contact_line_length_mm, 3, "mm");
    t.number("mean sum of normal forces", h.mean_normal_force_n, 1, "N");
    let there = h.ramp.as_ref().and_then(|r| r.dynamic_factor).map_or(String::new(), |at| at.place());
    t.number("dynamic factor", h.dynamic_factor, 4, &there);
    t.number("mean axial force on the wheel", h.mean_wheel_force_n[2], 1, "N");
    t.number("mean tilting moment on the pinion", h.mean_pinion_tilting_moment_nmm, 0, "N mm");
    if h.max_bearing_force_n > 0.0 {
        t.number("largest force of a bearing", h.max_bearing_force_n, 1, "N");
    }
    t.pressure(h.max_pressure_mpa, h.max_pressure_at.as_ref());
    if let Some([pinion, wheel]) = h.root_tensions() {
        let unit = format!("MPa, within about {}, {} %", fixed(pinion.1, 1), fixed(wheel.1, 1));
        t.text("largest root tension, pinion, wheel", format!("{}, {}", fixed(pinion.0, 1), fixed(wheel.0, 1)), &unit);
        t.iso_root_stress(facts);
    }
    t.cycles([c.warm_up_cycles, h.cycles], c.periodicity, c.period_cycles);
    t.text("tooth changes", h.tooth_changes, "");
    t.resolution(scene, facts);
    t.text("contact lost, times", c.contact_losses, "");
    t.science("energy open, over that of the vibration", c.energy_open_over_vibration, "");
    t.science("least force of a slice in contact", c.least_contact_force_n, "N");
    t.science("largest jump of the force at a tooth change", c.force_jump_at_tooth_change_n, "N");
    t.text("steps", c.steps, "");
    t.framed(scene, cost, warnings)
}

/// Whose inertia the mesh resonance is of.
fn inertia_line(t: &mut Lines, inertia: &InertiaHeadline) {
    t.number(
        "  of an inertia on the base circle of",
        inertia.equivalent_mass_kg,
        4,
        &format!("kg ({})", inertia.describe()),
    );
}

/// Where quasi-static elasticity ends.
fn elastic_lines(t: &mut Lines, e: &ElasticHeadline) {
    let [pinion, wheel] = e.lowest_elastic_frequency_hz.map(|hz| fixed(hz, 0));
    t.text("lowest elastic frequencies", format!("{pinion}, {wheel}"), "Hz");
    let of = format!("(harmonic {} of {} Hz)", e.mesh_harmonic, fixed(e.highest_mesh_frequency_hz, 1));
    t.number("mesh harmonic over elastic frequency", e.mesh_harmonic_over_elastic, 4, &of);
    let change = format!("um, {} % of the peak to peak", fixed(100.0 * e.change_over_peak_to_peak, 1));
    t.number("  its inertia may change the DTE by", e.change_of_peak_to_peak_um, 4, &change);
}

/// The largest answers of a sweep, time and peak memory of each phase.
pub fn sweep_table(scene: &Scene, facts: &Facts, cost: &Cost, headline: &SweepHeadline, warnings: &[String]) -> String {
    let mut t = Lines::new(facts);
    t.number("mesh resonance (mean stiffness)", headline.mesh_resonance_hz, 1, "Hz");
    t.number("  at a speed of the driver of", headline.mesh_resonance_rpm, 1, "1/min");
    inertia_line(&mut t, &headline.inertia);
    elastic_lines(&mut t, &headline.elasticity);
    t.number("peak-to-peak STE", headline.peak_to_peak_ste_um, 4, "um");
    for row in &headline.largest {
        let way = match row.way {
            SweepWay::Apart => "each by itself",
            SweepWay::Up => "upwards",
            SweepWay::Down => "downwards",
        };
        let at = format!("um at {:.1}/min, {:.1} Hz", row.speed_rpm, row.mesh_frequency_hz);
        t.number(&format!("largest peak-to-peak DTE, {way}"), row.peak_to_peak_dte_um, 4, &at);
        t.number("  dynamic factor there", row.dynamic_factor, 4, "");
    }
    if !headline.failed.is_empty() {
        t.text("speeds without a solution", headline.failed.len(), "");
    }
    t.framed(scene, cost, warnings)
}
