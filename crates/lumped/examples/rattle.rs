//! A pair with backlash, eight coordinates, at some speeds: where do its flanks lose contact?
//!
//! `cargo run -p lumped --example rattle`
#![allow(clippy::print_stdout, reason = "an example prints")]

use std::{error::Error, f64::consts::TAU};

use dynamics::RigidBody;
use geometry::{Driver, Gear, GearData, GearPair, Sense};
use integrate::Scheme;
use lumped::{
    Fourier, LumpedPair, MeshCycle, Operation, RunPlan,
    lumped8::{Lumped8, MeshLaw, Support8},
    run,
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
        let plan = RunPlan {
            scheme: Scheme::GeneralisedAlpha { rho: 0.9 },
            rows_per_cycle: 64,
            steps_per_row: 1,
            settling_cycles: 200,
            cycles: 20,
        };
        let rows = run(&mut motion, &plan, None)?.rows;
        let range = |of: fn(&lumped::HistoryRow) -> f64| {
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
