//! Friction on maps of the contact, beside the contact itself.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::{f64::consts::TAU, sync::Arc};

use contact::FlankProjection;
use dynamics::{MeshFlanks, MotionOptions as PairOptions};
use gearbox::{
    ExactMesh, GearboxError, MeshElement, Meshing, Operation, StaticGearbox, Torque, Vector12,
    motion::{
        Drive, GearboxInstant, GearboxMechanism, GearboxRun, MapRequest, MappedMesh, MotionOptions, MovingExactMesh,
        MovingMesh, Speed,
    },
};
use geometry::{GearPair, Sense};
use integrate::{Forces, Mechanism, OnlyRows, Row, Scheme, State};
use ltca::StaticOptions;
use mesh::Extent;
use nalgebra::{DVector, SMatrix};
use reduction::ElasticGear;
use testing::{
    moving::{MovingPair, machine, started},
    of_order, planet_in_ring,
};

use crate::{
    motion_flanks::{both_flanks, two_stage_box},
    pairs::{pair, reduced},
};

const FRICTION: f64 = 0.06;
const FORCE: f64 = 3000.0;
const DEFLECTION_MM: f64 = 0.012;

/// A pair with flanks on both sides, driven in a sense.
struct Rubbing {
    pair: GearPair,
    options: StaticOptions,
    gears: Arc<[ElasticGear; 2]>,
}

impl Rubbing {
    fn new(helix_deg: f64, sense: Sense, friction: f64) -> Self {
        let pair = pair([23, 31], helix_deg);
        let options = StaticOptions::new(1e5, &pair).with_contact(|c| {
            (c.sense, c.friction, c.slices) = (sense, friction, 16);
        });
        let gears = reduced(&pair, &options.clone().with_contact(|c| c.both_flanks = true));
        Self { pair, options, gears }
    }

    fn flanks(&self) -> MeshFlanks {
        let coast = Some(Arc::clone(&self.gears));
        MeshFlanks::new(&self.pair, Arc::clone(&self.gears), coast, &self.options, 0.0).unwrap()
    }

    fn exact(&self) -> MovingExactMesh {
        let coast = Some(Arc::clone(&self.gears));
        MovingExactMesh::new(self.pair.clone(), Arc::clone(&self.gears), coast, &self.options, 0.0).unwrap()
    }

    /// What displacements do to the driving and to the coast flanks.
    fn projections(&self) -> [FlankProjection; 2] {
        let all: Vec<_> = self.flanks().mapped_sides(&self.pair).map(|(projection, _)| projection).collect();
        [all[0], all[1]]
    }

    fn mapped(&self, tilts: bool, tolerance: f64) -> MappedMesh {
        let stands = vec![self.projections()[0].displacement(DEFLECTION_MM, 0.0)];
        let worst = 10.0 * tolerance;
        let request =
            MapRequest { stands, coast_stands: Vec::new(), tilts, mean_force: FORCE, overload: 3.0, tolerance, worst };
        MappedMesh::new(&self.flanks(), &self.pair, &request, &|_| {}).unwrap_or_else(|e| panic!("{e}"))
    }
}

/// Forces of all, and of friction alone, at a place.
fn forces(mesh: &mut dyn MovingMesh, cycles: f64, d: &Vector12) -> [Vector12; 2] {
    mesh.begin_at(cycles).unwrap();
    mesh.go_to(cycles).unwrap();
    let all = mesh.evaluate(d).unwrap().force;
    [all, mesh.losses(&Vector12::zeros(), 0.0).friction]
}

/// The largest force (N), and the largest moment over a length of 40 mm, as far as the gears' radii.
fn size(f: &Vector12) -> f64 {
    (0..12).map(|i| if i % 6 < 3 { f[i].abs() } else { f[i].abs() / 40.0 }).fold(0.0, f64::max)
}

fn rms(values: &[f64]) -> f64 {
    (values.iter().map(|x| x * x).sum::<f64>() / values.len() as f64).sqrt()
}

