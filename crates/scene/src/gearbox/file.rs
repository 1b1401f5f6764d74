//! A checked gearbox, in the units of the solvers: mm, N, MPa, rad.

use std::path::PathBuf;

use rating::Spectrum;

use super::{
    GearboxBranch, GearboxMotion,
    schema::{MeshTiming, RollingKind},
};
use crate::{AccuracyScene, DataFile, ModesScene, Scene, Sense, TorqueScene};

/// A checked gearbox file. Shafts are numbered in the order of the file, and so are gears.
#[derive(Debug, Clone, PartialEq)]
pub struct Gearbox {
    /// Title.
    pub name: String,
    /// Path of the file; paths in it are relative to its folder.
    pub file: PathBuf,
    /// Words of a command line that set keys in addition to the file.
    pub set: Vec<String>,
    /// Shafts of the gearbox.
    pub shafts: Vec<GearboxShaft>,
    /// Bearings of the gearbox.
    pub bearings: Vec<GearboxBearing>,
    /// Gears of the gearbox.
    pub gears: Vec<GearboxGear>,
    /// Meshes of the gearbox.
    pub meshes: Vec<GearboxMesh>,
    /// Input of the gearbox.
    pub input: GearboxInput,
    /// Torques that load the gearbox.
    pub torques: Vec<GearboxTorque>,
    /// Planets of stages; their parts are also among shafts, bearings, gears and meshes.
    pub planets: Vec<GearboxPlanets>,
    /// Rows of the housing's stiffness between the seats of the bearings in it, N, mm, rad; `None`: rigid.
    pub housing: Option<Vec<Vec<f64>>>,
    /// Positions per cycle of the first mesh.
    pub positions_per_cycle: u32,
    /// Number of cycles of the first mesh.
    pub cycles: u32,
    /// Least number of elements along every shaft.
    pub shaft_elements: u32,
    /// Accuracy requested for the static headline values.
    pub accuracy: AccuracyScene,
    /// Speed and oil of the rating, if requested.
    pub rating: Option<GearboxRating>,
    /// Vibration about the equilibrium, if requested.
    pub vibration: Option<GearboxVibration>,
    /// Normal modes of the gears in this vibration and in a motion; `None`: gears are rigid apart from their teeth.
    /// Their damping is that of the motion; a vibration has one damping ratio for all modes.
    pub modes: Option<ModesScene>,
    /// Motion in time; `None`: only statics.
    pub motion: Option<GearboxMotion>,
    /// Periodic motions over the speed of the input; `None`: not requested.
    pub branch: Option<GearboxBranch>,
    /// Whether every table is also written in columns (Parquet), for other programs.
    pub parquet: bool,
}

/// Heights nearer than this are one: round-off of sums of positions, mm.
const ONE_HEIGHT: f64 = 1e-9;
/// Round-off of a stiffness that is turned about, relative.
const ROUND: f64 = 1e-9;

/// Height of the mid-face of the second gear over that of the first one, along +z, mm; `None` where they are at one
/// height.
pub(super) fn mid_face_offset(shafts: &[GearboxShaft], all: &[GearboxGear], gears: [usize; 2]) -> Option<f64> {
    let [a, b] = gears.map(|g| shafts[all[g].shaft].origin[2] + all[g].position);
    Some(b - a).filter(|offset| offset.abs() > ONE_HEIGHT)
}

impl Gearbox {
    /// All meshes that planets have in common, with their planets, in the order of the file.
    pub fn meshes_of_planets(&self) -> impl Iterator<Item = (&GearboxPlanets, &PlanetMesh)> {
        self.planets.iter().flat_map(|planets| planets.meshes.iter().map(move |mesh| (planets, mesh)))
    }

    /// The shaft that is fixed in space while the carrier rotates; `None`: the carrier does not rotate.
    pub fn fixed_shaft(&self) -> Option<usize> {
        self.shafts.iter().position(|shaft| shaft.fixed)
    }

