//! Harris map: peak-to-peak STE over torque and tip relief.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]
//!
//! Source: S. L. Harris, Dynamic loads on the teeth of spur gears, Proc. IMechE 172 (1958): every relief has a load at
//! which STE is flattest, and is worse than none far below it.

use std::sync::Arc;

use geometry::{
    FlankModification, GearModifications, GearPair,
    modification::{ProfilePlace, Relief, ReliefShape},
};
use ltca::{StaticModel, StaticOptions};
use mesh::Extent;
use testing::{default_data, mean_and_peak_to_peak, modified, quadratic};

const TORQUES_NM: [f64; 5] = [15.0, 75.0, 150.0, 225.0, 300.0];
const RELIEFS_UM: [f64; 5] = [0.0, 10.0, 20.0, 30.0, 40.0];

/// Long relief of both tips: it starts where a second pair comes in.
fn relieved(pair: &GearPair, amount_um: f64) -> GearPair {
    let [start, end] = pair.path_of_contact();
    let pitch = pair.transverse_base_pitch();
    // From the end of single contact to the tip, on either gear.
    let (last, first) = (start + pitch, end - pitch);
    let rolls = [last / pair.pinion.base_radius(), (pair.tangent_length() - first) / pair.wheel.base_radius()];
    let of = |roll: f64| {
        let relief = Relief { amount: 1e-3 * amount_um, start: ProfilePlace::Roll(roll), shape: ReliefShape::Linear };
        GearModifications::both(FlankModification { tip_relief: Some(relief), ..Default::default() })
    };
    modified(pair, rolls.map(of))
}

#[test]
fn relief_flattens_ste_at_its_own_load() {
    let case = quadratic(default_data(0.0), None, 150e3, [3, 2, 2, 3, 1], Extent::Sector(5));
    let mut gears = Arc::new(case.reduced_gears(&case.slice_options()));
    let mut map = [[0.0; 5]; 5];
    for (r, amount) in RELIEFS_UM.iter().enumerate() {
        for (t, torque) in TORQUES_NM.iter().enumerate() {
            let options = StaticOptions { torque: 1e3 * torque, ..case.slice_options() };
            let pair = if *amount == 0.0 { case.pair.clone() } else { relieved(&case.pair, *amount) };
            let mut model = StaticModel::new(pair, gears, options).unwrap();
            let history = model.run(16, 1, |_, _, _| ()).unwrap_or_else(|e| panic!("{amount} um, {torque} N m: {e}"));
            map[r][t] = mean_and_peak_to_peak(history.positions.iter().map(|p| 1e3 * p.transmission_error)).1;
            gears = model.into_gears();
        }
    }
    println!("peak-to-peak STE, um; relief down, torque {TORQUES_NM:?} N m across");
    for (amount, row) in RELIEFS_UM.iter().zip(&map) {
        println!("{amount:>5} um: {row:>8.3?}");
    }
    // Design load of a relief: where its own p-p is least, among the torques.
    let plain = map[0];
    let best = |row: &[f64; 5]| (0..5).min_by(|&a, &b| row[a].total_cmp(&row[b])).unwrap();
    let mut last = 0;
    for (amount, row) in RELIEFS_UM.iter().zip(&map).skip(1) {
        let design = best(row);
        println!(
            "{amount} um: least at {} N m, {:.3} um where none has {:.3}",
            TORQUES_NM[design], row[design], plain[design]
        );
        assert!(design >= last, "{amount} um: design load falls with more relief");
        last = design;
    }
    let design = best(&map[2]);
    assert!(
        map[2][design] < 0.7 * plain[design],
        "20 um at its design load: {} um, without {}",
        map[2][design],
        plain[design]
    );
    assert!(map[2][0] > 1.5 * plain[0], "20 um far below: {} um, without {}", map[2][0], plain[0]);
}
