//! What a user should hear of a solution.

use dynamics::{StaticModel, StaticPosition};
use reduction::GearReducer;

use super::reduced;

/// A free-cut sector is softer than the gear it was cut from.
pub(crate) fn sector_warnings(model: &StaticModel) -> Vec<String> {
    let name = ["pinion", "wheel"];
    (0..2)
        .filter_map(|i| {
            let gear = model.gears()[i].gear();
            let meshed = gear.teeth().len();
            let cyclic = reduced(&model.gears()[i]).is_some_and(GearReducer::is_cyclic);
            (!cyclic && meshed < gear.tooth_count() as usize).then(|| {
                format!(
                    "the {}'s mesh has {meshed} of {} teeth and free cuts: it is softer than the whole gear (5 of 30 teeth: by about \
                     16 % in the mean transmission error); use it for comparison only",
                    name[i],
                    gear.tooth_count()
                )
            })
        })
        .collect()
}

/// Transmission error over the module from which on small deflections are doubtful; gears at their limits reach 0.02.
const LARGE_ERROR_MODULES: f64 = 0.05;

/// What a solution says that a user should hear.
pub(super) fn doubts(positions: &[StaticPosition], module: f64) -> Vec<String> {
    let worst = |value: fn(&StaticPosition) -> f64| positions.iter().map(value).fold(0.0, f64::max);
    let mut said = Vec::new();
    let error = worst(|p| (p.transmission_error - p.kinematic_transmission_error).abs());
    if error > LARGE_ERROR_MODULES * module {
        said.push(format!(
            "the transmission error reaches {error:.3} mm at a module of {module} mm: elasticity here is linear and holds for \
             small deflections; is the torque in N m?"
        ));
    }
    said
}
