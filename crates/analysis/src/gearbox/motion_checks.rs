//! Checks of a gearbox in motion, and of its periodic motions over the speed.

use answer::{Check, Checks};
use gearbox::motion::ReductionCertificate;
use scene::gearbox::MeshModel;

use super::motion_remarks::Judged;
use crate::in_motion::{energy_check, map_checks, map_excess};

/// Energy that steps may add or take by themselves, over that of the vibration: a tenth of what a pair may have.
const ENERGY: f64 = 1e-3;
/// Error of the natural frequencies of reduced shafts.
const FREQUENCIES: f64 = 0.03;
const FREQUENCIES_HINT: &str = "state a lower or higher `highest_frequency_hz`: modes up to twice that are kept";
/// Transmission error in modules, shafts and bearings that deflect in it: what lies beyond is no small strain.
pub(super) const DEFLECTION: f64 = 1.0;
pub(super) const SMALL: &str = "elasticity here is linear and holds for small deflections: are torques in N m, and bearings stiff \
                                enough for them?";
/// What to do where a map does not hold, and where a motion leaves its map or spring.
const INSTEAD: [&str; 2] = [
    "take `mesh = \"exact\"`, which solves the contact itself",
    "take `mesh = \"exact\"`, or let it run with more damping",
];
/// The same along a branch, which has no exact contact.
const ON_BRANCH: [&str; 2] = ["aim at a smaller `map_tolerance`", "give it more damping, or a larger load"];

/// How a mesh stands for its contact.
#[derive(Debug, Clone, Copy)]
pub(super) struct Contact {
    pub model: MeshModel,
    /// Error of its map over the mean approach, beside the most with which it is taken.
    pub map_error: Option<[f64; 2]>,
    /// How much of what it holds the motion has used at most.
    pub reach: f64,
    pub on_branch: bool,
}

impl Contact {
    fn checks(self) -> Vec<Check> {
        let instead = if self.on_branch { ON_BRANCH } else { INSTEAD };
        match (self.map_error, self.model) {
            (Some(error), _) => map_checks(error, self.reach, instead).into(),
            (None, MeshModel::Spring) => vec![map_excess(self.reach, instead[1])],
            (None, MeshModel::Exact | MeshModel::Mapped) => Vec::new(),
        }
    }
}

/// Checks of a mesh by its number in the file.
fn named(mesh: usize, checks: impl IntoIterator<Item = Check>) -> impl Iterator<Item = Check> {
    let one = move |check: Check| Check { name: format!("mesh_{}_{}", mesh + 1, check.name).into(), ..check };
    checks.into_iter().map(one)
}

/// Natural frequencies of the reduced shafts.
fn of_shafts(reduction: &ReductionCertificate) -> Check {
    Check::new("shaft_frequency_error", reduction.error, FREQUENCIES, FREQUENCIES_HINT)
}

/// Maps or springs of all meshes along a branch, and its reduced shafts.
pub(super) fn of_branch(meshes: impl Iterator<Item = Contact>, reduction: &ReductionCertificate) -> Checks {
    let all = meshes.enumerate().flat_map(|(i, own)| named(i, own.checks()));
    Checks::new(all.chain([of_shafts(reduction)]))
}

impl Judged<'_> {
    /// Checks of energy, of each mesh and its map or spring, and of the frequencies of the reduced shafts.
    pub fn checks(&self) -> Checks {
        let open = energy_check(self.moved.energy.open_over_vibration, self.step_keys());
        let energy = Check { bound: ENERGY, ..open };
        let meshes = (0..self.rest.meshes.len()).flat_map(|i| {
            let contact = Contact {
                model: self.asked.mesh,
                map_error: self.moved.map_errors[i],
                reach: self.moved.reach[i],
                on_branch: false,
            };
            named(i, self.mesh(i).checks().into_iter().map(with_shafts).chain(contact.checks()))
        });
        Checks::new([energy].into_iter().chain(meshes).chain([of_shafts(&self.moved.reduction)]))
    }
}

/// A check of a deflection in which shafts and bearings have a part.
fn with_shafts(check: Check) -> Check {
    if check.name == "dynamic_deflection_over_module" {
        Check { bound: DEFLECTION, hint: SMALL, ..check }
    } else {
        check
    }
}
