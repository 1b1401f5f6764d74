//! Laws of the course of a gearbox's motion: settling over a common period of all meshes, steps by an error, events,
//! checkpoints before and among the rows.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::f64::consts::TAU;

use gearbox::{
    Disc, GearMesh, GearboxError, Torque,
    motion::{
        Drive, Extremes, GearboxCheckpoint, GearboxInstant, GearboxMechanism, GearboxRun, MeshMemory, MotionOptions,
        MotionPlan, MovingExactMesh, Speed, SpringMesh,
    },
};
use geometry::Sense;
use integrate::{Follower, MotionError, Row, Scheme, Settle, Timetable};

use crate::{
    motion::{stiffness, train},
    pairs::{operation, options, pair, reduced, single},
};

const SPEED: Drive = Drive::Speed(Speed::Constant(100.0));
/// Of two stages with 17 on 53 and 19 on 47 teeth, in cycles of the first mesh.
const COMMON: u64 = 53;

fn plan(cycles: u64) -> MotionPlan {
    MotionPlan { steps_per_row: 4, ..crate::motion::steps(Scheme::GeneralisedAlpha { rho: 0.8 }, [cycles, 24]) }
}

fn run(drive: Drive, change: impl Fn(&mut MotionPlan), cycles: u64) -> (Vec<GearboxInstant>, GearboxRun) {
    let mut mechanism = train(drive, Sense::Ccw, 0.0);
    let start = mechanism.start(0.05).unwrap();
    let mut plan = plan(cycles);
    change(&mut plan);
    let mut rows = Vec::new();
    let done = mechanism.run(&start, &plan, |instant| rows.push(instant.clone())).unwrap();
    (rows, done)
}

/// Transmission errors of both meshes, mm.
fn errors(rows: &[GearboxInstant]) -> Vec<[f64; 2]> {
    rows.iter().map(|row| [0, 1].map(|i| row.meshes[i].transmission_error)).collect()
}

fn apart(a: &[[f64; 2]], b: &[[f64; 2]]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).flat_map(|(a, b)| [0, 1].map(|i| (a[i] - b[i]).abs())).fold(0.0, f64::max)
}

fn peak_to_peak(of: &[[f64; 2]], mesh: usize) -> f64 {
    let ends = of.iter().map(|x| x[mesh]).fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| [a.min(x), b.max(x)]);
    ends[1] - ends[0]
}

/// A train knows the steps that explicit methods bear: with steps just within the limit none is divided, beyond it some are,
/// and having asked changes no bit of the motion.
#[test]
fn a_train_knows_the_steps_that_explicit_methods_bear() {
    for scheme in [Scheme::RungeKutta4, Scheme::DormandPrince] {
        let mut mechanism = train(SPEED, Sense::Ccw, 0.0);
        let start = mechanism.start(0.05).unwrap();
        let limit = mechanism.stable_step(scheme).unwrap().unwrap();
        let period = mechanism.time_of_cycles(1.0).unwrap();
        let at_limit = period / limit.step;
        let moved = |share: f64| {
            let steps = (at_limit / share / 4.0).round().max(1.0) as u64 * 4;
            run(SPEED, |plan| (plan.scheme, plan.steps_per_cycle) = (scheme, steps), 4)
        };
        let [within, beyond] = [0.95, 1.3].map(|share| moved(share).1.divided);
        println!("{scheme:?}: {at_limit:.2} steps a cycle at the limit; {within} divided within, {beyond} beyond");
        assert!(within == 0 && beyond > 0, "{scheme:?}: {within} steps divided within the limit, {beyond} beyond");
        let plan = MotionPlan { scheme, steps_per_cycle: (at_limit / 0.95 / 4.0).round() as u64 * 4, ..plan(4) };
        let mut rows = Vec::new();
        mechanism.run(&start, &plan, |instant| rows.push(instant.clone())).unwrap();
        assert!(errors(&rows) == errors(&moved(0.95).0), "{scheme:?}: bits of the motion go with having asked");
    }
    let mut mechanism = train(SPEED, Sense::Ccw, 0.0);
    mechanism.start(0.05).unwrap();
    assert_eq!(mechanism.stable_step(Scheme::Energy).unwrap(), None);
}

