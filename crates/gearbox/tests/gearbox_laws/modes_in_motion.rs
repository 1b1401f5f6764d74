//! Normal modes beside the rigid bodies: the same at rest, exact forces, no trace of a tooth change, and where the
//! low-frequency approximation ends.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::sync::{Arc, OnceLock};

use ale::Station;
use contact::Bulk;
use dynamics::{
    Bearing, CHANGE_LIMIT, Drive, ElasticChange, GearVibration, LOW_FREQUENCY_LIMIT, MotionOptions, RigidBody, Speed,
    Torque,
};
use fem::ElementOptions;
use gearbox::motion::{
    CycleSteps, GearboxMechanism, MotionTimes, PairModel, PairMotion, instants, run_to_steady, shoot,
};
use geometry::{Gear, GearData, GearPair};
use integrate::{Forces, Integrator, Mechanism, Scheme, State, StepControl};
use ltca::StaticOptions;
use mesh::{GroupNames, MeshedGear};
use nalgebra::{DMatrix, DVector};
use reduction::{ElasticGear, GearModes, GearReducer, ModeChoice};
use testing::{
    Case,
    moving::{at_speed, peak_to_peak, rigid_bodies, started, worst},
};

const TORQUE: f64 = 150e3;

/// The default pair on its coarse meshes, reduced once for all tests.
struct Pair {
    case: Case,
    contact: StaticOptions,
    gears: Arc<[ElasticGear; 2]>,
    bodies: [RigidBody; 2],
    /// STE (mm) at phase 0.
    ste: f64,
    /// Mean tangent stiffness (N/mm) and line length (mm).
    means: [f64; 2],
}

fn pair() -> &'static Pair {
    static PAIR: OnceLock<Pair> = OnceLock::new();
    PAIR.get_or_init(|| {
        let case = Case::read("coarse_hex8_pinion.msh", "coarse_hex8_wheel.msh", ElementOptions::default());
        Pair::new(case)
    })
}

/// Discs on thin shafts: bodies that twist.
fn small_bore(diameter: f64) -> Pair {
    let data = GearData { bore_diameter: diameter, ..GearData::default() };
    let wheel = GearData { helix_angle: -data.helix_angle, ..data.clone() };
    let pair = GearPair::new(Gear::new(data).unwrap(), Gear::new(wheel).unwrap(), None).unwrap();
    let options = mesh::StructuredOptions {
        order: 1,
        elements_profile: 2,
        elements_fillet: 2,
        elements_thickness: 2,
        elements_face: 4,
        elements_rim: 5,
        extent: mesh::Extent::Periodic,
    };
    let meshes = [&pair.pinion, &pair.wheel].map(|gear| {
        let mesh = mesh::generate(gear, &options).unwrap_or_else(|e| panic!("{e}"));
        MeshedGear::from_groups(mesh, &GroupNames::default(), gear.teeth()).unwrap()
    });
    Pair::new(Case { pair, meshes, elements: ElementOptions::default(), torque: TORQUE })
}

impl Pair {
    fn new(case: Case) -> Self {
        let contact = case.slice_options();
        let mut model = case.reduced(contact.clone());
        let p = model.solve(Station { cycle: 0, phase: 0.0 }).unwrap_or_else(|e| panic!("{e}"));
        let bodies = rigid_bodies(&case.meshes.each_ref().map(|mesh| mesh.clone().whole().unwrap()));
        let (gears, means) = (Arc::new(case.reduced_gears(&contact)), [p.tangent_stiffness, p.contact_line_length]);
        Self { case, contact, gears, bodies, ste: p.transmission_error, means }
    }

    /// Constant speed of the pinion, rad/s; everything held but the wheel's turn.
    fn options(&self, speed: f64, zeta: f64) -> MotionOptions {
        at_speed(self.contact.clone(), self.bodies, speed, TORQUE, zeta)
    }

    fn reducers(&self) -> [&GearReducer; 2] {
        self.gears.each_ref().map(|gear| match gear {
            ElasticGear::Reduced(reducer) => reducer,
            ElasticGear::Full(_) => panic!("not a reduced gear"),
        })
    }

    /// Without and with modes.
    fn both(&self, options: &MotionOptions, kept: impl Fn(&GearReducer) -> GearModes) -> [PairModel; 2] {
        let modes = self.reducers().map(|reducer| {
            let modes = Arc::new(kept(reducer));
            GearVibration { modes, damping_ratio: 0.01 }
        });
        let make = || {
            let gears = Arc::clone(&self.gears);
            PairModel::new(self.case.pair.clone(), gears, None, options.clone(), self.means).unwrap()
        };
        [make(), make().with_modes(modes).unwrap_or_else(|e| panic!("{e}"))]
    }
}

