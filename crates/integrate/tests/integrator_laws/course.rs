//! Laws of the one loop in time, on an oscillator with a clearance: cycles, rows, settling, events, checkpoints.

use std::convert::Infallible;

use integrate::{
    Ahead, Checkpoint, Compared, Course, CycleTimes, Follower, Forces, Goal, Mechanism, Method, MotionError, OnlyRows,
    Periodicity, Resumable, Row, RowPlace, Scheme, Settle, SignalRecurrence, State, StepControl, Stop, SweepDirection,
    Timetable, sweep,
};
use nalgebra::{DMatrix, DVector, dvector};

/// x'' + 2 zeta x' + f(x) = F_m + F_a cos(t), f the dead zone of half-width 1; events where the flanks touch. It remembers
/// how far it went, and warms its answers by where it was last until it is told to forget.
#[derive(Debug)]
struct Oscillator {
    mass: DMatrix<f64>,
    zeta: f64,
    load: [f64; 2],
    farthest: f64,
    warm: f64,
}

const PERIOD: f64 = std::f64::consts::TAU;

fn oscillator() -> Oscillator {
    Oscillator { mass: DMatrix::identity(1, 1), zeta: 0.08, load: [0.5, 0.4], farthest: 0.0, warm: 0.0 }
}

impl Oscillator {
    fn force(x: f64) -> f64 {
        x.signum() * (x.abs() - 1.0).max(0.0)
    }
}

impl Mechanism for Oscillator {
    type Error = Infallible;

    fn mass(&self) -> &DMatrix<f64> {
        &self.mass
    }

    fn forces(&mut self, t: f64, q: &DVector<f64>, v: &DVector<f64>, out: &mut Forces) -> Result<(), Infallible> {
        let drive = self.load[0] + self.load[1] * t.cos();
        out.conservative[0] = -Self::force(q[0]);
        // A solver that starts where it was last finds other last digits.
        out.other[0] = drive * (1.0 + 1e-13 * self.warm) - 2.0 * self.zeta * v[0];
        out.stiffness[(0, 0)] = if q[0].abs() > 1.0 { 1.0 } else { 0.0 };
        out.damping[(0, 0)] = 2.0 * self.zeta;
        out.supplied = drive * v[0];
        out.dissipated = 2.0 * self.zeta * v[0] * v[0];
        Ok(())
    }

    fn potential(&mut self, _: f64, q: &DVector<f64>) -> Result<f64, Infallible> {
        Ok(0.5 * Self::force(q[0]).powi(2))
    }

    fn events(&self) -> usize {
        1
    }

    fn event_values(&mut self, _: f64, q: &DVector<f64>, _: &DVector<f64>, out: &mut [f64]) -> Result<(), Infallible> {
        out[0] = q[0] - 1.0;
        Ok(())
    }

    fn accepted(&mut self, _: f64, q: &DVector<f64>, _: &DVector<f64>) -> Result<(), Infallible> {
        self.farthest = self.farthest.max(q[0].abs());
        self.warm = (q[0] * 1e3).fract();
        Ok(())
    }

    fn forget(&mut self) {
        self.warm = 0.0;
    }
}

impl Resumable for Oscillator {
    type Memory = f64;

    fn memory(&self) -> f64 {
        self.farthest
    }

    fn restore(&mut self, memory: &f64) -> Result<(), Infallible> {
        self.farthest = *memory;
        Ok(())
    }
}

/// Periods of the drive with this many rows.
#[derive(Debug, Clone)]
struct Periods {
    rows: usize,
    tolerance: Option<f64>,
    stop_at_events: bool,
    restarts: bool,
    rows_at: RowPlace,
    /// The motion ends with this cycle.
    last: u64,
}

const PERIODS: Periods = Periods {
    rows: 32,
    tolerance: None,
    stop_at_events: false,
    restarts: true,
    rows_at: RowPlace::Ends,
    last: u64::MAX,
};

impl Timetable<Oscillator> for Periods {
    fn method(&self, _: &Oscillator) -> Method {
        let (scheme, scale) = (Scheme::Energy, dvector![1.0]);
        Method { scheme, scale, stop_at_events: self.stop_at_events, keep_stable: true }
    }

    fn cycle(&self, _: &Oscillator, cycle: u64, _: f64) -> Option<CycleTimes> {
        let time = |k: usize| (cycle as f64 + k as f64 / self.rows as f64) * PERIOD;
        let stops = match self.rows_at {
            RowPlace::Steps(_) => vec![Stop::row(time(self.rows))],
            _ => (1..=self.rows).map(|k| Stop::row(time(k))).collect(),
        };
        let control = StepControl::new(self.tolerance, PERIOD / self.rows as f64);
        (cycle <= self.last).then_some(CycleTimes { stops, rows: self.rows_at, control })
    }