/// A settled train of two stages comes back after the common period of its meshes; after a cycle of the first mesh alone it
/// does not, and from the equilibrium on it has not settled.
#[test]
fn a_settled_gearbox_comes_back_after_a_common_period() {
    let per_cycle = 6;
    let common = COMMON as usize * per_cycle;
    let settle = Settle { tolerance: 1e-7, most: 60 * COMMON };
    let (rows, done) = run(SPEED, |plan| plan.settle = Some(settle), 2 * COMMON);
    let found = done.periodicity.unwrap();
    assert!(done.warm_up > COMMON && done.warm_up.is_multiple_of(COMMON), "{} cycles waited", done.warm_up);
    assert!(found.residual <= 1e-6 && found.period as u64 == COMMON, "{found:?} after {}", done.warm_up);
    assert_eq!(rows.len(), 2 * common + 1, "the state to which it has settled is a row");
    let of = errors(&rows);
    let size = peak_to_peak(&of, 0).min(peak_to_peak(&of, 1));
    let back = apart(&of[..common], &of[common..2 * common]) / size;
    assert!(back < 1e-5, "a common period changes {back:e} of the peak to peak");
    let cycle = apart(&of[..common], &of[per_cycle..common + per_cycle]) / size;
    assert!(cycle > 1e-2, "a cycle of the first mesh changes {cycle:e} only: the law says nothing");
    let (at_once, done) = run(SPEED, |_| (), 2 * COMMON);
    assert_eq!((done.warm_up, done.periodicity), (0, None));
    let of = errors(&at_once);
    let from_rest = apart(&of[..common], &of[common..2 * common]) / size;
    assert!(from_rest > 1e3 * back, "settled from the start: {from_rest:e} beside {back:e}");
}

/// Where teeth of a gear differ, a motion comes back after a turn of this gear, and not after a mesh cycle.
#[test]
fn teeth_that_differ_come_back_after_a_turn() {
    let teeth = [(0..23).map(|i| 1e-3 * f64::from(i * 7 % 5)).collect(), Vec::new()];
    let mut mechanism = crate::motion_branch::one_stage(5e4, teeth);
    let start = mechanism.start(0.05).unwrap();
    let settle = Some(Settle { tolerance: 1e-7, most: 60 * 23 });
    let plan = MotionPlan { settle, ..plan(2 * 23) };
    let mut rows = Vec::new();
    let done = mechanism.run(&start, &plan, |instant| rows.push(instant.meshes[0].transmission_error)).unwrap();
    let found = done.periodicity.unwrap();
    assert!(found.residual <= 1e-7 && found.period == 23, "{found:?} after {}", done.warm_up);
    let (per_cycle, turn) = (6, 6 * 23);
    let ends = rows.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| [a.min(*x), b.max(*x)]);
    let after = |n: usize| (0..turn).map(|i| (rows[i + n] - rows[i]).abs()).fold(0.0, f64::max) / (ends[1] - ends[0]);
    let [turned, cycle] = [turn, per_cycle].map(after);
    println!("after a turn {turned:.1e} of the peak to peak, after a cycle {cycle:.1e}");
    assert!(turned < 1e-6 && cycle > 0.1, "after a turn {turned:e}, after a cycle {cycle:e}");
}

