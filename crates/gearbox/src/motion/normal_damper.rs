//! A damper along the normal of flanks in contact.

use dynamics::FlankInstant;

use super::MeshLosses;
use crate::Vector12;

/// A damper (N s/mm) between flanks that press with `force` (N).
///
/// ```text
/// F_d = c rate,   |F_d| <= F
/// ```
/// Parting flanks let go at most as much as they press, so that none pulls; and flanks that meet are damped no harder
/// than they press, so that the force does not jump where contact begins.
#[derive(Debug, Clone, Copy)]
pub(super) struct NormalDamper<'a> {
    /// What displacements bring the flanks nearer by: 1, mm.
    pub lever: &'a Vector12,
    pub damping: f64,
    pub force: f64,
    /// dF/d approach, N/mm.
    pub stiffness: f64,
    /// What the flanks come nearer by with the mesh cycles alone, mm a cycle.
    pub by_cycles: f64,
}

impl NormalDamper<'_> {
    /// What the flanks come nearer by at `rates` of the displacements and so many mesh cycles a second, mm/s.
    fn rate(&self, rates: &Vector12, cycles: f64) -> f64 {
        self.lever.dot(rates) + self.by_cycles * cycles
    }

    /// State of the flanks in contact under its force, including the force of the damper.
    pub fn instant(&self, rates: &Vector12, cycles: f64) -> FlankInstant {
        let damping = (self.damping * self.rate(rates, cycles)).clamp(-self.force, self.force);
        FlankInstant { force: self.force, damping, ..FlankInstant::default() }
    }

    /// Adds its force at `rates` of the displacements and `cycles` mesh cycles per second.
    pub fn add(&self, rates: &Vector12, cycles: f64, all: &mut MeshLosses) {
        let rate = self.rate(rates, cycles);
        let asked = self.damping * rate;
        let damped = asked.clamp(-self.force, self.force);
        let outer = self.lever * self.lever.transpose();
        all.force -= damped * self.lever;
        all.along_cycles -= damped * self.by_cycles;
        all.dissipated += damped * rate;
        if damped == asked {
            all.rate_slope += self.damping * outer;
        } else {
            all.slope += damped.signum() * self.stiffness * outer;
        }
    }
}
