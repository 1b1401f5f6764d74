//! Contact alone: two reduced gears stand where they are told, and the wheel is turned into the pinion step by step;
//! once with slices, once with points.
//!
//! `cargo run --release -p contact --example given_poses`
#![allow(clippy::print_stdout, reason = "an example prints")]

use std::error::Error;

use ale::{SlidingWindow, Station, teeth_needed};
use contact::{ContactOptions, ContactSet, Method, WindowContact, pose::frames};
use fem::{ElementOptions, Material};
use geometry::{Gear, GearData, GearPair};
use mesh::{Extent, GroupNames, MeshedGear, StructuredOptions, generate};
use reduction::{ElasticGear, GearReducer, ReductionOptions};

fn main() -> Result<(), Box<dyn Error>> {
    let pinion = GearData::default();
    let wheel = GearData { helix_angle: -pinion.helix_angle, ..pinion.clone() };
    let pair = GearPair::new(Gear::new(pinion)?, Gear::new(wheel)?, None)?;
    let options = ContactOptions::new(&pair);
    let teeth = [pair.pinion.teeth(), pair.wheel.teeth()];
    let count = teeth_needed(pair.total_contact_ratio());
    let sliding = SlidingWindow::at_start(count, teeth, options.sense)?;
    let window = sliding.window();
    let reduce = |gear: &Gear, first: u32| -> Result<ElasticGear, Box<dyn Error>> {
        let sector = StructuredOptions { extent: Extent::Periodic, ..StructuredOptions::default() };
        let mesh = MeshedGear::from_groups(generate(gear, &sector)?, &GroupNames::default(), gear.teeth())?;
        let kept =
            ReductionOptions { sides: options.sides(), window: count, first, elements: ElementOptions::default() };
        Ok(ElasticGear::Reduced(GearReducer::new(mesh, Material::STEEL, kept)?))
    };
    let [first, second] = window.first_teeth();
    let gears = [reduce(&pair.pinion, first)?, reduce(&pair.wheel, second)?];

    println!("{:>8} {:>12} {:>12} {:>14} {:>16}", "", "approach", "force [N]", "tilting [N mm]", "stiffness [N/um]");
    let station = Station { cycle: 0, phase: 0.25 };
    for method in [Method::Slice, Method::Nodal] {
        let options = ContactOptions { method, ..options.clone() };
        let set = ContactSet::new(&pair, &gears, window, &options)?;
        let mut contact = WindowContact::new(&pair, set.clone(), &options)?;
        for step in 0..5 {
            let approach_mm = 5e-3 * f64::from(step);
            let turn = options.side().sign() * approach_mm / pair.wheel.base_radius();
            let poses = frames(&pair, &set, window, &options, station, [0.0, turn]);
            let force = contact.evaluate(&pair, &gears, &options, &poses)?;
            let (total, tilting): (f64, f64) = (force.pair_forces.iter().sum(), force.wrench[0].moment[1]);
            // Stiffness about the wheel's axis, on its base circle.
            let stiffness = -1e-3 * force.tangent[11][11] / pair.wheel.base_radius().powi(2);
            println!("{method:?} {approach_mm:>12.3} mm {total:>12.1} {tilting:>14.0} {stiffness:>16.2}");
        }
    }
    Ok(())
}
