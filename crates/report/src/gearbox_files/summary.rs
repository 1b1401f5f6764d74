//! `summary.json` of a gearbox.

use analysis::gearbox_at_rest::GearboxResult;
use scene::gearbox::Gearbox;
use serde_json::json;

use crate::{Cost, SUMMARY_SCHEMA};

/// What is known of a gearbox but its rows. Names of keys bear the units.
pub fn gearbox_summary(file: &Gearbox, result: &GearboxResult, cost: &Cost, files: &[String]) -> String {
    let meshes = result.meshes.iter().zip(&result.pairs).map(|(m, pair)| {
        json!({
            "name": m.name,
            "eps_gamma": pair.total_contact_ratio(),
            "centre_distance_mm": pair.centre_distance(),
            "slices": m.slices,
            "mean_normal_force_n": m.normal_force,
            "mean_ste_um": 1e3 * m.transmission_error[0],
            "peak_to_peak_ste_um": 1e3 * m.transmission_error[1],
            "misalignment_in_plane_um": 1e3 * m.misalignment[0],
            "misalignment_across_um": 1e3 * m.misalignment[1],
            "face_load_factor": m.face_load_factor,
            "max_pressure_mpa": m.max_pressure,
            "timing_deg": m.timing.to_degrees(),
        })
    });
    let bearings = result.bearings.iter().map(|b| {
        json!({
            "name": b.name,
            "mean_force_n": b.force,
            "mean_moment_nmm": b.moment,
            "max_tilt_urad": 1e6 * b.tilt,
        })
    });
    let outputs = result
        .outputs
        .iter()
        .map(|o| json!({ "mean_lag_urad": 1e6 * o.mean, "peak_to_peak_lag_urad": 1e6 * o.peak_to_peak }));
    let shafts = file.shafts.iter().zip(&result.ratios).map(|(s, ratio)| json!({ "name": s.name, "ratio": ratio }));
    let all = json!({
        "schema": SUMMARY_SCHEMA,
        "gearbox": file.file.display().to_string(),
        "name": file.name,
        "shafts": shafts.collect::<Vec<_>>(),
        "meshes": meshes.collect::<Vec<_>>(),
        "bearings": bearings.collect::<Vec<_>>(),
        "outputs": outputs.collect::<Vec<_>>(),
        "mean_input_torque_nm": 1e-3 * result.input_torque,
        "positions": result.positions.len(),
        "certificate": { "residual": result.certificate[0], "body_balance": result.certificate[1] },
        "motion": super::motion::summary(file, result),
        "cost": cost,
        "warnings": result.warnings,
        "files": files,
    });
    format!("{all:#}\n")
}