    /// The mesh to which a part of a key refers: by its index in the file from 0, otherwise by its name; for a mesh
    /// that planets have in common, the first one.
    pub fn mesh_called(&self, which: &str) -> Option<usize> {
        let is_copy = |i: &usize| self.meshes_of_planets().any(|(_, own)| own.of_planets[1..].contains(i));
        let mut in_file = (0..self.meshes.len()).filter(|i| !is_copy(i));
        let number = which.parse().ok().and_then(|n| in_file.nth(n));
        let named = || self.meshes.iter().position(|mesh| mesh.name == which);
        let of_planets =
            || self.meshes_of_planets().find(|(_, own)| own.name == which).map(|(_, own)| own.of_planets[0]);
        number.or_else(named).or_else(of_planets)
    }
}

/// A shaft.
#[derive(Debug, Clone, PartialEq)]
pub struct GearboxShaft {
    /// Name.
    pub name: String,
    /// Position of its own z = 0, mm.
    pub origin: [f64; 3],
    /// Sections, starting at its own z = 0.
    pub sections: Vec<GearboxSection>,
    /// Young's modulus, MPa.
    pub young_mpa: f64,
    /// Poisson's ratio.
    pub poisson: f64,
    /// Density, t/mm^3; used in motion.
    pub density: f64,
    /// Whether it is rigid in rigid bearings.
    pub held: bool,
    /// Whether it does not rotate in the frame of the carrier.
    pub stands: bool,
    /// Whether it does not rotate in space while the carrier does.
    pub fixed: bool,
}

/// Planets of a stage.
#[derive(Debug, Clone, PartialEq)]
pub struct GearboxPlanets {
    /// Name of the shaft of the first planet in the file.
    pub name: String,
    /// Meshes of each planet.
    pub meshes: Vec<PlanetMesh>,
    /// Angle of each planet relative to the first, rad about +z.
    pub angles: Vec<f64>,
}

/// A mesh that each planet of a stage has.
#[derive(Debug, Clone, PartialEq)]
pub struct PlanetMesh {
    /// Name in the file.
    pub name: String,
    /// Indices of the planets' meshes, in order.
    pub of_planets: Vec<usize>,
    /// Which of its gears is the planet: 0 pinion, 1 wheel.
    pub planet: usize,
}

/// Operating conditions for the rating of meshes and bearings.
#[derive(Debug, Clone, PartialEq)]
pub struct GearboxRating {
    /// Speed of the input, 1/min, above 0.
    pub speed_rpm: f64,
    /// Kinematic viscosity of the oil in the bearings at their temperature, mm^2/s; `None`: neither losses nor modified
    /// lives.
    pub viscosity: Option<f64>,
    /// e_C of ISO 281; `None`: only basic lives.
    pub contamination_factor: Option<f64>,
    /// Load spectrum over the life, each load with the torque of the first output and the speed of the input; other
    /// torques are proportional.
    pub spectrum: Option<DataFile<Spectrum>>,
}

/// A piece of shaft with a constant section.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GearboxSection {
    /// Length, mm.
    pub length: f64,
    /// Outer diameter, mm.
    pub outer: f64,
    /// Inner diameter, mm.
    pub inner: f64,
}

/// A bearing.
#[derive(Debug, Clone, PartialEq)]
pub struct GearboxBearing {
    /// Name.
    pub name: String,
    /// Index of the shaft.
    pub shaft: usize,
    /// Middle of the bearing, mm from the shaft's z = 0.
    pub position: f64,
    /// Index of the shaft that contains its seat; `None`: the housing.
    pub in_shaft: Option<usize>,
    /// Index of the gear whose bore its rollers press; `None`: rigid rings.
    pub in_bore_of: Option<usize>,
    /// Displacement of its seat from the nominal position, mm.
    pub seat_offset: [f64; 3],
    /// Stiffness for displacements x, y, z and rotations about them: N/mm, N, N mm.
    pub stiffness: [[f64; 6]; 6],
    /// Damping along x, y, z, N s/mm.
    pub damping: [f64; 3],
    /// Rolling elements instead of the stiffness, which is then zero.
    pub rolling: Option<GearboxRolling>,
}

