//! Errors of a gearbox: refused inputs, and failures of the solution.

use dynamics::MapFailure;
use fem::FemError;
use integrate::MotionError;
use ltca::StaticError;
use lumped::LumpedError;
use periodic::PeriodicError;
use reduction::ReductionError;

use crate::{SeatError, rolling_bearing::RollingBearingError};

/// Largest share of a vibration that harmonics may leave out, as files have it.
const WIDEST_TAIL: f64 = 0.1;

/// Why shafts, bearings and gears cannot be put together or solved.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GearboxError {
    /// No shaft at all.
    #[error("there is no shaft")]
    NoShafts,
    /// The sections of a shaft make no sense.
    #[error("shaft {shaft}: {source}")]
    Shaft {
        /// Name of the shaft.
        shaft: String,
        /// Error of the shaft.
        source: FemError,
    },
    /// A shaft that its bearings do not hold.
    #[error("nothing holds shaft {shaft} {motion}")]
    Loose {
        /// Name of the shaft.
        shaft: String,
        /// Direction in which it can move.
        motion: &'static str,
    },
    /// A shaft whose bearings all take thrust one way, and that is pressed the other way.
    #[error(
        "nothing takes {direction} on shaft {shaft}: {by} it there with {force_n:.0} N, and its bearings take thrust {taken} alone"
    )]
    OneWay {
        /// Name of the shaft.
        shaft: String,
        /// `+z` or `-z`.
        direction: &'static str,
        /// The other one.
        taken: &'static str,
        /// What presses it, with its verb.
        by: &'static str,
        /// Force along the direction that nothing takes, N.
        force_n: f64,
    },
    /// A natural frequency that the digits of a computer do not hold beside the highest.
    #[error(
        "a natural frequency below {least_hz:.3} Hz cannot be told from round-off: the highest is {highest_hz:.2e} Hz"
    )]
    LostMode {
        /// Frequency whose square is round-off of that of the highest, Hz.
        least_hz: f64,
        /// The highest, Hz.
        highest_hz: f64,
    },
    /// No rolling bearing can be made of what is stated.
    #[error("bearing {bearing}: {source}")]
    Bearing {
        /// Name of the bearing.
        bearing: String,
        /// Error of the rolling bearing.
        source: RollingBearingError,
    },
    /// Rolling elements where springs are needed.
    #[error("bearing {bearing} has rolling elements, and this analysis needs a linear stiffness")]
    NotLinear {
        /// Name of the bearing.
        bearing: String,
    },
    /// A gear of a motion in time has elastic modes.
    #[error("gear {gear} has elastic modes; in this motion gears are rigid except for their teeth")]
    ModesInMotion {
        /// Name of the gear.
        gear: String,
    },
    /// Mass or inertia below what the elastic modes of a gear move.
    #[error(
        "gear {gear}: its elastic modes move more than its mass and inertia, which leave {share:.1e} of a direction to the rest"
    )]
    LessThanModes {
        /// Name of the gear.
        gear: String,
        /// Smallest eigenvalue of what is left over, over the disc's own inertia.
        share: f64,
    },
    /// A gear of which the mesh has a part alone, or that two meshes have unlike.
    #[error("gear {gear} cannot have elastic modes: {said}")]
    NoModes {
        /// Name of the gear.
        gear: String,
        /// What is wrong with its meshes.
        said: &'static str,
    },
    /// Shooting with modes that a turn by teeth does not map into each other.
    #[error("shooting with elastic modes: the modes of gear {gear} are not alike for all teeth")]
    ModesWithoutPeriod {
        /// Name of the gear.
        gear: String,
    },
    /// Elastic modes that were not found.
    #[error("elastic modes of gear {gear}: {source}")]
    GearModes {
        /// Name of the gear.
        gear: String,
        /// Error of the reduction.
        source: ReductionError,
    },
    /// A part names a shaft that is not there.
    #[error("{part} is on shaft {shaft}: shafts are numbered from 0, and there are {count}")]
    NoShaft {
        /// Name of the part.
        part: String,
        /// The shaft it names.
        shaft: usize,
        /// Number of shafts.
        count: usize,
    },
    /// A part names a disc or gear that is not there.
    #[error("{part} is at disc {disc}, and there are {count} (they count from 0)")]
    NoDisc {
        /// Name of the part.
        part: String,
        /// The disc it names.
        disc: usize,
        /// Number of discs.
        count: usize,
    },
    /// Something else at the cross-section that a disc with a reach moves with.
    #[error("{other} has the same place on the shaft as the seat of {disc}")]
    SharedSeat {
        /// Name of the disc with a reach.
        disc: String,
        /// Name of what else is there.
        other: String,
    },
    /// A part sits beside its shaft.
    #[error("{part} at {position_mm} mm is not on its shaft of {length_mm} mm")]
    OffShaft {
        /// Name of the part.
        part: String,
        /// Position, mm.
        position_mm: f64,
        /// Length of the shaft, mm.
        length_mm: f64,
    },
    /// A state of another gearbox.
    #[error("the state to go on from has {checkpoint} meshes, and the motion has {motion}")]
    OtherMeshes {
        /// Meshes of the stored state.
        checkpoint: usize,
        /// Meshes of the motion.
        motion: usize,
    },
    /// A motion that is to settle, and may not wait until it could repeat itself.
    #[error(
        "all meshes, and teeth that differ, come back together after {} cycles of the fastest one, and the motion may wait for {most}",
        period.map_or("more than 100000".into(), |p| p.to_string())
    )]
    NoCommonPeriod {
        /// Cycles of the fastest mesh after which all meshes come back; `None`: too many to be looked for.
        period: Option<u64>,
        /// Cycles that the motion may wait.
        most: u64,
    },
    /// A gearbox without branches of periodic motions over the speed.
    #[error("no branch of periodic motions over the speed is known of a gearbox {what}")]
    NoBranch {
        /// What it has.
        what: &'static str,
    },
    /// A branch of motions whose period is too long.
    #[error(
        "all meshes, and teeth that differ, come back together after {} cycles of the fastest one, and a branch has up to {most} with its harmonics",
        period.map_or("more than 100000".into(), |p| p.to_string())
    )]
    LongPeriod {
        /// Cycles of the fastest mesh after which all meshes come back; `None`: too many to be looked for.
        period: Option<u64>,
        /// Cycles that a branch can have with the harmonics of a cycle that it is asked for.
        most: u64,
        /// Harmonics of a cycle that a branch of this period can have; 0: none.
        per_cycle: u64,
    },
    /// The branch of periodic motions.
    #[error("the branch over the speed, 1/min: {0}")]
    Branch(Box<PeriodicError<GearboxError>>),
    /// A value is not a finite number, or below 0 where it must not be.
    #[error("{part}: {quantity} = {value} must be a number of 0 or more")]
    OutOfRange {
        /// Name of the part.
        part: String,
        /// The quantity, with its unit.
        quantity: &'static str,
        /// Value of the quantity.
        value: f64,
    },
    /// A stiffness or damping matrix that is not symmetric, or pushes where it should hold.
    #[error("{part}: {matrix} is not symmetric and free of negative stiffness: {off:.1e} of its largest entry")]
    NotElastic {
        /// Name of the part.
        part: String,
        /// Matrix: stiffness or damping.
        matrix: &'static str,
        /// Deviation over the largest entry.
        off: f64,
    },
    /// A matrix between bearing seats of another size.
    #[error("the housing has {found} coordinates, and {bearings} bearings have {wanted}")]
    HousingSize {
        /// Rows or columns given.
        found: usize,
        /// Number of bearings.
        bearings: usize,
        /// Rows and columns that are needed.
        wanted: usize,
    },
    /// A list that should have one entry for each part.
    #[error("{found} {what} are given for {wanted}")]
    Count {
        /// Entries that are counted.
        what: &'static str,
        /// Number found.
        found: usize,
        /// Number required.
        wanted: usize,
    },
    /// More nodes than dense matrices hold.
    #[error("{nodes:.0} nodes of shafts are too many: {most} at the most")]
    TooLarge {
        /// Nodes that the elements would have.
        nodes: f64,
        /// Largest number allowed.
        most: usize,
    },
    /// Linear algebra of the whole.
    #[error(transparent)]
    Matrix(#[from] FemError),
    /// Axes of a mesh at another distance than its gears are made for.
    #[error("mesh {mesh}: the axes are {distance_mm} mm apart, and the pair is made for {wanted_mm} mm")]
    Distance {
        /// Name of the mesh.
        mesh: String,
        /// Distance of the shafts, mm.
        distance_mm: f64,
        /// Centre distance of the pair, mm.
        wanted_mm: f64,
    },
    /// Gears of a mesh at other heights than their pair is made for.
    #[error(
        "mesh {mesh}: the mid-face of gear 2 lies {offset_mm} mm above that of gear 1, and the pair is made for {pair_mm} mm"
    )]
    Beside {
        /// Name of the mesh.
        mesh: String,
        /// Offset that the shafts give, mm along +z.
        offset_mm: f64,
        /// Offset of the pair's mid-faces, mm.
        pair_mm: f64,
    },
    /// Two ways through the train turn a shaft unlike.
    #[error("the meshes give shaft {shaft} two speeds: {} and {} times that of the input", ratios[0], ratios[1])]
    Ratios {
        /// Name of the shaft.
        shaft: String,
        /// The two ratios.
        ratios: [f64; 2],
    },
    /// A shaft that no chain of meshes joins to the input.
    #[error("shaft {shaft} meshes with nothing that the input drives")]
    NotDriven {
        /// Name of the shaft.
        shaft: String,
    },
    /// A torque that drives where it should load.
    #[error("the torque of {torque_nmm} N mm at {disc} drives its shaft instead of loading it")]
    Drives {
        /// Name of the disc.
        disc: String,
        /// The torque, N mm about +z.
        torque_nmm: f64,
    },
    /// Newton's method does not settle.
    #[error("no equilibrium after {iterations} steps: the last one was {step:.1e} of the displacements")]
    NoEquilibrium {
        /// Steps taken.
        iterations: usize,
        /// Last step over the displacements, in the norm of the stiffness.
        step: f64,
    },
    /// A load below what round-off of places makes of the stiffness of teeth.
    #[error(
        "a load of {load_n:.3e} N on the flanks is too light: round-off of places alone makes {lost_n:.3e} N of the stiffness of the teeth"
    )]
    LostLoad {
        /// Force of the load on the flanks, N.
        load_n: f64,
        /// Force that round-off makes, N.
        lost_n: f64,
    },
    /// Shooting with an input whose speed is free.
    #[error("an input that a torque drives has no period of its own: shooting needs a given speed")]
    FreeInput,
    /// A sweep over the speed of an input that a torque of its own drives.
    #[error(
        "a sweep prescribes the speed: the driver must be driven by speed, or by the torque that balances the load"
    )]
    SweepByTorque,
    /// A torque over time on an input whose speed is given.
    #[error("a torque over time on an input whose speed is given: the torque there is a result")]
    GivenSpeed,
    /// A bearing between shafts, or a shaft that does not turn.
    #[error(transparent)]
    Seat(#[from] SeatError),
    /// A bearing that holds a shaft which has to turn.
    #[error("{bearing} has stiffness or damping for the rotation about its axis, so its shaft could not rotate")]
    HeldTurn {
        /// Name of the bearing.
        bearing: String,
    },
    /// A motion could not go on.
    #[error("{0}")]
    Motion(Box<MotionError<GearboxError>>),
    /// A map of the contact.
    #[error(transparent)]
    Map(Box<contact_map::MapError<StaticError>>),
    /// A mesh that no map holds.
    #[error("this model of the mesh does not hold {what}")]
    Unmapped {
        /// What.
        what: &'static str,
    },
    /// Flanks that a mesh does not have would touch.
    #[error(
        "the driving flanks are {gap_mm:.4} mm apart, and the backlash is {backlash_mm:.4} mm: the others would touch"
    )]
    BeyondBacklash {
        /// Gap along the normal, mm.
        gap_mm: f64,
        /// Backlash along it, mm.
        backlash_mm: f64,
    },
    /// The contact of a mesh.
    #[error("mesh {mesh}: {source}")]
    AtMesh {
        /// Name of the mesh.
        mesh: String,
        /// Error of the mesh.
        source: Box<GearboxError>,
    },
    /// The exact contact of a pair of gears.
    #[error(transparent)]
    Contact(#[from] StaticError),
    /// The line of action of a mesh.
    #[error("mesh {mesh}: {source}")]
    Mesh {
        /// Name of the mesh.
        mesh: String,
        /// Error of the lumped mesh.
        source: LumpedError,
    },
}