/// Newton's method on the period leads to the motion that waiting leads to, long before it where little damps: on a spring,
/// and on the flanks themselves, whose windows go back to where the period began.
///
/// On the spring by `newmark`, of which the tangent flow is the exact derivative: from 4 % of the peak to peak one step leads
/// to 1e-10. By `energy` both ways end in the round-off of its discrete gradient, which repeats itself to no better than some
/// 1e-7. Waiting leaves its tolerance over 1 less the slowest multiplier, 0.978.
#[test]
fn a_gearbox_shoots_to_where_it_would_settle() {
    let left = 1e-9 / (1.0 - 0.978);
    for is_exact in [false, true] {
        let of = |shoots: bool| {
            let mut mechanism = one_stage(is_exact);
            let start = mechanism.start(0.004).unwrap();
            let (scheme, tolerance, most) =
                if is_exact { (Scheme::Energy, 1e-5, 60) } else { (Scheme::Newmark, 1e-9, 2000) };
            let settle = Some(Settle { tolerance, most });
            let plan = plan(2);
            let plan = MotionPlan { scheme, steps_per_cycle: 48, settle, shoots, ..plan };
            let mut rows = Vec::new();
            let done = mechanism.run(&start, &plan, |instant| rows.push(instant.meshes[0].transmission_error)).unwrap();
            (rows, done)
        };
        let (near, by_newton) = of(true);
        let residual = by_newton.periodicity.unwrap().residual;
        println!("settled after {} cycles to {residual:.1e}", by_newton.warm_up);
        assert!(residual <= if is_exact { 1e-5 } else { 1e-9 }, "{residual:e}");
        assert!(by_newton.warm_up < 40, "{} cycles", by_newton.warm_up);
        if is_exact {
            continue;
        }
        let (far, by_waiting) = of(false);
        println!("by waiting after {} cycles", by_waiting.warm_up);
        assert!(4 * by_newton.warm_up < by_waiting.warm_up, "{} of {}", by_newton.warm_up, by_waiting.warm_up);
        let ends = far.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| [a.min(*x), b.max(*x)]);
        let off = near.iter().zip(&far).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / (ends[1] - ends[0]);
        println!("off by {off:.1e} of the peak to peak, waiting leaves {left:.1e}");
        assert!(off < 10.0 * left, "another motion, by {off:e} of the peak to peak");
    }
}

/// A pair on shafts that bend, with little damping.
fn one_stage(is_exact: bool) -> GearboxMechanism {
    let gears = pair([23, 31], 12.0);
    let mut structure = single(&gears, 0.3);
    for (i, outer) in [66.0, 90.0].into_iter().enumerate() {
        let d = &structure.discs[i];
        structure.discs[i] = Disc::ring(d.name.clone(), d.shaft, d.position, [outer, 30.0], 20.0, 7.85e-9);
    }
    let operation = operation(&structure, 2, Sense::Ccw, vec![Torque { disc: 3, torque: 1.5e5 }]);
    let meshes = vec![GearMesh { name: "pair".into(), discs: [0, 1], pair: gears }];
    let asked = MotionOptions { drive: SPEED, modal_damping: 0.0, limit: TAU * 2000.0 };
    GearboxMechanism::new(structure, meshes, operation, &asked, |_, mesh, meshing| {
        if !is_exact {
            return Ok(Box::new(SpringMesh::new(mesh, meshing, stiffness())?.with_damping(0.2)));
        }
        let options = options(&mesh.pair, meshing, 1.5e5);
        let gears = reduced(&mesh.pair, &options);
        Ok(Box::new(MovingExactMesh::new(mesh.pair.clone(), gears, None, &options, 0.01)?))
    })
    .unwrap()
}

/// A motion that may not wait for a common period is refused with its length.
#[test]
fn a_wait_that_is_too_short_is_refused() {
    let mut mechanism = train(SPEED, Sense::Ccw, 0.0);
    let start = mechanism.start(0.05).unwrap();
    let settle = Some(Settle { tolerance: 1e-3, most: COMMON - 1 });
    let plan = MotionPlan { settle, ..plan(1) };
    let error = mechanism.run(&start, &plan, |_| ()).unwrap_err();
    assert_eq!(error, GearboxError::NoCommonPeriod { period: Some(COMMON), most: COMMON - 1 });
    assert!(
        error.to_string().contains("after 53 cycles") && error.hint().unwrap().contains("warm_up_cycles"),
        "{error}"
    );
}

