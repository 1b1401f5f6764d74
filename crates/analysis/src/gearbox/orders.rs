//! Orders of every mesh over a gearbox motion, and the waterfall for a speed ramp.

use std::f64::consts::TAU;

use answer::{RowStore, TableError};
use gearbox::motion::GearboxInstant;
use study::{StudyError, Window, order_amplitude};

use crate::{
    AnalysisError,
    motion::{MotionSpectrum, OrderCut, RPM, Stretches, Waterfall, waterfall as order_spectra},
};

/// Orders of each mesh.
pub(super) const ORDERS: usize = 5;
/// Rows of a spectrum at the least.
const FEWEST: usize = 8;
/// Cycles of the slowest mesh that a stretch has at the least.
const LEAST: f64 = 4.0;

/// Amplitudes at one order of one mesh over a section of the motion.
#[derive(Debug, Clone, PartialEq)]
pub struct MotionOrder {
    /// Time at the middle of the section, s.
    pub time: f64,
    /// Mean speed of the input, rad/s about +z.
    pub speed: f64,
    /// Mesh to which the order belongs.
    pub mesh: usize,
    /// Order of this mesh's frequency, from 1.
    pub order: usize,
    /// Frequency at the mean speed, Hz.
    pub frequency: f64,
    /// Dynamic transmission error of every mesh, mm.
    pub transmission_errors: Vec<f64>,
    /// Normal force of every mesh, N.
    pub mesh_forces: Vec<f64>,
    /// Force of every bearing, N: norm of the amplitudes along x, y and z.
    pub bearing_forces: Vec<f64>,
}

/// Orders of all meshes, stretch by stretch, each half over the one before; none where the slowest mesh has gone through
/// fewer than four cycles.
///
/// Stretches are as long as so many cycles of the slowest mesh, or as the motion: lines that are less than two over a
/// stretch apart, counted in cycles of the same mesh, are not told from each other.
///
/// # Errors
/// [`AnalysisError::Statistics`] for rows that hold what is no number.
pub(super) fn orders(rows: &RowStore<GearboxInstant>, cycles: u32) -> Result<Vec<MotionOrder>, AnalysisError> {
    let Some(Stretches { length, hop, .. }) = stretches((rows, rows.len()), cycles)? else { return Ok(Vec::new()) };
    let mut all = Vec::new();
    for from in (0..).map(|k| k * hop).take_while(|from| from + length <= rows.len()) {
        stretch(&rows.part(from..from + length)?, &mut all)?;
    }
    Ok(all)
}

/// Amplitudes of the orders of a mesh in its own transmission error, stretch by stretch.
pub(super) fn cuts(orders: &[MotionOrder], mesh: usize) -> Vec<OrderCut> {
    let own: Vec<&MotionOrder> = orders.iter().filter(|o| o.mesh == mesh).collect();
    let cut = |of: &[&MotionOrder]| OrderCut {
        time_s: of[0].time,
        driver_speed_rpm: of[0].speed.abs() / RPM,
        mesh_frequency_hz: of[0].frequency / of[0].order as f64,
        amplitudes_um: of.iter().map(|o| 1e3 * o.transmission_errors[mesh]).collect(),
    };
    own.chunk_by(|a, b| a.time == b.time).map(cut).collect()
}

/// Order spectra of every mesh and bearing over the same stretches, of a motion whose first rows, so many, are evenly spaced
/// along the turn of its input: transmission error (um) and normal force (N) of each mesh, then the force of each bearing
/// (N). Orders are those of the fastest mesh.
///
/// # Errors
/// [`AnalysisError::Statistics`] for rows that hold what is no number.
pub(super) fn waterfall(
    (rows, even): (&RowStore<GearboxInstant>, usize),
    cycles: u32,
) -> Result<Option<Waterfall>, AnalysisError> {
    let Some(stretches) = stretches((rows, even), cycles)? else { return Ok(None) };
    let mut all: Option<Waterfall> = None;
    for from in (0..).map(|k| k * stretches.hop).take_while(|from| from + stretches.length <= even) {
        let own = line(&rows.part(from..from + stretches.length)?, stretches)?;
        match &mut all {
            Some(all) => all.lines.extend(own.lines),
            None => all = Some(own),
        }
    }
    Ok(Some(all.unwrap_or_default()))
}

/// The spectra of one stretch.
fn line(rows: &[GearboxInstant], stretches: Stretches) -> Result<Waterfall, StudyError> {
    let quantities = Quantities::of(rows.iter());
    let column = |of: &dyn Fn(&GearboxInstant) -> f64| rows.iter().map(of).collect::<Vec<f64>>();
    let (time, speed) = (column(&|p| p.time), column(&|p| p.input[1] / RPM));
    order_spectra(&quantities.lists(), (&time, &speed), stretches)
}

