//! A pair with backlash, eight coordinates, at some speeds: where do its flanks lose contact?
//!
//! `cargo run -p lumped --example rattle`
#![allow(clippy::print_stdout, reason = "an example prints")]

use std::{convert::Infallible, error::Error, f64::consts::TAU};

use dynamics::RigidBody;
use geometry::{Driver, Gear, GearData, GearPair, Sense};
use integrate::{Course, EvenRows, Method, MotionError, Row, Scheme, StepControl};
use lumped::{
    Fourier, HistoryRow, LumpedModel, LumpedPair, MeshCycle, Operation,
    lumped8::{Lumped8, MeshLaw, Motion8, Support8},
    starting_state,
};

fn main() -> Result<(), Box<dyn Error>> {
    let pinion = GearData { helix_angle: 10f64.to_radians(), ..GearData::default() };
    let wheel = GearData { teeth: 45, helix_angle: -pinion.helix_angle, ..pinion.clone() };
    let gears = GearPair::new(Gear::new(pinion)?, Gear::new(wheel)?, None)?;
    // Discs of 1 and 2.2 kg; t, mm, N, s inside.
    let bodies = [(1.0e-3, gears.pinion.base_radius()), (2.2e-3, gears.wheel.base_radius())].map(|(mass, radius)| {
        let disc = 0.5 * mass * radius * radius;
        RigidBody { mass, transverse_inertia: 0.5 * disc, polar_inertia: disc }
    });
    // 300 N/um on the line of action, 30 % of it to either side with the teeth.
    let cycle = MeshCycle::new(Fourier::first_order(3.0e5, 9.0e4, 0.0), Fourier::default());
    let support = Support8 { stiffness: [2e5; 3], damping: [0.5; 3], ..Support8::default() };

    println!("{:>10} {:>14} {:>14} {:>14} {:>12}", "1/min", "mesh, Hz", "least force, N", "largest, N", "DTE p-p, um");
    for speed_rpm in [2000.0, 6000.0, 10_000.0, 12_000.0, 14_000.0, 18_000.0] {
        let operation = Operation {
            driver: Driver::Pinion,
            sense: Sense::Ccw,
            speed: speed_rpm * TAU / 60.0,
            torque: 10e3,
            friction: 0.05,
        };
        let pair = LumpedPair::new(&gears, &operation, bodies, cycle.clone())?;
        let mut motion = Lumped8::new(pair, [support; 2], 0.02, 0.01, MeshLaw::Normal)?.motion()?;
        let rows = rows(&mut motion)?;
        let range = |of: fn(&HistoryRow) -> f64| {
            rows.iter().map(of).fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
        };
        let ([least, largest], [low, high]) = (range(|r| r.normal_force), range(|r| 1e3 * r.transmission_error));
        // Damping acts between parted flanks too, so the least force may be a little below zero.
        let remark = if least <= 0.0 { "flanks lose contact" } else { "" };
        println!(
            "{speed_rpm:>10} {:>14.0} {least:>14.1} {largest:>14.1} {:>12.2}  {remark}",
            30.0 * speed_rpm / 60.0,
            high - low
        );
    }
    Ok(())
}

/// Twenty mesh cycles of 64 rows, each a step, after two hundred in which the motion settles.
fn rows(motion: &mut Motion8) -> Result<Vec<HistoryRow>, MotionError<Infallible>> {
    let period = 1.0 / motion.pair().clock.mesh_frequency();
    let scheme = Scheme::GeneralisedAlpha { rho: 0.9 };
    let method = Method { scheme, scale: motion.scale(), stop_at_events: false, keep_stable: false };
    let (first, spacing) = (200.0 * period, period / 64.0);
    let times = EvenRows { method, control: StepControl::Fixed(spacing), first, spacing, rows: 20 * 64 };
    let start = starting_state(motion);
    let mut course = Course::new(motion, times, start);
    course.run_cycle::<MotionError<Infallible>>(None)?;
    let mut rows = Vec::new();
    course.run_cycle(Some(&mut |Row { system, state, .. }: Row<'_, &mut Motion8>| {
        rows.push(system.row(state.time, &state.q, &state.v));
        Ok::<_, MotionError<Infallible>>(())
    }))?;
    Ok(rows)
}
