//! Laws of motion in time: energy, phases, sidebands, reduction.

use std::f64::consts::{PI, TAU};

use fem::Material;
use gearbox::{
    Disc, GearMesh, Operation, Structure, Torque,
    motion::{Drive, GearboxInstant, GearboxMechanism, MotionOptions, MotionPlan, PitchErrors, Speed, SpringMesh},
};
use geometry::Sense;
use integrate::Scheme;
use lumped::Fourier;

use crate::pairs::{operation, pair, two_stages};

/// Two stages whose gears and couplings have mass.
fn heavy() -> (Structure, Vec<GearMesh>) {
    let (mut structure, meshes) = two_stages();
    let gear = |disc: &mut Disc, outer: f64| {
        *disc = Disc::ring(disc.name.clone(), disc.shaft, disc.position, [outer, 30.0], 20.0, 7.85e-9);
    };
    for (i, outer) in [53.0, 160.0, 58.0, 145.0, 80.0, 120.0].into_iter().enumerate() {
        gear(&mut structure.discs[i], outer);
    }
    (structure, meshes)
}

const OUTPUT: f64 = 4e5;

fn loaded(structure: &Structure, sense: Sense) -> Operation {
    let torque = -(sense.sign() as f64) * OUTPUT;
    operation(structure, 4, sense, vec![Torque { disc: 5, torque }])
}

/// Stiffness of a mesh over its phase, N/mm.
pub fn stiffness() -> Fourier {
    Fourier { mean: 4e5, cosine: vec![5e4], sine: vec![2e4, 1e4] }
}

/// A train of two stages whose meshes have a varying stiffness, a damper, backlash and pitch errors on gear 2.
pub fn train(drive: Drive, sense: Sense, error: f64) -> GearboxMechanism {
    let (structure, meshes) = heavy();
    let options = MotionOptions { drive, modal_damping: 0.01, limit: TAU * 4000.0 };
    let operation = loaded(&structure, sense);
    GearboxMechanism::new(structure, meshes, operation, &options, |i, mesh, meshing| {
        let mut teeth = [Vec::new(), vec![0.0; 53]];
        if i == 0 {
            teeth[1][7] = error;
        } else {
            teeth[1].clear();
        }
        let spring =
            SpringMesh::new(mesh, meshing, stiffness())?.with_damping(20.0).with_coast_flanks(mesh, meshing)?;
        Ok(Box::new(spring.with_errors(PitchErrors::new(teeth)?)))
    })
    .unwrap()
}

/// Cycles of the fastest mesh from the start on in so many steps, each of which is a row.
pub fn steps(scheme: Scheme, [cycles, steps_per_cycle]: [u64; 2]) -> MotionPlan {
    let (steps_per_row, tolerance, stop_at_events, settle, shoots) = (1, None, false, None, false);
    MotionPlan { scheme, cycles, steps_per_cycle, steps_per_row, tolerance, stop_at_events, settle, shoots }
}

fn run(
    mechanism: &mut GearboxMechanism,
    scheme: Scheme,
    cycles: u64,
    steps_per_cycle: u64,
) -> (Vec<GearboxInstant>, gearbox::motion::GearboxRun) {
    let start = mechanism.start(0.01).unwrap();
    let plan = steps(scheme, [cycles, steps_per_cycle]);
    let mut rows = Vec::new();
    let run = mechanism.run(&start, &plan, |instant| {
        rows.push(instant.clone());
    });
    (rows, run.unwrap())
}