/// Spectra of the same over the first rows, so many, of a motion whose speed is not led, so many cycles of the fastest mesh of a
/// frequency (Hz) at the start; the first row is the start and counts as the last one.
///
/// # Errors
/// [`AnalysisError::Statistics`] for rows that hold what is no number.
pub(super) fn spectrum(
    (rows, even): (&RowStore<GearboxInstant>, usize),
    of: (f64, f64),
    window: Window,
) -> Result<Option<MotionSpectrum>, AnalysisError> {
    if even <= FEWEST {
        return Ok(None);
    }
    let mut all = Quantities::default();
    rows.for_each(1..even, |row| all.push(row))?;
    Ok(Some(MotionSpectrum::of(&all.lists(), of, window)?))
}

/// What has a spectrum, each by its components: transmission error (um) and normal force (N) of each mesh, then the force of
/// each bearing (N).
#[derive(Default)]
struct Quantities(Vec<Vec<Vec<f64>>>);

impl Quantities {
    fn of<'a>(rows: impl Iterator<Item = &'a GearboxInstant>) -> Self {
        let mut all = Self::default();
        rows.for_each(|row| all.push(row));
        all
    }

    fn push(&mut self, row: &GearboxInstant) {
        let meshes = 2 * row.meshes.len();
        if self.0.is_empty() {
            self.0 = (0..meshes).map(|_| vec![Vec::new()]).collect();
            self.0.extend((0..row.bearings.len()).map(|_| vec![Vec::new(); 3]));
        }
        let (of_meshes, of_bearings) = self.0.split_at_mut(meshes);
        for (own, mesh) in of_meshes.chunks_exact_mut(2).zip(&row.meshes) {
            own[0][0].push(1e3 * mesh.transmission_error);
            own[1][0].push(mesh.normal_force);
        }
        for (own, bearing) in of_bearings.iter_mut().zip(&row.bearings) {
            own.iter_mut().zip(bearing.force).for_each(|(along, force)| along.push(force));
        }
    }

    fn lists(&self) -> Vec<Vec<&[f64]>> {
        self.0.iter().map(|components| components.iter().map(Vec::as_slice).collect()).collect()
    }
}

/// Stretches of so many cycles of the slowest mesh, or of the whole motion, each half over the one before; `None` where the
/// slowest mesh has gone through fewer than four cycles.
fn stretches((rows, count): (&RowStore<GearboxInstant>, usize), cycles: u32) -> Result<Option<Stretches>, TableError> {
    let (Some(first), Some(last)) = (rows.get(0)?, rows.get(count.saturating_sub(1))?) else { return Ok(None) };
    let gone = || first.meshes.iter().zip(&last.meshes).map(|(a, b)| (b.cycles - a.cycles).abs());
    let (slowest, fastest) = (gone().fold(f64::INFINITY, f64::min), gone().fold(0.0, f64::max));
    if !(slowest >= LEAST && slowest.is_finite()) {
        return Ok(None);
    }
    // Rows of a ramp are as many a turn everywhere; those of a motion that a torque drives nearly so. Orders of the fastest
    // mesh are in the middle of lines.
    let (whole, per_cycle) = ((f64::from(cycles) * fastest / slowest).round(), (count - 1) as f64 / fastest);
    let length = ((whole * per_cycle).round() as usize).clamp(8, count.max(8));
    Ok(Some(Stretches {
        length,
        hop: (length / 2).max(1),
        per_cycle,
        cycles_per_turn: fastest * TAU / (last.input[0] - first.input[0]).abs(),
    }))
}

fn stretch(rows: &[GearboxInstant], all: &mut Vec<MotionOrder>) -> Result<(), StudyError> {
    let (first, last) = (&rows[0], &rows[rows.len() - 1]);
    let span = last.time - first.time;
    let speed = (last.input[0] - first.input[0]) / span;
    let samples = |of: &dyn Fn(&GearboxInstant) -> f64| rows.iter().map(of).collect::<Vec<f64>>();
    for mesh in 0..first.meshes.len() {
        let places = samples(&|p| p.meshes[mesh].cycles);
        let cycles = (last.meshes[mesh].cycles - first.meshes[mesh].cycles).abs();
        for order in 1..=ORDERS {
            // Fewer than four rows a period show another line.
            if cycles * order as f64 * 4.0 > rows.len() as f64 {
                break;
            }
            let at = |of: &dyn Fn(&GearboxInstant) -> f64| order_amplitude(&samples(of), &places, order as f64);
            let meshes = 0..first.meshes.len();
            let errors = meshes.clone().map(|m| at(&|p| p.meshes[m].transmission_error));
            let forces = meshes.clone().map(|m| at(&|p| p.meshes[m].normal_force));
            let bearing = |b: usize| {
                let along = |axis: usize| at(&move |p| p.bearings[b].force[axis]);
                Ok(along(0)?.hypot(along(1)?).hypot(along(2)?))
            };
            all.push(MotionOrder {
                time: 0.5 * (first.time + last.time),
                speed,
                mesh,
                order,
                frequency: order as f64 * cycles / span,
                transmission_errors: errors.collect::<Result<_, _>>()?,
                mesh_forces: forces.collect::<Result<_, _>>()?,
                bearing_forces: (0..first.bearings.len()).map(bearing).collect::<Result<_, StudyError>>()?,
            });
        }
    }
    Ok(())
}