/// Steps by an error tolerance lead to the motion that fine steps have, the nearer the tighter it is; and take fewer steps
/// than these.
#[test]
fn steps_by_an_error_find_the_motion() {
    let fine = |plan: &mut MotionPlan| {
        plan.steps_per_cycle *= 32;
        plan.steps_per_row *= 32;
    };
    let (reference, finest) = run(SPEED, fine, 12);
    let reference = errors(&reference);
    let size = peak_to_peak(&reference, 0);
    let off = |tolerance: f64| {
        let (rows, done) = run(SPEED, |plan| plan.tolerance = Some(tolerance), 12);
        assert!(done.steps < finest.steps, "{} steps for {tolerance:e}", done.steps);
        (apart(&errors(&rows), &reference) / size, done.steps)
    };
    let (coarse, tight) = (off(1e-2), off(1e-5));
    assert!(tight.1 > coarse.1, "{coarse:?} {tight:?}");
    assert!(tight.0 < 0.01 && tight.0 < 0.5 * coarse.0, "off by {:e} and {:e} of the peak to peak", tight.0, coarse.0);
}

/// Where flanks come apart, steps that end there are counted beside those that the rows ask for, and the flanks part as
/// often as without them.
#[test]
fn steps_end_where_flanks_come_apart() {
    // A tooth that stands out by a tenth of a millimetre takes the flanks apart.
    let of = |stop_at_events: bool| {
        let mut mechanism = train(Drive::Speed(Speed::Constant(420.0)), Sense::Ccw, 0.1);
        let start = mechanism.start(0.002).unwrap();
        let plan = MotionPlan { stop_at_events, ..plan(60) };
        mechanism.run(&start, &plan, |_| ()).unwrap()
    };
    let [through, stopping] = [false, true].map(of);
    let lost = |run: &GearboxRun| run.flanks.iter().map(|own| own.contact_losses + own.coast_contacts).sum::<u64>();
    assert!(lost(&through) > 2, "the flanks stay in contact: {:?}", through.flanks);
    assert_eq!(through.steps, 60 * 24);
    // Each loss, and each contact that comes back.
    assert!(stopping.steps >= 60 * 24 + lost(&stopping), "{} steps, {:?}", stopping.steps, stopping.flanks);
    let [a, b] = [lost(&through), lost(&stopping)];
    assert!(a.abs_diff(b) <= 2 + a / 2, "parts {a} times, {b} times with steps that end there");
}

/// Rows of a run-up are turns that are alike; steps between them are no longer than a tenth beyond their mean, from standstill
/// on as well.
#[test]
fn a_run_up_from_standstill_has_short_steps() {
    let drive = Drive::Speed(Speed::Ramp { from: 0.0, to: 100.0, start: 0.0, duration: 0.05 });
    let mut mechanism = train(drive, Sense::Ccw, 0.0);
    let start = mechanism.start(0.05).unwrap();
    let times = plan(3).times(mechanism.scale(&start));
    let mut begin = 0.0;
    for cycle in 0..3 {
        let own = times.cycle(&mechanism, cycle, begin).unwrap();
        let ends: Vec<f64> = std::iter::once(begin).chain(own.stops.iter().map(|stop| stop.time)).collect();
        let mean = (ends[ends.len() - 1] - begin) / 24.0;
        let longest = ends.windows(2).map(|two| two[1] - two[0]).fold(0.0, f64::max);
        assert!(longest <= 1.1 * mean && ends.len() <= 40, "{longest} s beside {mean} s, {} steps", ends.len() - 1);
        let rows: Vec<f64> = own.stops.iter().filter(|stop| stop.is_row).map(|stop| stop.time).collect();
        let of_row = |k: usize| mechanism.time_of_cycles(cycle as f64 + (k + 1) as f64 / 6.0).unwrap();
        assert!(rows.len() == 6 && (0..6).all(|k| (rows[k] - of_row(k)).abs() < 1e-12), "{rows:?}");
        begin = ends[ends.len() - 1];
    }
}

