//! Charts of a motion and of a sweep.

use std::borrow::Cow;

use analysis::motion::{CampbellDiagram, MotionSpectrum, RPM, RunUp, RunUpCycle, SweepRow, Waterfall};
use dynamics::Speed;
use scene::SweepWay;
use study::{StudyError, extent};

use super::{spectrum::spectrum_chart, waterfall::waterfall_chart};
use crate::{
    ReportError,
    charts::{Curve, campbell_chart, line_chart},
};
use answer::Table;
use columns::{
    energy::RESIDUAL,
    motion_history::{MESH_PHASE, TIME},
};

/// Mesh cycles of a steady motion that are drawn, the last ones.
pub const SHOWN_CYCLES: usize = 4;
/// Mesh orders whose amplitudes are drawn over speed.
const SHOWN_CUTS: usize = 4;

/// What the charts of a motion are drawn from.
#[derive(Debug, Clone, Copy)]
pub struct MotionPictures<'a> {
    /// Rows of the history.
    pub rows: &'a Table,
    /// Rows of the ledger.
    pub energy: &'a Table,
    /// Spectra, at constant speed.
    pub spectrum: Option<&'a MotionSpectrum>,
    /// Waterfall of a run-up.
    pub waterfall: Option<&'a Waterfall>,
    /// A run-up or run-down: speed of the driver over time, its teeth, and what was found over speed.
    pub ramp: Option<(Speed, u32, &'a RunUp)>,
    /// Mesh orders beside the frequencies that they may meet.
    pub campbell: Option<&'a CampbellDiagram>,
    /// Rows in a mesh cycle.
    pub per_cycle: usize,
    /// Transmission error of the quasi-static cycle, mm, position by position; `None` where there is none.
    pub quasi_static: Option<&'a [f64]>,
}

/// Rows that are looked at together.
const ROWS: usize = 65_536;

/// All charts of a motion.
///
/// # Errors
/// [`ReportError`] for rows without a column that every motion has, and where they cannot be read back.
pub fn motion_charts(of: &MotionPictures<'_>) -> Result<Vec<String>, ReportError> {
    let steady = of.ramp.is_none();
    let rows = of.rows.rows();
    let first = if steady { rows.saturating_sub(SHOWN_CYCLES * of.per_cycle) } else { 0 };
    // Of a ramp, which is shown as a whole, one column at a time.
    let last = if steady { Some(of.rows.part(first..rows, |_| true)?) } else { None };
    let column = |name: &str| -> Result<Option<Vec<f64>>, ReportError> {
        let of = match &last {
            Some(last) => Cow::Borrowed(last),
            None => Cow::Owned(of.rows.part(0..rows, |own| own == name)?),
        };
        Ok(of.find(name).map(<[f64]>::to_vec))
    };
    let time = &column(TIME.name)?.ok_or_else(|| missing(TIME.name))?[..];
    let begin = if steady { time.first().copied().unwrap_or(0.0) } else { 0.0 };
    let unit = 1e3;
    // Of a ramp everything is drawn over the speed that it is made for.
    let place = |t: f64| match of.ramp {
        Some((law, ..)) => law.at(t) / RPM,
        None => unit * (t - begin),
    };
    let axis = of.ramp.map_or("time [ms], last mesh cycles".to_owned(), |(_, teeth, _)| speed_axis(teeth));
    let axis = axis.as_str();
    // A model without such a quantity has no curve.
    let curve = |label: &str, name: &str| -> Result<Curve, ReportError> {
        let points = time.iter().zip(column(name)?.unwrap_or_default()).map(|(t, x)| (place(*t), x)).collect();
        Ok(Curve { label: label.to_owned(), points })
    };
    let mut errors = vec![curve("DTE", "dte_um")?];
    if let (true, Some(ste)) = (steady, of.quasi_static) {
        errors.push(Curve {
            label: "STE".into(),
            points: repeated(
                &column(MESH_PHASE.name)?.ok_or_else(|| missing(MESH_PHASE.name))?,
                ste,
                time,
                begin,
                unit,
            ),
        });
    }
    let forces = [curve("driving flanks", "normal_force_n")?, curve("coast flanks", "coast_normal_force_n")?];
    let pairs = if steady { pressed_pairs(of.rows)? } else { Vec::new() };
    let sharing =
        pairs.iter().map(|name| curve(&name.replace("normal_force_", "").replace("_n", "").replace('_', " "), name));
    let sharing = sharing.collect::<Result<Vec<_>, _>>()?;
    let moments = [curve("pinion", "pinion_moment_y_nmm")?, curve("wheel", "wheel_moment_y_nmm")?];
    let (energy_axis, energy_place): (&str, &dyn Fn(f64) -> f64) =
        if steady { ("time [s]", &|t| t) } else { (axis, &place) };
    let mut all = of.ramp.map_or(Vec::new(), |(_, teeth, run_up)| run_up_charts(run_up, &speed_axis(teeth)));
    all.extend([
        line_chart("Dynamic transmission error", axis, "transmission error [um]", &errors, false),
        line_chart(
            "Total contact-line length",
            axis,
            "length [mm]",
            &[curve("length", "contact_line_length_mm")?],
            false,
        ),
        line_chart("Sum of normal forces", axis, "force [N]", &forces, true),
        line_chart("Load sharing", axis, "normal force [N]", &sharing, true),
        line_chart("Axial force on the wheel", axis, "force [N]", &[curve("z", "wheel_force_z_n")?], false),
        line_chart("Tilting moment about y", axis, "moment [N mm]", &moments, false),
    ]);
    for gear in ["pinion", "wheel"] {
        let beginning = format!("{gear}_bearing_force_");
        let names = of.rows.names().filter_map(|name| Some((name, name.strip_prefix(&beginning)?)));
        let curves = names.map(|(name, axis)| curve(axis.trim_end_matches("_n"), name));
        let curves = curves.collect::<Result<Vec<Curve>, _>>()?;
        all.push(line_chart(&format!("Bearing force of the {gear}"), axis, "force [N]", &curves, false));
    }
    if let Some(spectrum) = of.spectrum {
        let shown = [
            ["Spectrum of the dynamic transmission error", "amplitude [um]"],
            ["Spectrum of the sum of normal forces", "amplitude [N]"],
        ];
        all.extend(shown.into_iter().enumerate().map(|(i, words)| spectrum_chart(spectrum, i, words)));
    }
    let dte = ["the DTE", "um"];
    all.push(of.waterfall.and_then(|own| waterfall_chart(own, 0, dte, "pinion speed [1/min]")));
    all.push(of.campbell.and_then(|c| campbell_chart(&c.diagram, &c.orders, &c.names)));
    all.push(energy_chart(of.energy, energy_axis, energy_place)?);
    Ok(all.into_iter().flatten().collect())
}

