//! `resonance.csv` of a sweep over speed.

use analysis::motion::{SWEEP_ORDERS, SweepRow, SweepStatus};

use crate::csv::{push_row, quoted};

/// As it stands in the file.
fn status(of: SweepStatus) -> &'static str {
    match of {
        SweepStatus::Periodic => "periodic",
        SweepStatus::NotPeriodic => "not-periodic",
        SweepStatus::Failed => "failed",
    }
}

/// `resonance.csv`: a row a way and speed.
pub fn resonance_csv(rows: &[SweepRow]) -> String {
    let harmonics: Vec<String> = (1..=SWEEP_ORDERS).map(|h| format!("dte_harmonic_{h}_um")).collect();
    let mut csv = format!(
        "way,speed_rpm,mesh_frequency_hz,mean_dte_um,peak_to_peak_dte_um,{},min_normal_force_n,max_normal_force_n,\
         dynamic_factor,max_coast_normal_force_n,max_bearing_force_n,period_cycles,periodicity,warm_up_cycles,start,status,reason\n",
        harmonics.join(",")
    );
    for row in rows {
        csv.push_str(row.way.word());
        csv.push(',');
        let lines = (0..SWEEP_ORDERS).map(|h| row.dte_harmonics_um.get(h).copied().unwrap_or(f64::NAN));
        let first = [row.speed_rpm, row.mesh_frequency_hz, row.mean_dte_um, row.peak_to_peak_dte_um];
        let last = [
            row.min_normal_force_n,
            row.max_normal_force_n,
            row.dynamic_factor,
            row.max_coast_normal_force_n,
            row.max_bearing_force_n,
            row.period_cycles as f64,
            row.periodicity,
            row.warm_up_cycles as f64,
        ];
        push_row(&mut csv, first.into_iter().chain(lines).chain(last));
        csv.pop();
        let start = if row.own_start { "quasi-static" } else { "neighbour" };
        csv.push_str(&format!(",{start},{},{}\n", status(row.status), quoted(&row.reason)));
    }
    csv
}
