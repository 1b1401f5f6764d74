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
    /// Where the file stands; paths in it are relative to its folder.
    pub file: PathBuf,
    /// Words of a command line that set keys beside the file.
    pub set: Vec<String>,
    /// Shafts.
    pub shafts: Vec<GearboxShaft>,
    /// Bearings.
    pub bearings: Vec<GearboxBearing>,
    /// Gears.
    pub gears: Vec<GearboxGear>,
    /// Meshes.
    pub meshes: Vec<GearboxMesh>,
    /// Where it is driven.
    pub input: GearboxInput,
    /// Loads.
    pub torques: Vec<GearboxTorque>,
    /// Planets of stages, written out among shafts, bearings, gears and meshes.
    pub planets: Vec<GearboxPlanets>,
    /// Rows of the stiffness of the housing between the seats of the bearings in it, N, mm, rad; none: rigid.
    pub housing: Option<Vec<Vec<f64>>>,
    /// Positions a cycle of the first mesh.
    pub positions_per_cycle: u32,
    /// Cycles of the first mesh.
    pub cycles: u32,
    /// Elements along every shaft, at least.
    pub shaft_elements: u32,
    /// How exact its headline numbers at rest are to be.
    pub accuracy: AccuracyScene,
    /// Speed and oil of ratings, where they are asked for.
    pub rating: Option<GearboxRating>,
    /// Vibration about where it stands, where it is asked for.
    pub vibration: Option<GearboxVibration>,
    /// Normal modes of the gears in that vibration and in a motion; none: gears are rigid beside their teeth. Their damping is
    /// that of the motion: a vibration has one for all modes.
    pub modes: Option<ModesScene>,
    /// How it runs in time; none: at rest alone.
    pub motion: Option<GearboxMotion>,
    /// Periodic motions over the speed of the input; none: not asked for.
    pub branch: Option<GearboxBranch>,
    /// Every table column by column as well, for other programs.
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

    /// The shaft that is fixed in space while the carrier turns; `None`: the carrier does not turn.
    pub fn fixed_shaft(&self) -> Option<usize> {
        self.shafts.iter().position(|shaft| shaft.fixed)
    }

    /// The mesh that a part of a key means: by its number in the file from 0, else by its name; the first one where planets
    /// have it in common.
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
    /// Where its own z = 0 lies, mm.
    pub origin: [f64; 3],
    /// Sections from there on.
    pub sections: Vec<GearboxSection>,
    /// Young's modulus, MPa.
    pub young_mpa: f64,
    /// Poisson's ratio.
    pub poisson: f64,
    /// Density, t/mm^3; it matters in motion.
    pub density: f64,
    /// Rigid in rigid bearings.
    pub held: bool,
    /// Whether it does not turn in the frame of the carrier.
    pub stands: bool,
    /// Whether it does not turn in space, where the carrier does.
    pub fixed: bool,
}

/// Planets of a stage.
#[derive(Debug, Clone, PartialEq)]
pub struct GearboxPlanets {
    /// Name of the shaft of the first one in the file.
    pub name: String,
    /// Meshes that each of them has.
    pub meshes: Vec<PlanetMesh>,
    /// Angle of each planet from the first, rad about +z.
    pub angles: Vec<f64>,
}

/// A mesh that each planet of a stage has.
#[derive(Debug, Clone, PartialEq)]
pub struct PlanetMesh {
    /// Name in the file.
    pub name: String,
    /// Meshes of the planets, in their order.
    pub of_planets: Vec<usize>,
    /// Which of its gears is the planet: 0 pinion, 1 wheel.
    pub planet: usize,
}

/// Operation that meshes and bearings are rated for.
#[derive(Debug, Clone, PartialEq)]
pub struct GearboxRating {
    /// Speed of the input, 1/min, above 0.
    pub speed_rpm: f64,
    /// Kinematic viscosity of the oil in the bearings at their temperature, mm^2/s; none: neither losses nor modified lives.
    pub viscosity: Option<f64>,
    /// e_C of ISO 281; none: basic lives alone.
    pub contamination_factor: Option<f64>,
    /// Loads over the life, each with the torque of the first load and the speed of the input; other torques go with it.
    pub spectrum: Option<DataFile<Spectrum>>,
}

/// A length of shaft of one section.
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
    /// Shaft.
    pub shaft: usize,
    /// Middle of the bearing, mm from the shaft's z = 0.
    pub position: f64,
    /// Shaft that its seat is part of; none: the housing.
    pub in_shaft: Option<usize>,
    /// How far its seat stands off, mm.
    pub seat_offset: [f64; 3],
    /// Stiffness for displacements x, y, z and turns about them: N/mm, N, N mm.
    pub stiffness: [[f64; 6]; 6],
    /// Damping along x, y, z, N s/mm.
    pub damping: [f64; 3],
    /// Rolling elements in place of the stiffness, which is zero then.
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

