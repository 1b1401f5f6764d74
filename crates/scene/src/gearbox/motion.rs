//! `[motion]` of a gearbox file: the motion of the gearbox in time.

use integrate::{Scheme, whole_cycles};
use toml::Spanned;

use super::{
    schema::{GearboxDrive, GearboxRun, MOTION, MeshModel, RawContinuation, RawMotion},
    values::{Checked, given, needed_of, row},
};
use crate::{Integration, Source};

/// Cycles of a motion at the most.
const MOST_CYCLES: f64 = 1e6;
/// Rows of a motion at the most.
const ROWS: u64 = 500_000;
/// Least number of rows in a cycle of the fastest mesh: fewer have no peak to peak.
const LEAST_ROWS: u32 = 4;

/// Motion of a gearbox in time, from its equilibrium on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GearboxMotion {
    /// Speed of the input, 1/min: constant, or the initial speed if a torque drives.
    pub speed_rpm: f64,
    /// Final speed, 1/min, of a motion with a speed ramp over all its cycles.
    pub to_speed_rpm: Option<f64>,
    /// Drive of the input.
    pub drive: GearboxDrive,
    /// Torque on the input, N mm, if a torque drives; `None`: the torque that balances the loads.
    pub input_torque: Option<f64>,
    /// Model of the meshes.
    pub mesh: MeshModel,
    /// Number of cycles of the fastest mesh; the whole cycles in `duration` if that is given.
    pub cycles: u32,
    /// Duration of the motion, s, if given; for a run-up, the duration of the speed ramp.
    pub duration: Option<f64>,
    /// Steps per cycle of the fastest mesh.
    pub steps_per_cycle: u32,
    /// Steps per row.
    pub steps_per_row: u32,
    /// Number of cycles of the slowest mesh in one spectrum of the waterfall.
    pub waterfall_cycles: u32,
    /// Integration method.
    pub scheme: Scheme,
    /// Tolerance for the local error of a step, relative to the static displacements; `None`: steps of equal length.
    pub error_tolerance: Option<f64>,
    /// Whether a step ends wherever contact is lost or gained.
    pub stop_at_events: bool,
    /// Settling before the rows: difference over a common period of all meshes, relative to the peak to peak, that
    /// counts as periodic, and the largest number of cycles of the fastest mesh to wait. `None`: rows begin in the
    /// equilibrium.
    pub settle: Option<(f64, u32)>,
    /// Whether a settling motion is brought to its periodic state by Newton's method.
    pub shoots: bool,
    /// Damping of the meshes.
    pub mesh_damping: GearboxDamping,
    /// Damping ratio of every elastic mode.
    pub modal_damping_ratio: f64,
    /// Highest frequency that shafts must represent, Hz; `None`: four times that of the fastest mesh.
    pub highest_frequency_hz: Option<f64>,
    /// Target for the error of maps, relative to the mean approach.
    pub map_tolerance: f64,
    /// Largest force of maps, relative to the static mean.
    pub map_overload: f64,
    /// Number of cycles of the fastest mesh between checkpoints; 0: no checkpoints.
    pub checkpoint_every_cycles: u32,
}

/// Damping of meshes in motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum GearboxDamping {
    /// Damping ratio of the gears of a mesh vibrating against each other.
    Ratio(f64),
    /// Damping coefficient, N s/mm per mm of contact line.
    PerLength(f64),
}

/// The branch of periodic motions of a gearbox over the speed of its input.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GearboxBranch {
    /// The motion at the first speed: drive, meshes, damping, and the settings of motions in time.
    pub motion: GearboxMotion,
    /// Last speed, 1/min.
    pub to_speed_rpm: f64,
    /// Number of common periods of all meshes after which a motion repeats.
    pub periods: u32,
    /// Initial number of harmonics per cycle of the fastest mesh.
    pub harmonics: u32,
    /// Largest number of harmonics.
    pub most_harmonics: u32,
    /// Largest share of the vibration that neglected harmonics may have.
    pub tail: f64,
    /// Least number of phases per cycle of the fastest mesh at which forces are evaluated.
    pub phases: u32,
    /// Longest step, in units of the speed range and of the static deflections.
    pub longest_step: f64,
    /// Largest number of motions.
    pub motions: u32,
    /// Number of stable motions that are run in time.
    pub time_points: u32,
}

