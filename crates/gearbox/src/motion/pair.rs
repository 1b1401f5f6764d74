//! A single pair as a mechanism: two rigid gears, each with its bearing and its free axes, and one mesh. Theory (45),
//! (92).

use dynamics::{COORDINATES, MotionOptions as PairOptions, SideLoads, ToothChanges};
use geometry::{Driver, GearPair};
use integrate::State;
use nalgebra::DVector;

use super::{Drive, FlankInstant, GearboxMechanism, MeshInstant, MotionOptions, MovingMesh, free_coordinates::Guide};
use crate::{
    Bearing, BearingState, Disc, GearMesh, GearboxError, Meshing, Operation, Shaft, Structure, Torque, Vector12,
};

/// Name of the mesh of a pair, whose errors need no name.
const PAIR: &str = "";

/// State of a pair at an instant of its motion.
#[derive(Debug, Clone, PartialEq)]
pub struct PairInstant {
    /// Time, s.
    pub time: f64,
    /// The mesh.
    pub mesh: MeshInstant,
    /// Displacements of both gears from their nominal motion, mm and rad, in the mesh's own axes.
    pub displacements: Vector12,
    /// Rates of the displacements, mm/s and rad/s.
    pub rates: Vector12,
    /// Speeds of both gears, rad/s about +z.
    pub speeds: [f64; 2],
    /// State of the driving and the coast flanks.
    pub flanks: [FlankInstant; 2],
    /// Torque of the driver in the running sense, N mm: the given torque, or the one that maintains the given speed.
    pub drive_torque: f64,
    /// Torque on the driven gear against its motion, N mm.
    pub load_torque: f64,
    /// Bearings of both gears, damping included; their forces are those on the gears.
    pub bearings: [BearingState; 2],
}

impl PairInstant {
    /// Sums of the normal forces on driving and coast flanks, damping included, N.
    pub fn normal_forces(&self) -> [f64; 2] {
        [self.mesh.normal_force, self.mesh.coast_normal_force]
    }
}

impl GearboxMechanism {
    /// The mechanism of a pair: gear 1 rotates about the common z axis, gear 2 is beside it along +x. The coordinate of
    /// the driven gear's rotation is its lag on the base circle, mm. This is the transmission error itself, so it keeps
    /// its digits however far the driver has rotated. If a torque drives, the rotation of the driver is a coordinate
    /// relative to its nominal rotation, the last of all.
    ///
    /// # Errors
    /// The errors of [`GearboxMechanism::new`].
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
        let meshes = vec![GearMesh { name: PAIR.into(), discs: [0, 1], pair: pair.clone() }];
        let torques = vec![Torque { disc: driven, torque: 0.0 }];
        let operation = Operation { input: driver, sense: senses[driver], torques, keys, held: Vec::new() };
        let asked = MotionOptions { drive, modal_damping: 0.0, limit: 1.0 };
        let base = [&pair.pinion, &pair.wheel][driven].base_radius();
        let guide = Guide {
            moves: &|gear, axis| options.free[gear][axis],
            by_length: Some((driven, statics.side().sign() / base)),
        };
        let made = Self::guided((structure, meshes, operation), &asked, &guide, element)?.beside_nominal();
        let mut made = made.with_torques(vec![(0, dynamics::Torque::Constant(0.0))])?;
        // The place where the run begins, without the round-off of the ways to it.
        made.start_cycles = vec![options.start_cycles];
        made.live[0].element().begin_at(options.start_cycles)?;
        made.set_pair_load(&options.load);
        match torque {
            Some(torque) => made.with_input_torque(torque.clone().scaled(senses[driver].sign() as f64)),
            None => Ok(made),
        }
    }

    /// Sets another load on the driven gear of a pair, N mm against its rotation.
    pub fn set_pair_load(&mut self, load: &dynamics::Torque) {
        let against = self.against_turn();
        self.set_torque(0, load.clone().scaled(against));
    }

    /// Sense of a load on the driven gear of a pair, about +z.
    fn against_turn(&self) -> f64 {
        let driven = self.operation.torques.first().map_or(0, |own| own.disc);
        let ratio = self.train.ratios()[self.assembly.structure().discs[driven].shaft];
        -(self.operation.sense.sign() as f64) * ratio.signum()
    }

    /// Derivatives of the transmission error of a mesh by the coordinates, mm/mm and mm/rad.
    pub fn error_slopes(&self, mesh: usize) -> DVector<f64> {
        let (pair, meshing) = (&self.meshes[mesh].pair, &self.train.meshing()[mesh]);
        let mut lever = Vector12::zeros();
        for (gear, own) in [&pair.pinion, &pair.wheel].into_iter().enumerate() {
            lever[COORDINATES * (gear + 1) - 1] = meshing.side().sign() * own.base_radius();
        }
        self.along(mesh, &lever)
    }

    /// Derivatives, by the coordinates, of a combination of displacements of both gears of a mesh.
    pub fn along(&self, mesh: usize, lever: &Vector12) -> DVector<f64> {
        self.live[mesh].to_gears.tr_mul(lever)
    }

    /// Quantities of a pair at a state.
    ///
    /// # Errors
    /// [`GearboxError`] of the mesh.
    pub fn pair_instant(&mut self, state: &State) -> Result<PairInstant, GearboxError> {
        let State { time, q, v, .. } = state;
        let (whole, mut flanks) = self.instant_by_side(state)?;
        let [displacements, rates] = [q, v].map(|z| self.displacements(0, z));
        let speeds = [0, 1].map(|g| self.train.ratios()[g] * whole.input[1] + rates[COORDINATES * (g + 1) - 1]);
        Ok(PairInstant {
            time: *time,
            mesh: whole.meshes[0],
            displacements,
            rates,
            speeds,
            flanks: flanks.swap_remove(0),
            drive_torque: self.operation.sense.sign() as f64 * whole.input_torque,
            load_torque: self.against_turn() * self.varying.output(0, *time),
            bearings: [0, 1].map(|g| whole.bearings[g]),
        })
    }

    /// Loads on the flanks in contact of a mesh at its last position ([`MovingMesh::loads`]).
    pub fn loads(&self, mesh: usize) -> Vec<SideLoads<'_>> {
        self.live[mesh].loads()
    }

    /// Tooth changes of the driving flanks of a mesh; empty for a mesh whose teeth do not change.
    pub fn changes(&self, mesh: usize) -> ToothChanges {
        self.live[mesh].windows().map_or(ToothChanges::default(), |own| own.driving.changes)
    }
}