impl GearboxError {
    /// What went wrong at a time (s) of a motion.
    pub fn at(time: f64) -> impl Fn(Self) -> Self + Copy {
        move |source| match source {
            Self::Motion(_) => source,
            source => MotionError::Mechanism { time, source }.into(),
        }
    }

    /// The error of the contact, where it is what went wrong.
    pub fn contact_error(&self) -> Option<&StaticError> {
        match self {
            Self::Contact(source) => Some(source),
            Self::AtMesh { source, .. } => source.contact_error(),
            Self::Motion(source) => match &**source {
                MotionError::Mechanism { source, .. } => source.contact_error(),
                _ => None,
            },
            _ => None,
        }
    }

    /// Whether the input has a meaning and no result came out.
    pub fn is_without_result(&self) -> bool {
        match self {
            Self::NoEquilibrium { .. }
            | Self::LostLoad { .. }
            | Self::BeyondBacklash { .. }
            | Self::LostMode { .. } => true,
            // What the contact is asked for a map is of the map's own choice.
            Self::Map(_) => true,
            Self::Motion(source) => match &**source {
                MotionError::Mechanism { source, .. } => source.is_without_result(),
                _ => true,
            },
            Self::Branch(source) => match &**source {
                PeriodicError::Mechanism { source, .. } => source.is_without_result(),
                _ => true,
            },
            Self::AtMesh { source, .. } => source.is_without_result(),
            Self::Contact(source) => {
                matches!(
                    source,
                    StaticError::Contact { .. } | StaticError::NoEquilibrium { .. } | StaticError::PassedThrough { .. }
                )
            }
            _ => false,
        }
    }