    fn restarts(&self) -> bool {
        self.restarts
    }
}

/// Times and places of rows, and the checkpoints.
#[derive(Default)]
struct Seen {
    rows: Vec<[f64; 2]>,
    checkpoints: Vec<(usize, Checkpoint<f64>)>,
    /// A state that Newton's method would find, and whether it was asked for.
    shot: Option<State>,
}

impl Follower<Oscillator> for Seen {
    type Error = MotionError<Infallible>;

    fn row(&mut self, row: Row<'_, Oscillator>) -> Result<(), Self::Error> {
        self.rows.push([row.state.time, row.state.q[0]]);
        Ok(())
    }

    fn checkpoint(&mut self, state: Checkpoint<f64>) -> Result<(), Self::Error> {
        self.checkpoints.push((self.rows.len(), state));
        Ok(())
    }

    fn seeks(&self, _: &Oscillator, _: Periodicity) -> bool {
        self.shot.is_some()
    }

    fn nearer(&mut self, _: &mut Oscillator, period: &Ahead) -> Result<Option<State>, Self::Error> {
        Ok(self.shot.take().map(|there| State { time: period.state.time, ..there }))
    }
}

fn goal(settle: Option<Settle>, cycles: u64) -> Goal<Oscillator> {
    let compared = Some(Compared::States { scale: dvector![1.0], free: None, period: 1 });
    let (tolerance, checkpoint_every) = (1e-9, 0);
    Goal { compared, settle, tolerance, cycles, starts_with_row: false, checkpoint_every, stop_after: None }
}

fn start() -> State {
    State::new(0.0, dvector![1.5], dvector![0.0])
}

fn run(times: &Periods, goal: &Goal<Oscillator>) -> (Seen, Course<Oscillator, Periods>) {
    let (mut course, mut seen) = (Course::new(oscillator(), times.clone(), start()), Seen::default());
    assert!(!course.run(goal, &mut seen).unwrap(), "nobody asked to stop");
    (seen, course)
}

/// Taken up at any checkpoint, from text, a motion goes the same way to the last bit: while it settles and among its
/// rows, by fixed and by adaptive steps, with and without memory from cycle to cycle.
#[test]
fn a_motion_taken_up_again_goes_the_same_way() {
    for (tolerance, stop_at_events, restarts) in
        [(None, false, true), (None, true, false), (Some(1e-6), false, true), (Some(1e-6), true, false)]
    {
        let times = Periods { tolerance, stop_at_events, restarts, ..PERIODS };
        let asked = Goal { checkpoint_every: 3, ..goal(Some(Settle { tolerance: 1e-3, most: 40 }), 7) };
        let (whole, end) = run(&times, &asked);
        let settling = whole.checkpoints.iter().filter(|(_, state)| !state.stage.recording).count();
        assert!(settling > 0 && settling < whole.checkpoints.len(), "checkpoints on either side of the first row");
        for (rows, state) in &whole.checkpoints {
            let text = serde_json::to_string(state).unwrap();
            let back = serde_json::from_str(&text).unwrap();
            let mut course = Course::resume(oscillator(), times.clone(), back).unwrap();
            let mut rest = Seen::default();
            course.run(&asked, &mut rest).unwrap();
            let of_whole = &whole.rows[*rows..];
            assert!(rest.rows == of_whole, "cycle {}: rows differ, {tolerance:?} {restarts}", state.cycle);
            assert!(course.checkpoint() == end.checkpoint(), "cycle {}: the ends differ", state.cycle);
        }
    }
}

/// What is remembered shows: without being told to forget, a motion that is taken up again ends in other last digits.
/// Else the law above could not fail.
#[test]
fn memory_shows_where_nothing_is_forgotten() {
    let times = Periods { restarts: false, ..PERIODS };
    let [with, without] = [3, 0].map(|checkpoint_every| run(&times, &Goal { checkpoint_every, ..goal(None, 7) }).0);
    assert!(with.rows != without.rows, "the memory does not show");
    let off = with.rows.iter().zip(&without.rows).map(|(a, b)| (a[1] - b[1]).abs()).fold(0.0, f64::max);
    assert!(off < 1e-9, "off by {off:e}: more than last digits");
}

/// A motion stops where it is asked to, with a checkpoint, and not at its very end.
#[test]
fn a_motion_stops_where_it_is_asked_to() {
    let stopped = |after| {
        let (mut course, mut seen) = (Course::new(oscillator(), PERIODS, start()), Seen::default());
        let stops = course.run(&Goal { stop_after: Some(after), ..goal(None, 5) }, &mut seen).unwrap();
        (stops, course.cycle(), seen.checkpoints.len())
    };
    assert_eq!(stopped(2), (true, 2, 1));
    assert_eq!(stopped(5), (false, 5, 0), "a motion that is done has not stopped");
}