/// All forces and moments of friction, and all of the mesh, at phases, loads and tilts of a spur and a helical pair, in
/// either sense, on driving and on coast flanks: to the error that the map tells of itself.
#[test]
fn friction_on_a_map_is_that_of_the_contact() {
    let all = [(12.0, Sense::Ccw, true), (0.0, Sense::Cw, true), (0.0, Sense::Ccw, false), (12.0, Sense::Cw, true)];
    for (helix, sense, tilts) in all.into_iter().take(testing::cases(3, 4)) {
        let own = Rubbing::new(helix, sense, FRICTION);
        let mut mapped = own.mapped(tilts, 2e-3);
        let maps: Vec<_> = mapped.maps().cloned().collect();
        for (side, (map, projection)) in maps.iter().zip(own.projections()).enumerate() {
            let told = map.certificate();
            let (friction, approach) =
                (told.friction.expect("there is friction"), told.rms_error_mm / told.deflection_mm);
            let [mut off, mut of_all, mut mean] = [Vec::new(), Vec::new(), Vec::new()];
            for i in 0..64 {
                let cycles = 0.0817 * f64::from(i);
                let tilt = if tilts { 1e-4 * (1.7 * f64::from(i)).sin() } else { 0.0 };
                let force = FORCE * (0.4 + 0.02 * f64::from(i));
                let d = projection.displacement(map.approach(cycles, tilt, force), tilt);
                let [all, rubs] = forces(&mut own.exact(), cycles, &d);
                let [all_mapped, rubs_mapped] = forces(&mut mapped, cycles, &d);
                off.push(size(&(rubs - rubs_mapped)) / force.max(FORCE));
                // Without tilts nothing is told of moments over the face.
                let turns = |f: Vector12| {
                    if tilts { f } else { Vector12::from_fn(|i, _| if matches!(i % 6, 3 | 4) { 0.0 } else { f[i] }) }
                };
                of_all.push(size(&turns(all - all_mapped)) / FORCE);
                mean.push(size(&rubs) / FORCE);
            }
            let [off, of_all, mean] = [off, of_all, mean].map(|x| rms(&x));
            println!(
                "helix {helix}, {sense:?}, side {side}: friction {mean:.1e} of the force, off by {off:.1e} (told {:.1e}); \
                 all off by {of_all:.1e} (told {approach:.1e}); {} phases, {} contacts",
                friction.rms, told.phases, told.contacts
            );
            assert!(off < 2.0 * friction.rms, "friction is off by {off:e}, told is {:e}", friction.rms);
            assert!(off < 0.1 * mean, "friction is off by {off:e} of a force, and {mean:e} of it");
            assert!(of_all < 3.0 * approach + 2.0 * friction.rms, "forces are off by {of_all:e}, told is {approach:e}");
        }
    }
}

/// Friction of both gears as force along the sliding and moments along the path of contact and over the face.
fn parts(projection: &FlankProjection, friction: &Vector12) -> [f64; 3] {
    let levers = SMatrix::<f64, 12, 3>::from_columns(&projection.friction);
    let found = (levers.tr_mul(&levers)).try_inverse().unwrap() * levers.tr_mul(friction);
    assert!((levers * found - friction).norm() < 1e-9 * friction.norm(), "friction has no more than three parts");
    [found[0], found[1], found[2]]
}

