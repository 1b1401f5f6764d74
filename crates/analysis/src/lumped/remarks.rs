//! Remarks for the user of a cheaper model.

use answer::Remark;
use scene::{Model, MotionScene, Run};
use study::Lyapunov;

use super::{headline::LumpedHeadline, inputs::LumpedInputs};
use crate::{
    in_motion::{NO_BACKLASH_UM, StepKeys, energy_remark, no_backlash as pair_without_backlash},
    motion::parting,
    remark,
};

/// Backlash of the model along the line of action, um.
pub(super) fn backlash_um(inputs: &LumpedInputs) -> f64 {
    let given = inputs.scene.mesh.as_ref().and_then(|mesh| mesh.half_backlash_um);
    given.map_or_else(|| 1e3 * inputs.pair.backlash(), |half| 2.0 * half)
}

/// A mesh without backlash where the model has one: its flanks do not part.
pub(super) fn no_backlash(inputs: &LumpedInputs) -> Option<Remark> {
    let LumpedInputs { scene, pair, .. } = inputs;
    let has_one = match scene.analysis.model {
        model if model.has_reduced_gears() => return pair_without_backlash(pair, parting(scene)),
        Model::Lumped8 | Model::Shaft18 => scene.mesh.is_some(),
        model => model == Model::Impact,
    };
    let backlash_um = has_one.then(|| backlash_um(inputs))?;
    let own = if scene.mesh.is_some() { "`half_backlash_um` in [mesh], or " } else { "" };
    (backlash_um.abs() < NO_BACKLASH_UM).then(|| remark::mesh_without_backlash(own))
}

/// What the largest exponent says of a motion that does not repeat itself.
fn why_not(exponent: Option<Lyapunov>) -> String {
    match exponent {
        Some(found) if found.is_chaotic() => format!(
            "it is chaotic: neighbours part by a factor e in {:.2e} s (largest Lyapunov exponent {:.3e} +- {:.1e} 1/s)",
            1.0 / found.exponent,
            found.exponent,
            found.error
        ),
        Some(found) if found.exponent < -3.0 * found.error => format!(
            "neighbours come together (largest Lyapunov exponent {:.3e} +- {:.1e} 1/s): it needs more `warm_up_cycles`, or its \
             period is longer than those that are looked for",
            found.exponent, found.error
        ),
        Some(found) => format!(
            "neighbours neither part nor come together (largest Lyapunov exponent {:.3e} +- {:.1e} 1/s): it may have two \
             frequencies, or need more `warm_up_cycles`",
            found.exponent, found.error
        ),
        None => "it may be chaotic, or need more `warm_up_cycles`".to_owned(),
    }
}

/// What the certificate says that a user should hear.
pub(super) fn certificate_remarks(motion: &MotionScene, headline: &LumpedHeadline) -> Vec<Remark> {
    let mut remarks = Vec::new();
    let c = &headline.certificate;
    if let (Run::Steady, Some(found), Some(asked)) = (motion.run, c.periodicity, motion.periodic_tolerance) {
        if found > asked {
            remarks.push(remark::not_periodic(c.warm_up_cycles, found, asked, why_not(c.lyapunov)));
        } else if let Some(period) = c.period_cycles.filter(|p| Some(*p as u64) > c.common_period_cycles) {
            remarks.push(remark::subharmonic(period));
        }
    }
    remarks.extend(energy_remark(c.energy_open_over_vibration, StepKeys::PAIR.by(motion.error_tolerance)));
    remarks
}