/// Work of input and output is stored or taken by dampers, at given speed, up and down a ramp of it, and under a given
/// torque, either way round;
/// and the input's work by its ledger is that of its torque at every instant.
#[test]
fn energy_of_a_train_of_two_stages_is_accounted_for() {
    let speed = 100.0;
    let along =
        |from: f64, to: f64| Drive::Speed(Speed::Ramp { from, to, start: 0.0, duration: 30.0 / 17.0 * TAU / speed });
    for (drive, sense) in [
        (along(40.0, 160.0), Sense::Ccw),
        (along(160.0, 40.0), Sense::Cw),
        (Drive::Speed(Speed::Constant(speed)), Sense::Ccw),
        (Drive::Speed(Speed::Constant(speed)), Sense::Cw),
        (Drive::Torque { start: speed, torque: None }, Sense::Ccw),
        (Drive::Torque { start: speed, torque: Some(1.1 * OUTPUT * 17.0 * 19.0 / 53.0 / 47.0) }, Sense::Cw),
    ] {
        let mut mechanism = train(drive, sense, 0.004);
        let (rows, done) = run(&mut mechanism, Scheme::Energy, 30, 60);
        let energy = done.energy;
        let said = format!("{drive:?}, {sense:?}: {energy:?}");
        assert!(energy.relative_residual.abs() < 1e-9, "{said}");
        assert!(energy.output_work < 0.0 && energy.dissipated > 0.0, "{said}");
        // On the way down the train drives the input.
        let ramp = if let Drive::Speed(Speed::Ramp { from, to, .. }) = drive { Some([from, to]) } else { None };
        assert!(energy.input_work > 0.0 || ramp.is_some_and(|[from, to]| to < from), "{said}");
        assert!(energy.shafts > 0.0 && energy.supports > 0.0 && energy.meshes > 0.0 && energy.kinetic > 0.0, "{said}");
        let power = |p: &GearboxInstant| p.input_torque * p.input[1];
        let work: f64 = rows.windows(2).map(|w| 0.5 * (power(&w[0]) + power(&w[1])) * (w[1].time - w[0].time)).sum();
        // Trapezoids on 60 rows a cycle, with the ripple of both meshes in the torque.
        let turnover = if ramp.is_some() { energy.kinetic } else { 0.0 };
        let off = (work - energy.input_work) / energy.input_work.abs().max(turnover);
        assert!(off.abs() < 2e-3, "{work} beside {said}");
        if let Some([_, to]) = ramp {
            let turned = rows[rows.len() - 1].input[0].abs() / TAU * 17.0;
            assert!((turned - 30.0).abs() < 1e-9, "{turned} cycles, {said}");
            let last = rows[rows.len() - 1].input[1].abs();
            assert!((last / to - 1.0).abs() < 1e-9, "{last} rad/s at the end of a ramp to {to}");
        }
        let out: f64 = rows
            .windows(2)
            .map(|w| 0.5 * (w[0].output_speeds[0] + w[1].output_speeds[0]) * (w[1].time - w[0].time))
            .sum();
        let of_load = -(sense.sign() as f64) * OUTPUT * out;
        let off = of_load / energy.output_work - 1.0;
        assert!(off.abs() < 1e-3, "{of_load} beside {said}");
    }
}

/// With generalised-alpha, what does not close falls with the square of the step.
#[test]
fn the_energy_residual_of_generalised_alpha_falls_with_the_square_of_the_step() {
    let residual = |steps: u64| {
        let mut mechanism = train(Drive::Speed(Speed::Constant(100.0)), Sense::Ccw, 0.0);
        run(&mut mechanism, Scheme::GeneralisedAlpha { rho: 0.9 }, 10, steps).1.energy.relative_residual.abs()
    };
    let [coarse, fine] = [residual(200), residual(400)];
    assert!(fine < 1e-4, "{coarse:.1e}, {fine:.1e}");
    assert!(fine < 0.35 * coarse, "{coarse:.1e}, {fine:.1e}");
}

/// The phases of both meshes count the teeth that have gone through, in either sense, driven by speed or by torque: 17
/// a turn of the input at the first mesh and 17/53 19 at the second.
#[test]
fn phases_in_motion_are_those_counted_by_hand() {
    for drive in [Drive::Speed(Speed::Constant(150.0)), Drive::Torque { start: 150.0, torque: None }] {
        for sense in [Sense::Ccw, Sense::Cw] {
            let mut mechanism = train(drive, sense, 0.0);
            let (rows, _) = run(&mut mechanism, Scheme::Energy, 20, 30);
            let (first, last) = (&rows[0], &rows[rows.len() - 1]);
            let turns = (last.input[0] - first.input[0]) / TAU * sense.sign() as f64;
            assert!((turns - 20.0 / 17.0).abs() < 0.01, "{turns} turns of the input");
            for (mesh, teeth) in [17.0, 17.0 / 53.0 * 19.0].into_iter().enumerate() {
                let gone = last.meshes[mesh].cycles - first.meshes[mesh].cycles;
                assert!((gone - turns * teeth).abs() < 1e-9, "mesh {mesh}: {gone} beside {}", turns * teeth);
            }
            let ratio = last.output_speeds[0] / last.input[1];
            let wanted = 17.0 * 19.0 / 53.0 / 47.0;
            assert!((ratio / wanted - 1.0).abs() < 0.02, "{ratio} beside {wanted}");
        }
    }
}

/// What the input's acceleration has the meshes accelerate: gears and shafts behind it, by the squares of their ratios.
#[test]
fn the_inertia_behind_the_input_is_that_of_discs_and_shafts() {
    let mechanism = train(Drive::Speed(Speed::Constant(150.0)), Sense::Ccw, 0.0);
    let (structure, _) = heavy();
    let ratios = [0.0, 17.0 / 53.0, 17.0 / 53.0 * 19.0 / 47.0];
    let shafts = [35.0_f64, 50.0].map(|d| Material::STEEL.density_t_per_mm3() * 200.0 * PI * d.powi(4) / 32.0);
    let discs = structure.discs.iter().map(|d| d.polar_inertia * ratios[d.shaft] * ratios[d.shaft]);
    let wanted = discs.sum::<f64>() + shafts[0] * ratios[1] * ratios[1] + shafts[1] * ratios[2] * ratios[2];
    let found = mechanism.driven_inertia();
    assert!((found / wanted - 1.0).abs() < 1e-9, "{found} t mm^2, by hand {wanted}");
}