/// Checkpoints with as many rows as there were.
#[derive(Default)]
struct Kept {
    rows: Vec<GearboxInstant>,
    states: Vec<(usize, GearboxCheckpoint)>,
}

impl Follower<&mut GearboxMechanism> for Kept {
    type Error = GearboxError;

    fn row(&mut self, row: Row<'_, &mut GearboxMechanism>) -> Result<(), GearboxError> {
        self.rows.push(row.system.instant(row.state)?);
        Ok(())
    }

    fn checkpoint(&mut self, state: GearboxCheckpoint) -> Result<(), GearboxError> {
        self.states.push((self.rows.len(), state));
        Ok(())
    }
}

/// From any checkpoint, out of its text, the motion goes on to the same bits: settling and with rows, by equal steps, by
/// an error, with steps that end at events.
#[test]
fn a_gearbox_taken_up_again_goes_the_same_way() {
    for (tolerance, stop_at_events) in [(None, false), (None, true), (Some(1e-4), true)] {
        let follow = |from: Option<GearboxCheckpoint>| {
            let mut mechanism = train(SPEED, Sense::Ccw, 0.01);
            let start = mechanism.start(0.05).unwrap();
            let settle = Some(Settle { tolerance: 1e-12, most: COMMON });
            let plan = MotionPlan { tolerance, stop_at_events, settle, ..plan(20) };
            let mut goal = mechanism.goal(&start, &plan).unwrap();
            goal.checkpoint_every = 19;
            let mut kept = Kept::default();
            let mut course = mechanism.course(&start, &plan, from).unwrap();
            course.run(&goal, &mut kept).unwrap();
            let done = GearboxRun::of(course, &start).unwrap();
            (kept, done)
        };
        let (whole, end) = follow(None);
        let before = whole.states.iter().filter(|(rows, _)| *rows == 0).count();
        assert!(before == 2 && whole.states.len() == 3, "{before} of {}", whole.states.len());
        for (rows, state) in &whole.states {
            let back = serde_json::from_str(&serde_json::to_string(state).unwrap()).unwrap();
            let (rest, again) = follow(Some(back));
            assert!(rest.rows == whole.rows[*rows..], "cycle {}: rows differ ({tolerance:?})", state.cycle);
            assert_eq!(again, end, "cycle {} ({tolerance:?})", state.cycle);
        }
    }
}

/// Windows of teeth are in a checkpoint: on the flanks themselves the motion goes on to the same bits.
#[test]
fn flanks_taken_up_again_go_the_same_way() {
    let follow = |from: Option<GearboxCheckpoint>| {
        let mut mechanism = one_stage(true);
        let start = mechanism.start(0.02).unwrap();
        let plan = plan(5);
        let mut goal = mechanism.goal(&start, &plan).unwrap();
        goal.checkpoint_every = 2;
        let mut kept = Kept::default();
        let mut course = mechanism.course(&start, &plan, from).unwrap();
        course.run(&goal, &mut kept).unwrap();
        kept
    };
    let whole = follow(None);
    let windows: Vec<_> = whole.states.iter().map(|(_, state)| state.memory.meshes[0].windows.unwrap()).collect();
    assert!(windows.len() == 2 && windows[0].driving.first != windows[1].driving.first, "{windows:?}");
    for (rows, state) in &whole.states {
        let back = serde_json::from_str(&serde_json::to_string(state).unwrap()).unwrap();
        assert!(follow(Some(back)).rows == whole.rows[*rows..], "cycle {}: rows differ", state.cycle);
    }
}