    /// The mesh whose window has too few teeth: a wider one may do.
    pub fn starved_mesh(&self) -> Option<&str> {
        match self {
            Self::AtMesh { mesh, source } => {
                let starved = matches!(&**source, Self::Contact(own) if own.is_starved());
                starved.then_some(mesh)
            }
            Self::Motion(source) => match &**source {
                MotionError::Mechanism { source, .. } => source.starved_mesh(),
                _ => None,
            },
            _ => None,
        }
    }

    /// What the user can do next.
    pub fn hint(&self) -> Option<String> {
        let text = match self {
            Self::NoShafts => "give one shaft at least",
            Self::Shaft { source, .. } => return source.hint(),
            Self::Loose { motion: "about its own axis", .. } => {
                "give a bearing between it and the ground `turn_stiffness_nm_per_rad`"
            }
            Self::Loose { .. } => {
                "give it bearings that do, `stiffness_n_per_mm` in x, y and z, two of them or one with \
                 `tilt_stiffness_nm_per_rad`; or hold it (`held = true`). Along z two meshes of opposite hands \
                 hold a shaft as well. Cylindrical rollers and rings that float hold no thrust, and about a load rolling bearings that carry nothing hold nothing: less clearance, or a preload"
            }
            Self::OneWay { direction, .. } => {
                return Some(format!(
                    "turn one of its bearings about: `takes_thrust = \"{direction}\"`; two that face each other hold both ways"
                ));
            }
            Self::LostMode { .. } => {
                "is some spring many decades softer or stiffer than the others (stiffnesses are N/mm), or does a bearing, \
                 gear or section lie some nanometres beside another?"
            }
            Self::Bearing { source, .. } => source.hint(),
            Self::NotLinear { .. } => "take the springs about where it stands, `Structure::about`",
            Self::ModesInMotion { .. } => "leave [motion] out, or [modes]",
            Self::LessThanModes { .. } => {
                "leave `mass_kg` and the inertias of the gear out: its mesh has them; or keep fewer modes"
            }
            Self::NoModes { .. } => {
                "mesh the whole gear or one periodic sector (`sector_teeth = 1`), the same in all scenes that it is in"
            }
            Self::ModesWithoutPeriod { .. } => {
                "mesh one periodic sector (`sector_teeth = 1`) of each gear, or wait with `run = \"steady\"`"
            }
            Self::GearModes { source, .. } => return source.hint(),
            Self::SharedSeat { .. } => {
                "move one of them: bearings and loads act beside the part of the shaft that is meshed with the gear"
            }
            Self::NoShaft { .. } | Self::NoDisc { .. } => {
                "shafts and discs are numbered in the order in which they are given"
            }
            Self::OffShaft { .. } => "positions count from the shaft's own beginning, its sections one after the other",
            Self::OtherMeshes { .. } => "begin the motion anew",
            Self::NoCommonPeriod { .. } => "raise `warm_up_cycles` in [motion], or take `run = \"span\"`",
            Self::NoBranch { .. } => "take the mesh as \"mapped\" or \"spring\" and `drive = \"speed\"`",
            Self::LongPeriod { per_cycle: 0, .. } => {
                "take numbers of teeth with a shorter common period, or a run-up, which has any (`run = \"span\"` with \
                 `to_speed_rpm`)"
            }
            Self::LongPeriod { per_cycle, .. } => {
                return Some(format!(
                    "such a period has up to {per_cycle} harmonics a cycle: `most_harmonics = {per_cycle}`, `harmonics` no \
                     more than that, and a `tail` that they keep, all in [motion.continuation]; or take a run-up, which has \
                     any period (`run = \"span\"` with `to_speed_rpm`)"
                ));
            }
            Self::Branch(source) => match &**source {
                PeriodicError::Mechanism { source, .. } => return source.hint(),
                PeriodicError::Harmonics { tail, .. } if 1.2 * tail < WIDEST_TAIL => {
                    return Some(format!(
                        "allow a larger `tail` in [motion.continuation], `tail = {:.1e}` say, or begin far from a resonance \
                         or with more damping; more `most_harmonics` where the period is short",
                        1.2 * tail
                    ));
                }
                _ => "begin at another speed, far from a resonance, or take more damping",
            },
            Self::OutOfRange { .. } => {
                "inside are mm, N, t, s: 1 MN/m is 1000 N/mm, 1 kg is 0.001 t, 1 kg m^2 is 1000 t mm^2"
            }
            Self::NotElastic { .. } => {
                "elastic bearings and housings have symmetric matrices; the oil film of plain bearings, which has none, \
                 is not in these models"
            }
            Self::HousingSize { .. } => {
                "six coordinates a bearing, in the order of the bearings: x, y, z and the turns about them"
            }
            Self::Count { .. } => return None,
            Self::TooLarge { .. } => "take longer elements, or fewer sections",
            Self::Distance { .. } => "place the shafts by the centre distance, or give the pair theirs",
            Self::Beside { .. } => {
                "place the gears by the offset of their mid-faces, or leave `mid_face_offset_mm` out of the scene: positions say it then"
            }
            Self::Ratios { .. } => "numbers of teeth around a closed train must agree",
            Self::NotDriven { .. } => "add the mesh that drives it, or leave the shaft out",
            Self::Drives { .. } => "turn its sign, or make this shaft the input",
            Self::NoEquilibrium { .. } => {
                "is every shaft held in x, y, z and against tilting, along z both ways where rolling bearings take thrust \
                 one way alone, and can the teeth carry the torques (files have N m)? Hardly any torque does not find \
                 its way through the play of bearings; where a torque presses the coast flanks of a pair, give \
                 `flanks = \"both\"`"
            }
            Self::Map(_) => {
                "allow a larger error of the map, or solve the contact itself: the model \"reduced\", of a gearbox the mesh \
                 \"exact\""
            }
            Self::Unmapped { .. } => "solve the contact itself: the model \"reduced\", of a gearbox the mesh \"exact\"",
            Self::BeyondBacklash { .. } => {
                "give `flanks = \"both\"` in [contact] of the pair, take the mesh as \"spring\", or let it run with more load or damping"
            }
            Self::LostLoad { .. } => "give a larger torque: teeth that bear next to nothing are not known well enough",
            Self::FreeInput => "wait for the motion to settle instead of shooting for its periodic state",
            Self::SweepByTorque => "give the driver a speed, or let its torque balance the load",
            Self::GivenSpeed => "let a torque drive the input, or leave the torque over time out",
            Self::Seat(source) => source.hint(),
            Self::HeldTurn { .. } => "give a row and a column of zeros for the turn about z, or a matrix of five rows",
            Self::Motion(motion) => match &**motion {
                MotionError::Mechanism { source, .. } => return source.hint().or_else(|| Some(motion.hint().into())),
                other => other.hint(),
            },
            Self::AtMesh { source, .. } => return source.hint(),
            Self::Contact(source) => return source.hint(),
            Self::Matrix(FemError::NotPositiveDefinite { .. }) => {
                "does every shaft have mass, and is every shaft held in x, y, z and against tilting?"
            }
            Self::Matrix(source) => return source.hint(),
            Self::Mesh { source, .. } => return source.hint(),
        };
        Some(text.to_owned())
    }
}

impl From<std::convert::Infallible> for GearboxError {
    fn from(never: std::convert::Infallible) -> Self {
        match never {}
    }
}

impl From<MotionError<GearboxError>> for GearboxError {
    fn from(source: MotionError<GearboxError>) -> Self {
        Self::Motion(Box::new(source))
    }
}

impl From<MapFailure> for GearboxError {
    fn from(e: MapFailure) -> Self {
        match e {
            MapFailure::Unmapped { what } => Self::Unmapped { what },
            MapFailure::Map(source) => Self::Map(source),
            MapFailure::Contact(source) => source.into(),
        }
    }
}