/// What a table of motion asks for: a motion in time, or a branch.
pub(super) enum Asked {
    Motion(GearboxMotion),
    Branch(GearboxBranch),
}

impl Asked {
    /// The motion in time, or that at the beginning of the branch.
    pub fn motion(&self) -> &GearboxMotion {
        match self {
            Self::Motion(motion) => motion,
            Self::Branch(branch) => &branch.motion,
        }
    }
}

/// What the table asks for.
/// `per_turn`: cycles of the fastest mesh in a turn of the input.
pub(super) fn asked(s: &Source<'_>, table: &Spanned<RawMotion>, per_turn: f64) -> Checked<Asked> {
    let (raw, motion) = (table.get_ref(), motion(s, table, per_turn)?);
    if s.choice_of::<GearboxRun>("run", &raw.run)? != GearboxRun::Continuation {
        return match &raw.continuation {
            None => Ok(Asked::Motion(motion)),
            Some(own) => {
                let said = "[motion.continuation] belongs to a branch over the speed";
                Err(s.conflict(&own.span(), said, "take `run = \"continuation\"`, or leave the table out"))
            }
        };
    }
    let at = raw.run.as_ref().map_or(table.span(), Spanned::span);
    let Some(to_speed_rpm) = motion.to_speed_rpm else {
        let said = "a branch over the speed that has no end";
        return Err(s.conflict(&at, said, "give `to_speed_rpm`, above or below `speed_rpm`"));
    };
    if let (MeshModel::Exact, Some(own)) = (motion.mesh, &raw.mesh) {
        let said = "the exact contact has no continuation: all displacements of its flanks count";
        return Err(s.conflict(&own.span(), said, "take `mesh = \"mapped\"` or `mesh = \"spring\"`"));
    }
    if let (GearboxDrive::Balanced, Some(own)) = (motion.drive, &raw.drive) {
        let said = "a branch has an input that keeps its speed";
        return Err(s.conflict(
            &own.span(),
            said,
            "take `drive = \"speed\"`, with the inertia of the machine in [input]",
        ));
    }
    let of_rows = [
        ("cycles", raw.cycles.as_ref().map(Spanned::span)),
        ("duration_s", raw.duration_s.as_ref().map(Spanned::span)),
        ("steps_per_row", raw.steps_per_row.as_ref().map(Spanned::span)),
        ("waterfall_cycles", raw.waterfall_cycles.as_ref().map(Spanned::span)),
        ("checkpoint_every_cycles", raw.checkpoint_every_cycles.as_ref().map(Spanned::span)),
    ];
    if let Some((key, span)) = of_rows.into_iter().find_map(|(key, span)| Some((key, span?))) {
        let said = format!("`{key}` belongs to a motion that writes rows in time");
        return Err(s.conflict(&span, said, "leave it out: a branch has a row for each motion"));
    }
    let none = RawContinuation::default();
    let words = raw.continuation.as_ref().map_or(&none, Spanned::get_ref);
    let branch = GearboxBranch {
        motion: GearboxMotion { to_speed_rpm: None, shoots: true, ..motion },
        to_speed_rpm,
        periods: row!(s, CONTINUATION, words.periods)?,
        harmonics: row!(s, CONTINUATION, words.harmonics)?,
        most_harmonics: row!(s, CONTINUATION, words.most_harmonics)?,
        tail: row!(s, CONTINUATION, words.tail)?,
        phases: row!(s, CONTINUATION, words.phases)?,
        longest_step: row!(s, CONTINUATION, words.longest_step)?,
        motions: row!(s, CONTINUATION, words.motions)?,
        time_points: row!(s, CONTINUATION, words.time_points)?,
    };
    if let (true, Some(own)) = (branch.most_harmonics < branch.harmonics, &words.most_harmonics) {
        let said = format!("`most_harmonics` = {} is below `harmonics` = {}", branch.most_harmonics, branch.harmonics);
        return Err(s.conflict(&own.span(), said, "begin with fewer, or allow more"));
    }
    Ok(Asked::Branch(branch))
}

