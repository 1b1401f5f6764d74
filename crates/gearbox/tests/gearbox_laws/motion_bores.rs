//! Laws of motion of gears whose bores are elastic and follow their shafts by means.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::{f64::consts::TAU, sync::Arc};

use dynamics::MeshFlanks;
use gearbox::{
    Disc, ExactMesh, GearMesh, GearboxError, Held, MeshElement, MeshExcitation, MeshSample, Operation, StaticGearbox,
    Structure, Torque, Train, Vector12, Vibration,
    motion::{
        Drive, GearboxInstant, GearboxMechanism, GearboxRun, MapRequest, MappedMesh, MotionOptions, MovingExactMesh,
        MovingMesh, Speed,
    },
    turn_levers,
};
use geometry::{GearPair, Sense};
use integrate::{Forces, Mechanism, Scheme};
use ltca::StaticOptions;
use mesh::{BoreCoupling, MeshedGear};
use nalgebra::DVector;
use reduction::ElasticGear;
use testing::Case;

use crate::pairs::{SECTOR, operation, options, pair, single};

const TORQUE: f64 = 1.5e5;
/// Speed of a motion whose inertia counts for a billionth, rad/s.
const SLOW: f64 = 0.02;

/// A pair in shafts that bend, its gears held at their bores by a coupling.
struct Bored {
    structure: Structure,
    meshes: Vec<GearMesh>,
    operation: Operation,
    train: Train,
    gears: Arc<[ElasticGear; 2]>,
}

impl Bored {
    fn new(gears: &GearPair, coupling: BoreCoupling) -> Self {
        let mut structure = single(gears, 0.3);
        for (i, outer) in [66.0, 90.0].into_iter().enumerate() {
            let d = &structure.discs[i];
            structure.discs[i] = Disc::ring(d.name.clone(), d.shaft, d.position, [outer, 30.0], 20.0, 7.85e-9);
        }
        let operation = operation(&structure, 2, Sense::Ccw, vec![Torque { disc: 3, torque: TORQUE }]);
        let meshes = vec![GearMesh { name: "pair".into(), discs: [0, 1], pair: gears.clone() }];
        let train = Train::new(&structure, &meshes, &operation.keys, operation.input, operation.sense).unwrap();
        let mut case = Case::meshed(gears.clone(), &SECTOR, TORQUE);
        case.meshes = case.meshes.map(|own: MeshedGear| own.coupled(coupling));
        let gears = Arc::new(case.reduced_gears(&options(gears, &train.meshing()[0], TORQUE)));
        Self { structure, meshes, operation, train, gears }
    }

    fn options(&self) -> StaticOptions {
        options(&self.meshes[0].pair, &self.train.meshing()[0], TORQUE)
    }

    /// At rest with an element in its mesh.
    fn standing(&self, element: impl Fn(&GearPair) -> Result<Box<dyn MeshElement>, GearboxError>) -> StaticGearbox {
        let parts = (self.structure.clone(), self.meshes.clone(), self.operation.clone());
        StaticGearbox::new(parts.0, parts.1, parts.2, |_, mesh, _| element(&mesh.pair)).unwrap()
    }

    fn at_rest(&self) -> StaticGearbox {
        self.standing(|pair| Ok(Box::new(ExactMesh::new(pair.clone(), Arc::clone(&self.gears), self.options())?)))
    }

    /// Map of the contact over a cycle at rest.
    fn map(&self) -> MappedMesh {
        let mut rest = self.at_rest();
        let positions: Vec<_> = (0..8).map(|i| rest.solve(TAU / 23.0 * f64::from(i) / 8.0).unwrap()).collect();
        let request = MapRequest {
            coast_stands: Vec::new(),
            tilts: true,
            stands: positions.iter().map(|p| Vector12::from(p.meshes[0].displacements)).collect(),
            mean_force: positions.iter().map(|p| p.meshes[0].normal_force).sum::<f64>() / 8.0,
            overload: 3.0,
            tolerance: 2e-3,
            worst: 2e-2,
        };
        let pair = &self.meshes[0].pair;
        let flanks = MeshFlanks::new(pair, Arc::clone(&self.gears), None, &self.options(), 0.0).unwrap();
        MappedMesh::new(&flanks, pair, &request, &|_| {}).unwrap()
    }

