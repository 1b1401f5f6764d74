//! `[motion]` of a gearbox file: how the gearbox runs in time.

use integrate::Scheme;
use serde::Deserialize;
use toml::Spanned;

use super::values::{Checked, needed_number};
use crate::{
    Integration, Source,
    spanned::{Number, Whole, Word},
};

/// Rows of a motion at the most.
const ROWS: u64 = 500_000;

/// How a gearbox runs in time, from its equilibrium on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GearboxMotion {
    /// Speed of the input, 1/min: always, or at the start where a torque drives.
    pub speed_rpm: f64,
    /// Speed at the end, 1/min, of a motion at given speed that goes from one to another over all its cycles.
    pub to_speed_rpm: Option<f64>,
    /// What drives.
    pub drive: GearboxDrive,
    /// Torque on the input, N mm, where a torque drives; none: what balances the loads.
    pub input_torque: Option<f64>,
    /// What stands for the meshes.
    pub mesh: MeshModel,
    /// Cycles of the fastest mesh.
    pub cycles: u32,
    /// Steps a cycle of the fastest mesh.
    pub steps_per_cycle: u32,
    /// Steps a row.
    pub steps_per_row: u32,
    /// Method of integration.
    pub scheme: Scheme,
    /// Damping ratio of the gears turning against each other at a mesh.
    pub mesh_damping_ratio: f64,
    /// Damping ratio of every elastic mode.
    pub modal_damping_ratio: f64,
    /// Highest frequency that shafts must show, Hz; none: four times that of the fastest mesh.
    pub highest_frequency_hz: Option<f64>,
    /// Error of maps that is aimed at, over the mean approach.
    pub map_tolerance: f64,
    /// Cycles of the fastest mesh from one checkpoint to the next; 0: none.
    pub checkpoint_every_cycles: u32,
}

/// What turns the input.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum GearboxDrive {
    /// It keeps its speed.
    Speed,
    /// A torque acts on it.
    Torque,
}

/// What stands for the meshes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MeshModel {
    /// A map of the exact contact.
    Mapped,
    /// A spring over the phase, by the exact contact about its mean.
    Spring,
    /// The exact contact at every step.
    Exact,
}

/// Keys of the table.
pub(super) const KEYS: &[&str] = &[
    "speed_rpm",
    "to_speed_rpm",
    "drive",
    "input_torque_nm",
    "mesh",
    "cycles",
    "steps_per_cycle",
    "steps_per_row",
    "method",
    "spectral_radius",
    "mesh_damping_ratio",
    "modal_damping_ratio",
    "highest_frequency_hz",
    "map_tolerance",
    "checkpoint_every_cycles",
];

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawMotion {
    pub speed_rpm: Number,
    pub to_speed_rpm: Number,
    pub drive: Word,
    pub input_torque_nm: Number,
    pub mesh: Word,
    pub cycles: Whole,
    pub steps_per_cycle: Whole,
    pub steps_per_row: Whole,
    pub method: Word,
    pub spectral_radius: Number,
    pub mesh_damping_ratio: Number,
    pub modal_damping_ratio: Number,
    pub highest_frequency_hz: Number,
    pub map_tolerance: Number,
    pub checkpoint_every_cycles: Whole,
}

pub(super) fn motion(s: &Source<'_>, table: &Spanned<RawMotion>) -> Checked<GearboxMotion> {
    let raw = table.get_ref();
    let drive = s.choice("drive", &raw.drive, &[("speed", GearboxDrive::Speed), ("torque", GearboxDrive::Torque)])?;
    let given = |key: &str, value: &Number, low: f64, high: f64| match value {
        Some(_) => s.number(key, value, 0.0, low, high).map(Some),
        None => Ok(None),
    };
    let input_torque = given("input_torque_nm", &raw.input_torque_nm, 0.0, 1e12)?.map(|t| 1e3 * t);
    if let (GearboxDrive::Speed, Some(own)) = (drive, &raw.input_torque_nm) {
        let said = "an input of given speed has a torque of its own";
        return Err(s.conflict(
            &own.span(),
            said,
            "take `drive = \"torque\"`, or leave the torque out: it is a result",
        ));
    }
    let to_speed_rpm = given("to_speed_rpm", &raw.to_speed_rpm, 1e-3, 1e7)?;
    if let (GearboxDrive::Torque, Some(own)) = (drive, &raw.to_speed_rpm) {
        let said = "the speed at the end is a result where a torque drives";
        return Err(s.conflict(&own.span(), said, "take `drive = \"speed\"`, or leave `to_speed_rpm` out"));
    }
    let models = [("mapped", MeshModel::Mapped), ("spring", MeshModel::Spring), ("exact", MeshModel::Exact)];
    let method = s.choice_of::<Integration>("method", &raw.method)?;
    let radius = given("spectral_radius", &raw.spectral_radius, 0.0, 1.0)?;
    if let (Some(own), false) = (&raw.spectral_radius, method == Integration::GeneralisedAlpha) {
        let said = "a spectral radius belongs to generalised-alpha";
        return Err(s.conflict(&own.span(), said, "take `method = \"generalised-alpha\"`, or leave it out"));
    }
    let cycles = s.whole("cycles", &raw.cycles, 50, 1, 1_000_000)?;
    let steps_per_cycle = s.whole("steps_per_cycle", &raw.steps_per_cycle, 64, 8, 10_000)?;
    let steps_per_row = s.whole("steps_per_row", &raw.steps_per_row, 1, 1, 1_000_000)?;
    let rows = u64::from(cycles) * u64::from(steps_per_cycle) / u64::from(steps_per_row);
    if rows > ROWS {
        let said = format!("a motion of {rows} rows");
        return Err(s.conflict(&table.span(), said, format!("{ROWS} at the most: raise `steps_per_row`")));
    }
    Ok(GearboxMotion {
        speed_rpm: needed_number(s, table, "[motion]", "speed_rpm", &raw.speed_rpm, 1e-3, 1e7)?,
        to_speed_rpm,
        drive,
        input_torque,
        mesh: s.choice("mesh", &raw.mesh, &models)?,
        cycles,
        steps_per_cycle,
        steps_per_row,
        scheme: method.scheme(radius),
        mesh_damping_ratio: s.number("mesh_damping_ratio", &raw.mesh_damping_ratio, 0.05, 0.0, 10.0)?,
        modal_damping_ratio: s.number("modal_damping_ratio", &raw.modal_damping_ratio, 0.02, 0.0, 1.0)?,
        highest_frequency_hz: given("highest_frequency_hz", &raw.highest_frequency_hz, 1.0, 1e7)?,
        map_tolerance: s.number("map_tolerance", &raw.map_tolerance, 2e-3, 1e-6, 0.5)?,
        checkpoint_every_cycles: s.whole("checkpoint_every_cycles", &raw.checkpoint_every_cycles, 0, 0, 1_000_000)?,
    })
}