fn motion(s: &Source<'_>, table: &Spanned<RawMotion>, per_turn: f64) -> Checked<GearboxMotion> {
    let raw = table.get_ref();
    let drive = s.choice_of("drive", &raw.drive)?;
    let input_torque = given!(s, MOTION, raw.input_torque_nm)?.map(|t| 1e3 * t);
    if let (GearboxDrive::Speed | GearboxDrive::Balanced, Some(own)) = (drive, &raw.input_torque_nm) {
        let said = "an input of given speed has a torque of its own";
        return Err(s.conflict(
            &own.span(),
            said,
            "take `drive = \"torque\"`, or leave the torque out: it is a result",
        ));
    }
    let to_speed_rpm = given!(s, MOTION, raw.to_speed_rpm)?;
    if let (GearboxDrive::Torque, Some(own)) = (drive, &raw.to_speed_rpm) {
        let said = "the speed at the end is a result where a torque drives";
        return Err(s.conflict(&own.span(), said, "take `drive = \"speed\"`, or leave `to_speed_rpm` out"));
    }
    let speed_rpm = needed_of(s, (table, "[motion]"), &MOTION, "speed_rpm", &raw.speed_rpm)?;
    if let (true, Some(own)) = (to_speed_rpm == Some(speed_rpm), &raw.to_speed_rpm) {
        let said = format!("`to_speed_rpm` is {speed_rpm}, and so is `speed_rpm`: the speed stays");
        return Err(s.conflict(&own.span(), said, "leave `to_speed_rpm` out, or give another speed"));
    }
    if let (Some(_), Some(own)) = (&raw.mesh_damping_ns_per_mm2, &raw.mesh_damping_ratio) {
        let said = "the damping of the meshes is given twice";
        return Err(s.conflict(&own.span(), said, "keep one of `mesh_damping_ratio` and `mesh_damping_ns_per_mm2`"));
    }
    let method = s.choice_of::<Integration>("method", &raw.method)?;
    let radius = given!(s, MOTION, raw.spectral_radius)?;
    if let (Some(own), false) = (&raw.spectral_radius, method == Integration::GeneralisedAlpha) {
        let said = "a spectral radius belongs to generalised-alpha";
        return Err(s.conflict(&own.span(), said, "take `method = \"generalised-alpha\"`, or leave it out"));
    }
    let mesh = s.choice_of("mesh", &raw.mesh)?;
    let of_maps = [("map_tolerance", &raw.map_tolerance), ("map_overload", &raw.map_overload)];
    if let (Some((key, span)), true) =
        (of_maps.into_iter().find_map(|(key, own)| Some((key, own.as_ref()?.span()))), mesh != MeshModel::Mapped)
    {
        let said = format!("`{key}` belongs to maps, and there are none");
        return Err(s.conflict(&span, said, "take `mesh = \"mapped\"`, or leave it out"));
    }
    let speed_rpm = needed_of(s, (table, "[motion]"), &MOTION, "speed_rpm", &raw.speed_rpm)?;
    let cycles = cycles(s, raw, 0.5 * (speed_rpm + to_speed_rpm.unwrap_or(speed_rpm)) / 60.0 * per_turn)?;
    let steps_per_cycle = row!(s, MOTION, raw.steps_per_cycle)?;
    let steps_per_row = row!(s, MOTION, raw.steps_per_row)?;
    let settle = settle(s, raw, [steps_per_cycle, steps_per_row])?;
    if let (true, Some(own)) = (steps_per_cycle < LEAST_ROWS * steps_per_row, &raw.steps_per_row) {
        let said = format!("a cycle of {steps_per_cycle} steps with a row each {steps_per_row}");
        let hint = format!("{LEAST_ROWS} rows a cycle at the least: lower `steps_per_row`, or raise `steps_per_cycle`");
        return Err(s.conflict(&own.span(), said, hint));
    }
    let rows = u64::from(cycles) * u64::from(steps_per_cycle) / u64::from(steps_per_row);
    if rows > ROWS {
        let said = format!("a motion of {rows} rows");
        let at = raw.duration_s.as_ref().map_or(table.span(), Spanned::span);
        return Err(s.conflict(&at, said, format!("{ROWS} at the most: raise `steps_per_row`")));
    }
    Ok(GearboxMotion {
        speed_rpm,
        to_speed_rpm,
        drive,
        input_torque,
        mesh,
        cycles,
        duration: given!(s, MOTION, raw.duration_s)?,
        steps_per_cycle,
        steps_per_row,
        waterfall_cycles: row!(s, MOTION, raw.waterfall_cycles)?,
        scheme: method.scheme(radius),
        error_tolerance: given!(s, MOTION, raw.error_tolerance)?,
        stop_at_events: row!(s, MOTION, raw.stop_at_events)?,
        settle,
        shoots: s.choice_of::<GearboxRun>("run", &raw.run)? == GearboxRun::Shooting,
        mesh_damping: match given!(s, MOTION, raw.mesh_damping_ns_per_mm2)? {
            Some(per_length) => GearboxDamping::PerLength(per_length),
            None => GearboxDamping::Ratio(row!(s, MOTION, raw.mesh_damping_ratio)?),
        },
        modal_damping_ratio: row!(s, MOTION, raw.modal_damping_ratio)?,
        highest_frequency_hz: given!(s, MOTION, raw.highest_frequency_hz)?,
        map_tolerance: row!(s, MOTION, raw.map_tolerance)?,
        map_overload: row!(s, MOTION, raw.map_overload)?,
        checkpoint_every_cycles: row!(s, MOTION, raw.checkpoint_every_cycles)?,
    })
}