/// The gear's own modes.
fn own_modes(count: usize) -> impl Fn(&GearReducer) -> GearModes {
    move |reducer| reducer.modes(ModeChoice::Count(count)).unwrap()
}

fn scale(system: &PairModel) -> DVector<f64> {
    system.scale(1e-2)
}

/// Balance at the very place, from one near it: contact keeps places that were found up to a um away, which a static
/// comparison to 1e-8 would see.
fn settled(system: &mut GearboxMechanism, q: &DVector<f64>) -> DVector<f64> {
    let (mut q, still) = (q.clone(), DVector::zeros(q.len()));
    for _ in 0..4 {
        system.forget();
        let mut forces = Forces::zeros(q.len());
        system.forces(0.0, &q, &still, &mut forces).unwrap();
        q += forces.stiffness.lu().solve(&(forces.conservative + forces.other)).unwrap();
    }
    system.forget();
    q
}

/// At rest modes and residual make up the whole compliance: the same transmission error with modes as without, by
/// tables and by matrices, with friction and without, with the gear's own modes and with those of its Craig-Bampton
/// model.
#[test]
fn modes_change_nothing_at_rest() {
    let pair = pair();
    let plain = pair.contact.clone();
    let bampton = |reducer: &GearReducer| reducer.craig_bampton_modes(ModeChoice::Count(12), 2).unwrap();
    for (name, contact, own) in [
        ("tables", plain.clone(), true),
        ("matrices", plain.clone().with_contact(|c| c.bulk = Bulk::Exact), true),
        ("friction", plain.clone().with_contact(|c| c.friction = 0.06), true),
        ("Craig-Bampton", plain, false),
    ] {
        let options = MotionOptions { statics: contact, ..pair.options(1e-6, 0.05) };
        let systems = if own { pair.both(&options, own_modes(12)) } else { pair.both(&options, bampton) };
        let [(a, torque_a), (b, torque_b)] = systems.map(|system| {
            let (mut system, state) = started(&system, 0.0);
            let q = settled(&mut system, &state.q);
            // Inertia of the modes takes nothing of the torque as long as they do not accelerate.
            let still = State::new(0.0, q.clone(), DVector::zeros(q.len()));
            (q[0], system.pair_instant(&still).unwrap().drive_torque)
        });
        println!("{name}: {:.6} um without, {:.2e} of it more with 24 modes", 1e3 * a, b / a - 1.0);
        assert!((b / a - 1.0).abs() < 1e-8, "{name}: {b} mm with modes, {a} mm without");
        assert!((torque_b / torque_a - 1.0).abs() < 1e-7, "{name}: {torque_b} N mm with modes, {torque_a} without");
    }
}

/// Forces are the gradient of the potential in all coordinates, and tangents that of the forces; all rigid coordinates
/// free, gears turned on.
#[test]
fn forces_and_tangents_are_derivatives() {
    let pair = pair();
    let k = 1e5 * nalgebra::Matrix6::from_diagonal(&[1.0, 1.0, 1.0, 1e3, 1e3, 0.0].into());
    let bearing = Bearing { stiffness: k, ..Bearing::default() };
    let held = pair.options(1.0, 0.0);
    let free = MotionOptions { free: [[true; 6]; 2], bearings: [bearing; 2], start_cycles: 7.3, ..held };
    let [_, model] = pair.both(&free, own_modes(5));
    let s = model.scale(1e-2);
    let (mut system, State { mut q, .. }) = started(&model, 0.0);
    let n = q.len();
    // Anywhere near, so that no force vanishes.
    for i in 0..n {
        q[i] += 0.02 * s[i] * ((3 * i) as f64).sin();
    }
    let mut forces = Forces::zeros(n);
    let still = DVector::zeros(n);
    system.forces(0.0, &q, &still, &mut forces).unwrap();
    let (mut worst_force, mut worst_tangent) = (0.0f64, 0.0f64);
    // Over sizes of coordinates: work, which may be compared between forces and moments.
    let work = forces.conservative.component_mul(&s).amax();
    let stiff = (0..n).map(|i| forces.stiffness[(i, i)] * s[i] * s[i]).fold(0.0, f64::max);
    for i in 0..n {
        let step = 1e-4 * s[i];
        let [(up, f_up), (down, f_down)] = [0, 1].map(|side| {
            let mut moved = q.clone();
            moved[i] += if side == 0 { step } else { -step };
            let mut f = Forces::zeros(n);
            system.forces(0.0, &moved, &still, &mut f).unwrap();
            (system.potential(0.0, &moved).unwrap(), f.conservative)
        });
        let slope = -(up - down) / (2.0 * step);
        worst_force = worst_force.max((slope - forces.conservative[i]).abs() * s[i] / work);
        let change = f_up - f_down;
        for j in 0..n {
            let slope = -change[j] / (2.0 * step);
            worst_tangent = worst_tangent.max((slope - forces.stiffness[(j, i)]).abs() * s[i] * s[j] / stiff);
        }
    }
    println!("{n} coordinates: forces off by {worst_force:.1e}, tangents by {worst_tangent:.1e} of the largest");
    assert!(worst_force < 2e-3 && worst_tangent < 1e-2, "{worst_force:e}, {worst_tangent:e}");
}

