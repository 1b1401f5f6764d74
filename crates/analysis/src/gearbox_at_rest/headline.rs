//! The numbers that a gearbox is judged, varied and compared by.

use scene::gearbox::Gearbox;
use serde_json::{Map, Value, json};

use super::{BearingLoad, GearboxMotionResult, GearboxResult, GearboxSwings, MeshResult, OutputResult};

/// What a number is of, and how it is read off; of meshes and bearings by their place in the file.
#[derive(Clone, Copy)]
enum Of {
    Whole(fn(&GearboxResult) -> f64),
    Meshes(fn(&MeshResult) -> Option<f64>),
    Outputs(fn(&OutputResult) -> f64),
    Bearings(fn(&BearingLoad) -> f64),
    MeshesVibrating(fn(&GearboxSwings, usize) -> f64),
    BearingsVibrating(fn(&GearboxSwings, usize) -> f64),
    MeshesMoving(fn(&GearboxMotionResult, usize) -> f64),
    BearingsMoving(fn(&GearboxMotionResult, usize) -> f64),
}

/// Every number once; those of meshes, outputs and bearings are lists in the order of the file.
const NUMBERS: [(&str, Of); 14] = [
    ("mean_input_torque_nm", Of::Whole(|r| 1e-3 * r.input_torque)),
    ("mean_ste_um", Of::Meshes(|m| Some(1e3 * m.transmission_error[0]))),
    ("peak_to_peak_ste_um", Of::Meshes(|m| Some(1e3 * m.transmission_error[1]))),
    ("misalignment_in_plane_um", Of::Meshes(|m| Some(1e3 * m.misalignment[0]))),
    ("face_load_factor", Of::Meshes(|m| m.face_load_factor)),
    ("max_pressure_mpa", Of::Meshes(|m| Some(m.max_pressure))),
    ("peak_to_peak_lag_urad", Of::Outputs(|o| 1e6 * o.peak_to_peak)),
    ("mean_bearing_force_n", Of::Bearings(|b| b.force[0].hypot(b.force[1]).hypot(b.force[2]))),
    ("largest_dynamic_force_rms_n", Of::MeshesVibrating(|s, i| s.peak(|rms| rms.mesh_forces[i]).unwrap_or_default().1)),
    (
        "largest_housing_force_rms_n",
        Of::BearingsVibrating(|s, i| s.peak(|rms| rms.bearing_forces[i]).unwrap_or_default().1),
    ),
    ("peak_to_peak_dte_um", Of::MeshesMoving(|m, i| m.settled(|p| 1e3 * p.meshes[i].transmission_error).span())),
    ("min_normal_force_n", Of::MeshesMoving(|m, i| m.settled(|p| p.meshes[i].normal_force).least)),
    ("max_normal_force_n", Of::MeshesMoving(|m, i| m.settled(|p| p.meshes[i].normal_force).largest)),
    ("max_radial_bearing_force_n", Of::BearingsMoving(|m, i| m.radial_force(i).largest)),
];

impl GearboxResult {
    /// The headline of `summary.json`; the names bear the units. Numbers of a vibration or a motion are there where the
    /// file asks for one.
    pub fn headline(&self) -> Value {
        let meshes = 0..self.meshes.len();
        let bearings = 0..self.bearings.len();
        let value = |of: Of| -> Option<Value> {
            Some(match of {
                Of::Whole(own) => json!(own(self)),
                Of::Meshes(own) => self.meshes.iter().map(own).collect(),
                Of::Outputs(own) => self.outputs.iter().map(own).collect(),
                Of::Bearings(own) => self.bearings.iter().map(own).collect(),
                Of::MeshesVibrating(own) => {
                    self.vibration.as_ref().map(|s| meshes.clone().map(|i| own(s, i)).collect())?
                }
                Of::BearingsVibrating(own) => {
                    self.vibration.as_ref().map(|s| bearings.clone().map(|i| own(s, i)).collect())?
                }
                Of::MeshesMoving(own) => self.motion.as_ref().map(|m| meshes.clone().map(|i| own(m, i)).collect())?,
                Of::BearingsMoving(own) => {
                    self.motion.as_ref().map(|m| bearings.clone().map(|i| own(m, i)).collect())?
                }
            })
        };
        NUMBERS.iter().filter_map(|(key, of)| Some(((*key).to_owned(), value(*of)?))).collect::<Map<_, _>>().into()
    }

    /// Keys of the headline before anything is solved, each with how many numbers it lists; `None`: it is one.
    pub fn headline_keys(file: &Gearbox) -> Vec<(&'static str, Option<usize>)> {
        let (vibrates, moves) = (file.vibration.is_some(), file.motion.is_some());
        let count = |of: Of| match of {
            Of::Whole(_) => Some(None),
            Of::Meshes(_) => Some(Some(file.meshes.len())),
            Of::Outputs(_) => Some(Some(file.torques.len())),
            Of::Bearings(_) => Some(Some(file.bearings.len())),
            Of::MeshesVibrating(_) => vibrates.then_some(Some(file.meshes.len())),
            Of::BearingsVibrating(_) => vibrates.then_some(Some(file.bearings.len())),
            Of::MeshesMoving(_) => moves.then_some(Some(file.meshes.len())),
            Of::BearingsMoving(_) => moves.then_some(Some(file.bearings.len())),
        };
        NUMBERS.iter().filter_map(|(key, of)| Some((*key, count(*of)?))).collect()
    }

    /// Whether a number of the headline, by its key, is one of the vibration, and whether it is one of the motion.
    pub fn is_in_time(key: &str) -> [bool; 2] {
        let of = NUMBERS.iter().find(|(own, _)| *own == key).map(|(_, of)| *of);
        [
            matches!(of, Some(Of::MeshesVibrating(_) | Of::BearingsVibrating(_))),
            matches!(of, Some(Of::MeshesMoving(_) | Of::BearingsMoving(_))),
        ]
    }
}
