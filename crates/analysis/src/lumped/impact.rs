//! Rigid gears with their true flanks.

use ::lumped::{
    LumpedError,
    impact::{ImpactLaw, ImpactMechanism, ImpactOptions, StickSlip, contact_stiffness},
};
use dynamics::{COORDINATES, Torque};
use gearbox::GearboxError;
use geometry::GearPair;
use integrate::State;
use nalgebra::DVector;
use scene::{ImpactScene, Scene, TorqueScene};

use super::{
    LumpedRow,
    bodies::{bearings, bodies},
    mechanism::{Formulas, LumpedMechanism, StaticPoint, at_rest},
};
use crate::{
    AnalysisError,
    motion::{drive, torque},
    options,
};

/// The model of a scene, and its remarks.
///
/// # Errors
/// [`LumpedError`] for what has no meaning.
pub(super) fn impact(
    scene: &Scene,
    own: &ImpactScene,
    gears: &GearPair,
) -> Result<(ImpactMechanism, Vec<answer::Remark>), LumpedError> {
    let running = options(scene, gears);
    let (stiffness, remarks) = match own.stiffness_n_per_mm_to_exponent {
        Some(given) => (given, Vec::new()),
        None => formula(scene, own, gears)?,
    };
    let bodies = bodies(scene.gears(), gears);
    let free = [0, 1].map(|i| {
        let mut free = [false; COORDINATES];
        scene.gears()[i].body.iter().flat_map(|b| &b.free).for_each(|axis| free[axis.number()] = true);
        free
    });
    let rubs = own.static_friction > 0.0 || own.dynamic_friction > 0.0;
    let impact = ImpactOptions {
        driver: running.contact.driver,
        sense: running.contact.sense,
        bearings: bearings(scene.gears(), &bodies),
        bodies,
        free,
        drive: drive(scene, gears),
        load: load(scene),
        law: ImpactLaw {
            stiffness,
            exponent: own.exponent,
            damping: own.damping_ns_per_mm,
            depth: own.damping_depth_mm,
        },
        friction: rubs.then_some(StickSlip {
            static_coefficient: own.static_friction,
            dynamic_coefficient: own.dynamic_friction,
            static_speed: own.static_speed_mm_per_s,
            dynamic_speed: own.dynamic_speed_mm_per_s,
        }),
        slices: running.contact.slices,
        start_cycles: 0.0,
    };
    Ok((ImpactMechanism::new(gears.clone(), impact)?, remarks))
}

fn load(scene: &Scene) -> Torque {
    torque(scene.load.as_ref().unwrap_or(&TorqueScene::default()), scene.operation.torque())
}

/// K of two balls; gears of different materials by one material that is as stiff in contact.
fn formula(scene: &Scene, own: &ImpactScene, gears: &GearPair) -> Result<(f64, Vec<answer::Remark>), LumpedError> {
    let compliance: f64 = scene.gears().iter().map(|g| (1.0 - g.material.poisson.powi(2)) / g.material.young_mpa).sum();
    let poisson = scene.pinion.material.poisson;
    let young = 2.0 * (1.0 - poisson * poisson) / compliance;
    let stiffness = contact_stiffness(gears, options(scene, gears).contact.driver, young, poisson)?;
    let warning = (own.exponent != 1.5).then(|| crate::remark::impact_exponent(stiffness, own.exponent));
    Ok((stiffness, warning.into_iter().collect()))
}

impl LumpedMechanism for Formulas<ImpactMechanism> {
    fn start(&mut self) -> Result<State, AnalysisError> {
        Ok(at_rest(self.rolling_state()?))
    }

    /// Impacts make of a small difference a large one.
    fn shoots(&self) -> bool {
        false
    }

    fn scale(&self) -> DVector<f64> {
        self.0.scale()
    }

    fn row(&mut self, state: &State) -> Result<LumpedRow, GearboxError> {
        let row = self.0.row(state.time, &state.q, &state.v);
        let pair_forces = || row.pair_forces.iter().map(|(_, f)| *f);
        Ok(LumpedRow {
            time: row.time,
            pinion_angle: Some((self.cycles(state.time) - 0.5) * self.pair().pinion.pitch_angle()),
            mesh_phase: row.mesh_phase,
            speeds: Some(row.speed),
            transmission_error_um: row.transmission_error_um,
            contact_line_length: Some(row.contact_line_length),
            pairs_in_contact: Some(pair_forces().filter(|f| *f > 0.0).count()),
            normal_force: row.normal_force[0],
            coast_normal_force: Some(row.normal_force[1]),
            // No overlap is found where nothing is near: a number all the same, none that is infinite.
            least_slice_force: Some(finite_or_zero(row.least_slice_force)),
            overlap: Some(row.overlap.map(finite_or_zero)),
            largest_pair_force: Some(pair_forces().fold(0.0, f64::max)),
            wrench: row.wrench,
            friction_wrench: Some(Box::new(row.friction)),
            ..LumpedRow::default()
        })
    }

    fn static_cycle(&self, phases: usize) -> Option<Vec<StaticPoint>> {
        let at = |k: usize| {
            let mut there = self.beginning_at(k as f64 / phases as f64).ok()?;
            let q = there.static_state().ok()?;
            let row = there.row(0.0, &q, &DVector::zeros(q.len()));
            Some(StaticPoint { error: 1e-3 * row.transmission_error_um, line_length: Some(row.contact_line_length) })
        };
        (0..phases).map(at).collect()
    }

    fn natural_frequencies_hz(&self, _: f64) -> Vec<f64> {
        Vec::new()
    }
}

fn finite_or_zero(x: f64) -> f64 {
    if x.is_finite() { x } else { 0.0 }
}
