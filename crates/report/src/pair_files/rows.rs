//! Rows beside the histories of motions as tables.

use analysis::{
    flank_orders::FlankWaves,
    lumped::LumpedCampbell,
    motion::{CampbellDiagram, MotionSpectrum, RunUp, RunUpCycle, SWEEP_ORDERS, SweepRow, Waterfall},
};
use answer::Table;
use study::Campbell;

use crate::{
    contact_files::{PINION_WAVE, WHEEL_WAVE},
    motion_files::{self, SPECTRA, WaterfallOf},
};

/// Meaning of the column `periodicity` of all sweeps.
pub(super) const PERIODICITY: &str =
    "largest difference of a coordinate or velocity after the best period, over its peak to peak";
/// Meaning of the column `status` of all sweeps.
pub(super) const STATUS: &str = "`solved`; `not-periodic`: `periodicity` is above `periodic_tolerance`; `failed`: no motion, or one that fails its certificate";

/// `spectrum`: lines of a motion at constant speed, beside the waves of the flanks.
pub(crate) fn spectrum(of: &MotionSpectrum, flanks: &FlankWaves) -> Table {
    let meaning = "single-sided amplitude; of order 0 the mean";
    let at =
        |gear: usize, what: fn(&FlankWaves, f64) -> [f64; 2]| of.orders.iter().map(move |o| what(flanks, *o)[gear]);
    motion_files::spectrum(of, SPECTRA.map(|name| (name.to_owned(), meaning)))
        .numbers("pinion_order", "order of one turn of the pinion", at(0, FlankWaves::orders))
        .numbers("wheel_order", "order of one turn of the wheel", at(1, FlankWaves::orders))
        .numbers("pinion_wave_um", PINION_WAVE, at(0, FlankWaves::amplitudes_um))
        .numbers("wheel_wave_um", WHEEL_WAVE, at(1, FlankWaves::amplitudes_um))
}

/// `waterfall`: spectra of a ramp, stretch by stretch.
pub(crate) fn waterfall(of: &Waterfall) -> Table {
    let dte = ("dte_um".to_owned(), "single-sided amplitude of the dynamic transmission error");
    let of_pair = WaterfallOf {
        speed: ["pinion_speed_rpm", "mean speed of the pinion over the interval"],
        order: "order of the mesh frequency",
        quantities: &[dte],
    };
    motion_files::waterfall(of, of_pair)
}

/// `cycles`: one row a mesh cycle of a ramp.
pub(crate) fn cycles(of: &RunUp) -> Table {
    let mut table = cycles_of(Table::new("cycles"), &of.cycles.iter().collect::<Vec<_>>());
    if of.cycles.iter().all(|c| c.max_pair_normal_force_n.is_some()) {
        let forces = of.cycles.iter().filter_map(|c| c.max_pair_normal_force_n);
        table.push_numbers(
            "max_pair_normal_force_n",
            "largest normal force of one tooth pair, without damping; not of `impact`",
            forces,
        );
    }
    table
}

/// The same of the meshes of a gearbox, one after the other.
pub(crate) fn cycles_of_meshes<'a>(of: impl Iterator<Item = (&'a str, &'a RunUp)> + Clone) -> Table {
    let names = of.clone().flat_map(|(name, own)| own.cycles.iter().map(move |_| name));
    let table = Table::new("cycles").texts("mesh", "name of the mesh", names);
    cycles_of(table, &of.flat_map(|(_, own)| &own.cycles).collect::<Vec<_>>())
}

/// Columns of mesh cycles behind those of a table.
fn cycles_of(table: Table, all: &[&RunUpCycle]) -> Table {
    table
        .numbers("time_s", "middle of the mesh cycle", all.iter().map(|c| c.time_s))
        .numbers(
            "driver_speed_rpm",
            "speed of the driver at that time, of a gearbox of its input",
            all.iter().map(|c| c.driver_speed_rpm),
        )
        .numbers("mesh_frequency_hz", "mesh frequency at that time", all.iter().map(|c| c.mesh_frequency_hz))
        .numbers("mean_dte_um", "mean dynamic transmission error", all.iter().map(|c| c.mean_dte_um))
        .numbers(
            "peak_to_peak_dte_um",
            "peak to peak of the dynamic transmission error",
            all.iter().map(|c| c.peak_to_peak_dte_um),
        )
        .numbers(
            "min_normal_force_n",
            "smallest sum of normal forces on the driving flanks",
            all.iter().map(|c| c.min_normal_force_n),
        )
        .numbers(
            "max_normal_force_n",
            "largest sum of normal forces on the driving flanks",
            all.iter().map(|c| c.max_normal_force_n),
        )
        .numbers(
            "dynamic_factor",
            "largest sum of normal forces over the mean quasi-static one",
            all.iter().map(|c| c.dynamic_factor),
        )
}

