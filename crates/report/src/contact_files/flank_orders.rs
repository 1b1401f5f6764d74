//! `te_orders.csv`, `te_shares.csv`: orders of the transmission error, and what the flanks make of them.

use analysis::flank_orders::{FlankOrders, FlankPart, FlankShare, TeLine};
use answer::Table;

/// Meanings of the waves beside orders.
pub const PINION_WAVE: &str = "amplitude of the wave of this order on the driving flanks of the pinion at mid-face, normal to them, up to order 20 z; 0 without one";
/// The same of the wheel.
pub const WHEEL_WAVE: &str = "amplitude of the wave of this order on the driving flanks of the wheel at mid-face, up to order 20 z; 0 without one";

/// Orders of the transmission error beside the waves of the flanks, and the shares of waves and teeth.
pub fn flank_orders(found: &FlankOrders) -> [Table; 2] {
    let lines = || found.lines.iter();
    let shares = || found.shares.iter();
    let wave = |gear: usize| lines().map(move |line: &TeLine| line.wave_um[gear]);
    let number = |of: fn(&FlankPart) -> Option<u32>| {
        shares().map(move |own: &FlankShare| of(&own.part).map_or(f64::NAN, f64::from))
    };
    let is_wave = |part: &FlankPart| match part {
        FlankPart::Wave(order) => Some(*order),
        FlankPart::Tooth(_) => None,
    };
    let is_tooth = |part: &FlankPart| match part {
        FlankPart::Tooth(tooth) => Some(*tooth),
        FlankPart::Wave(_) => None,
    };
    let orders = Table::new("te_orders")
        .numbers(
            "mesh_order",
            "order of the mesh frequency; lines are one over the number of cycles apart",
            lines().map(|l| l.mesh_order),
        )
        .numbers("pinion_order", "order of one turn of the pinion", lines().map(|l| l.order[0]))
        .numbers("wheel_order", "order of one turn of the wheel", lines().map(|l| l.order[1]))
        .numbers("ste_um", "single-sided amplitude of the static transmission error", lines().map(|l| l.ste_um))
        .numbers(
            "kinematic_te_um",
            "single-sided amplitude of the no-load transmission error",
            lines().map(|l| l.kinematic_te_um),
        )
        .numbers(
            "flanks_um",
            "single-sided amplitude of what topographies and pitch errors of all teeth make under load, to first order",
            lines().map(|l| l.flanks_um),
        )
        .numbers("pinion_wave_um", PINION_WAVE, wave(0))
        .numbers("wheel_wave_um", WHEEL_WAVE, wave(1));
    let shares = Table::new("te_shares")
        .numbers("mesh_order", "order of the mesh frequency: the twelve lines to which the flanks contribute most", shares().map(|s| s.mesh_order))
        .numbers("pinion_order", "order of one turn of the pinion", shares().map(|s| s.order[0]))
        .numbers("wheel_order", "order of one turn of the wheel", shares().map(|s| s.order[1]))
        .texts("gear", "gear that makes the part", shares().map(|s| if s.gear == 0 { "pinion" } else { "wheel" }))
        .numbers("wave_order", "order of the wave on all driving flanks that makes the part; NaN of a tooth", number(is_wave))
        .numbers("tooth", "tooth, from 0, whose topography and pitch error make the part; NaN of a wave", number(is_tooth))
        .numbers("part_um", "single-sided amplitude of the part, to first order", shares().map(|s| s.amplitude_um))
        .numbers("share", "component of the part along the static transmission error of this order over its amplitude: waves, and teeth, add up to what the flanks make of it. Parts below a hundredth are left out", shares().map(|s| s.share));
    [orders, shares]
}
