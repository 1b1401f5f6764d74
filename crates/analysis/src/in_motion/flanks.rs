//! The flanks of a mesh in motion: results, checks, remarks.

use answer::{Check, Remark};
use gearbox::motion::FlankCourse;
use geometry::GearPair;
use scene::Scene;
use serde::Serialize;

use super::{deflection_check_in_motion, force_jump_check, pulling_check};
use crate::{
    plausible::{effective_modulus, pressure_check},
    remark,
};

/// Error of the coupling of both flanks over the peak to peak that a user should hear of.
const COUPLED: f64 = 0.01;
/// Backlash below which there is none, um.
pub(crate) const NO_BACKLASH_UM: f64 = 1e-3;

described::described! {
    /// What the flanks of a mesh do in motion.
    #[derive(Debug, Clone, PartialEq, Serialize)]
    pub struct FlankCertificate {
        /// smallest force of a slice in contact, damping included, at the end of any step; below 0 a flank would pull. `null` without slices
        pub least_contact_force_n: Option<f64>,
        /// largest difference of the sum of normal forces before and after a tooth change at the same place, each solved by itself
        pub force_jump_at_tooth_change_n: f64,
        /// losses of contact of all driving flanks together
        pub contact_losses: u64,
        /// steps in which no driving flank touches
        pub steps_without_contact: u64,
        /// largest gap between the driving flanks
        pub largest_gap_um: f64,
        /// contacts of the coast flanks
        pub coast_contacts: u64,
        /// rows in which driving and coast flanks press at once
        pub rows_on_both_flanks: usize,
        /// bound of the displacement that such rows leave out, because in motion neither flank bends the other: the smaller of both forces over the mean mesh stiffness along the normal
        pub flank_coupling_bound_um: f64,
    }
}

/// Rows of a mesh in which driving and coast flanks press at once.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct BothFlanks {
    rows: usize,
    /// Largest of the smaller of both forces, N.
    shared_force: f64,
}

impl BothFlanks {
    /// Adds the normal forces of a row on driving and coast flanks, N.
    pub fn push(&mut self, [driving, coast]: [f64; 2]) {
        let shared = driving.min(coast);
        if shared > 0.0 {
            self.rows += 1;
            self.shared_force = self.shared_force.max(shared);
        }
    }
}

impl FlankCertificate {
    /// Of a mesh with this mean stiffness along the normal, N/mm.
    pub(crate) fn new(course: &FlankCourse, both: BothFlanks, stiffness: f64) -> Self {
        let FlankCourse { contact_losses, coast_contacts, extremes, changes, .. } = *course;
        Self {
            least_contact_force_n: extremes.least_force,
            force_jump_at_tooth_change_n: changes.jump,
            contact_losses,
            steps_without_contact: extremes.steps_apart,
            largest_gap_um: 1e3 * extremes.largest_gap,
            coast_contacts,
            rows_on_both_flanks: both.rows,
            // A force on one flank of a tooth bends the other flank by less than its own, F / k, and of the two forces only
            // the smaller is shared.
            flank_coupling_bound_um: 1e3 * both.shared_force / stiffness,
        }
    }
}

/// A mesh in motion as its checks and remarks see it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct MeshInMotion<'a> {
    pub scene: &'a Scene,
    pub pair: &'a GearPair,
    pub flanks: &'a FlankCertificate,
    pub has_coast_flanks: bool,
    /// Least and largest transmission error of all rows, um.
    pub errors_um: [f64; 2],
    /// Peak to peak of the transmission error, um.
    pub peak_to_peak_um: f64,
    /// Largest normal force of all rows on either side, N.
    pub force_n: f64,
    /// Largest pressure of all rows, MPa; `None` of a mesh without slices.
    pub pressure_mpa: Option<f64>,
}

impl MeshInMotion<'_> {
    /// Checks of tensile forces, of force jumps by tooth changes, and of the range of deflection and pressure in which
    /// linear elasticity is valid.
    pub fn checks(&self) -> Vec<Check> {
        let Self { scene, pair, flanks, force_n, .. } = *self;
        let deflection = deflection_check_in_motion(scene, pair, self.errors_um.into_iter().map(|um| 1e-3 * um));
        let Some(pressure) = self.pressure_mpa else { return vec![deflection] };
        vec![
            pulling_check(flanks.least_contact_force_n.unwrap_or(0.0), force_n),
            force_jump_check(flanks.force_jump_at_tooth_change_n, force_n),
            deflection,
            Check {
                name: "dynamic_pressure_over_modulus".into(),
                ..pressure_check(effective_modulus(scene), pressure)
            },
        ]
    }

    /// Remarks about contact on flanks that the model does not have, and about contact on both sides at once.
    pub fn remarks(&self) -> Vec<Remark> {
        let Self { pair, flanks, .. } = *self;
        let mut said = Vec::new();
        // Without coast flanks nothing stops teeth that have parted.
        let backlash_um = 1e3 * pair.backlash() * pair.base_helix_angle().cos();
        // Flanks that touch have no gap; digits of a centre distance are no backlash.
        let backlash_um = if backlash_um < NO_BACKLASH_UM { 0.0 } else { backlash_um };
        if !self.has_coast_flanks && flanks.largest_gap_um > backlash_um + NO_BACKLASH_UM {
            said.push(remark::gap_beyond_backlash(flanks.largest_gap_um, backlash_um));
        }
        if flanks.flank_coupling_bound_um > COUPLED * self.peak_to_peak_um {
            said.push(remark::both_flanks_press(flanks.rows_on_both_flanks, flanks.flank_coupling_bound_um));
        }
        said
    }
}

/// What stops driving flanks that part.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Parting {
    /// The coast flanks.
    CoastFlanks,
    /// Nothing: they fly on.
    Nothing,
    /// The motion ends where coast flanks would touch.
    End,
}

/// A pair without backlash in a motion in which flanks may part.
pub(crate) fn no_backlash(pair: &GearPair, parting: Parting) -> Option<Remark> {
    let backlash_um = 1e3 * pair.backlash();
    (backlash_um.abs() < NO_BACKLASH_UM).then(|| {
        let what = match parting {
            Parting::CoastFlanks => "where the driving flanks lose contact the coast flanks press at once, and there is no loss of contact as with a clearance",
            Parting::Nothing => "with `flanks = \"driving\"` teeth that part fly as if there were room behind them",
            Parting::End => "the motion ends where the driving flanks lose contact, as the coast flanks are not there to press",
        };
        remark::no_backlash(what)
    })
}

#[cfg(test)]
#[path = "../../tests/units/flanks.rs"]
mod tests;