impl GearboxBearing {
    /// Whether it is the same all round its axis, with its seat: nothing of it turns against another frame.
    pub(super) fn is_round(&self) -> bool {
        let mut turned = self.clone();
        turned.turn_about(1.0);
        let entries = |b: &Self| b.stiffness.concat();
        let largest = entries(self).iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        let apart = entries(self).iter().zip(entries(&turned)).any(|(a, b)| (a - b).abs() > ROUND * largest);
        !apart && self.seat_offset[0] == 0.0 && self.seat_offset[1] == 0.0
    }

    /// Turns the bearing with its seat about z, rad.
    pub(super) fn turn_about(&mut self, angle: f64) {
        let k = self.stiffness;
        let turns_alike = |i: usize| k[i][i] == k[i + 1][i + 1] && k[i][i + 1] == 0.0 && k[i + 1][i] == 0.0;
        let apart = (0..6).flat_map(|i| (0..6).map(move |j| (i, j))).all(|(i, j)| i == j || k[i][j] == 0.0);
        // Round-off would be the only change.
        if !(apart && turns_alike(0) && turns_alike(3)) {
            let (sin, cos) = angle.sin_cos();
            let mut turn = [[0.0; 6]; 6];
            for at in [0, 3] {
                (turn[at][at], turn[at][at + 1], turn[at + 1][at], turn[at + 1][at + 1]) = (cos, -sin, sin, cos);
                turn[at + 2][at + 2] = 1.0;
            }
            let entry = |i: usize, j: usize| -> f64 {
                let pairs = (0..6).flat_map(|a| (0..6).map(move |b| (a, b)));
                pairs.map(|(a, b)| turn[i][a] * k[a][b] * turn[j][b]).sum()
            };
            self.stiffness = std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)));
        }
        let (sin, cos) = angle.sin_cos();
        let [x, y, z] = self.seat_offset;
        self.seat_offset = [x * cos - y * sin, x * sin + y * cos, z];
    }
}

/// A rolling bearing whose stiffness depends on its load.
#[derive(Debug, Clone, PartialEq)]
pub struct GearboxRolling {
    /// Kind of the bearing.
    pub kind: RollingKind,
    /// Dimensions of its rolling elements, or catalogue data.
    pub size: RollingSize,
    /// Nominal contact angle, rad; 0 for deep grooves and cylindrical rollers.
    pub contact_angle: f64,
    /// Groove radius divided by ball diameter: inner and outer ring.
    pub conformity: [f64; 2],
    /// Whether rollers have no relief.
    pub straight_rollers: bool,
    /// Radial clearance (total play), mm.
    pub radial_clearance: f64,
    /// Axial setting of its rows.
    pub axial: AxialPlay,
    /// Position of each row relative to the middle, mm, and +1 or -1 for the shaft thrust that it takes.
    pub rows: Vec<[f64; 2]>,
    /// Thrust that its seat takes.
    pub seat: ThrustSeat,
    /// C of the whole bearing, N, ISO 281; `None`: estimated, or the life is not computed.
    pub dynamic_rating: Option<f64>,
    /// Designation, if given; then a rating that is not given is estimated.
    pub designation: Option<String>,
}

impl GearboxRolling {
    /// Whether its life is computed if a speed is known.
    pub fn has_life(&self) -> bool {
        self.dynamic_rating.is_some() || self.designation.is_some()
    }
}

/// Shaft thrust that the seat of a bearing takes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ThrustSeat {
    /// That of its rows.
    Held,
    /// None: the outer ring floats axially.
    Floating,
    /// Only towards +z (+1) or -z (-1).
    Shoulder(f64),
}

