//! The pair in motion: a few mesh cycles at constant speed from quasi-static balance, with its ledger of energy.
//!
//! `cargo run -p gearbox --example dynamic_run`
#![allow(clippy::print_stdout, reason = "an example prints")]

use std::{error::Error, f64::consts::TAU};

mod pair;

use ale::Station;
use dynamics::{Bearing, Drive, MeshDamping, MotionOptions, RigidBody, Speed, Torque};
use fem::{Material, mass_properties};
use gearbox::motion::PairModel;
use integrate::{Integrator, Scheme, StepControl};
use ltca::{StaticModel, StaticOptions};

const TORQUE_NMM: f64 = 150e3;

fn main() -> Result<(), Box<dyn Error>> {
    let (pair, meshes) = pair::coarse()?;
    let contact = StaticOptions::new(TORQUE_NMM, &pair);
    let mut statics = StaticModel::new(pair.clone(), pair::reduced(&pair, &meshes, &contact)?, contact.clone())?;
    let at_rest = statics.solve(Station { cycle: 0, phase: 0.0 })?;

    let masses =
        [mass_properties(meshes[0].mesh(), &Material::STEEL)?, mass_properties(meshes[1].mesh(), &Material::STEEL)?];
    let speed = 6000.0 * TAU / 60.0; // of the pinion, rad/s
    let options = MotionOptions {
        statics: contact,
        bodies: masses.map(|m| RigidBody::of_tensor(m.mass_t, m.inertia_about_tmm2([0.0; 3]))),
        bearings: [Bearing::default(); 2],
        free: [[false; 6]; 2], // axes held: the turn of the wheel alone moves
        drive: Drive::Speed(Speed::Constant(speed)),
        load: Torque::Constant(TORQUE_NMM),
        damping: MeshDamping::Ratio(0.05),
        start_cycles: 0.0,
    };
    let means = [at_rest.tangent_stiffness, at_rest.contact_line_length];
    let model = PairModel::new(pair.clone(), statics.into_gears(), None, options, means)?;
    let mut system = model.machine()?;
    let mut state = system.start(0.0)?;

    let period = pair.pinion.pitch_angle() / speed;
    let mut integrator =
        Integrator::new(Scheme::Energy, StepControl::Fixed(period / 64.0), model.scale(at_rest.transmission_error));
    println!("{:>6} {:>10} {:>14}", "cycle", "DTE, um", "rate, um/ms");
    for eighth in 0..=32 {
        println!("{:>6.3} {:>10.4} {:>14.4}", f64::from(eighth) / 8.0, 1e3 * state.q[0], state.v[0]);
        integrator.advance(&mut system, &mut state, f64::from(eighth + 1) * period / 8.0, |_, _| ())?;
    }
    if let Some(ledger) = integrator.ledger() {
        println!(
            "\nN mm: supplied {:.4}, dissipated {:.4}, by the turning of the teeth {:.4}, open {:.0e}",
            ledger.supplied,
            ledger.dissipated,
            ledger.parametric,
            ledger.residual()
        );
    }
    Ok(())
}