/// Settling waits until the motion repeats itself: the rows of the cycles that follow are alike to the tolerance, those
/// from the start on are not; and it ends after as many cycles as it may take.
#[test]
fn a_settled_motion_repeats_itself() {
    let apart = |rows: &[[f64; 2]]| (0..32).map(|i| (rows[i][1] - rows[32 + i][1]).abs()).fold(0.0, f64::max);
    let (settled, course) = run(&PERIODS, &goal(Some(Settle { tolerance: 1e-7, most: 1000 }), 2));
    let found = course.stage().periodicity.unwrap();
    assert!(found.residual <= 1e-7 && found.period == 1, "{found:?}");
    assert!(apart(&settled.rows) < 1e-6, "{:e}", apart(&settled.rows));
    let (at_once, _) = run(&PERIODS, &goal(None, 2));
    assert!(apart(&at_once.rows) > 1e-2, "{:e}", apart(&at_once.rows));
    let (_, impatient) = run(&PERIODS, &goal(Some(Settle { tolerance: 1e-7, most: 3 }), 2));
    assert_eq!((impatient.cycle(), impatient.stage().recorded), (5, 2));
}

/// States and one signal tell the same of a motion; periods of two cycles are seen only where they are compared.
#[test]
fn states_and_a_signal_tell_the_same() {
    let settle = Some(Settle { tolerance: 1e-7, most: 1000 });
    let of = |compared| run(&PERIODS, &Goal { compared: Some(compared), ..goal(settle, 1) }).1;
    let by_signal = of(Compared::Signal { of: |_, state| Ok(state.q[0]), period: 1 });
    let by_states = of(Compared::States { scale: dvector![1.0], free: None, period: 1 });
    assert!(by_signal.cycle().abs_diff(by_states.cycle()) <= 4, "{} {}", by_signal.cycle(), by_states.cycle());
    for compared in [
        Compared::States { scale: dvector![1.0], free: None, period: 2 },
        Compared::Signal { of: |_, state| Ok(state.q[0]), period: 2 },
    ] {
        let by_two = of(compared);
        let (cycles, found) = (by_two.cycle() - 1, by_two.stage().periodicity.unwrap());
        assert!(cycles.is_multiple_of(2), "settled after {cycles} cycles: no whole period of two");
        assert_eq!(found.period, 2, "a period is counted in cycles: {found:?}");
    }
}

/// A record of period three is found as such, not as one of six, and noise as none.
#[test]
fn the_shortest_period_of_a_signal_is_found() {
    let mut signal = SignalRecurrence::default();
    let mut last = None;
    for k in 0..8 {
        let own = f64::from(k % 3);
        last = Some(signal.judge(vec![own, 2.0 + own, -1.0], 1e-9));
    }
    assert_eq!(last, Some(Periodicity { period: 3, residual: 0.0 }));
    let mut signal = SignalRecurrence::default();
    let noise = (0..8).map(|k| signal.judge(vec![f64::from(k * k), 0.0], 1e-9).residual);
    assert!(noise.fold(f64::INFINITY, f64::min) > 1e-3);
}

/// A nearer state takes the place of waiting: with the periodic state at hand the motion has settled in a cycle or two.
#[test]
fn a_nearer_state_ends_the_waiting() {
    let settle = Some(Settle { tolerance: 1e-9, most: 1000 });
    let (_, waited) = run(&PERIODS, &goal(settle, 1));
    let there = waited.checkpoint().unwrap().state;
    let (mut course, mut seen) =
        (Course::new(oscillator(), PERIODS, start()), Seen { shot: Some(there), ..Seen::default() });
    course.run(&goal(settle, 1), &mut seen).unwrap();
    assert!(seen.shot.is_none() && course.cycle() <= 11, "{} cycles, waiting took {}", course.cycle(), waited.cycle());
    assert!(waited.cycle() > 20, "waiting is no test with {} cycles", waited.cycle());
}

/// Rows stand at the same times by counting steps, at stops, and at beginnings one row before; a start may be a row.
#[test]
fn rows_stand_where_they_are_asked_for() {
    let of = |rows_at| run(&Periods { rows_at, ..PERIODS }, &goal(None, 2)).0.rows;
    let [steps, ends, beginnings] = [RowPlace::Steps(1), RowPlace::Ends, RowPlace::Beginnings].map(of);
    assert_eq!([steps.len(), ends.len(), beginnings.len()], [64; 3]);
    assert_eq!(beginnings[0], [0.0, 1.5]);
    for (i, row) in ends.iter().enumerate() {
        assert!((row[0] - steps[i][0]).abs() < 1e-12 && (row[1] - steps[i][1]).abs() < 1e-9, "{i}: {row:?}");
        assert!((row[0] - (i + 1) as f64 / 32.0 * PERIOD).abs() < 1e-12, "{i}: {row:?}");
        assert!(i == 63 || (beginnings[i + 1][1] - row[1]).abs() < 1e-9, "{i}: {row:?}");
    }
    let (with_start, _) = run(&PERIODS, &Goal { starts_with_row: true, ..goal(None, 2) });
    assert_eq!((with_start.rows.len(), with_start.rows[0]), (65, [0.0, 1.5]));
}

