//! Laws of loads that change with time: their work is accounted for, and constant ones are what they were.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::f64::consts::TAU;

use gearbox::{
    GearboxError,
    motion::{Drive, GearboxInstant, GearboxRun, MotionPlan, Speed, TorqueOverTime as Torque},
};
use geometry::Sense;
use integrate::Scheme;

use crate::motion::train;

/// Load of the train, N mm.
const LOAD: f64 = 4e5;
const SPEED: f64 = 100.0;
/// Cycles of the first mesh, 17 a turn of the input, in rows of one step.
const CYCLES: u64 = 30;
const DURATION: f64 = CYCLES as f64 / 17.0 * TAU / SPEED;

/// A load against the output's turn that pulses, and one that becomes a drive and goes away again.
fn loads() -> [Torque; 2] {
    let pulsing = Torque::Harmonic { mean: LOAD, amplitude: 0.4 * LOAD, frequency_hz: 83.0, phase: 0.7 };
    let times = [0.2, 0.4, 0.6, 0.8].map(|part| part * DURATION).to_vec();
    [pulsing, Torque::Table { times, values: vec![LOAD, -0.3 * LOAD, -0.3 * LOAD, 0.8 * LOAD] }]
}

fn plan() -> MotionPlan {
    crate::motion::steps(Scheme::Energy, [CYCLES, 60])
}

fn run(drive: Drive, sense: Sense, load: Option<&Torque>) -> (Vec<GearboxInstant>, GearboxRun) {
    driven(drive, sense, [load, None])
}

/// Motion under a load over time, and under a torque over time on the input.
fn driven(drive: Drive, sense: Sense, [load, input]: [Option<&Torque>; 2]) -> (Vec<GearboxInstant>, GearboxRun) {
    let mut mechanism = train(drive, sense, 0.004);
    if let Some(load) = load {
        // The output turns as the input does: two meshes.
        let own = load.clone().scaled(-f64::from(sense.sign() as i32));
        mechanism = mechanism.with_torques(vec![(0, own)]).unwrap();
    }
    if let Some(input) = input {
        mechanism = mechanism.with_input_torque(input.clone().scaled(sense.sign() as f64)).unwrap();
    }
    let start = mechanism.start(0.01).unwrap();
    let mut rows = Vec::new();
    let done = mechanism.run(&start, &plan(), |row| rows.push(row.clone())).unwrap();
    (rows, done)
}

/// Work of a power over all rows by trapezoids, N mm.
fn work(rows: &[GearboxInstant], power: impl Fn(&GearboxInstant) -> f64) -> f64 {
    rows.windows(2).map(|w| 0.5 * (power(&w[0]) + power(&w[1])) * (w[1].time - w[0].time)).sum()
}

const DRIVES: [(Drive, Sense); 4] = [
    (Drive::Speed(Speed::Constant(SPEED)), Sense::Cw),
    (Drive::Speed(Speed::Ramp { from: 0.6 * SPEED, to: 1.4 * SPEED, start: 0.0, duration: DURATION }), Sense::Ccw),
    (Drive::Torque { start: SPEED, torque: None }, Sense::Ccw),
    (Drive::Balanced(Speed::Constant(SPEED)), Sense::Ccw),
];

/// Input, outputs, what is stored and what dampers take add up to nothing at given speed, up a ramp, under a given torque and
/// under one that balances;
/// and the work of the load and of the input are those of their torques at every instant.
#[test]
fn energy_under_loads_over_time_is_accounted_for() {
    for (drive, sense) in DRIVES {
        for load in loads() {
            let (rows, done) = run(drive, sense, Some(&load));
            let energy = done.energy;
            let said = format!("{drive:?}, {load:?}: {energy:?}");
            assert!(energy.relative_residual.abs() < 1e-9, "{said}");
            let turned = |row: &GearboxInstant| row.output_speeds[0] * f64::from(sense.sign() as i32);
            let of_load = work(&rows, |row| -load.at(row.time) * turned(row));
            let of_input = work(&rows, |row| row.input_torque * row.input[1]);
            let size = work(&rows, |row| (load.at(row.time) * turned(row)).abs());
            let [load, input] = [of_load - energy.output_work, of_input - energy.input_work].map(|off| off / size);
            println!("{drive:?}: left {:.1e}, load off by {load:.1e}, input by {input:.1e}", energy.relative_residual);
            assert!(load.abs() < 2e-3 && input.abs() < 2e-3, "off by {load:e} and {input:e}, {said}");
        }
    }
}

/// Torque on the input that balances the load, N mm: two stages of 17 to 53 and 19 to 47 teeth.
fn balancing() -> f64 {
    let (rows, _) = run(Drive::Torque { start: SPEED, torque: None }, Sense::Cw, None);
    rows[0].input_torque.abs()
}

