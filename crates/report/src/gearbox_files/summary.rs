//! Headline and facts of a gearbox, as `summary.json` has them.

use std::f64::consts::TAU;

use analysis::gearbox_at_rest::{GearboxResult, GearboxSwings, MeshResult, RollingLoad};
use gearbox::rolling_bearing::RollingElements;
use geometry::GearPair;
use scene::gearbox::{Gearbox, GearboxVibration};
use serde_json::{Map, Value, json};

use super::swing_words::{bearing_peaks, first_modes, holders, mesh_peaks};

/// What is known of a gearbox but its rows and its headline. Names of keys bear the units.
pub(super) fn info(file: &Gearbox, result: &GearboxResult) -> Map<String, Value> {
    let meshes = result.meshes.iter().zip(&result.pairs).map(|(m, pair)| mesh(m, pair));
    let bearings = result.bearings.iter().map(|b| {
        let mut own = json!({
            "name": b.name,
            "mean_force_n": b.force,
            "mean_moment_nmm": b.moment,
            "max_tilt_urad": 1e6 * b.tilt,
        });
        if let Some(load) = &b.rolling {
            own["rolling"] = rolling(load);
        }
        own
    });
    let outputs = result
        .outputs
        .iter()
        .map(|o| json!({ "mean_lag_urad": 1e6 * o.mean, "peak_to_peak_lag_urad": 1e6 * o.peak_to_peak }));
    let shafts = file.shafts.iter().zip(&result.ratios).map(|(s, ratio)| json!({ "name": s.name, "ratio": ratio }));
    let vibration = file.vibration.as_ref().zip(result.vibration.as_ref()).map(|own| vibration(file, own));
    let keys = [
        ("shafts", shafts.collect::<Value>()),
        ("meshes", meshes.collect()),
        ("bearings", bearings.collect()),
        ("outputs", outputs.collect()),
        ("positions", json!(result.positions.len())),
        ("motion", super::motion::summary(file, result)),
    ];
    // Keys of what is not asked for are not there.
    let vibration = vibration.map(|own| ("vibration", own));
    keys.into_iter().chain(vibration).map(|(key, value)| (key.to_owned(), value)).collect()
}

/// What is known of a rolling bearing.
fn rolling(load: &RollingLoad) -> Value {
    let (elements, diameter, length, pitch_diameter) = match &load.elements {
        RollingElements::Balls(b) => (b.elements, b.diameter, None, b.pitch_diameter),
        RollingElements::Rollers(r) => (r.elements, r.diameter, Some(r.length), r.pitch_diameter),
    };
    json!({
        "elements_per_row": elements,
        "element_diameter_mm": diameter,
        "element_length_mm": length,
        "pitch_diameter_mm": pitch_diameter,
        "is_estimated": load.is_estimated,
        "elements": load.count,
        "min_loaded_elements": load.loaded[0],
        "max_loaded_elements": load.loaded[1],
        "max_element_force_n": load.element_force,
        "max_hertz_pressure_mpa": load.pressure,
        "stiffness_n_mm_rad": load.stiffness,
    })
}

/// Headline of a vibration.
fn vibration(file: &Gearbox, (asked, swings): (&GearboxVibration, &GearboxSwings)) -> Value {
    let modes = first_modes(swings).iter().map(|mode| {
        json!({
            "frequency_hz": mode.frequency / TAU,
            "strain": holders(file, &mode.energy.strain),
            "kinetic": holders(file, &mode.energy.kinetic),
        })
    });
    let meshes = mesh_peaks(file, swings).into_iter().enumerate().map(|(i, peak)| {
        json!({
            "name": peak.name,
            "mean_mesh_stiffness_n_per_um": 1e-3 * swings.mesh_stiffness[i],
            "ste_amplitude_um": swings.transmission_error[i].iter().map(|x| 1e3 * x).collect::<Vec<_>>(),
            "largest_dynamic_force_rms_n": peak.force_n,
            "at_input_rpm": peak.input_rpm,
        })
    });
    let bearings = bearing_peaks(file, swings).into_iter().map(|peak| {
        json!({
            "name": peak.name,
            "largest_housing_force_rms_n": peak.force_n,
            "at_input_rpm": peak.input_rpm,
        })
    });
    let gears = file.gears.iter().zip(&swings.gears).map(|(gear, body)| {
        json!({
            "name": gear.name,
            "mass_kg": 1e3 * body.mass,
            "transverse_inertia_kg_m2": 1e-3 * body.transverse_inertia,
            "polar_inertia_kg_m2": 1e-3 * body.polar_inertia,
        })
    });
    json!({
        "input_rpm": asked.speeds_rpm,
        "damping_ratio": asked.damping_ratio,
        "modes": modes.collect::<Vec<_>>(),
        "modes_kept": swings.modes_kept,
        "modes_up_to_hz": swings.modes_up_to_hz,
        "crossings": swings.campbell.resonances.len(),
        "meshes": meshes.collect::<Vec<_>>(),
        "bearings": bearings.collect::<Vec<_>>(),
        "gears": gears.collect::<Vec<_>>(),
    })
}

/// What is known of a mesh.
fn mesh(m: &MeshResult, pair: &GearPair) -> Value {
    json!({
        "name": m.name,
        "eps_gamma": pair.total_contact_ratio(),
        "centre_distance_mm": pair.centre_distance(),
        "common_face_width_mm": pair.face_width(),
        "mid_face_offset_mm": pair.mid_face_offset(),
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
}
