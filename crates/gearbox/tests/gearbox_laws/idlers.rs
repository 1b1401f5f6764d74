//! Laws of a gear in two meshes: what its shaft bears, its root stress, power.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::{
    f64::consts::{PI, TAU},
    sync::Arc,
};

use ale::Station;
use gearbox::{
    Disc, ExactMesh, GearMesh, MeshElement, Operation, StaticGearbox, Structure, Torque,
    motion::{Drive, GearboxMechanism, MotionOptions, MovingExactMesh, Speed},
};
use geometry::{GearPair, Sense};
use integrate::Scheme;
use ltca::{FilletStress, StaticModel};
use nalgebra::{Rotation3, Vector3};
use reduction::ElasticGear;

use crate::pairs::{bearing, operation, options, pair, reduced, shaft, springs};

/// Torque of the output, N mm.
const TORQUE: f64 = 1.5e5;
/// Cycles of both meshes a turn of the input.
const TEETH: f64 = 20.0;

/// Pinion, idler and wheel with the wheel at a direction from the idler's axis. Discs: 0 to 2 the gears, 3 input, 4 output.
pub fn row(direction: f64, helix_deg: f64, held: bool) -> (Structure, Vec<GearMesh>, Operation) {
    let pairs = [pair([20, 31], helix_deg), pair([31, 23], -helix_deg)];
    let [a, b] = [0, 1].map(|i| pairs[i].centre_distance());
    let far = [a + b * direction.cos(), b * direction.sin(), 0.0];
    let both = |s: usize| [(20.0, 1e5), (80.0, 0.0)].map(|(z, axial)| bearing(&format!("{s} at {z}"), s, z, axial));
    let structure = Structure {
        shafts: vec![
            shaft("in", [0.0; 3], 100.0, 30.0),
            shaft("idler", [a, 0.0, 0.0], 100.0, 30.0),
            shaft("out", far, 100.0, 30.0),
        ],
        discs: [("pinion", 0, 50.0), ("idler", 1, 50.0), ("wheel", 2, 50.0), ("input", 0, 0.0), ("output", 2, 100.0)]
            .map(|(name, s, z)| Disc::ring(name, s, z, [60.0, 30.0], 20.0, 7.85e-9))
            .into(),
        bearings: (0..3).flat_map(both).collect(),
        ..Structure::default()
    };
    let mut run = operation(&structure, 3, Sense::Ccw, vec![Torque { disc: 4, torque: -TORQUE }]);
    if held {
        run.held = vec![0, 1, 2];
    }
    let mesh = |(discs, pair): ([usize; 2], GearPair)| GearMesh { name: format!("{discs:?}"), discs, pair };
    (structure, [[0, 1], [1, 2]].into_iter().zip(pairs).map(mesh).collect(), run)
}

/// The gearbox with exact contacts and root stress, and the gears of its meshes.
fn exact(
    (structure, meshes, run): (Structure, Vec<GearMesh>, Operation),
) -> (StaticGearbox, Vec<Arc<[ElasticGear; 2]>>) {
    let mut gears = Vec::new();
    let made = StaticGearbox::new(structure, meshes, run, |_, mesh, meshing| {
        let own = options(&mesh.pair, meshing, TORQUE);
        let both = reduced(&mesh.pair, &own);
        gears.push(Arc::clone(&both));
        let own = ltca::StaticOptions { root_stress: true, ..own };
        Ok(Box::new(ExactMesh::new(mesh.pair.clone(), both, own)?) as Box<dyn MeshElement>)
    });
    (made.unwrap_or_else(|e| panic!("{e}")), gears)
}