/// The error that rows have no column of that name.
fn missing(name: &str) -> ReportError {
    StudyError::NoColumn { name: name.to_owned() }.into()
}

/// The column of that name, in memory.
fn series<'t>(of: &'t Table, name: &str) -> Result<&'t [f64], ReportError> {
    of.find(name).ok_or_else(|| missing(name))
}

/// Energy that does not close, row by row, over places of their times.
///
/// # Errors
/// [`ReportError`] where rows cannot be read back.
pub(crate) fn energy_chart(
    energy: &Table,
    axis: &str,
    place: &dyn Fn(f64) -> f64,
) -> Result<Option<String>, ReportError> {
    let part = energy.part(0..energy.rows(), |name| name == TIME.name || name == RESIDUAL.name)?;
    let both = series(&part, TIME.name)?.iter().zip(series(&part, RESIDUAL.name)?);
    let residual = Curve { label: "residual".into(), points: both.map(|(t, x)| (place(*t), *x)).collect() };
    Ok(line_chart("Energy that does not close", axis, "residual [mJ]", &[residual], false))
}

/// Columns of the pairs that press in any row.
fn pressed_pairs(of: &Table) -> Result<Vec<String>, ReportError> {
    let is_of_pair = |name: &str| name.starts_with("normal_force_pair_");
    let mut largest: Vec<(String, f64)> =
        of.names().filter(|name| is_of_pair(name)).map(|name| (name.to_owned(), f64::NEG_INFINITY)).collect();
    let rows = if largest.is_empty() { 0 } else { of.rows() };
    for first in (0..rows).step_by(ROWS) {
        let part = of.part(first..rows.min(first + ROWS), is_of_pair)?;
        for ((_, largest), column) in largest.iter_mut().zip(&part.columns) {
            *largest = largest.max(extent(column.numbers())[1]);
        }
    }
    Ok(largest.into_iter().filter(|(_, force)| *force > 0.0).map(|(name, _)| name).collect())
}

/// Axis of speeds of a driver with so many teeth; mesh frequency goes with it.
fn speed_axis(teeth: u32) -> String {
    let hz = format!("{:.4}", f64::from(teeth) / 60.0);
    format!("speed of the driver [1/min], each {} Hz of mesh frequency", hz.trim_end_matches('0').trim_end_matches('.'))
}