/// Contact is lost and gained in turns, and steps that end there are more than the rows ask for.
#[test]
fn events_are_counted_and_end_steps() {
    let [through, stopping] =
        [false, true].map(|stop_at_events| run(&Periods { stop_at_events, ..PERIODS }, &goal(None, 6)).1);
    for course in [&through, &stopping] {
        let (ups, downs) = (course.counts().ups(0), course.counts().downs(0));
        assert!(downs > 2 && ups.abs_diff(downs) <= 1, "{ups} {downs}");
    }
    let [crossed, steps] = [stopping.counts().downs(0) + stopping.counts().ups(0), stopping.counts().steps];
    assert_eq!((through.counts().steps, steps), (6 * 32, 6 * 32 + crossed));
}

/// A motion that ends before its cycles are over has as many rows as there are cycles, and says so where one more is
/// asked for.
#[test]
fn a_motion_may_end_before_its_cycles() {
    let (seen, mut course) = run(&Periods { last: 2, ..PERIODS }, &goal(None, 9));
    assert_eq!((seen.rows.len(), course.goes_on()), (3 * 32, false));
    let error = course.run_cycle::<MotionError<Infallible>>(None).unwrap_err();
    assert_eq!(error, MotionError::StandsStill { cycle: 3 });
}

/// A checkpoint of other coordinates is refused.
#[test]
fn a_foreign_checkpoint_is_refused() {
    let (mut seen, course) = run(&PERIODS, &goal(None, 1));
    seen.rows.clear();
    let state = course.checkpoint().unwrap();
    let mut other = state.clone();
    other.state = State::new(0.0, dvector![0.0, 0.0], dvector![0.0, 0.0]);
    let mut torn = state;
    torn.state.v = dvector![];
    for foreign in [other, torn] {
        let error = Course::resume(oscillator(), PERIODS, foreign).unwrap_err();
        assert!(matches!(error, MotionError::OtherCoordinates { motion: 1, .. }), "{error}");
    }
}

/// A follower's own error ends a motion at once, with as many rows as it took.
#[test]
fn a_follower_ends_a_motion() {
    for rows_at in [RowPlace::Ends, RowPlace::Steps(1), RowPlace::Beginnings] {
        let mut course = Course::new(oscillator(), Periods { rows_at, ..PERIODS }, start());
        let mut rows = 0;
        let full = MotionError::<Infallible>::NotPositive { name: "room", value: 0.0 };
        let done = course.record(
            &goal(None, 3),
            &mut OnlyRows(|_: Row<'_, Oscillator>| {
                rows += 1;
                if rows == 5 { Err(full.clone()) } else { Ok(()) }
            }),
        );
        assert_eq!((done, rows), (Err(full.clone()), 5), "{rows_at:?}");
    }
}

/// Up and down each goes on from its neighbour, from the last answer where that has none; a value that fails from there
/// starts by itself; independent values know of no other.
#[test]
fn a_sweep_carries_its_ends() {
    let values = [1, 2, 3, 4];
    let ways = [SweepDirection::Up, SweepDirection::Down, SweepDirection::Independent];
    let at = |_, &value: &i32, from: Option<&i32>| match (value, from) {
        (3, _) => Err("never"),
        (2, Some(_)) => Err("not from there"),
        _ => Ok((from.copied(), value)),
    };
    let all = sweep(&values, &ways, at, |_| false, |_, _| std::ops::ControlFlow::Continue(()));
    let (none, never) = (Ok(None), Err("never"));
    assert_eq!(all[0], [(0, none), (1, none), (2, never), (3, Ok(Some(2)))]);
    assert_eq!(all[1], [(3, none), (2, never), (1, none), (0, Ok(Some(2)))]);
    assert_eq!(all[2], [(0, none), (1, none), (2, never), (3, none)]);
    let stops = |value: &i32, _: &Result<_, _>| match value {
        2 => std::ops::ControlFlow::Break(()),
        _ => std::ops::ControlFlow::Continue(()),
    };
    let cut = sweep(&values, &ways[..1], at, |e| *e == "not from there", stops);
    assert_eq!(cut[0], [(0, none), (1, Err("not from there"))], "what a start cannot cure is not tried again");
}
