//! Gearboxes with mass, and a mesh whose stiffness and excess go through the cycle: what laws of vibration are tried on.

use std::f64::consts::TAU;

use gearbox::{
    GearMesh, GearboxError, Held, Machine, MeanMesh, MeshElement, MeshExcitation, MeshForces, MeshSample, Meshing,
    Operation, StaticGearbox, Structure, Torque, Vector12, Vibration, own_cycle, turn_levers,
};
use geometry::Sense;

use crate::pairs::{LinearMesh, operation, spring, two_stages};

/// Stiffness and excess that change with the phase c: k (1 + 0.2 cos 2 pi c), e = 1 um cos(2 pi c) + 0.4 um sin(4 pi c).
pub struct Wavy {
    pub mean: LinearMesh,
    at: f64,
}

impl Wavy {
    pub fn new(mesh: &GearMesh, meshing: &Meshing) -> Self {
        Self { mean: spring(mesh, meshing), at: 0.0 }
    }
}

impl MeshElement for Wavy {
    fn go_to(&mut self, cycles: f64) -> Result<(), GearboxError> {
        self.at = cycles;
        Ok(())
    }

    fn evaluate(&mut self, displacements: &Vector12) -> Result<MeshForces, GearboxError> {
        let phase = TAU * self.at;
        let stiffness = self.mean.stiffness * (1.0 + 0.2 * phase.cos());
        let excess = 1e-3 * phase.cos() + 4e-4 * (2.0 * phase).sin();
        LinearMesh { stiffness, excess, ..self.mean.clone() }.evaluate(displacements)
    }
}

/// Positions of a cycle: an odd number, so that orders up to half of it say all there is.
pub const POSITIONS: usize = 15;

/// Two stages whose gears have the mass of steel rings, and machines at both ends.
pub fn heavy_stages() -> (Structure, Vec<GearMesh>) {
    let (mut structure, meshes) = two_stages();
    for (i, (outer, inner)) in [(52.0, 25.0), (164.0, 35.0), (58.0, 35.0), (144.0, 50.0)].into_iter().enumerate() {
        let seat = &structure.discs[i];
        let (name, shaft, position) = (seat.name.clone(), seat.shaft, seat.position);
        structure.discs[i] = gearbox::Disc::ring(name, shaft, position, [outer, inner], 20.0, 7.85e-9);
    }
    let machine = |name: &str, disc, inertia| Machine { name: name.into(), disc, inertia };
    structure.machines = vec![machine("motor", 4, 5.0), machine("load", 5, 80.0)];
    (structure, meshes)
}

/// Its load: 400 N m at the output.
pub fn load(structure: &Structure, sense: Sense) -> Operation {
    operation(structure, 4, sense, vec![Torque { disc: 5, torque: -(sense.sign() as f64) * 4e5 }])
}

/// Each mesh through its own cycle under load, the others at their means.
pub fn cycles(structure: &Structure, meshes: &[GearMesh], run: &Operation) -> Vec<(Vec<MeshSample>, Vec<f64>)> {
    let solve = |own: usize, means: &[MeanMesh]| {
        let made = StaticGearbox::new(structure.clone(), meshes.to_vec(), run.clone(), |i, mesh, meshing| {
            let mean = means.get(i).filter(|_| i != own).cloned();
            Ok(mean.map_or_else(|| Box::new(Wavy::new(mesh, meshing)) as Box<dyn MeshElement>, |m| Box::new(m)))
        });
        own_cycle(&mut made.unwrap(), own, POSITIONS, || {}).unwrap()
    };
    let rough: Vec<MeanMesh> = (0..meshes.len()).map(|i| MeanMesh::of(&solve(i, &[]).0).unwrap()).collect();
    (0..meshes.len()).map(|i| solve(i, &rough)).collect()
}

/// A box that is turned by its input.
pub fn vibration(structure: &Structure, meshes: &[GearMesh], run: &Operation, held: &Held) -> Vibration {
    let own = cycles(structure, meshes, run);
    let train = gearbox::Train::new(structure, meshes, &run.keys, run.input, run.sense).unwrap();
    let excitations = own.iter().enumerate().map(|(i, (s, te))| {
        let turns = turn_levers(&meshes[i], &train.meshing()[i]).unwrap();
        MeshExcitation::new(s, te, POSITIONS / 2, turns).unwrap()
    });
    Vibration::new(structure.clone(), (meshes, &train, run.sense), excitations.collect(), held).unwrap()
}