/// Known dimensions of a rolling bearing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RollingSize {
    /// Dimensions of the rolling elements of a row, mm; the length is that of rollers.
    Elements {
        /// Number of elements per row.
        elements: u32,
        /// Diameter of the elements.
        diameter: f64,
        /// Effective length in contact.
        length: f64,
        /// Pitch diameter of the elements.
        pitch_diameter: f64,
    },
    /// Catalogue data.
    Catalogue {
        /// Bore, mm.
        bore: f64,
        /// Outer diameter, mm.
        outer_diameter: f64,
        /// C_0, N.
        static_rating: f64,
    },
    /// Boundary dimensions from the standard of its designation.
    Dimensions {
        /// Bore, mm.
        bore: f64,
        /// Outer diameter, mm.
        outer_diameter: f64,
        /// Width, mm; for tapered rollers that of both rings together.
        width: f64,
    },
}

/// Axial setting of the rows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum AxialPlay {
    /// Axial distance until a row is in contact, mm; negative: preloaded.
    Clearance(f64),
    /// Preload force of each row, N.
    Preload(f64),
}

/// A gear on a shaft.
#[derive(Debug, Clone, PartialEq)]
pub struct GearboxGear {
    /// Name.
    pub name: String,
    /// Index of the shaft.
    pub shaft: usize,
    /// Mid-plane of the gear, mm from the shaft's z = 0.
    pub position: f64,
    /// Position of the cross-section with which its bore moves, mm from the shaft's z = 0.
    pub seat: f64,
    /// Angle of tooth 0 relative to the mark of the shaft, rad.
    pub key: f64,
    /// Mass (t), inertia about an axis perpendicular to its own and about its own (t mm^2), if given.
    pub inertia: [Option<f64>; 3],
}

/// Two gears in mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct GearboxMesh {
    /// Name.
    pub name: String,
    /// Indices of the gears that are pinion and wheel of the scene.
    pub gears: [usize; 2],
    /// Geometry, meshes and contact of the gears: a static scene of the model `reduced` with slices. Its axes and
    /// mid-faces follow from the shafts. Torque, driver and rotation are those of the gearbox.
    pub scene: Scene,
    /// How its gears are set if the train has a closed loop.
    pub timing: MeshTiming,
}

/// Input of a gearbox.
#[derive(Debug, Clone, PartialEq)]
pub struct GearboxInput {
    /// Index of the shaft.
    pub shaft: usize,
    /// Position, mm from the shaft's z = 0.
    pub position: f64,
    /// Sense of rotation of the input.
    pub rotation: Sense,
    /// Its torque over time, relative to the mean or instead of it, in a motion that it drives; `None`: constant.
    pub over_time: Option<TorqueScene>,
    /// Inertia of the machine there about its axis, t mm^2.
    pub inertia: f64,
}

/// A load on a shaft, against its rotation.
#[derive(Debug, Clone, PartialEq)]
pub struct GearboxTorque {
    /// Index of the shaft.
    pub shaft: usize,
    /// Position, mm from the shaft's z = 0.
    pub position: f64,
    /// Torque, N mm, >= 0: in statics, and in motion if it does not change with time.
    pub torque: f64,
    /// Torque in motion over time, relative to this value or instead of it; `None`: constant.
    pub over_time: Option<TorqueScene>,
    /// Inertia of the machine there about its axis, t mm^2.
    pub inertia: f64,
}

/// Vibration about the equilibrium, order by order of the meshes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GearboxVibration {
    /// First and last speed of the input, 1/min.
    pub speeds_rpm: [f64; 2],
    /// Number of speeds, evenly spaced, at least 2.
    pub speeds: u32,
    /// Number of orders of each mesh.
    pub orders: u32,
    /// Damping ratio of all modes.
    pub damping_ratio: f64,
    /// Number of natural frequencies in the results.
    pub modes: u32,
    /// Whether the rotation of the input is given; otherwise it is free, with the inertia of the machine there.
    pub held_input: bool,
}
