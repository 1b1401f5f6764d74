//! Masses and inertias of gears and machines of a gearbox.

use dynamics::RigidBody;
use gearbox::{Machine, Operation, Structure};
use scene::gearbox::Gearbox;

use super::meshes::ReducedMesh;
use crate::AnalysisError;

/// Mass and inertia of every gear: what the file states, else the scene of the first pair that it is in, else its mesh; a
/// gear that meshes with nothing has what is stated alone.
pub(super) fn gears(file: &Gearbox, reduced: &[ReducedMesh]) -> Result<Vec<RigidBody>, AnalysisError> {
    let mut own: Vec<Option<RigidBody>> = vec![None; file.gears.len()];
    for (mesh, reduced) in file.meshes.iter().zip(reduced) {
        for (end, gear) in mesh.gears.into_iter().enumerate() {
            let body = reduced.body(end)?;
            own[gear].get_or_insert(body);
        }
    }
    let nothing = RigidBody { mass: 0.0, transverse_inertia: 0.0, polar_inertia: 0.0 };
    let of = |(gear, own): (&scene::gearbox::GearboxGear, Option<RigidBody>)| {
        let (own, [mass, transverse, polar]) = (own.unwrap_or(nothing), gear.inertia);
        RigidBody {
            mass: mass.unwrap_or(own.mass),
            transverse_inertia: transverse.unwrap_or(own.transverse_inertia),
            polar_inertia: polar.unwrap_or(own.polar_inertia),
        }
    };
    Ok(file.gears.iter().zip(own).map(of).collect())
}

/// The structure at rest with the mass of gears and machines.
pub(super) fn heavy(file: &Gearbox, at_rest: &Structure, operation: &Operation, gears: &[RigidBody]) -> Structure {
    let mut structure = at_rest.clone();
    for (disc, body) in structure.discs.iter_mut().zip(gears) {
        disc.mass = body.mass;
        disc.diametral_inertia = body.transverse_inertia;
        disc.polar_inertia = body.polar_inertia;
    }
    let machine = |name: String, disc: usize, inertia: f64| Machine { name, disc, inertia };
    let input = operation.input;
    structure.machines.push(machine("the machine at the input".into(), input, file.input.inertia));
    for (i, (torque, at)) in file.torques.iter().zip(&operation.torques).enumerate() {
        structure.machines.push(machine(format!("the machine at torque {}", i + 1), at.disc, torque.inertia));
    }
    structure
}