/// A rolling bearing whose stiffness follows its load.
#[derive(Debug, Clone, PartialEq)]
pub struct GearboxRolling {
    /// Kind of the bearing.
    pub kind: RollingKind,
    /// Size of its rolling elements, or what a catalogue says.
    pub size: RollingSize,
    /// Nominal contact angle, rad; 0 for deep grooves and cylindrical rollers.
    pub contact_angle: f64,
    /// Groove radius over ball diameter: inner and outer ring.
    pub conformity: [f64; 2],
    /// Rollers without relief.
    pub straight_rollers: bool,
    /// Radial clearance, the whole play, mm.
    pub radial_clearance: f64,
    /// How its rows are set along the axis.
    pub axial: AxialPlay,
    /// Place of each row beside the middle, mm, and +1 or -1 for the thrust of the shaft that it takes.
    pub rows: Vec<[f64; 2]>,
    /// Thrust that its seat takes.
    pub seat: ThrustSeat,
    /// C of the whole bearing, N, ISO 281; none: estimated, or its life is not told.
    pub dynamic_rating: Option<f64>,
    /// Designation, where it has one: a rating that is not stated is estimated.
    pub designation: Option<String>,
}

impl GearboxRolling {
    /// Whether its life is told where a speed is known.
    pub fn has_life(&self) -> bool {
        self.dynamic_rating.is_some() || self.designation.is_some()
    }
}

/// Thrust of the shaft that the seat of a bearing takes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ThrustSeat {
    /// As its rows do.
    Held,
    /// None: the outer ring floats.
    Floating,
    /// Towards +z (+1) or -z (-1) alone.
    Shoulder(f64),
}

/// What is known of the inside of a rolling bearing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RollingSize {
    /// The elements of a row, mm; the length is that of rollers.
    Elements {
        /// How many a row has.
        elements: u32,
        /// Diameter.
        diameter: f64,
        /// Length that presses.
        length: f64,
        /// Diameter of the circle of their centres.
        pitch_diameter: f64,
    },
    /// What catalogues say.
    Catalogue {
        /// Bore, mm.
        bore: f64,
        /// Outer diameter, mm.
        outer_diameter: f64,
        /// C_0, N.
        static_rating: f64,
    },
    /// What the standard of its designation says.
    Dimensions {
        /// Bore, mm.
        bore: f64,
        /// Outer diameter, mm.
        outer_diameter: f64,
        /// Width, mm; of tapered rollers that of both rings together.
        width: f64,
    },
}

/// How rows are set along the axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum AxialPlay {
    /// Way until a row touches, mm; below 0: pressed.
    Clearance(f64),
    /// Force that presses each row, N.
    Preload(f64),
}

/// A gear on a shaft.
#[derive(Debug, Clone, PartialEq)]
pub struct GearboxGear {
    /// Name.
    pub name: String,
    /// Shaft.
    pub shaft: usize,
    /// Mid-plane of the gear, mm from the shaft's z = 0.
    pub position: f64,
    /// The cross-section that its bore moves with, mm from the shaft's z = 0.
    pub seat: f64,
    /// Angle of tooth 0 against the mark of the shaft, rad.
    pub key: f64,
    /// Mass (t), inertia about an axis across its own and about its own (t mm^2), where they are stated.
    pub inertia: [Option<f64>; 3],
}

/// Two gears in mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct GearboxMesh {
    /// Name.
    pub name: String,
    /// The gears that are pinion and wheel of the scene.
    pub gears: [usize; 2],
    /// What shape they are, how they are meshed and how contact is solved: a scene at rest of the model `reduced` with
    /// slices. Its axes and mid-faces are where the shafts have them. Torque, driver and rotation are the gearbox's.
    pub scene: Scene,
    /// How its gears are set where the train closes a ring.
    pub timing: MeshTiming,
}

/// Where the gearbox is driven.
#[derive(Debug, Clone, PartialEq)]
pub struct GearboxInput {
    /// Shaft.
    pub shaft: usize,
    /// mm from the shaft's z = 0.
    pub position: f64,
    /// Sense in which it turns.
    pub rotation: Sense,
    /// What its torque is beside the mean, or in place of it, in a motion that it drives; none: constant.
    pub over_time: Option<TorqueScene>,
    /// Inertia of the machine there about its axis, t mm^2.
    pub inertia: f64,
}

/// A load on a shaft, against its rotation.
#[derive(Debug, Clone, PartialEq)]
pub struct GearboxTorque {
    /// Shaft.
    pub shaft: usize,
    /// mm from the shaft's z = 0.
    pub position: f64,
    /// N mm, >= 0: at rest, and in motion where it does not change with time.
    pub torque: f64,
    /// What it is in motion beside that, or in place of it; none: constant.
    pub over_time: Option<TorqueScene>,
    /// Inertia of the machine there about its axis, t mm^2.
    pub inertia: f64,
}

/// Vibration about equilibrium, order by order of the meshes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GearboxVibration {
    /// Speeds of the input, first and last, 1/min.
    pub speeds_rpm: [f64; 2],
    /// How many of them, evenly spaced, 2 at least.
    pub speeds: u32,
    /// Orders of each mesh.
    pub orders: u32,
    /// Damping ratio of all modes.
    pub damping_ratio: f64,
    /// Natural frequencies that are told.
    pub modes: u32,
    /// Whether the turn of the input is given; else it is free and has the inertia of its machine.
    pub held_input: bool,
}