/// Amplitudes of a signal over one whole period, by orders.
fn amplitude(samples: &[f64], order: usize) -> f64 {
    let n = samples.len();
    let sum = |of: fn(f64) -> f64| -> f64 {
        samples.iter().enumerate().map(|(i, x)| x * of(TAU * ((order * i) % n) as f64 / n as f64)).sum()
    };
    2.0 * sum(f64::cos).hypot(sum(f64::sin)) / n as f64
}

/// One wrong tooth of gear 2 meets its mate once a turn of the middle shaft: the forces of both meshes then have the
/// frequency of that shaft, and lines beside their mesh frequencies at distances of it. With all teeth alike they have
/// none of them. The transmission error of the first mesh has the tooth's own share at the shaft's frequency.
#[test]
fn a_pitch_error_on_the_middle_shaft_shows_at_its_frequency_at_both_meshes() {
    let wrong_by = 0.01;
    let spectra = |error: f64| {
        let mut mechanism = train(Drive::Speed(Speed::Constant(60.0)), Sense::Ccw, error);
        // 53 cycles of the first mesh are a turn of the middle shaft: three to settle, as dampers feel what is left of the start
        // by its speed, one to look at.
        let (rows, _) = run(&mut mechanism, Scheme::Energy, 4 * 53, 40);
        let turn = &rows[rows.len() - 1 - 53 * 40..rows.len() - 1];
        let force = |mesh: usize| turn.iter().map(|r| r.meshes[mesh].normal_force).collect::<Vec<_>>();
        ([force(0), force(1)], turn.iter().map(|r| r.meshes[0].transmission_error).collect::<Vec<_>>())
    };
    let ((wrong, lag), (right, _)) = (spectra(wrong_by), spectra(0.0));
    for (mesh, teeth) in [53, 19].into_iter().enumerate() {
        let mean = right[mesh].iter().sum::<f64>() / right[mesh].len() as f64;
        for order in [1, 2, teeth - 1, teeth + 1] {
            let [with, without] = [&wrong, &right].map(|all| amplitude(&all[mesh], order) / mean);
            assert!(with > 1e3 * without, "mesh {mesh}, order {order} of the shaft: {with:.1e} beside {without:.1e}");
        }
        let [own, none] = [teeth, 1].map(|order| amplitude(&right[mesh], order) / mean);
        assert!(own > 1e3 * none, "mesh {mesh} at its mesh frequency: {own:.1e} beside {none:.1e}");
        let sideband = amplitude(&wrong[mesh], teeth + 1) / mean;
        assert!(sideband > 1e-6, "mesh {mesh} beside its mesh frequency: {sideband:.1e}");
    }
    // The tooth counts for a cycle of 53: 2 e/53 at the first order, on the transverse line of action.
    let helix = pair([17, 53], 15.0).base_helix_angle();
    let (found, wanted) = (amplitude(&lag, 1), 2.0 * wrong_by / 53.0 / helix.cos());
    // What little the shafts turn against each other is the rest.
    assert!((found / wanted - 1.0).abs() < 0.02, "{found:.3e} mm beside {wanted:.3e} mm");
}

/// Few coordinates show the natural frequencies of all nodes, those far below the limit the better.
#[test]
fn reduced_shafts_have_the_natural_frequencies_of_the_whole() {
    let (structure, _) = heavy();
    let assembly = gearbox::Assembly::new(structure).unwrap();
    let reduced = |hz: f64| {
        let bodies = gearbox::motion::ReducedBodies::new(&assembly, &[false; 3], 2.0 * PI * hz).unwrap();
        *bodies.certificate()
    };
    let [low, high] = [reduced(3000.0), reduced(12_000.0)];
    assert!(low.compared > 10 && high.compared > low.compared, "{low:?}, {high:?}");
    assert!(high.modes > low.modes && high.coordinates[1] < high.coordinates[0], "{low:?}, {high:?}");
    // Modes that are left out begin at twice the limit; their share falls with the fourth power of the distance.
    assert!(low.error < 5e-3 && high.error < 2e-2, "{low:?}, {high:?}");
}

/// A bearing that holds its shaft's turn is refused by name, a speed that is none by its value.
#[test]
fn what_cannot_run_is_refused() {
    let (mut structure, meshes) = heavy();
    let options =
        |speed: f64| MotionOptions { drive: Drive::Speed(Speed::Constant(speed)), modal_damping: 0.0, limit: 1e4 };
    let made = |structure: &Structure, options: &MotionOptions| {
        let operation = loaded(structure, Sense::Ccw);
        GearboxMechanism::new(structure.clone(), meshes.clone(), operation, options, |_, mesh, meshing| {
            Ok(Box::new(SpringMesh::new(mesh, meshing, Fourier::constant(1e5))?))
        })
    };
    assert!(made(&structure, &options(f64::NAN)).is_err());
    assert!(made(&structure, &options(10.0)).is_ok());
    structure.bearings[1].stiffness[(5, 5)] = 1.0;
    let refused = made(&structure, &options(10.0));
    assert!(matches!(refused.err(), Some(gearbox::GearboxError::HeldTurn { bearing }) if bearing == "0 loose"));
}