/// Both meshes of an idler press it with the same torque, against each other, and its shaft bears the sum of their forces as
/// vectors.
///
/// ```text
/// F = T/r_b [R(-a_1) e_y + R(phi + a_2) e_y]      a: working pressure angles, phi: direction from the idler to the wheel
/// ```
/// Of springs along the line of action to 1e-9. Of the exact contact on shafts that bend bearings and meshes balance to 1e-9,
/// and axes that give way lean the forces by a part of a per cent.
#[test]
fn an_idlers_shaft_bears_the_vector_sum_of_both_meshes() {
    for (direction, helix_deg) in [(0.0, 0.0), (PI / 3.0, 15.0), (-2.0, -12.0)] {
        // Springs along the line of action: it is that of the geometry alone.
        let (structure, meshes, run) = row(direction, helix_deg, true);
        let pairs = [meshes[0].pair.clone(), meshes[1].pair.clone()];
        let found = StaticGearbox::new(structure, meshes, run, springs).unwrap().solve(0.3).unwrap();
        let torque = TORQUE * 31.0 / 23.0;
        let base = pairs[0].wheel.base_radius();
        let normal = torque / (base * pairs[0].base_helix_angle().cos());
        for mesh in &found.meshes {
            assert!((mesh.normal_force / normal - 1.0).abs() < 1e-12, "{} beside {normal} N", mesh.normal_force);
        }
        // The pinion pushes the idler along +y of their line of centres, leaned away from itself; the wheel, which the idler
        // pushes along -y of theirs, pushes back.
        let turned = |angle: f64| Rotation3::from_axis_angle(&Vector3::z_axis(), angle) * Vector3::y();
        let lean = pairs.each_ref().map(GearPair::working_pressure_angle);
        let [pushed, back] = [turned(-lean[0]), turned(direction + lean[1])];
        let transverse = torque / base;
        let wanted = transverse * (pushed + back);
        let on_idler = Vector3::from(found.meshes[0].force[1]) + Vector3::from(found.meshes[1].force[0]);
        assert!((on_idler - wanted).norm() < 1e-9 * transverse, "{direction}: {on_idler:?} beside {wanted:?} N");
        // Axial forces cancel: both are F_bt tan b_b, against each other.
        assert!(on_idler.z.abs() < 1e-12 * normal, "{} N along the axis", on_idler.z);
        let held = found.held_reactions[1].unwrap();
        (0..3).for_each(|k| assert!((held[k] + on_idler[k]).abs() < 1e-9 * normal, "reaction {k}"));

        // The exact contact on shafts that bend.
        let (mut gearbox, _) = exact(row(direction, helix_deg, false));
        for angle in [0.0, 0.1, 0.25] {
            let found = gearbox.solve(angle).unwrap_or_else(|e| panic!("{e}"));
            assert!(found.certificate.body_balance < 1e-9, "{:?}", found.certificate);
            let on_idler = Vector3::from(found.meshes[0].force[1]) + Vector3::from(found.meshes[1].force[0]);
            let moment = found.meshes[0].moment[1][2] + found.meshes[1].moment[0][2];
            let borne: Vector3<f64> = found.bearings[2..4].iter().map(|b| Vector3::from(b.force)).sum();
            assert!((borne + on_idler).norm() < 1e-9 * normal, "{angle}: {:?} N left over", borne + on_idler);
            assert!(moment.abs() < 1e-9 * torque, "{angle}: {moment} N mm left over");
            // Axes that give way lean the forces: a part of a per cent.
            assert!((on_idler - wanted).norm() < 0.02 * transverse, "{on_idler:?} beside {wanted:?} N");
        }
    }
}

/// Fillets of both sides: largest first and smallest third principal stress, MPa.
fn extremes<'a>(fillets: impl Iterator<Item = &'a FilletStress>) -> [[f64; 2]; 2] {
    let mut found = [[0.0f64; 2]; 2];
    for fillet in fillets {
        let own = &mut found[usize::from(fillet.side == geometry::Side::Left)];
        *own = [own[0].max(fillet.max_principal.stress), own[1].min(fillet.min_principal.stress)];
    }
    found
}

/// Root stress in a gearbox is that of the pairs alone under the torques that they have there, fillet by fillet; the fillets
/// on both sides of an idler's teeth are in tension by one of its meshes, and in compression by the other one.
#[test]
fn an_idlers_fillets_are_bent_both_ways() {
    let (mut gearbox, gears) = exact(row(PI / 3.0, 15.0, true));
    let meshing: Vec<_> = gearbox.train().meshing().to_vec();
    let (_, meshes, _) = row(PI / 3.0, 15.0, true);
    let mut of_idler = [[[0.0f64; 2]; 2]; 2];
    for k in 0..8 {
        let angle = TAU / TEETH * f64::from(k) / 8.0;
        let found = gearbox.solve(angle).unwrap_or_else(|e| panic!("{e}"));
        for (i, own) in found.meshes.iter().enumerate() {
            let pair = &meshes[i].pair;
            let driven = usize::from(meshing[i].driver == geometry::Driver::Pinion);
            let torque = own.moment[driven][2].abs();
            let alone = ltca::StaticOptions { root_stress: true, ..options(pair, &meshing[i], torque) };
            let mut alone = StaticModel::new(pair.clone(), Arc::clone(&gears[i]), alone).unwrap();
            // The idler lags behind its nominal turn by what the first mesh gives way.
            let behind = meshing[i].sense.sign() as f64 * own.displacements[5] / pair.pinion.pitch_angle();
            let station = Station::at_cycles((own.cycles + behind).rem_euclid(1.0));
            let wanted = alone.advance(station, |_| ()).unwrap();
            for end in 0..2 {
                let peaks: Vec<FilletStress> = own.root_stress[end].iter().map(|field| field.peaks).collect();
                assert_eq!(peaks.len(), wanted.root_stress[end].len());
                let [found, wanted] = [extremes(peaks.iter()), extremes(wanted.root_stress[end].iter())];
                for (a, b) in found.as_flattened().iter().zip(wanted.as_flattened()) {
                    assert!(
                        (a / b - 1.0).abs() < 1e-9,
                        "mesh {i}, gear {end}, {angle}: {found:?} beside {wanted:?} MPa"
                    );
                }
                if end == 1 - i {
                    let all = of_idler[i].as_flattened_mut().iter_mut().zip(found.as_flattened());
                    all.for_each(|(most, now)| {
                        if now.abs() > most.abs() {
                            *most = *now
                        }
                    });
                }
            }
        }
    }
    println!("right and left fillets of the idler by the first and the second mesh: {of_idler:?} MPa");
    let [first, second] = of_idler;
    // Counter-clockwise pinion: it presses the right flanks of the idler, which presses the wheel with its left ones.
    for (bent, back) in [([first, second], 0), ([second, first], 1)] {
        let [tension, compression] = [bent[0][back][0], bent[1][back][1]];
        let ratio = compression / tension;
        println!("R of one side by peaks: {ratio:.3}");
        assert!(tension > 0.0 && (-1.5..-0.9).contains(&ratio), "{tension} and {compression} MPa");
    }
}

