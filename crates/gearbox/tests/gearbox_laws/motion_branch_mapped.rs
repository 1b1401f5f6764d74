//! The resonance curve of a one-stage box with backlash on a map of the contact of its teeth, beside sweeps in time.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::{f64::consts::TAU, sync::Arc};

use dynamics::MeshFlanks;
use gearbox::{
    Disc, ExactMesh, GearMesh, GearboxError, MeshElement, Meshing, StaticGearbox, Torque, Vector12,
    motion::{Drive, GearboxMechanism, MapRequest, MappedMesh, MotionOptions, Speed},
};
use geometry::Sense;

use crate::{
    motion_branch::{DAMPING, branch, folds_and_jumps, plan},
    pairs::{operation, options, pair, reduced, shaft, single},
};

const TORQUE: f64 = 1.5e5;

/// A spur pair on stiff shafts in stiff bearings, its contact mapped at rest.
fn one_stage() -> GearboxMechanism {
    let gears = pair([23, 31], 0.0);
    let mut structure = single(&gears, 0.3);
    for (i, (name, origin)) in [("in", [0.0; 3]), ("out", structure.shafts[1].origin)].into_iter().enumerate() {
        structure.shafts[i] = shaft(name, origin, 150.0, 60.0);
    }
    for bearing in &mut structure.bearings {
        bearing.stiffness *= 10.0;
    }
    for (i, outer) in [66.0, 90.0].into_iter().enumerate() {
        let d = &structure.discs[i];
        structure.discs[i] = Disc::ring(d.name.clone(), d.shaft, d.position, [outer, 30.0], 20.0, 7.85e-9);
    }
    let operation = operation(&structure, 2, Sense::Ccw, vec![Torque { disc: 3, torque: TORQUE }]);
    let meshes = vec![GearMesh { name: "pair".into(), discs: [0, 1], pair: gears }];
    let mut found = None;
    let mut made = |_: usize, mesh: &GearMesh, meshing: &Meshing| -> Result<Box<dyn MeshElement>, GearboxError> {
        let options = options(&mesh.pair, meshing, TORQUE);
        let gears = reduced(&mesh.pair, &options);
        let element = ExactMesh::new(mesh.pair.clone(), Arc::clone(&gears), options.clone())?;
        found = Some((gears, options));
        Ok(Box::new(element))
    };
    let mut rest = StaticGearbox::new(structure.clone(), meshes.clone(), operation.clone(), &mut made).unwrap();
    let positions: Vec<_> = (0..8).map(|i| rest.solve(TAU / 23.0 * f64::from(i) / 8.0).unwrap()).collect();
    let (gears, options) = found.unwrap();
    let request = MapRequest {
        coast_stands: Vec::new(),
        tilts: true,
        stands: positions.iter().map(|p| Vector12::from(p.meshes[0].displacements)).collect(),
        mean_force: positions.iter().map(|p| p.meshes[0].normal_force).sum::<f64>() / 8.0,
        overload: 6.0,
        tolerance: 5e-3,
        worst: 5e-2,
    };
    let flanks = MeshFlanks::new(&meshes[0].pair, gears, None, &options, 0.0).unwrap();
    let map = MappedMesh::new(&flanks, &meshes[0].pair, &request, &|_| {}).unwrap().with_damping(0.02);
    let drive = Drive::Speed(Speed::Constant(1500.0));
    let asked = MotionOptions { drive, modal_damping: DAMPING, limit: TAU * 6000.0 };
    GearboxMechanism::new(structure, meshes, operation, &asked, |_, _, _| Ok(Box::new(map.clone()))).unwrap()
}

/// On a map of the contact the branch folds where sweeps in time jump, both ways, within half a per cent.
#[test]
fn sweeps_on_a_map_jump_at_the_folds() {
    let mut mechanism = one_stage();
    let found = branch(&mut mechanism, &plan(17_000.0, 10_000.0));
    for motion in found.branch.motions.iter().step_by(6) {
        println!("{:.1} 1/min: multiplier {:.4}", motion.parameter, motion.floquet.largest());
    }
    println!("{:?}", found.branch.bifurcations.iter().map(|b| (b.loss, b.motion.parameter)).collect::<Vec<_>>());
    for (fold, jump) in folds_and_jumps(&mut mechanism, &found) {
        assert!((jump / fold - 1.0).abs() < 5e-3, "fold at {fold:.2} 1/min, jump in time at {jump:.2}");
    }
}