/// Cycles of the fastest mesh, stated or of a duration; `mesh_hz`: its mean frequency.
///
/// The mean speed of a run-up is that of both ends: its smooth step is even about its middle.
fn cycles(s: &Source<'_>, raw: &RawMotion, mesh_hz: f64) -> Checked<u32> {
    let Some(duration) = given!(s, MOTION, raw.duration_s)? else { return row!(s, MOTION, raw.cycles) };
    let at = raw.duration_s.as_ref().map_or(0..0, Spanned::span);
    if let Some(own) = &raw.cycles {
        let said = "`duration_s` and `cycles` both say how long the motion is";
        return Err(s.conflict(&own.span(), said, "leave one of both out"));
    }
    let cycles = whole_cycles(duration * mesh_hz);
    if cycles > MOST_CYCLES {
        let said = format!("{duration} s are {cycles:.0} cycles of the fastest mesh");
        return Err(s.conflict(&at, said, format!("{MOST_CYCLES:.0} at the most: take a shorter one")));
    }
    Ok(cycles as u32)
}

/// What a motion waits for before its rows.
fn settle(s: &Source<'_>, raw: &RawMotion, [per_cycle, per_row]: [u32; 2]) -> Checked<Option<(f64, u32)>> {
    let run = s.choice_of::<GearboxRun>("run", &raw.run)?;
    let is_branch = run == GearboxRun::Continuation;
    if run == GearboxRun::Span {
        let own = [
            raw.periodic_tolerance.as_ref().map(|x| (x.span(), "periodic_tolerance")),
            raw.warm_up_cycles.as_ref().map(|x| (x.span(), "warm_up_cycles")),
        ];
        if let Some((span, key)) = own.into_iter().flatten().next() {
            let said = format!("`{key}` belongs to a motion that settles first");
            return Err(s.conflict(&span, said, "take `run = \"steady\"`, or leave it out"));
        }
        return Ok(None);
    }
    if s.choice_of::<GearboxDrive>("drive", &raw.drive)? == GearboxDrive::Torque
        && let Some(drive) = &raw.drive
    {
        let said = "under a torque the speed wanders, and a motion without a given speed has no period";
        return Err(s.conflict(&drive.span(), said, "take `run = \"span\"`, or `drive = \"speed\"`"));
    }
    if let (Some(ramp), false) = (&raw.to_speed_rpm, is_branch) {
        let said = "a motion whose speed changes never repeats itself";
        return Err(s.conflict(&ramp.span(), said, "take `run = \"span\"`, or leave `to_speed_rpm` out"));
    }
    if !per_cycle.is_multiple_of(per_row)
        && let Some(own) = &raw.steps_per_row
    {
        let said = format!("rows of {per_row} steps do not meet the ends of cycles of {per_cycle}");
        let hint = "let `steps_per_row` divide `steps_per_cycle`, or take `run = \"span\"`";
        return Err(s.conflict(&own.span(), said, hint));
    }
    Ok(Some((row!(s, MOTION, raw.periodic_tolerance)?, row!(s, MOTION, raw.warm_up_cycles)?)))
}
