//! A pair alone as a machine: two rigid gears, each with its bearing and the axes in which it is free, and one mesh.
//! Theory (45), (92).

use dynamics::{COORDINATES, MotionOptions as PairOptions};
use geometry::{Driver, GearPair};
use integrate::State;
use nalgebra::DVector;

use super::{Drive, FlankInstant, GearboxMechanism, MeshInstant, MotionOptions, MovingMesh};
use crate::{Bearing, Disc, GearMesh, GearboxError, Meshing, Operation, Shaft, Structure, Torque, Vector12};

/// A mesh with both of its gears at an instant.
#[derive(Debug, Clone, PartialEq)]
pub struct PairInstant {
    /// The mesh.
    pub mesh: MeshInstant,
    /// Displacements of both gears from their nominal motion, mm and rad, and their rates; the mesh's own axes.
    pub displacements: Vector12,
    /// Their rates.
    pub rates: Vector12,
    /// Speeds of both gears, rad/s about +z.
    pub speeds: [f64; 2],
    /// Driving and coast flanks, of a mesh that tells them apart.
    pub flanks: Option<[FlankInstant; 2]>,
}

impl GearboxMechanism {
    /// The mechanism of a pair: gear 1 turns about the common z axis, gear 2 beside it along +x. The turn of a driver that a
    /// torque drives is a coordinate beside its nominal one.
    ///
    /// # Errors
    /// As [`GearboxMechanism::new`].
    pub fn of_pair(
        pair: &GearPair,
        options: &PairOptions,
        element: impl FnMut(usize, &GearMesh, &Meshing) -> Result<Box<dyn MovingMesh>, GearboxError>,
    ) -> Result<Self, GearboxError> {
        let statics = &options.statics;
        let (driven, contact) = (statics.driven(), &statics.contact);
        let driver = 1 - driven;
        // Tooth 0 of gear 1 where so many mesh cycles have passed.
        let cycles = contact.sense.sign() as f64 * (options.start_cycles - 0.5);
        let first = pair.middle_angle(statics.side()) + cycles * pair.pinion.pitch_angle();
        let keys = match contact.driver {
            Driver::Pinion => vec![first, 0.0],
            Driver::Wheel => vec![0.0, pair.wheel_angle(statics.side(), first)],
        };
        let alike = pair.wheel.signed_teeth() < 0.0;
        let senses = [contact.sense, if alike { contact.sense } else { contact.sense.opposite() }];
        let (drive, torque) = match &options.drive {
            dynamics::Drive::Speed(speed) => (Drive::Speed(*speed), None),
            dynamics::Drive::Balanced(speed) => (Drive::Balanced(*speed), None),
            dynamics::Drive::Torque { start, torque } => (Drive::Torque { start: *start, torque: None }, Some(torque)),
        };
        let names = ["pinion", "wheel"];
        let places = [[0.0; 3], [pair.centre_distance(), 0.0, pair.mid_face_offset()]];
        let structure = Structure {
            shafts: [0, 1]
                .map(|g| Shaft { name: names[g].into(), origin: places[g], pieces: Vec::new(), longest_element: 1.0 })
                .into(),
            discs: [0, 1]
                .map(|g| {
                    let body = &options.bodies[g];
                    Disc {
                        mass: body.mass,
                        diametral_inertia: body.transverse_inertia,
                        polar_inertia: body.polar_inertia,
                        ..Disc::seat(names[g], g, 0.0)
                    }
                })
                .into(),
            bearings: [0, 1]
                .map(|g| {
                    let own = &options.bearings[g];
                    Bearing { damping: own.damping, ..Bearing::linear(names[g], g, 0.0, own.stiffness) }
                })
                .into(),
            ..Structure::default()
        };
        let meshes = vec![GearMesh { name: "the pair".into(), discs: [0, 1], pair: pair.clone() }];
        let torques = vec![Torque { disc: driven, torque: 0.0 }];
        let operation = Operation { input: driver, sense: senses[driver], torques, keys, held: Vec::new() };
        let asked = MotionOptions { drive, modal_damping: 0.0, limit: 1.0 };
        let moves = |gear: usize, axis: usize| options.free[gear][axis];
        let made = Self::guided((structure, meshes, operation), &asked, &moves, element)?.beside_nominal();
        let mut made = made.with_torques(vec![(0, dynamics::Torque::Constant(0.0))])?;
        made.set_pair_load(&options.load);
        match torque {
            Some(torque) => made.with_input_torque(torque.clone().scaled(senses[driver].sign() as f64)),
            None => Ok(made),
        }
    }

    /// Gives the driven gear of a pair another load, N mm against its turn.
    pub fn set_pair_load(&mut self, load: &dynamics::Torque) {
        let Some(own) = self.operation.torques.first() else { return };
        let ratio = self.train.ratios()[self.assembly.structure().discs[own.disc].shaft];
        let sense = self.operation.sense.sign() as f64 * ratio.signum();
        self.set_torque(0, load.clone().scaled(-sense));
    }

    /// How the transmission error of a mesh follows the coordinates, mm/mm and mm/rad.
    pub fn error_slopes(&self, mesh: usize) -> DVector<f64> {
        let (pair, meshing) = (&self.meshes[mesh].pair, &self.train.meshing()[mesh]);
        let mut lever = Vector12::zeros();
        for (gear, own) in [&pair.pinion, &pair.wheel].into_iter().enumerate() {
            lever[COORDINATES * (gear + 1) - 1] = meshing.side().sign() * own.base_radius();
        }
        self.live[mesh].to_gears.tr_mul(&lever)
    }

    /// A mesh and its gears at a state.
    ///
    /// # Errors
    /// [`GearboxError`] of the mesh.
    pub fn pair_instant(&mut self, mesh: usize, state: &State) -> Result<PairInstant, GearboxError> {
        let State { time, q, v, .. } = state;
        let input = self.input(*time, q, v);
        let (instant, _) = self.mesh_instant(mesh, input, q, v)?;
        let [displacements, rates] = [q, v].map(|z| self.displacements(mesh, z));
        let flanks = self.live[mesh].element().by_side(&rates);
        let speeds = [0, 1].map(|g| {
            let shaft = self.assembly.structure().discs[self.meshes[mesh].discs[g]].shaft;
            self.train.ratios()[shaft] * input[1] + rates[COORDINATES * (g + 1) - 1]
        });
        Ok(PairInstant { mesh: instant, displacements, rates, speeds, flanks })
    }
}