/// `order_cuts`: amplitudes of mesh orders over speed, one row a stretch of the waterfall.
pub(crate) fn order_cuts(of: &RunUp) -> Table {
    let orders = of.cuts.iter().map(|c| c.amplitudes_um.len()).min().unwrap_or(0);
    let mut table = Table::new("order_cuts")
        .numbers("time_s", "middle of the interval", of.cuts.iter().map(|c| c.time_s))
        .numbers("driver_speed_rpm", "speed of the driver", of.cuts.iter().map(|c| c.driver_speed_rpm))
        .numbers("mesh_frequency_hz", "mesh frequency", of.cuts.iter().map(|c| c.mesh_frequency_hz));
    for n in 0..orders {
        let amplitudes = of.cuts.iter().map(|c| c.amplitudes_um[n]);
        table.push_numbers(
            format!("dte_order_{}_um", n + 1),
            "amplitude of a mesh order in the dynamic transmission error, 8 orders at the most",
            amplitudes,
        );
    }
    table
}

/// `campbell` of a reduced pair: one row a speed.
pub(crate) fn campbell(of: &CampbellDiagram) -> Table {
    let column = |name: &String| name.replace(' ', "_") + "_hz";
    frequencies(&of.diagram, of.names.iter().map(column), of.orders.iter().map(column))
}

/// `campbell` of a linear model: one row a speed of the driver.
pub(crate) fn lumped_campbell(of: &LumpedCampbell) -> Table {
    let modes = (1..=of.diagram.frequencies.len()).map(|m| format!("elastic_mode_{m}_hz"));
    frequencies(&of.diagram, modes, of.names.iter().map(|n| n.replace([' ', '\''], "_") + "_hz"))
}

fn frequencies(diagram: &Campbell, modes: impl Iterator<Item = String>, lines: impl Iterator<Item = String>) -> Table {
    let speeds = &diagram.speeds;
    let mut table = Table::new("campbell").numbers(
        "speed_rpm",
        "speed of the driver, from standstill",
        speeds.iter().map(|s| 60.0 * s),
    );
    for (name, mode) in modes.zip(&diagram.frequencies) {
        let meaning = match name.contains("_elastic_") {
            true => "lowest natural frequency of the gear, bore held and flanks free",
            false => "natural frequency of a mode; gyroscopic moments split the whirls as the speed rises",
        };
        table.push_numbers(name, meaning, mode[..speeds.len()].iter().copied());
    }
    for (name, order) in lines.zip(&diagram.orders) {
        table.push_numbers(
            name,
            "frequency of an order of excitation: mesh order, or rotation of a gear",
            speeds.iter().map(|speed| order * speed),
        );
    }
    table
}

/// `resonance`: a row a way and speed.
pub(crate) fn resonance(rows: &[SweepRow]) -> Table {
    let mut table = Table::new("resonance")
        .texts(
            "way",
            "direction: `up`, `down` (from the motion of the speed before) or `apart` (from rest under the load)",
            rows.iter().map(|r| r.way.word()),
        )
        .numbers("speed_rpm", "speed of the driver", rows.iter().map(|r| r.speed_rpm))
        .numbers("mesh_frequency_hz", "mesh frequency", rows.iter().map(|r| r.mesh_frequency_hz))
        .numbers("mean_dte_um", "mean dynamic transmission error", rows.iter().map(|r| r.mean_dte_um))
        .numbers(
            "peak_to_peak_dte_um",
            "peak to peak of the dynamic transmission error",
            rows.iter().map(|r| r.peak_to_peak_dte_um),
        );
    for h in 0..SWEEP_ORDERS {
        let amplitudes = rows.iter().map(|r| r.dte_harmonics_um.get(h).copied().unwrap_or(f64::NAN));
        table.push_numbers(
            format!("dte_harmonic_{}_um", h + 1),
            "amplitude of a mesh harmonic of the dynamic transmission error",
            amplitudes,
        );
    }
    table
        .numbers(
            "min_normal_force_n",
            "smallest sum of normal forces on the driving flanks",
            rows.iter().map(|r| r.min_normal_force_n),
        )
        .numbers(
            "max_normal_force_n",
            "largest sum of normal forces on the driving flanks",
            rows.iter().map(|r| r.max_normal_force_n),
        )
        .numbers(
            "dynamic_factor",
            "largest sum of normal forces on driving or coast flanks over the mean quasi-static one",
            rows.iter().map(|r| r.dynamic_factor),
        )
        .numbers(
            "max_coast_normal_force_n",
            "largest sum of normal forces on the coast flanks",
            rows.iter().map(|r| r.max_coast_normal_force_n),
        )
        .numbers("max_bearing_force_n", "largest force of a bearing", rows.iter().map(|r| r.max_bearing_force_n))
        .numbers(
            "period_cycles",
            "mesh cycles after which the motion repeats itself best",
            rows.iter().map(|r| r.period_cycles as f64),
        )
        .numbers("periodicity", PERIODICITY, rows.iter().map(|r| r.periodicity))
        .numbers("warm_up_cycles", "mesh cycles before the first row", rows.iter().map(|r| r.warm_up_cycles as f64))
        .texts(
            "start",
            "start of the motion: `neighbour`, the end of the speed beside it, or `quasi-static`, its own equilibrium",
            rows.iter().map(|r| if r.own_start { "quasi-static" } else { "neighbour" }),
        )
        .texts("status", STATUS, rows.iter().map(|r| r.status.word()))
        .texts(
            "reason",
            "reason why there is no motion; empty where there is one",
            rows.iter().map(|r| r.reason.as_str()),
        )
}