    /// In motion with an element in its mesh.
    fn mechanism(
        &self,
        speed: f64,
        limit_hz: f64,
        element: impl Fn(&GearPair) -> Result<Box<dyn MovingMesh>, GearboxError>,
    ) -> GearboxMechanism {
        let (drive, limit) = (Drive::Speed(Speed::Constant(speed)), TAU * limit_hz);
        let asked = MotionOptions { drive, modal_damping: 0.0, limit };
        let parts = (self.structure.clone(), self.meshes.clone(), self.operation.clone());
        GearboxMechanism::new(parts.0, parts.1, parts.2, &asked, |_, mesh, _| element(&mesh.pair)).unwrap()
    }

    fn in_motion(&self, speed: f64, limit_hz: f64, damping: f64) -> GearboxMechanism {
        self.mechanism(speed, limit_hz, |pair| {
            let (pair, gears) = (pair.clone(), Arc::clone(&self.gears));
            Ok(Box::new(MovingExactMesh::new(pair, gears, None, &self.options(), damping)?))
        })
    }
}

/// Motion from the equilibrium on over so many mesh cycles of so many steps.
fn run(
    mut mechanism: GearboxMechanism,
    scheme: Scheme,
    [steps, cycles]: [u64; 2],
    modal_damping: f64,
) -> (Vec<GearboxInstant>, GearboxRun) {
    let start = mechanism.start(modal_damping).unwrap();
    let plan = crate::motion::steps(scheme, [cycles, steps]);
    let mut rows = Vec::new();
    let done = mechanism.run(&start, &plan, |instant| rows.push(instant.clone())).unwrap();
    (rows, done)
}

const BOTH: [BoreCoupling; 2] = [BoreCoupling::Distributing, BoreCoupling::Kinematic];

/// Largest differences of transmission errors and of bearing forces from those at rest, over the largest at rest, with these.
fn off_rest(rows: &[GearboxInstant], rest: &mut StaticGearbox) -> ([f64; 2], [f64; 2]) {
    let (mut off, mut sizes) = ([0.0f64; 2], [0.0f64; 2]);
    let mut see = |kind: usize, found: f64, wanted: f64| {
        off[kind] = off[kind].max((found - wanted).abs());
        sizes[kind] = sizes[kind].max(wanted.abs());
    };
    for row in rows {
        let wanted = rest.solve(row.input[0]).unwrap();
        see(0, row.meshes[0].transmission_error, wanted.meshes[0].transmission_error);
        for (a, b) in row.bearings.iter().zip(&wanted.bearings) {
            (0..3).for_each(|k| see(1, a.force[k], b.force[k]));
        }
    }
    ([off[0] / sizes[0], off[1] / sizes[1]], sizes)
}

/// A motion begins in the equilibrium at rest, and so slow that nothing has inertia or is damped it goes through the equilibria:
/// transmission error and forces of the bearings are those at rest on the map of the same contact, and others than with rigid
/// bores. (The contact itself knows places of flanks beside those that were looked at before to 1e-6, theory (46a).)
#[test]
fn slow_motion_is_at_rest() {
    let gears = pair([23, 31], 12.0);
    let mut deflections = Vec::new();
    // What takes high frequencies away in a step has its balance at the end of the step.
    let scheme = Scheme::GeneralisedAlpha { rho: 0.0 };
    for coupling in BOTH {
        let own = Bored::new(&gears, coupling);
        let (rows, _) = run(own.in_motion(SLOW, 3000.0, 0.0), scheme, [64, 1], 0.0);
        let (begun, _) = off_rest(&rows[..1], &mut own.at_rest());
        let map = own.map();
        let moving = own.mechanism(SLOW, 3000.0, |_| Ok(Box::new(map.clone())));
        let (rows, _) = run(moving, scheme, [64, 1], 0.0);
        let rows: Vec<_> = rows.into_iter().step_by(4).collect();
        let (off, sizes) = off_rest(&rows, &mut own.standing(|_| Ok(Box::new(map.clone()))));
        println!("{coupling:?}: at the start {begun:?}, slow on a map {off:?} off those at rest");
        assert!(begun.iter().all(|off| *off < 1e-8), "{coupling:?} at the start: {begun:?}");
        assert!(off.iter().all(|off| *off < 1e-9), "{coupling:?}: {off:?}");
        deflections.push(sizes[0]);
    }
    assert!(deflections[0] > 1.01 * deflections[1], "elastic bores give way: {deflections:?} mm");
}