/// On one place of the same flanks friction turns round with the sense of rotation: on the coast flanks of a pair it is
/// against that of the pair that drives on them. In either sense and on either side it takes power of the nominal turn.
#[test]
fn friction_turns_round_with_the_sense() {
    let [ccw, cw] = [Sense::Ccw, Sense::Cw].map(|sense| Rubbing::new(12.0, sense, FRICTION));
    let [mut on_coast, mut driving] = [&ccw, &cw].map(|own| own.mapped(false, 1e-3));
    let (of_coast, of_driving) = (ccw.projections()[1], cw.projections()[0]);
    let coast = on_coast.maps().nth(1).unwrap().clone();
    let front = driving.maps().next().unwrap().clone();
    // The place of the pinion in the cycles of either sense.
    let angle = |own: &Rubbing, cycles: f64| own.exact().gear_angles(cycles)[0];
    let (zero, pitch) = ([&ccw, &cw].map(|own| angle(own, 0.0)), ccw.pair.pinion.pitch_angle());
    let [mut off, mut size] = [0.0f64; 2];
    for i in 0..40 {
        let (cycles, force) = (0.131 * f64::from(i), FORCE * (0.5 + 0.02 * f64::from(i)));
        let there = (zero[1] - zero[0]) / pitch - cycles;
        let d = [
            of_coast.displacement(coast.approach(cycles, 0.0, force), 0.0),
            of_driving.displacement(front.approach(there, 0.0, force), 0.0),
        ];
        let [a, b] = [forces(&mut on_coast, cycles, &d[0])[1], forces(&mut driving, there, &d[1])[1]];
        let [own, other] = [parts(&of_coast, &a), parts(&of_driving, &b)];
        for (k, length) in [1.0, 6.0, 10.0].into_iter().enumerate() {
            off = off.max((own[k] + other[k]).abs() / length / force);
            size = size.max(own[k].abs() / length / force);
        }
        for (mesh, cycles, d) in [(&mut on_coast, cycles, &d[0]), (&mut driving, there, &d[1])] {
            forces(mesh, cycles, d);
            let power = mesh.losses(&Vector12::zeros(), 100.0).dissipated;
            assert!(power > 0.0, "friction gives {power} mW");
        }
        assert!(own[1] < 0.0 && other[1] > 0.0, "against the turn of the pinion: {own:?}, {other:?}");
    }
    println!("off by {off:.1e} of the force, friction {size:.1e}");
    // What friction itself does to the sharing of the load is of second order.
    assert!(off < 0.08 * size, "off by {off:e} of {size:e}");
}

/// The mirror image of a pair, of the other hand and driven the other way round, has the mirror image of its friction.
#[test]
fn the_mirror_image_has_mirrored_friction() {
    let [own, image] =
        [(12.0, Sense::Ccw), (-12.0, Sense::Cw)].map(|(helix, sense)| Rubbing::new(helix, sense, FRICTION));
    let [mut a, mut b] = [&own, &image].map(|own| own.mapped(true, 5e-3));
    let map = a.maps().next().unwrap().clone();
    // x -> x, y -> -y, z -> z: of turns those about y stay.
    let mirrored = |d: &Vector12| Vector12::from_fn(|i, _| if matches!(i % 6, 1 | 3 | 5) { -d[i] } else { d[i] });
    for i in 0..20 {
        let (cycles, tilt) = (0.217 * f64::from(i), 5e-5 * f64::from(i % 5 - 2));
        let d = own.projections()[0].displacement(map.approach(cycles, tilt, FORCE), tilt);
        let [all, rubs] = forces(&mut a, cycles, &d);
        let [of_image, image_rubs] = forces(&mut b, cycles, &mirrored(&d));
        let [off, off_rubs] = [all - mirrored(&of_image), rubs - mirrored(&image_rubs)].map(|f| size(&f) / FORCE);
        assert!(off < 1e-6 && off_rubs < 1e-6, "at {cycles}: off by {off:e}, friction by {off_rubs:e}");
    }
}

/// The tangent is that of the forces, friction among them, and no friction at all is the mesh without friction bit by bit.
#[test]
fn the_tangent_has_friction() {
    let own = Rubbing::new(12.0, Sense::Ccw, FRICTION);
    let mut mapped = own.mapped(true, 5e-3);
    let map = mapped.maps().next().unwrap().clone();
    let d = own.projections()[0].displacement(map.approach(0.3, 4e-5, FORCE), 4e-5);
    mapped.go_to(0.3).unwrap();
    let tangent = mapped.evaluate(&d).unwrap().tangent;
    let mut off = 0.0f64;
    for i in 0..12 {
        let h = if i % 6 < 3 { 1e-6 } else { 2e-8 };
        let mut at = |sign: f64| {
            let mut there = d;
            there[i] += sign * h;
            mapped.evaluate(&there).unwrap().force
        };
        let slope = (at(1.0) - at(-1.0)) / (2.0 * h);
        let unit = if i % 6 < 3 { 1.0 } else { 40.0 };
        off = off.max(size(&(slope - tangent.column(i))) / unit);
    }
    let largest =
        (0..12).map(|i| size(&tangent.column(i).into_owned()) / if i % 6 < 3 { 1.0 } else { 40.0 }).fold(0.0, f64::max);
    assert!(off < 1e-6 * largest, "off by {off:e} of {largest:e}");
    // A map of friction 0 is the map without.
    let [mut smooth, mut none] =
        [0.0, -0.0].map(|friction| Rubbing::new(12.0, Sense::Ccw, friction).mapped(true, 5e-3));
    assert!(smooth.by_levers().is_some() && mapped.by_levers().is_none());
    assert_eq!(smooth.maps().next().unwrap(), none.maps().next().unwrap());
    assert!(smooth.maps().all(|map| !map.has_friction() && map.certificate().friction.is_none()));
    none.go_to(0.3).unwrap();
    assert_eq!(none.losses(&Vector12::zeros(), 10.0).dissipated, 0.0);
}