/// A checkpoint of a gearbox with other coordinates, or other meshes, is refused.
#[test]
fn a_checkpoint_of_another_gearbox_is_refused() {
    let mut mechanism = train(SPEED, Sense::Ccw, 0.0);
    let start = mechanism.start(0.05).unwrap();
    let plan = plan(1);
    let mut course = mechanism.course(&start, &plan, None).unwrap();
    course.run_cycle::<GearboxError>(None).unwrap();
    let state = course.checkpoint().unwrap();
    let mut meshes = state.clone();
    meshes.memory.meshes.push(MeshMemory { reach: 0.0, extremes: Extremes::default(), windows: None });
    let mut coordinates = state;
    coordinates.state = start.clone();
    coordinates.state.q = coordinates.state.q.push(0.0);
    let errors = [meshes, coordinates].map(|state| mechanism.course(&start, &plan, Some(state)).err().unwrap());
    let GearboxError::Motion(of_meshes) = &errors[0] else { panic!("{}", errors[0]) };
    let one_more = GearboxError::OtherMeshes { checkpoint: 3, motion: 2 };
    assert!(matches!(&**of_meshes, MotionError::Mechanism { source, .. } if *source == one_more), "{of_meshes}");
    let GearboxError::Motion(of_coordinates) = &errors[1] else { panic!("{}", errors[1]) };
    assert!(matches!(&**of_coordinates, MotionError::OtherCoordinates { .. }), "{of_coordinates}");
}

/// A change of speed shorter than a step is none that steps may miss: the blow of it is that of fine steps.
#[test]
fn a_short_change_of_speed_is_not_stepped_over() {
    let cycle = TAU / 100.0 / 17.0;
    let largest = |share: f64, per_cycle: u64| {
        let ramp = Speed::Ramp { from: 100.0, to: 103.0, start: 0.41 * cycle, duration: share * cycle };
        let change = |plan: &mut MotionPlan| (plan.steps_per_cycle, plan.steps_per_row) = (per_cycle, 1);
        let (rows, done) = run(Drive::Speed(ramp), change, 3);
        assert_eq!(rows.len() as u64, 3 * per_cycle + 1, "parts of steps are no rows");
        println!("{} steps", done.steps);
        errors(&rows).iter().map(|mesh| mesh[0]).fold(0.0, |m: f64, error| m.max(error.abs()))
    };
    for share in [0.2, 0.01, 1e-4] {
        let [coarse, fine] = [32, 256].map(|steps| largest(share, steps));
        println!("{share} of a cycle: {:.3}, {:.3} um", 1e3 * coarse, 1e3 * fine);
        assert!((coarse / fine - 1.0).abs() < 0.03, "{share} of a cycle: {coarse} beside {fine} mm");
    }
    let [still, blow] = [(100.0, 100.0), (100.0, 103.0)].map(|(from, to)| {
        let ramp = Speed::Ramp { from, to, start: 0.41 * cycle, duration: 1e-4 * cycle };
        let (rows, _) = run(Drive::Speed(ramp), |plan| plan.steps_per_row = 1, 3);
        errors(&rows).iter().map(|mesh| mesh[0]).fold(0.0, |m: f64, error| m.max(error.abs()))
    });
    assert!(blow > 1.2 * still, "a blow of {blow} mm beside {still} mm: the law says nothing");
}

/// A change of speed that begins with the motion is that which begins later: no rate of the start foresees it.
#[test]
fn a_change_at_the_start_is_a_change_later() {
    let cycle = TAU / 100.0 / 17.0;
    for share in [1e-3, 0.3, 2.0] {
        let [first, later] = [0.0, 4.0].map(|wait| {
            let ramp = Speed::Ramp { from: 100.0, to: 103.0, start: wait * cycle, duration: share * cycle };
            let change = |plan: &mut MotionPlan| (plan.steps_per_cycle, plan.steps_per_row) = (64, 1);
            let (rows, _) = run(Drive::Speed(ramp), change, 7);
            let all = errors(&rows)[wait as usize * 64..].iter().map(|mesh| mesh[0]).collect::<Vec<_>>();
            all.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], x| [l.min(*x), h.max(*x)])
        });
        let [first, later] = [first, later].map(|[l, h]| h - l);
        println!("{share} of a cycle: {:.3}, {:.3} um", 1e3 * first, 1e3 * later);
        assert!((first / later - 1.0).abs() < 0.05, "{share} of a cycle: {first} at the start, {later} mm later");
    }
}
