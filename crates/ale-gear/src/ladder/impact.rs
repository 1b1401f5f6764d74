//! Rigid gears on their true flanks.

use dynamics::{COORDINATES, Torque};
use geometry::GearPair;
use integrate::{Mechanism, State};
use lumped::{
    LumpedError,
    impact::{ImpactLaw, ImpactMechanism, ImpactOptions, StickSlip, contact_stiffness},
};
use nalgebra::DVector;
use std::f64::consts::TAU;

use super::{
    bodies::{bearings, bodies},
    model::{LadderModel, StaticPoint, at_rest},
};
use crate::{
    motion::{GEARS, TURNING, WRENCH, drive, torque},
    run,
    scene::{ImpactScene, Scene, TorqueScene},
};

const LEADING: [&str; 8] = [
    "contact_line_length_mm",
    "pairs_in_contact",
    "normal_force_n",
    "coast_normal_force_n",
    "least_slice_force_n",
    "overlap_um",
    "coast_overlap_um",
    "largest_pair_force_n",
];

/// The model of a scene, and its warnings.
///
/// # Errors
/// [`LumpedError`] for what has no meaning.
pub(super) fn impact(
    scene: &Scene,
    words: &ImpactScene,
    gears: &GearPair,
) -> Result<(ImpactMechanism, Vec<String>), LumpedError> {
    let running = run::options(scene, gears);
    let (stiffness, warnings) = match words.stiffness_n_per_mm_to_exponent {
        Some(given) => (given, Vec::new()),
        None => formula(scene, words, gears)?,
    };
    let bodies = bodies(scene, gears);
    let free = [0, 1].map(|i| {
        let mut free = [false; COORDINATES];
        scene.gears()[i].body.iter().flat_map(|b| &b.free).for_each(|axis| free[axis.number()] = true);
        free
    });
    let rubs = words.static_friction > 0.0 || words.dynamic_friction > 0.0;
    let options = ImpactOptions {
        driver: running.contact.driver,
        sense: running.contact.sense,
        bearings: bearings(scene, &bodies),
        bodies,
        free,
        drive: drive(scene, gears),
        load: load(scene),
        law: ImpactLaw {
            stiffness,
            exponent: words.exponent,
            damping: words.damping_ns_per_mm,
            depth: words.damping_depth_mm,
        },
        friction: rubs.then_some(StickSlip {
            static_coefficient: words.static_friction,
            dynamic_coefficient: words.dynamic_friction,
            static_speed: words.static_speed_mm_per_s,
            dynamic_speed: words.dynamic_speed_mm_per_s,
        }),
        slices: running.contact.slices,
        start_cycles: 0.0,
    };
    Ok((ImpactMechanism::new(gears.clone(), options)?, warnings))
}

fn load(scene: &Scene) -> Torque {
    torque(scene.load.as_ref().unwrap_or(&TorqueScene::default()), scene.operation.torque())
}

/// K of two balls; gears of different materials by one material that is as stiff in contact.
fn formula(scene: &Scene, words: &ImpactScene, gears: &GearPair) -> Result<(f64, Vec<String>), LumpedError> {
    let compliance: f64 = scene.gears().iter().map(|g| (1.0 - g.material.poisson.powi(2)) / g.material.young_mpa).sum();
    let poisson = scene.pinion.material.poisson;
    let young = 2.0 * (1.0 - poisson * poisson) / compliance;
    let stiffness = contact_stiffness(gears, run::options(scene, gears).contact.driver, young, poisson)?;
    let said = (words.exponent != 1.5).then(|| {
        format!(
            "the impact stiffness of {stiffness:.4e} N/mm^1.5 is that of two balls and belongs to the exponent 1.5; here it is taken with {}: give \
             `stiffness_n_per_mm_to_exponent`",
            words.exponent
        )
    });
    Ok((stiffness, said.into_iter().collect()))
}

impl LadderModel for ImpactMechanism {
    fn start(&mut self) -> Result<State, LumpedError> {
        Ok(at_rest(self.static_state()?))
    }

    fn scale(&self) -> DVector<f64> {
        Self::scale(self)
    }

    fn columns(&self) -> Vec<String> {
        let mut names: Vec<String> = TURNING.iter().chain(&LEADING).map(|&n| n.to_owned()).collect();
        for part in ["", "friction_"] {
            names.extend(GEARS.iter().flat_map(|g| WRENCH.iter().map(move |n| format!("{g}_{part}{n}"))));
        }
        names
    }

    fn row(&mut self, state: &State) -> Vec<f64> {
        let row = Self::row(self, state.time, &state.q, &state.v);
        let angle = (self.cycles(state.time) - 0.5) * self.pair().pinion.pitch_angle();
        let mut all = vec![
            row.time,
            angle.to_degrees(),
            row.mesh_phase,
            row.speed[0] * 60.0 / TAU,
            row.speed[1] * 60.0 / TAU,
            row.transmission_error_um,
            row.contact_line_length,
            row.pair_forces.iter().filter(|(_, f)| *f > 0.0).count() as f64,
            row.normal_force[0],
            row.normal_force[1],
            row.least_slice_force,
            1e3 * row.overlap[0],
            1e3 * row.overlap[1],
            row.pair_forces.iter().map(|(_, f)| *f).fold(0.0, f64::max),
        ];
        // No overlap is found where nothing is near: a number all the same, none that is infinite.
        all.iter_mut().for_each(|x| *x = if x.is_finite() { *x } else { 0.0 });
        all.extend(row.wrench.iter().chain(&row.friction).flatten());
        all
    }

    fn static_cycle(&self, phases: usize) -> Option<Vec<StaticPoint>> {
        let at = |k: usize| {
            let mut there = self.beginning_at(k as f64 / phases as f64).ok()?;
            let state = State::new(0.0, there.static_state().ok()?, DVector::zeros(self.mass().nrows()));
            let row = Self::row(&mut there, 0.0, &state.q, &state.v);
            Some(StaticPoint { error: 1e-3 * row.transmission_error_um, line_length: Some(row.contact_line_length) })
        };
        (0..phases).map(at).collect()
    }

    fn natural_frequencies_hz(&self, _: f64) -> Vec<f64> {
        Vec::new()
    }
}