/// The energy of a motion with elastic bores is accounted for as with rigid ones.
#[test]
fn energy_with_elastic_bores_is_accounted_for() {
    let gears = pair([23, 31], 12.0);
    let own = Bored::new(&gears, BOTH[0]);
    let (rows, done) = run(own.in_motion(200.0, 3000.0, 0.05), Scheme::Energy, [50, 12], 0.02);
    let [least, largest] =
        rows.iter().map(|row| row.meshes[0].normal_force).fold([f64::MAX, 0.0], |[l, h], f| [l.min(f), h.max(f)]);
    println!("{:.1e} left over; forces {least:.0} .. {largest:.0} N", done.energy.relative_residual);
    assert!(done.energy.relative_residual.abs() < 1e-9, "{:?}", done.energy);
    assert!(largest > 1.02 * least, "nothing moves");
}

/// Small motions about the equilibrium have the natural frequencies of the vibration about it, with elastic bores as with rigid
/// ones. The vibration leaves out that flanks move on while the gears turn with the teeth, a tenth and less of what the bores
/// change.
#[test]
fn small_motions_have_the_frequencies_of_the_vibration() {
    let gears = pair([23, 31], 12.0);
    let mut all = Vec::new();
    for coupling in BOTH {
        let own = Bored::new(&gears, coupling);
        let mut rest = own.at_rest();
        let position = rest.solve(0.0).unwrap();
        let sample = MeshSample::at(&rest, &position, 0).unwrap();
        let turns = turn_levers(&own.meshes[0], &own.train.meshing()[0]).unwrap();
        let samples = vec![sample; 5];
        let excitation = MeshExcitation::new(&samples, &[0.0; 5], 2, turns).unwrap();
        let parts = (&own.meshes[..], &own.train, own.operation.sense);
        let held = Held { shafts: Vec::new(), turns: vec![2] };
        let vibration = Vibration::with_modes(own.structure.clone(), parts, vec![excitation], &[], &held).unwrap();
        let wanted = vibration.rotors().modes_at_rest().frequencies.clone();
        let mut mechanism = own.in_motion(1.0, 2e4, 0.0);
        let start = mechanism.start(0.0).unwrap();
        let n = mechanism.count();
        let mut forces = Forces::zeros(n);
        forces.tangents = true;
        mechanism.forces(0.0, &start.q, &DVector::zeros(n), &mut forces).unwrap();
        let stiffness = 0.5 * (&forces.stiffness + forces.stiffness.transpose());
        let found = fem::natural_modes(&stiffness, mechanism.mass()).unwrap().frequencies;
        let off: Vec<f64> = found.iter().zip(&wanted).take(10).map(|(a, b)| a / b - 1.0).collect();
        let (first, worst) = (wanted[0] / TAU, off.iter().fold(0.0, |m: f64, x| m.max(x.abs())));
        println!("{coupling:?}: first {first:.1} Hz, ten are off by {worst:.1e} at the most");
        assert!(off.len() == 10 && off.iter().all(|off| off.abs() < 5e-4), "{off:?}");
        all.push(wanted);
    }
    let moved = (0..10).map(|i| (all[0][i] / all[1][i] - 1.0).abs()).fold(0.0, f64::max);
    assert!(moved > 5e-3, "elastic bores change no frequency by more than {moved:.1e}");
}