/// What goes in comes out: elastic gears and shafts come back after a cycle of both meshes, so that the mean torque of the
/// input over it is that of the load by the teeth of pinion and wheel, whatever idler is between.
#[test]
fn the_power_of_an_idler_passes_through() {
    let (mut gearbox, _) = exact(row(1.0, 15.0, false));
    let ratio = gearbox.train().ratios()[2];
    assert!((ratio - TEETH / 23.0).abs() < 1e-15, "{ratio}");
    let mut off = |count: u32| {
        let at = |k: u32| gearbox.solve(TAU / TEETH * f64::from(k) / f64::from(count)).unwrap().input_torque;
        (0..count).map(at).sum::<f64>() / f64::from(count) / (TORQUE * ratio) - 1.0
    };
    let [few, many] = [16, 64].map(&mut off);
    println!("mean torque off by {few:.1e} of 16 positions, {many:.1e} of 64");
    // Trapezoids over slices that come into contact one by one.
    assert!(many.abs() < 1e-5, "{many:e}");
}

/// In motion, too: work of the input is that of the output and of the dampers, to 1e-9 of the energy that comes and goes, and
/// the idler's bearings bear the sum of both meshes but for its inertia; at a hundredth of a turn a second that is nothing.
#[test]
fn an_idler_in_motion_keeps_energy_and_balance() {
    let parts = row(1.0, 15.0, false);
    let (mut rest, gears) = exact(parts.clone());
    let run = |speed: f64, scheme: Scheme, cycles: u64| {
        let options =
            MotionOptions { drive: Drive::Speed(Speed::Constant(speed)), modal_damping: 0.02, limit: TAU * 4000.0 };
        let (structure, meshes, run) = parts.clone();
        let mut mechanism = GearboxMechanism::new(structure, meshes, run, &options, |i, mesh, meshing| {
            let own = crate::pairs::options(&mesh.pair, meshing, TORQUE);
            Ok(Box::new(MovingExactMesh::new(mesh.pair.clone(), Arc::clone(&gears[i]), None, &own, 0.01)?))
        })
        .unwrap();
        let start = mechanism.start(options.modal_damping).unwrap();
        let mut rows = Vec::new();
        let plan = crate::motion::steps(scheme, [cycles, 40]);
        let done = mechanism.run(&start, &plan, |instant| rows.push(instant.clone())).unwrap();
        (rows, done)
    };
    let (_, done) = run(150.0, Scheme::Energy, 4);
    assert!(done.energy.relative_residual.abs() < 1e-6, "{:?}", done.energy);
    let (rows, _) = run(0.06, Scheme::GeneralisedAlpha { rho: 0.0 }, 1);
    for row in &rows {
        let borne: Vector3<f64> = row.bearings[2..4].iter().map(|b| Vector3::from(b.force)).sum();
        let on = |mesh: usize, at: usize| Vector3::from_fn(|k, _| row.meshes[mesh].wrench[at + k]);
        let left = borne + on(0, 6) + on(1, 0);
        let size = row.meshes[0].normal_force;
        assert!(left.norm() < 1e-4 * size, "{}: {left:?} of {size} N left over", row.time);
        let still = rest.solve(row.input[0]).unwrap();
        for (a, b) in row.meshes.iter().zip(&still.meshes) {
            let off = (a.transmission_error - b.transmission_error).abs() / b.transmission_error.abs();
            assert!(off < 1e-3, "{}: {} beside {} mm", row.time, a.transmission_error, b.transmission_error);
        }
    }
}