/// Over tooth changes force goes on to round-off, mode coordinates are not touched at all, and the energy ledger
/// closes.
#[test]
fn tooth_change_leaves_no_trace_in_the_modes() {
    let pair = pair();
    // Mesh frequency 1 kHz.
    let speed = 1e3 * pair.case.pair.pinion.pitch_angle();
    let [_, model] = pair.both(&pair.options(speed, 0.05), own_modes(8));
    let s = scale(&model);
    let (mut system, mut state) = started(&model, 0.0);
    let mut integrator = Integrator::new(Scheme::Energy, StepControl::Fixed(1e-3 / 48.0), s);
    let (mut largest, mut open, mut turnover) = (0.0f64, 0.0f64, 0.0f64);
    integrator
        .advance(&mut system, &mut state, 2.2e-3, |system, seen| {
            largest = largest.max(system.extremes(0).largest_force);
            open = open.max(seen.ledger.residual().abs());
            turnover = seen.ledger.turnover;
        })
        .unwrap_or_else(|e| panic!("{e}"));
    let changes = system.changes(0);
    println!(
        "{} changes, force jumps by {:.1e} of its largest; energy open by {open:.1e} of {turnover:.1e} N mm",
        changes.count,
        changes.jump / largest
    );
    assert!(changes.count >= 2, "{changes:?}");
    assert!(changes.jump < 1e-9 * largest, "{changes:?}");
    assert!(open < 1e-9 * turnover, "energy open by {open:e} N mm");
}

/// The periodic answer that waiting finds, with modes of both gears: amplitudes go on turned by a pitch from cycle to
/// cycle, so that shooting finds it too, and finds it stable.
#[test]
fn shooting_finds_what_waiting_finds() {
    let pair = pair();
    // Near the mesh resonance, weakly damped.
    let speed = 2.2e3 * pair.case.pair.pinion.pitch_angle();
    let [waited, shot] = [false, true].map(|shooting| {
        let [_, model] = pair.both(&pair.options(speed, 0.03), own_modes(3));
        let times = MotionTimes {
            scheme: Scheme::Energy,
            steps: CycleSteps::Counted { per_cycle: 32, per_row: 1, last: None },
            tolerance: None,
            stop_at_events: false,
            scale: scale(&model),
        };
        let (system, state) = started(&model, 0.0);
        let mut motion = PairMotion::new(system, times, state);
        let periods = if shooting {
            let shot = shoot(&mut motion, 1, 1e-7).unwrap_or_else(|e| panic!("{e}"));
            assert!(shot.residual < 1e-7 && shot.multiplier < 1.0, "{shot:?}");
            shot.periods as u64
        } else {
            let found = run_to_steady(&mut motion, 1e-7, 400).unwrap();
            assert!(found.residual < 1e-7 && found.period == 1, "{found:?}");
            motion.cycle()
        };
        let mut errors = Vec::new();
        motion.run_cycle(Some(&mut instants(|now, _, _| errors.push(now.mesh.transmission_error)))).unwrap();
        (periods, errors)
    });
    let off = waited.1.iter().zip(&shot.1).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / pair.ste;
    println!("{} periods waited, {} shot; off by {off:.1e} of the static error", waited.0, shot.0);
    assert!(waited.1.len() == 32 && off < 1e-5, "the answers differ by {off:e} of the static error");
}