/// A pair with friction on maps, of external gears and with a ring: forces on its coordinates and the power that friction
/// takes are those of the contact; and on the map they are in the ledger.
#[test]
fn a_pair_on_a_map_rubs_as_the_contact() {
    let external = testing::generated(20.0, [2, 2, 2, 2, 1]);
    let ring = of_order(1, planet_in_ring(15.0), None, 300e3, [2, 2, 2, 2, 1], Extent::Whole);
    for case in [external, ring] {
        let contact = case.slice_options();
        let bench = MovingPair::new(case, contact, 8);
        let rough = |o: &mut PairOptions| o.statics.contact.friction = FRICTION;
        let system = bench.system(1000.0, rough);
        let request = system.map_request(4.0, [1e-3, 1e-2]).unwrap();
        let mesh = MappedMesh::new(system.flanks().unwrap(), system.pair(), &request, &|_| {}).unwrap();
        let mut map = machine(&system.on_map(mesh));
        let [mut off, mut off_power] = [0.0f64; 2];
        for i in 0..12 {
            let (t, share) = (4e-5 * f64::from(i), 0.7 + 0.05 * f64::from(i));
            let (mut exact, start) = started(&system, t);
            let (q, v) = (start.q * share, DVector::from_element(1, 1e-5));
            let ask = |machine: &mut GearboxMechanism| {
                let mut out = Forces::zeros(1);
                machine.forces(t, &q, &v, &mut out).unwrap();
                out
            };
            let [a, b] = [ask(&mut exact), ask(&mut map)];
            let force = a.conservative[0].abs();
            let power = force * bench.speed(1000.0) * bench.case.pair.pinion.base_radius();
            off = off.max((a.conservative[0] + a.other[0] - b.conservative[0] - b.other[0]).abs() / force);
            off_power = off_power.max((a.dissipated - b.dissipated).abs() / power);
            assert!(a.dissipated > 1e-4 * power, "{} of {power} mW", a.dissipated);
        }
        println!("forces off by {off:.1e}, power lost by {off_power:.1e} of that of the force");
        assert!(off < 3e-3 && off_power < 5e-4, "forces off by {off:e}, power by {off_power:e}");
    }
}

/// Where the meshes of two stages stand, on the driving or on the coast flanks.
fn stands(friction: f64, coast: bool) -> Vec<(Vec<Vector12>, f64)> {
    let (structure, meshes, mut operation): (_, _, Operation) = two_stage_box();
    if coast {
        operation.sense = operation.sense.opposite();
        operation.torques.iter_mut().for_each(|own: &mut Torque| own.torque = -own.torque);
    }
    let sense = operation.sense.sign() as f64;
    let mut rest = StaticGearbox::new(structure, meshes.clone(), operation, |_, mesh, meshing| {
        let (options, gears) = both_flanks(&mesh.pair, meshing, friction);
        Ok(Box::new(ExactMesh::new(mesh.pair.clone(), gears, options)?) as Box<dyn MeshElement>)
    })
    .unwrap();
    let positions: Vec<_> = (0..8).map(|i| rest.solve(sense * TAU / 17.0 * f64::from(i) / 8.0).unwrap()).collect();
    let of = |i: usize| {
        let force = positions.iter().map(|p| p.meshes[i].normal_force).sum::<f64>() / 8.0;
        (positions.iter().map(|p| Vector12::from(p.meshes[i].displacements)).collect(), force)
    };
    (0..meshes.len()).map(of).collect()
}