/// What a ramp is made for: peak to peak, order cuts and forces over speed.
fn run_up_charts(of: &RunUp, axis: &str) -> Vec<Option<String>> {
    let cycles = |label: &str, value: &dyn Fn(&RunUpCycle) -> f64| Curve {
        label: label.into(),
        points: of.cycles.iter().map(|c| (c.driver_speed_rpm, value(c))).collect(),
    };
    let orders = of.cuts.iter().map(|c| c.amplitudes_um.len()).min().unwrap_or(0).min(SHOWN_CUTS);
    let cuts: Vec<Curve> = (0..orders)
        .map(|n| Curve {
            label: format!("mesh order {}", n + 1),
            points: of.cuts.iter().map(|c| (c.driver_speed_rpm, c.amplitudes_um[n])).collect(),
        })
        .collect();
    let forces = [
        cycles("sum, largest", &|c| c.max_normal_force_n),
        cycles("sum, least", &|c| c.min_normal_force_n),
        cycles("one pair, largest", &|c| c.max_pair_normal_force_n.unwrap_or(f64::NAN)),
    ];
    let peak = [cycles("peak to peak", &|c| c.peak_to_peak_dte_um)];
    let factor = [cycles("largest over static force", &|c| c.dynamic_factor)];
    vec![
        line_chart("Peak to peak of the DTE in each mesh cycle", axis, "peak to peak [um]", &peak, true),
        line_chart("Order cuts of the DTE", axis, "amplitude [um]", &cuts, true),
        line_chart("Dynamic factor of each mesh cycle", axis, "largest over static force", &factor, true),
        line_chart("Normal forces of each mesh cycle", axis, "force [N]", &forces, true),
    ]
}

/// The quasi-static error of one cycle under every cycle drawn; `phases` are those of the rows at `time`.
fn repeated(phases: &[f64], ste: &[f64], time: &[f64], begin: f64, unit: f64) -> Vec<(f64, f64)> {
    let n = ste.len();
    let at = |phase: f64| {
        let place = phase.rem_euclid(1.0) * n as f64;
        let (i, share) = (place.floor() as usize % n, place.fract());
        1e3 * ((1.0 - share) * ste[i] + share * ste[(i + 1) % n])
    };
    time.iter().zip(phases).map(|(t, phase)| (unit * (t - begin), at(*phase))).collect()
}

/// What the charts of a sweep are drawn from.
#[derive(Debug, Clone, Copy)]
pub struct SweepPictures<'a> {
    /// A row a way and speed.
    pub rows: &'a [SweepRow],
    /// Mesh orders beside the frequencies that they may meet.
    pub campbell: &'a CampbellDiagram,
    /// Teeth of the driver.
    pub teeth: u32,
}

/// Largest minus smallest DTE over speed, way by way, its orders, and the largest force.
pub fn sweep_charts(of: &SweepPictures<'_>) -> Vec<String> {
    let rows = of.rows;
    let curves = |value: &dyn Fn(&SweepRow) -> f64| -> Vec<Curve> {
        [SweepWay::Apart, SweepWay::Up, SweepWay::Down]
            .into_iter()
            .filter_map(|way| {
                let points: Vec<(f64, f64)> =
                    rows.iter().filter(|r| r.way == way).map(|r| (r.speed_rpm, value(r))).collect();
                let label = match way {
                    SweepWay::Apart => "each speed by itself",
                    SweepWay::Up => "upwards",
                    SweepWay::Down => "downwards",
                };
                (!points.is_empty()).then(|| Curve { label: label.into(), points })
            })
            .collect()
    };
    let axis = speed_axis(of.teeth);
    let speed = axis.as_str();
    let orders = rows.iter().map(|r| r.dte_harmonics_um.len()).min().unwrap_or(0);
    let cuts: Vec<Curve> = (0..orders)
        .flat_map(|n| {
            let ways = curves(&|r: &SweepRow| r.dte_harmonics_um[n]);
            ways.into_iter().map(move |c| Curve { label: format!("mesh order {}, {}", n + 1, c.label), ..c })
        })
        .collect();
    [
        line_chart("Peak to peak of the DTE", speed, "peak to peak [um]", &curves(&|r| r.peak_to_peak_dte_um), true),
        line_chart("Dynamic factor", speed, "largest over static force", &curves(&|r| r.dynamic_factor), true),
        line_chart("Order cuts of the DTE", speed, "amplitude [um]", &cuts, true),
        line_chart("Mean DTE", speed, "mean [um]", &curves(&|r| r.mean_dte_um), false),
        campbell_chart(&of.campbell.diagram, &of.campbell.orders, &of.campbell.names),
    ]
    .into_iter()
    .flatten()
    .collect()
}