/// Modes have momentum: a torque that balances the load keeps that of rotation and modes together, as a torque of its own
/// does that begins without momentum off the nominal motion.
#[test]
fn modes_take_their_momentum_from_the_whole_rotation() {
    const STEPS: f64 = 256.0;
    let pair = pair();
    let hz = 1e3;
    let speed = hz * pair.case.pair.pinion.pitch_angle();
    let held = pair.options(speed, 0.0);
    let given = Drive::Torque { start: speed, torque: Torque::Constant(TORQUE) };
    let of = |drive: Drive| pair.both(&MotionOptions { drive, ..held.clone() }, own_modes(3));
    let moved = |model: &PairModel, system: &mut GearboxMechanism, state: &mut State| {
        let control = StepControl::Fixed(1.0 / (STEPS * hz));
        let mut integrator = Integrator::new(Scheme::DormandPrince, control, scale(model));
        let (lag, mut errors) = (model.lag(), Vec::new());
        let seen = integrator.advance(system, state, 1.5 / hz, |_, seen| errors.push(seen.state.q[lag]));
        seen.unwrap_or_else(|e| panic!("{e}"));
        errors
    };
    let offs = std::iter::zip(of(Drive::Balanced(Speed::Constant(speed))), of(given)).map(|(balanced, given)| {
        let fastest = [&balanced, &given].map(|model| {
            let limit = model.machine().and_then(|mut machine| machine.stable_step(Scheme::DormandPrince));
            let limit = limit.unwrap_or_else(|e| panic!("{e}"));
            limit.map_or(0.0, |limit| limit.rate)
        });
        let frequencies = (fastest[1] / fastest[0] - 1.0).abs();
        // One stands by some um beside the other: 2e-5 of the stiffness.
        assert!(frequencies < 1e-4, "the fastest vibration has {fastest:?} rad/s");
        let (mut system, mut state) = started(&balanced, 0.0);
        let (mut free, _) = started(&given, 0.0);
        // All coordinates but the last, the turn, are the same; that one leaves no momentum along it.
        let turn = system.count();
        let mass = free.mass().row(turn).transpose();
        let beside = |z: &DVector<f64>| {
            let mut all = z.clone().insert_row(turn, 0.0);
            all[turn] = -mass.dot(&all) / mass[turn];
            all
        };
        let mut other = State::new(0.0, beside(&state.q), beside(&state.v));
        let [a, b] = [moved(&balanced, &mut system, &mut state), moved(&given, &mut free, &mut other)];
        assert_eq!(a.len(), b.len());
        worst(&a, &b) / peak_to_peak(&a)
    });
    let offs: Vec<f64> = offs.collect();
    println!("off by {:.2e} of the peak to peak without modes, {:.2e} with them", offs[0], offs[1]);
    // Normal forces of bent flanks move the whole rotation a little, which a balanced torque does not let them: 6e-5.
    assert!(offs[0] < 1e-4 && (offs[1] - offs[0]).abs() < 2e-6, "DTE differs by {offs:?} of its peak to peak");
}

/// Response of all coordinates to the mesh going on with frequency `hz`: (K + i w C - w^2 M) x = df/dt at held
/// coordinates, as amplitude of the lag.
fn response(model: &PairModel, system: &mut GearboxMechanism, state: &State, hz: f64) -> f64 {
    let n = system.count();
    let still = DVector::zeros(n);
    let mut forces = Forces::zeros(n);
    let h = 1e-4 * model.time_of_cycles(1.0).unwrap();
    let mut at = |t: f64| {
        forces.clear();
        system.forces(t, &state.q, &still, &mut forces).unwrap();
        forces.clone()
    };
    let (after, before, now) = (at(h), at(-h), at(0.0));
    let drive = &after.conservative - &before.conservative;
    let w = std::f64::consts::TAU * hz;
    // [A -B; B A] of the real and imaginary parts.
    let (a, b) = (&now.stiffness - w * w * system.mass(), w * &now.damping);
    let mut all = DMatrix::zeros(2 * n, 2 * n);
    for (row, column, block) in [(0, 0, &a), (n, n, &a), (n, 0, &b)] {
        all.view_mut((row, column), (n, n)).copy_from(block);
    }
    all.view_mut((0, n), (n, n)).copy_from(&-&b);
    let mut rhs = DVector::zeros(2 * n);
    rhs.rows_mut(0, n).copy_from(&drive);
    let x = all.lu().solve(&rhs).unwrap();
    let lag = model.lag();
    x[lag].hypot(x[n + lag])
}

