//! Checks of a motion.

use gearbox::motion::SweepPoint;
use geometry::GearPair;
use scene::Scene;

use super::MotionHeadline;
use crate::{
    certificate::Checks,
    in_motion::{MeshInMotion, StepKeys, deflection_check_in_motion, energy_check, force_jump_check, pulling_check},
};

/// What must hold of one speed of a sweep: the same as of a motion alone.
pub(super) fn checks_of_speed((scene, pair): (&Scene, &GearPair), point: &SweepPoint) -> Checks {
    let force = point.extremes.largest_force.max(point.coast_force);
    Checks::new([
        deflection_check_in_motion(scene, pair, point.transmission_error.iter().copied()),
        energy_check(point.ledger.open_over_vibration(), StepKeys::of_pair(scene)),
        pulling_check(point.extremes.least_force.unwrap_or(0.0), force),
        force_jump_check(point.changes.jump, force),
    ])
}

impl MotionHeadline {
    /// Energy, flanks that pull, forces that tooth changes set off, deflection and pressure that linear elasticity holds for.
    pub(super) fn checks(&self, scene: &Scene, pair: &GearPair) -> Checks {
        let of_mesh = self.mesh((scene, pair), true).checks();
        let energy = energy_check(self.certificate.energy_open_over_vibration, StepKeys::of_pair(scene));
        Checks::new([energy]).and(Checks::new(of_mesh))
    }

    /// Its mesh as checks and remarks see it.
    pub(super) fn mesh<'a>(
        &'a self,
        (scene, pair): (&'a Scene, &'a GearPair),
        has_coast_flanks: bool,
    ) -> MeshInMotion<'a> {
        MeshInMotion {
            scene,
            pair,
            flanks: &self.certificate.flanks,
            has_coast_flanks,
            errors_um: [self.min_dte_um, self.max_dte_um],
            peak_to_peak_um: self.peak_to_peak_dte_um,
            force_n: self.max_normal_force_n.max(self.max_coast_normal_force_n),
            pressure_mpa: Some(self.max_pressure_mpa),
        }
    }
}

#[cfg(test)]
mod tests {
    use dynamics::{Extremes, ToothChanges};
    use integrate::Ledger;
    use integrate::Periodicity;
    use integrate::SweepDirection;

    use super::*;

    /// A speed whose energy closes, without a flank that pulls or a force that jumps.
    fn sound() -> SweepPoint {
        SweepPoint {
            speed: 100.0,
            way: SweepDirection::Independent,
            own_start: true,
            periodicity: Periodicity { period: 1, residual: 0.0 },
            waited: 10,
            transmission_error: vec![5e-3; 4],
            normal_force: vec![100.0; 4],
            coast_force: 0.0,
            bearing_force: 0.0,
            ledger: Ledger { exchanged: 1.0, open: 1e-3, ..Ledger::default() },
            extremes: Extremes { least_force: Some(1.0), largest_force: 100.0, ..Extremes::default() },
            changes: ToothChanges { count: 10, jump: 1e-5 },
        }
    }

    /// Each measure of a speed alone makes it a failed one: energy out of nothing, a flank that pulls, a change that
    /// drops a force, and what is no number.
    #[test]
    fn a_speed_is_held_to_what_a_motion_is_held_to() {
        let scene = Scene::default_scene().unwrap();
        let pair = scene.gear_pair().unwrap();
        let missed = |change: fn(&mut SweepPoint)| {
            let mut point = sound();
            change(&mut point);
            checks_of_speed((&scene, &pair), &point).missed().map(|check| check.name.to_string()).collect::<Vec<_>>()
        };
        assert_eq!(missed(|_| ()), [""; 0]);
        assert_eq!(missed(|p| p.ledger.open = 0.011), ["energy_residual"]);
        assert_eq!(missed(|p| p.ledger.open = 0.009), [""; 0]);
        assert_eq!(missed(|p| p.ledger.open = f64::NAN), ["energy_residual"]);
        assert_eq!(missed(|p| p.ledger = Ledger { open: 1e-9, ..Ledger::default() }), ["energy_residual"]);
        assert_eq!(missed(|p| p.extremes.least_force = Some(-0.01)), ["pulling_force"]);
        assert_eq!(missed(|p| p.changes.jump = 0.02), ["force_jump"]);
        // The bound is 0.3 modules of 3 mm.
        assert_eq!(missed(|p| p.transmission_error[2] = 0.91), ["dynamic_deflection_over_module"]);
        assert_eq!(missed(|p| p.transmission_error[2] = 0.89), [""; 0]);
    }
}