/// A torque on the input that pulses, and one that brakes for a while, beside loads that are constant or change as well: it is
/// the given one at every instant, its work and that of the load are those of their torques, and nothing is left over.
#[test]
fn energy_under_an_input_over_time_is_accounted_for() {
    let mean = balancing();
    let own = loads().map(|load| load.scaled(mean / LOAD));
    let [pulsing, _] = loads();
    for (torque, load) in own.iter().zip([None, Some(&pulsing)]) {
        for sense in [Sense::Cw, Sense::Ccw] {
            let (rows, done) = driven(Drive::Torque { start: SPEED, torque: None }, sense, [load, Some(torque)]);
            let (energy, sign) = (done.energy, f64::from(sense.sign() as i32));
            let said = format!("{torque:?}, {load:?}: {energy:?}");
            assert!(energy.relative_residual.abs() < 1e-9, "{said}");
            let given = |row: &GearboxInstant| sign * torque.at(row.time);
            assert!(rows.iter().all(|row| (row.input_torque - given(row)).abs() < 1e-12 * mean), "{said}");
            let of_input = work(&rows, |row| given(row) * row.input[1]);
            let constant = Torque::Constant(LOAD);
            let of_load = work(&rows, |row| -load.unwrap_or(&constant).at(row.time) * sign * row.output_speeds[0]);
            let size = work(&rows, |row| (given(row) * row.input[1]).abs());
            let [input, load] = [of_input - energy.input_work, of_load - energy.output_work].map(|off| off / size);
            println!("left {:.1e}, input off by {input:.1e}, load by {load:.1e}", energy.relative_residual);
            assert!(load.abs() < 2e-3 && input.abs() < 2e-3, "off by {load:e} and {input:e}, {said}");
        }
    }
}

/// A torque on the input that is the same at all times is the constant one; one on an input whose speed is given is refused.
#[test]
fn an_input_over_time_that_does_not_change_is_constant() {
    let drive = Drive::Torque { start: SPEED, torque: None };
    let (constant, known) = run(drive, Sense::Ccw, None);
    let table = Torque::Table { times: vec![0.0, 1.0], values: vec![constant[0].input_torque; 2] };
    let (rows, done) = driven(drive, Sense::Ccw, [None, Some(&table)]);
    let off = rows.iter().zip(&constant).map(|(a, b)| (a.input[1] - b.input[1]).abs()).fold(0.0, f64::max);
    assert!(off < 1e-10 * SPEED, "speeds are {off:e} rad/s apart");
    for (own, wanted) in [(done.energy.input_work, known.energy.input_work), (done.energy.gained, known.energy.gained)]
    {
        assert!((own - wanted).abs() < 1e-8 * known.energy.input_work.abs(), "{own} N mm, constant {wanted} N mm");
    }
    for drive in [Drive::Speed(Speed::Constant(SPEED)), Drive::Balanced(Speed::Constant(SPEED))] {
        let refused = train(drive, Sense::Ccw, 0.0).with_input_torque(table.clone());
        assert!(refused.is_err_and(|e| e == GearboxError::GivenSpeed && e.hint().is_some()));
    }
}

/// A load that is the same at all times is the constant one.
#[test]
fn a_load_over_time_that_does_not_change_is_constant() {
    for (drive, sense) in DRIVES {
        let (constant, known) = run(drive, sense, None);
        let table = Torque::Table { times: vec![0.0, 1.0], values: vec![LOAD; 2] };
        let (rows, done) = run(drive, sense, Some(&table));
        let te = |rows: &[GearboxInstant]| rows.iter().map(|row| row.meshes[1].transmission_error).collect::<Vec<_>>();
        let (a, b) = (te(&rows), te(&constant));
        let off = a.iter().zip(&b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(off < 1e-8 * b[0].abs(), "{drive:?}: off by {off:e} mm of {} mm", b[0]);
        let own = [done.energy.input_work, done.energy.output_work];
        let wanted = [known.energy.input_work, known.energy.output_work];
        for (own, wanted) in own.into_iter().zip(wanted) {
            assert!((own - wanted).abs() < 1e-8 * wanted.abs(), "{drive:?}: {own} N mm, constant {wanted} N mm");
        }
    }
}

/// A checkpoint has the work of the loads so far: the motion goes on to the same bits. A load that the gearbox does not have
/// is refused.
#[test]
fn work_of_loads_is_in_checkpoints() {
    let [load, _] = loads();
    let made = || {
        let mechanism = train(DRIVES[0].0, Sense::Ccw, 0.0).with_torques(vec![(0, load.clone().scaled(-1.0))]).unwrap();
        (plan(), mechanism)
    };
    let (plan, mut whole) = made();
    let start = whole.start(0.01).unwrap();
    let mut course = whole.course(&start, &plan, None).unwrap();
    course.run_cycle::<GearboxError>(None).unwrap();
    let text = serde_json::to_string(&course.checkpoint().unwrap()).unwrap();
    course.run_cycle::<GearboxError>(None).unwrap();
    let wanted = GearboxRun::of(course, &start).unwrap();
    let (_, mut again) = made();
    let same = again.start(0.01).unwrap();
    let mut course = again.course(&same, &plan, Some(serde_json::from_str(&text).unwrap())).unwrap();
    course.run_cycle::<GearboxError>(None).unwrap();
    let found = GearboxRun::of(course, &same).unwrap();
    assert_eq!((found.energy, found.states), (wanted.energy, wanted.states));
    let other = train(DRIVES[0].0, Sense::Ccw, 0.0).with_torques(vec![(1, load)]);
    let refused = GearboxError::Count { what: "torques", found: 2, wanted: 1 };
    assert!(other.is_err_and(|e| e == refused), "a load that is not there");
}