/// Quasi-static elasticity against modes over speed (figure 7): one below the bound, two above it, and the warning in
/// between. The fixed-boundary frequency would warn too late.
#[test]
fn low_frequency_approximation_ends_where_the_warning_says() {
    for bore in [10.0, 20.0] {
        let pair = small_bore(bore);
        let lowest = pair.reducers().map(|reducer| reducer.lowest_frequencies().unwrap());
        let elastic_hz = lowest.map(|l| l.flanks_free_hz);
        // A fifth of a cycle on: there the teeth's stiffness changes fastest.
        let options = MotionOptions { start_cycles: 0.2, ..pair.options(1e-6, 0.1) };
        let systems = pair.both(&options, own_modes(16));
        println!(
            "bore {bore} mm: lowest {:.0} Hz, flanks held {:.0} Hz, mesh resonance {:.0} Hz",
            elastic_hz[0],
            lowest[0].flanks_held_hz,
            systems[0].mesh_resonance_hz()
        );
        let mut moving = systems.each_ref().map(|system| started(system, 0.0));
        println!("harmonic / lowest elastic frequency, what modes change in the DTE, what is foreseen of it");
        let (mut below, mut above, mut most) = (0.0f64, 0.0f64, 0.0f64);
        for ratio in [0.02, 0.05, 0.1, 0.15, 0.2, 0.249, 0.251, 0.3, 0.35, 0.4, 0.5, 0.8, 0.9, 1.0] {
            let mesh_hz = ratio * elastic_hz[0];
            let [a, b] = [0, 1].map(|i| {
                let (system, state) = &mut moving[i];
                response(&systems[i], system, state, mesh_hz)
            });
            let off = b / a - 1.0;
            let foreseen = ElasticChange::of(&[1.0], [mesh_hz; 2], elastic_hz, systems[0].mesh_resonance()).share;
            let warns = foreseen > CHANGE_LIMIT;
            println!(
                "{ratio:6.3} {:8.1} %, foreseen {:.1} %{}",
                100.0 * off,
                100.0 * foreseen,
                if warns { ", warns" } else { "" }
            );
            assert_eq!(warns, ratio > LOW_FREQUENCY_LIMIT, "{ratio}: {foreseen} foreseen");
            assert!(
                ratio > 0.4 || off.abs() < 0.02 || foreseen > 0.5 * off.abs(),
                "{ratio}: {off}, foreseen {foreseen}"
            );
            match ratio {
                r if r <= LOW_FREQUENCY_LIMIT => below = below.max(off.abs()),
                r if r <= 0.4 => above = above.max(off.abs()),
                _ => most = most.max(off.abs()),
            }
        }
        assert!(below < 0.09, "bore {bore} mm: modes change the DTE by {below} below the bound");
        assert!(
            above > 0.1 && most > 0.8,
            "bore {bore} mm: modes change the DTE by {above} and {most} above the bound"
        );
    }
}

/// The same in time at two speeds: mesh harmonic of the DTE over the last of some mesh cycles.
#[test]
fn time_says_the_same_as_linear_response() {
    const STEPS: usize = 32;
    let pair = small_bore(20.0);
    let lowest = pair.reducers()[0].lowest_frequencies().unwrap().flanks_free_hz;
    let change = |ratio: f64, cycles: f64| {
        let mesh_hz = ratio * lowest;
        let speed = mesh_hz * pair.case.pair.pinion.pitch_angle();
        let [a, b] = pair.both(&pair.options(speed, 0.1), own_modes(12)).map(|model| {
            let s = scale(&model);
            let (mut system, mut state) = started(&model, 0.0);
            let control = StepControl::Fixed(1.0 / (STEPS as f64 * mesh_hz));
            let mut integrator = Integrator::new(Scheme::GeneralisedAlpha { rho: 0.8 }, control, s);
            let mut dte = Vec::new();
            integrator
                .advance(&mut system, &mut state, cycles / mesh_hz, |_, seen| dte.push(seen.state.q[0]))
                .unwrap_or_else(|e| panic!("{mesh_hz} Hz: {e}"));
            let turn = |i: usize| std::f64::consts::TAU * i as f64 / STEPS as f64;
            let last = dte[dte.len() - STEPS..].iter().enumerate();
            let [c, d] = last.fold([0.0, 0.0], |[c, d], (i, x)| [c + x * turn(i).cos(), d + x * turn(i).sin()]);
            2.0 / STEPS as f64 * c.hypot(d)
        });
        println!("{ratio} of {lowest:.0} Hz: {:.4} um without modes, {:.4} um with", 1e3 * a, 1e3 * b);
        b / a - 1.0
    };
    let [slow, fast] = [change(0.1, 4.0), change(0.9, 20.0)];
    assert!(slow.abs() < 0.04, "modes change the DTE by {slow} at a tenth of the lowest elastic frequency");
    assert!(fast < -0.25, "modes change the DTE by {fast} at 0.9 of it");
}