/// Two stages with flanks on both sides, of maps or of the contact: rows, result, and for each row the normal forces of each
/// mesh on both sides as they would be without dampers, N.
fn run_two_stages(
    (maps, overload): (bool, f64),
    drive: Drive,
    friction: f64,
    steps: [u64; 2],
) -> (Vec<GearboxInstant>, GearboxRun, Vec<Vec<f64>>) {
    let (structure, meshes, operation) = two_stage_box();
    let options = MotionOptions { drive, modal_damping: 0.02, limit: TAU * 2000.0 };
    let stand = maps.then(|| [false, true].map(|coast| stands(friction, coast)));
    let element = |i: usize, pair: &GearPair, meshing: &Meshing| -> Box<dyn MovingMesh> {
        let (options, gears) = both_flanks(pair, meshing, friction);
        let coast = Some(Arc::clone(&gears));
        let Some([driving, on_coast]) = &stand else {
            return Box::new(MovingExactMesh::new(pair.clone(), gears, coast, &options, 0.05).unwrap());
        };
        let flanks = MeshFlanks::new(pair, gears, coast, &options, 0.0).unwrap();
        let request = MapRequest {
            stands: driving[i].0.clone(),
            coast_stands: on_coast[i].0.clone(),
            tilts: true,
            mean_force: driving[i].1,
            overload,
            tolerance: 2e-3,
            worst: 2e-2,
        };
        let map = MappedMesh::new(&flanks, pair, &request, &|_| {}).unwrap_or_else(|e| panic!("{e}"));
        Box::new(map.with_damping(0.05))
    };
    let made = GearboxMechanism::new(structure, meshes, operation, &options, |i, mesh, meshing| {
        Ok(element(i, &mesh.pair, meshing))
    });
    let mut mechanism = made.unwrap();
    let start = mechanism.start(options.modal_damping).unwrap();
    let plan = crate::motion::steps(Scheme::Energy, steps);
    let goal = mechanism.goal(&start, &plan).unwrap();
    let mut course = mechanism.course(&start, &plan, None).unwrap();
    let (mut rows, mut elastic): (Vec<GearboxInstant>, Vec<Vec<f64>>) = Default::default();
    let of_row = |Row { system, state, .. }: Row<'_, &mut GearboxMechanism>| {
        // At the same place and not in motion, dampers do nothing.
        let still = State { v: 0.0 * &state.v, ..state.clone() };
        let all = system.instant(&still)?.meshes;
        elastic.push(all.iter().map(|own| own.normal_force + own.coast_normal_force).collect());
        rows.push(system.instant(state)?);
        Ok::<_, GearboxError>(())
    };
    course.run(&goal, &mut OnlyRows(of_row)).unwrap();
    let done = GearboxRun::of(course, &start).unwrap();
    (rows, done, elastic)
}

/// Two stages with friction on maps move as on the contact: transmission errors, forces and what is lost. Input less output
/// is what is stored and lost, to round-off.
#[test]
fn two_stages_on_maps_lose_what_friction_takes() {
    let drive = Drive::Speed(Speed::Constant(200.0));
    let run = |maps: bool, friction: f64| run_two_stages((maps, 4.0), drive, friction, [6, 40]);
    let [exact, mapped, smooth, exact_smooth] =
        [(false, FRICTION), (true, FRICTION), (true, 0.0), (false, 0.0)].map(|(maps, friction)| run(maps, friction));
    let lost = |run: &GearboxRun| run.energy.dissipated / run.energy.input_work;
    println!("lost {:.5}, on maps {:.5}, without friction {:.5}", lost(&exact.1), lost(&mapped.1), lost(&smooth.1));
    assert!((lost(&mapped.1) / lost(&exact.1) - 1.0).abs() < 5e-3, "{} beside {}", lost(&mapped.1), lost(&exact.1));
    assert!((0.002..0.05).contains(&(lost(&mapped.1) - lost(&smooth.1))));
    for (_, run, _) in [&mapped, &smooth] {
        assert!(run.energy.relative_residual.abs() < 1e-9, "{:?}", run.energy);
        assert!(run.flanks.iter().all(|own| own.reach <= 1.0), "{:?}", run.flanks);
    }
    // As far off as without friction, which maps have as nearly.
    for mesh in 0..2 {
        let off = |of_map: &[GearboxInstant], of_contact: &[GearboxInstant]| {
            let all = of_map.iter().zip(of_contact).map(|(a, b)| (&a.meshes[mesh], &b.meshes[mesh]));
            let errors: Vec<f64> =
                all.clone().map(|(a, b)| 1e3 * (a.transmission_error - b.transmission_error)).collect();
            let forces: Vec<f64> = all.map(|(a, b)| a.normal_force / b.normal_force - 1.0).collect();
            [rms(&errors), rms(&forces)]
        };
        let [rough, plain] = [off(&mapped.0, &exact.0), off(&smooth.0, &exact_smooth.0)];
        println!(
            "mesh {mesh}: off by {:.1e} um, forces by {:.1e}; without friction {:.1e} um, {:.1e}",
            rough[0], rough[1], plain[0], plain[1]
        );
        assert!(
            rough[0] < 1.5 * plain[0].max(0.01) && rough[1] < 1.5 * plain[1],
            "mesh {mesh}: {rough:?} beside {plain:?}"
        );
    }
}

