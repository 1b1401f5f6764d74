//! Errors of a gearbox: invalid inputs, and failures of the solution.

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

/// Shafts, bearings and gears cannot be assembled or solved.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GearboxError {
    /// There is no shaft.
    #[error("there is no shaft")]
    NoShafts,
    /// The sections of a shaft are not valid.
    #[error("shaft {shaft}: {source}")]
    Shaft {
        /// Name of the shaft.
        shaft: String,
        /// Error of the shaft's beam model.
        source: FemError,
    },
    /// A shaft that is not held by its bearings.
    #[error("nothing holds shaft {shaft} {motion}")]
    Loose {
        /// Name of the shaft.
        shaft: String,
        /// Direction in which it can move.
        motion: &'static str,
    },
    /// All bearings of a shaft take thrust in the same direction, and the shaft is loaded in the opposite direction.
    #[error(
        "nothing takes {direction} on shaft {shaft}: {by} it there with {force_n:.0} N, and its bearings take thrust {taken} alone"
    )]
    OneWay {
        /// Name of the shaft.
        shaft: String,
        /// Direction of the load, `+z` or `-z`.
        direction: &'static str,
        /// Direction in which the bearings take thrust.
        taken: &'static str,
        /// What causes the load, with its verb.
        by: &'static str,
        /// Load along the direction in which no bearing takes thrust, N.
        force_n: f64,
    },
    /// A natural frequency that is lost in the round-off of the highest one.
    #[error(
        "a natural frequency below {least_hz:.3} Hz cannot be told from round-off: the highest is {highest_hz:.2e} Hz"
    )]
    LostMode {
        /// Frequency whose square is the round-off of that of the highest, Hz.
        least_hz: f64,
        /// Highest frequency, Hz.
        highest_hz: f64,
    },
    /// No rolling bearing can be made from the given data.
    #[error("bearing {bearing}: {source}")]
    Bearing {
        /// Name of the bearing.
        bearing: String,
        /// Error of the rolling bearing.
        source: RollingBearingError,
    },
    /// A bearing that cannot be in the bore of a gear.
    #[error("bearing {bearing}: {source}")]
    Bore {
        /// Name of the bearing.
        bearing: String,
        /// What does not fit.
        source: crate::BoreError,
    },
    /// Rolling elements in a model that needs springs.
    #[error("bearing {bearing} has rolling elements, and this analysis needs a linear stiffness")]
    NotLinear {
        /// Name of the bearing.
        bearing: String,
    },
    /// A gear has elastic modes in a motion in time.
    #[error("gear {gear} has elastic modes; in this motion gears are rigid except for their teeth")]
    ModesInMotion {
        /// Name of the gear.
        gear: String,
    },
    /// Mass or inertia of a gear below that of the motion of its elastic modes.
    #[error(
        "gear {gear}: its elastic modes move more than its mass and inertia, which leave {share:.1e} of a direction to the rest"
    )]
    LessThanModes {
        /// Name of the gear.
        gear: String,
        /// Smallest eigenvalue of the remaining inertia, relative to the disc's own inertia.
        share: f64,
    },
    /// Elastic modes in a motion that is seen from a carrier that turns.
    #[error("gear {gear} keeps elastic modes in a motion whose frame turns with a carrier")]
    ModesInFrame {
        /// Name of the gear.
        gear: String,
    },
    /// A gear of which the mesh has only a part, or that two meshes describe differently.
    #[error("gear {gear} cannot have elastic modes: {said}")]
    NoModes {
        /// Name of the gear.
        gear: String,
        /// What is wrong with its meshes.
        said: &'static str,
    },
    /// Shooting with modes that a rotation by several teeth does not map onto each other.
    #[error("shooting with elastic modes: the modes of gear {gear} are not alike for all teeth")]
    ModesWithoutPeriod {
        /// Name of the gear.
        gear: String,
    },
    /// The elastic modes of a gear could not be computed.
    #[error("elastic modes of gear {gear}: {source}")]
    GearModes {
        /// Name of the gear.
        gear: String,
        /// Error of the reduction.
        source: ReductionError,
    },
    /// A part refers to a shaft that does not exist.
    #[error("{part} is on shaft {shaft}: shafts are numbered from 0, and there are {count}")]
    NoShaft {
        /// Name of the part.
        part: String,
        /// Index of the shaft.
        shaft: usize,
        /// Number of shafts.
        count: usize,
    },
    /// A part refers to a disc or gear that does not exist.
    #[error("{part} is at disc {disc}, and there are {count} (they count from 0)")]
    NoDisc {
        /// Name of the part.
        part: String,
        /// Index of the disc.
        disc: usize,
        /// Number of discs.
        count: usize,
    },
    /// Another part is at the cross-section with which a disc with a reach moves.
    #[error("{other} has the same place on the shaft as the seat of {disc}")]
    SharedSeat {
        /// Name of the disc with a reach.
        disc: String,
        /// Name of the other part.
        other: String,
    },
    /// A part is outside its shaft.
    #[error("{part} at {position_mm} mm is not on its shaft of {length_mm} mm")]
    OffShaft {
        /// Name of the part.
        part: String,
        /// Position, mm.
        position_mm: f64,
        /// Length of the shaft, mm.
        length_mm: f64,
    },
    /// The state belongs to another gearbox.
    #[error("the state to go on from has {checkpoint} meshes, and the motion has {motion}")]
    OtherMeshes {
        /// Number of meshes in the stored state.
        checkpoint: usize,
        /// Number of meshes in the motion.
        motion: usize,
    },
    /// A motion that must settle, but whose period is longer than it may wait.
    #[error(
        "all meshes, and teeth that differ, come back together after {} cycles of the fastest one, and the motion may wait for {most}",
        period.map_or("more than 100000".into(), |p| p.to_string())
    )]
    NoCommonPeriod {
        /// Cycles of the fastest mesh after which all meshes repeat; `None`: too many to search.
        period: Option<u64>,
        /// Largest number of cycles that the motion may wait.
        most: u64,
    },
    /// A gearbox that has no branches of periodic motions over the speed.
    #[error("no branch of periodic motions over the speed is known of a gearbox {what}")]
    NoBranch {
        /// Feature that prevents it.
        what: &'static str,
    },
    /// A branch of motions whose period is too long.
    #[error(
        "all meshes, and teeth that differ, come back together after {} cycles of the fastest one, and a branch has up to {most} with its harmonics",
        period.map_or("more than 100000".into(), |p| p.to_string())
    )]
    LongPeriod {
        /// Cycles of the fastest mesh after which all meshes repeat; `None`: too many to search.
        period: Option<u64>,
        /// Largest number of cycles that a branch can have with the requested harmonics per cycle.
        most: u64,
        /// Harmonics per cycle that a branch of this period can have; 0: none.
        per_cycle: u64,
    },
    /// Error of the branch of periodic motions.
    #[error("the branch over the speed, 1/min: {0}")]
    Branch(Box<PeriodicError<GearboxError>>),
    /// A value is not a finite number, or is negative where it must not be.
    #[error("{part}: {quantity} = {value} must be a number of 0 or more")]
    OutOfRange {
        /// Name of the part.
        part: String,
        /// The quantity, with its unit.
        quantity: &'static str,
        /// Value of the quantity.
        value: f64,
    },
    /// A stiffness or damping matrix that is not symmetric or not positive semi-definite.
    #[error("{part}: {matrix} is not symmetric and free of negative stiffness: {off:.1e} of its largest entry")]
    NotElastic {
        /// Name of the part.
        part: String,
        /// Name of the matrix: stiffness or damping.
        matrix: &'static str,
        /// Deviation relative to the largest entry.
        off: f64,
    },
    /// A matrix between bearing seats that has the wrong size.
    #[error("the housing has {found} coordinates, and {bearings} bearings have {wanted}")]
    HousingSize {
        /// Number of rows or columns given.
        found: usize,
        /// Number of bearings.
        bearings: usize,
        /// Number of rows and columns needed.
        wanted: usize,
    },
    /// A list that does not have one entry per part.
    #[error("{found} {what} are given for {wanted}")]
    Count {
        /// What is counted.
        what: &'static str,
        /// Number found.
        found: usize,
        /// Number required.
        wanted: usize,
    },
    /// The model has more nodes than dense matrices permit.
    #[error("{nodes:.0} nodes of shafts are too many: {most} at the most")]
    TooLarge {
        /// Number of nodes that the elements would have.
        nodes: f64,
        /// Largest number allowed.
        most: usize,
    },
    /// Error in the linear algebra of the whole model.
    #[error(transparent)]
    Matrix(#[from] FemError),
    /// The distance of two shafts is not the centre distance of their gears.
    #[error("mesh {mesh}: the axes are {distance_mm} mm apart, and the pair is made for {wanted_mm} mm")]
    Distance {
        /// Name of the mesh.
        mesh: String,
        /// Distance of the shaft axes, mm.
        distance_mm: f64,
        /// Centre distance of the pair, mm.
        wanted_mm: f64,
    },
    /// The axial offset of two gears is not that of their pair.
    #[error(
        "mesh {mesh}: the mid-face of gear 2 lies {offset_mm} mm above that of gear 1, and the pair is made for {pair_mm} mm"
    )]
    Beside {
        /// Name of the mesh.
        mesh: String,
        /// Offset given by the shafts, mm along +z.
        offset_mm: f64,
        /// Offset of the mid-faces given by the pair, mm.
        pair_mm: f64,
    },
    /// Two paths through the train give a shaft different ratios.
    #[error("the meshes give shaft {shaft} two speeds: {} and {} times that of the input", ratios[0], ratios[1])]
    Ratios {
        /// Name of the shaft.
        shaft: String,
        /// The two ratios.
        ratios: [f64; 2],
    },
    /// A shaft that is not connected to the input by meshes.
    #[error("shaft {shaft} meshes with nothing that the input drives")]
    NotDriven {
        /// Name of the shaft.
        shaft: String,
    },
    /// A torque that drives where it should be a load.
    #[error("the torque of {torque_nmm} N mm at {disc} drives its shaft instead of loading it")]
    Drives {
        /// Name of the disc.
        disc: String,
        /// The torque, N mm about +z.
        torque_nmm: f64,
    },
    /// Newton's method does not converge.
    #[error("no equilibrium after {iterations} steps: the last one was {step:.1e} of the displacements")]
    NoEquilibrium {
        /// Number of steps taken.
        iterations: usize,
        /// Last step relative to the displacements, in the norm of the stiffness.
        step: f64,
    },
    /// A load smaller than the force that round-off of positions causes through the stiffness of the teeth.
    #[error(
        "a load of {load_n:.3e} N on the flanks is too light: round-off of places alone makes {lost_n:.3e} N of the stiffness of the teeth"
    )]
    LostLoad {
        /// Force of the load on the flanks, N.
        load_n: f64,
        /// Force caused by round-off, N.
        lost_n: f64,
    },
    /// Shooting with an input whose speed is free.
    #[error("an input that a torque drives has no period of its own: shooting needs a given speed")]
    FreeInput,
    /// A sweep over the speed of an input that is driven by a given torque.
    #[error(
        "a sweep prescribes the speed: the driver must be driven by speed, or by the torque that balances the load"
    )]
    SweepByTorque,
    /// A torque over time on an input whose speed is given.
    #[error("a torque over time on an input whose speed is given: the torque there is a result")]
    GivenSpeed,
    /// Error of a bearing between shafts, or of a shaft that does not rotate.
    #[error(transparent)]
    Seat(#[from] SeatError),
    /// A bearing that prevents the rotation of a shaft.
    #[error("{bearing} has stiffness or damping for the rotation about its axis, so its shaft could not rotate")]
    HeldTurn {
        /// Name of the bearing.
        bearing: String,
    },
    /// A motion cannot continue.
    #[error("{0}")]
    Motion(Box<MotionError<GearboxError>>),
    /// Error of a map of the contact.
    #[error(transparent)]
    Map(Box<contact_map::MapError<StaticError>>),
    /// A mesh that cannot be described by a map.
    #[error("this model of the mesh does not hold {what}")]
    Unmapped {
        /// Reason why not.
        what: &'static str,
    },
    /// Flanks that the mesh model does not have would touch.
    #[error(
        "the driving flanks are {gap_mm:.4} mm apart, and the backlash is {backlash_mm:.4} mm: the others would touch"
    )]
    BeyondBacklash {
        /// Gap along the normal, mm.
        gap_mm: f64,
        /// Backlash along the normal, mm.
        backlash_mm: f64,
    },
    /// Error in the contact of a mesh.
    #[error("mesh {mesh}: {source}")]
    AtMesh {
        /// Name of the mesh.
        mesh: String,
        /// Error of the mesh.
        source: Box<GearboxError>,
    },
    /// Error of the exact contact of a pair of gears.
    #[error(transparent)]
    Contact(#[from] StaticError),
    /// Error in the line of action of a mesh.
    #[error("mesh {mesh}: {source}")]
    Mesh {
        /// Name of the mesh.
        mesh: String,
        /// Error of the lumped mesh.
        source: LumpedError,
    },
}

impl GearboxError {
    /// Adds the time (s) of a motion to an error.
    pub fn at(time: f64) -> impl Fn(Self) -> Self + Copy {
        move |source| match source {
            Self::Motion(_) => source,
            source => MotionError::Mechanism { time, source }.into(),
        }
    }

    /// The error of the contact, if that is the cause.
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

    /// Whether the input is valid but no result was found.
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

    /// Name of the mesh whose window has too few teeth, so that a wider one may succeed.
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

    /// Hint for the user: what to do next.
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
            Self::Bore { source, .. } => source.hint(),
            Self::NotLinear { .. } => "take the springs about where it stands, `Structure::about`",
            Self::ModesInMotion { .. } => "leave [motion] out, or [modes]",
            Self::LessThanModes { .. } => {
                "leave `mass_kg` and the inertias of the gear out: its mesh has them; or keep fewer modes"
            }
            Self::ModesInFrame { .. } => "leave the modes out, or let the carrier be the fixed member",
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
