//! Natural frequencies beside another program's.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use gearbox::{Assembly, Rotors};

use crate::rotors::{friswell, overhung};

/// Ten frequencies of two rotors at three speeds are those in `tests/data/ross.csv`, which says where they come from and
/// why to a millionth.
#[test]
fn ten_frequencies_of_two_rotors_are_those_of_ross() {
    const TOLERANCE: f64 = 1e-6;
    let table = include_str!("../data/ross.csv");
    let rows: Vec<(&str, f64, usize, f64)> = table
        .lines()
        .skip_while(|line| !line.starts_with("rotor,"))
        .skip(1)
        .map(|line| {
            let cells: Vec<&str> = line.split(',').collect();
            (cells[0], cells[1].parse().unwrap(), cells[2].parse().unwrap(), cells[3].parse().unwrap())
        })
        .collect();
    assert_eq!(rows.len(), 60, "two rotors, three speeds, ten modes");
    let mut worst = 0.0f64;
    for (name, structure) in [("friswell", friswell()), ("overhung", overhung())] {
        let rotors = Rotors::new(Assembly::new(structure).unwrap()).unwrap();
        for speed in [0.0, 400.0, 1000.0] {
            let found = rotors.whirl_modes(&[speed]).unwrap();
            for &(_, _, mode, wanted) in rows.iter().filter(|r| r.0 == name && r.1 == speed) {
                let frequency = found.modes[mode].frequency;
                let off = frequency / wanted - 1.0;
                assert!(off.abs() < TOLERANCE, "{name}, {speed} rad/s, mode {mode}: {frequency} beside {wanted} rad/s");
                worst = worst.max(off.abs());
            }
        }
    }
    println!("worst difference of 60 frequencies {worst:.1e}");
    assert!(worst > 0.0, "another program cannot have the same bits");
}