fn spread(values: &[f64]) -> f64 {
    let ends = values.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| [a.min(*x), b.max(*x)]);
    ends[1] - ends[0]
}

/// A train that is slowed down faster than its load runs out goes through the backlash of both stages on maps as on the
/// contact: flanks part on both sides, the coast flanks strike as hard, and the energy is accounted for.
#[test]
fn torque_reverses_through_backlash_on_maps() {
    let drive = Drive::Speed(Speed::Ramp { from: 200.0, to: 120.0, start: 0.0, duration: 0.02 });
    for friction in [FRICTION, 0.0].into_iter().take(testing::cases(1, 2)) {
        let [exact, mapped] = [false, true].map(|maps| run_two_stages((maps, 16.0), drive, friction, [8, 60]));
        println!("{:?} {:?}", exact.1.flanks, mapped.1.flanks);
        assert!(mapped.1.energy.relative_residual.abs() < 1e-9, "{:?}", mapped.1.energy);
        for mesh in 0..2 {
            assert!(mapped.1.flanks[mesh].contact_losses > 0, "mesh {mesh}: {:?}", mapped.1.flanks);
            let te =
                |rows: &[GearboxInstant]| rows.iter().map(|r| r.meshes[mesh].transmission_error).collect::<Vec<_>>();
            let [a, b] = [te(&exact.0), te(&mapped.0)];
            let off = rms(&a.iter().zip(&b).map(|(a, b)| a - b).collect::<Vec<_>>()) / spread(&a);
            // A damper at a strike is at its largest for less than a step: forces of all rows together tell how hard it is.
            let force = |rows: &[GearboxInstant], side: usize| {
                let of = |r: &GearboxInstant| [r.meshes[mesh].normal_force, r.meshes[mesh].coast_normal_force][side];
                rms(&rows.iter().map(of).collect::<Vec<_>>())
            };
            let most = |rows: &[GearboxInstant]| force(rows, 0).hypot(force(rows, 1));
            let [f, g] = [most(&exact.0), most(&mapped.0)];
            let coast = [&exact.0, &mapped.0].map(|rows| force(rows, 1));
            let largest = |rows: &[Vec<f64>]| rows.iter().map(|own| own[mesh]).fold(0.0, f64::max);
            let [h, k] = [largest(&exact.2), largest(&mapped.2)];
            println!(
                "friction {friction}, mesh {mesh}: off by {off:.1e} of {:.3} mm; force {f:.0} N, on maps {g:.0} N, {coast:?} N of it \
                 on the coast flanks; largest without dampers {h:.0} N, on maps {k:.0} N",
                spread(&a)
            );
            assert!((k / h - 1.0).abs() < 2e-2, "mesh {mesh}: {k} N beside {h} N");
            assert!(spread(&b) > 0.05, "mesh {mesh} does not go through its backlash: {} mm", spread(&b));
            assert!(off < 1e-2 && (g / f - 1.0).abs() < 2e-2, "mesh {mesh}: off by {off:e}, {g} N beside {f} N");
        }
    }
}
