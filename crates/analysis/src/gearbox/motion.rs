//! A gearbox in motion: from its equilibrium on, row by row.

use std::{f64::consts::TAU, sync::Arc};

use answer::{Remark, RowStore, TableError};
use gearbox::{
    GearboxError,
    motion::{
        ContactSpring, Drive, GearboxCheckpoint, GearboxEnergy, GearboxInstant, GearboxMechanism, GearboxRun,
        MotionOptions, MotionPlan, ReductionCertificate,
    },
};
use integrate::{Ahead, Follower, Periodicity, Row, Stage, State};
use scene::gearbox::{GearboxDrive, GearboxMotion};

use super::{
    at_rest::AtRest,
    inertia,
    orders::{MotionOrder, orders, spectrum, waterfall},
    parts::{input_over_time, over_time},
    sink::GearboxSink,
    swings::{GearFrequencies, gear_frequencies},
};
use crate::{
    AnalysisError, Observer, PhaseWork, Progress,
    motion::{MotionSpectrum, QuasiStatic, Waterfall, window},
    run_phase,
    run_up::RunUpTorque,
    running::Running,
    unless_cancelled,
};

/// Highest frequency of the shafts over that of the fastest mesh, where none is stated.
const BEYOND: f64 = 4.0;

/// Where a motion begins, and where it is to stop.
#[derive(Debug, Default)]
pub(super) struct Span {
    /// State to go on from, with the rows before it.
    pub from: Option<(GearboxCheckpoint, RowStore<GearboxInstant>)>,
    /// Stop when so many cycles of the fastest mesh are done.
    pub stop_after: Option<u64>,
}

/// A gearbox in motion, run.
#[derive(Debug, Clone)]
pub struct GearboxMotionResult {
    /// Rows, the start among them.
    pub rows: Arc<RowStore<GearboxInstant>>,
    /// What they reach.
    pub reached: ReachedByRows,
    /// Frequency of each mesh at the speed of the start, Hz.
    pub mesh_frequencies: Vec<f64>,
    /// Mean stiffness of each mesh along its normal, N/mm, about where it stands.
    pub stiffness: Vec<f64>,
    /// Damping of each mesh along its normal, N s/mm.
    pub damping: Vec<f64>,
    /// Length of a step, s.
    pub step: f64,
    /// Steps taken, and those that were divided.
    pub steps: [u64; 2],
    /// Where the energy went.
    pub energy: GearboxEnergy,
    /// How often flanks of each mesh came apart: on the side that drives, and on the other one.
    pub separations: Vec<[u64; 2]>,
    /// How much of its map each mesh has used at most; 0 for others.
    pub reach: Vec<f64>,
    /// Orders of every mesh, stretch by stretch.
    pub orders: Vec<MotionOrder>,
    /// Spectra of a motion whose speed is led from one to another: transmission error (um) and normal force (N) of each
    /// mesh, then the force of each bearing (N).
    pub waterfall: Option<Waterfall>,
    /// Spectra of a motion whose speed is not led: what a waterfall has, over all rows.
    pub spectrum: Option<MotionSpectrum>,
    /// Cycles of the fastest mesh after which all meshes are where they began; `None` where that takes more than 100,000.
    pub common_period: Option<u64>,
    /// Elastic modes of the gears, in their order; `None` of gears that are rigid beside their teeth.
    pub gear_modes: Vec<Option<GearFrequencies>>,
    /// How well the shafts were reduced.
    pub reduction: ReductionCertificate,
    /// Cycles of the fastest mesh before the rows.
    pub warm_up_cycles: u64,
    /// How nearly the motion repeats itself at last, period in cycles of the fastest mesh; `None` where it need not.
    pub periodicity: Option<Periodicity>,
    /// What the acceleration of a run-up takes at the input: of all that the meshes drive, beside their loads.
    pub run_up: Option<RunUpTorque>,
    /// What was said of files of maps.
    pub(super) map_remarks: Vec<Remark>,
}

/// Least and largest value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Range {
    /// Least.
    pub least: f64,
    /// Largest.
    pub largest: f64,
}

impl Range {
    /// From the one to the other.
    pub fn span(self) -> f64 {
        self.largest - self.least
    }
}

/// What the rows of a motion reach.
#[derive(Debug, Clone, PartialEq)]
pub struct ReachedByRows {
    /// Dynamic transmission error of each mesh in all rows, um.
    pub dte_um: Vec<Range>,
    /// Normal force of each mesh in all rows, N.
    pub normal_force: Vec<Range>,
    /// Radial force of each bearing in all rows, N.
    pub radial_force: Vec<Range>,
    /// Size of the speed of the input in all rows, rad/s.
    pub input_speed: Range,
    /// Cycles of the fastest mesh since the first row, row by row, above 0 in the sense in which it goes on.
    pub cycles: Vec<f64>,
}

impl ReachedByRows {
    /// Of rows, with the frequencies of the meshes (Hz).
    fn of(rows: &RowStore<GearboxInstant>, mesh_frequencies: &[f64]) -> Result<Self, TableError> {
        let fastest = (0..mesh_frequencies.len()).max_by(|&a, &b| mesh_frequencies[a].total_cmp(&mesh_frequencies[b]));
        let mut cycles = Vec::with_capacity(rows.len());
        let [mut meshes, mut bearings]: [Vec<[Running; 2]>; 2] = Default::default();
        let mut speed = Running::default();
        rows.for_each(0..rows.len(), |row| {
            cycles.push(fastest.map_or(0.0, |mesh| row.meshes[mesh].cycles));
            speed.push(row.input[1].abs());
            meshes.resize(row.meshes.len(), Default::default());
            bearings.resize(row.bearings.len(), Default::default());
            for ([dte, force], mesh) in meshes.iter_mut().zip(&row.meshes) {
                dte.push(1e3 * mesh.transmission_error);
                force.push(mesh.normal_force);
            }
            for ([radial, _], bearing) in bearings.iter_mut().zip(&row.bearings) {
                radial.push(bearing.force[0].hypot(bearing.force[1]));
            }
        })?;
        let (first, last) = (cycles.first().copied().unwrap_or(0.0), cycles.last().copied().unwrap_or(0.0));
        let sense = if last < first { -1.0 } else { 1.0 };
        cycles.iter_mut().for_each(|own| *own = sense * (*own - first));
        let range = |of: &Running| Range { least: of.ends[0], largest: of.ends[1] };
        let ranges = |all: &[[Running; 2]], k: usize| all.iter().map(|own| range(&own[k])).collect();
        Ok(Self {
            dte_um: ranges(&meshes, 0),
            normal_force: ranges(&meshes, 1),
            radial_force: ranges(&bearings, 0),
            input_speed: range(&speed),
            cycles,
        })
    }
}

/// A gearbox that is ready to move, with what its meshes are.
pub(super) struct Ready {
    pub mechanism: GearboxMechanism,
    /// Equilibrium in which it begins.
    pub start: State,
    /// Mean stiffness of each mesh along its normal, N/mm, about where it stands.
    pub stiffness: Vec<f64>,
    /// Damping of each mesh along its normal, N s/mm.
    pub damping: Vec<f64>,
    /// What was said of files of maps.
    pub map_remarks: Vec<Remark>,
}

/// Makes the mechanism of a gearbox with a drive, up to a fastest speed (rad/s) of its input.
pub(super) fn ready(
    rest: &AtRest<'_>,
    asked: &GearboxMotion,
    (drive, fastest): (Drive, f64),
    observer: &mut dyn Observer,
) -> Result<Ready, AnalysisError> {
    let failed = |source: GearboxError| AnalysisError::from(source).in_file(&rest.file.file);
    let bodies = inertia::gears(rest.file, rest.reduced)?;
    let structure = inertia::heavy(rest.file, rest.linear, rest.operation, &bodies);
    let looked = run_phase(observer, "look at the meshes", PhaseWork::Unknown, |_| {
        let one = |i: usize| Ok((rest.spring(i).map_err(failed)?, rest.cycle(i)?));
        (0..rest.meshes.len()).map(one).collect::<Result<Vec<(ContactSpring, QuasiStatic)>, AnalysisError>>()
    });
    let (springs, cycles): (Vec<_>, Vec<_>) = looked?.into_iter().unzip();
    let damping: Vec<f64> = cycles.iter().enumerate().map(|(i, own)| rest.damping(i, &bodies, own, asked)).collect();
    let mut map_remarks = Vec::new();
    let elements = run_phase(observer, "make meshes", PhaseWork::Steps(rest.meshes.len() as u64), |progress| {
        let one = |i: usize| {
            let made = rest.element(i, asked, (&springs[i], &cycles[i], damping[i]), (progress, &mut map_remarks));
            progress.tick();
            made.map_err(|source| GearboxError::AtMesh { mesh: rest.meshes[i].name.clone(), source: Box::new(source) })
        };
        (0..rest.meshes.len()).map(one).collect::<Result<Vec<_>, _>>()
    })
    .map_err(failed)?;
    let limit = TAU * asked.highest_frequency_hz.unwrap_or_else(|| BEYOND * rest.fastest(fastest));
    let options = MotionOptions { drive, modal_damping: asked.modal_damping_ratio, limit };
    let mut elements = elements.into_iter();
    let (meshes, operation) = (rest.meshes.to_vec(), rest.operation.clone());
    let made = GearboxMechanism::new(structure, meshes, operation, &options, |_, mesh, _| {
        elements.next().ok_or(GearboxError::NotDriven { shaft: mesh.name.clone() })
    });
    let made = made.and_then(|own| own.with_rolling_bearings(rest.structure));
    let made = made.and_then(|own| own.with_torques(over_time(rest.file, rest.operation)));
    let balancing = -rest.load_at_input() * rest.operation.sense.sign() as f64;
    let of_input = input_over_time(rest.file, asked.input_torque.unwrap_or(balancing));
    let made = made.and_then(|own| match of_input {
        Some(law) => own.with_input_torque(law),
        None => Ok(own),
    });
    let mut mechanism = made.map_err(failed)?;
    let start = mechanism.start(options.modal_damping).map_err(failed)?;
    let stiffness = springs.iter().map(|s| s.stiffness().mean).collect();
    Ok(Ready { mechanism, start, stiffness, damping, map_remarks })
}

/// Runs a gearbox as its file asks for; the cycles of the fastest mesh after which it was stopped, where it was.
pub(super) fn run(
    rest: &AtRest<'_>,
    asked: &GearboxMotion,
    span: Span,
    (observer, sink): (&mut dyn Observer, &mut dyn GearboxSink),
) -> Result<(GearboxMotionResult, Option<u64>), AnalysisError> {
    let failed = |source: GearboxError| AnalysisError::from(source).in_file(&rest.file.file);
    let speed = asked.speed_rpm * TAU / 60.0;
    let drive = match asked.drive {
        GearboxDrive::Speed => Drive::Speed(rest.nominal(asked)),
        GearboxDrive::Balanced => Drive::Balanced(rest.nominal(asked)),
        GearboxDrive::Torque => Drive::Torque { start: speed, torque: asked.input_torque },
    };
    let fastest = speed.max(asked.to_speed_rpm.unwrap_or(0.0) * TAU / 60.0);
    let Ready { mut mechanism, start, stiffness, damping, map_remarks } =
        ready(rest, asked, (drive, fastest), observer)?;
    let run_up = match drive {
        Drive::Speed(speed) | Drive::Balanced(speed) => {
            RunUpTorque::new(speed, (mechanism.driven_inertia(), 1.0), rest.load_at_input())
        }
        Drive::Torque { .. } => None,
    };
    let plan = rest.plan(asked);
    let (from, rows) = span.from.map_or((None, RowStore::default()), |(from, rows)| (Some(from), rows));
    sink.begin_rows(from.is_some()).map_err(AnalysisError::Sink)?;
    let mut goal = mechanism.goal(&start, &plan).map_err(failed)?;
    goal.checkpoint_every = u64::from(asked.checkpoint_every_cycles);
    goal.stop_after = span.stop_after;
    let frequencies = mechanism.mesh_frequencies();
    let reduction = *mechanism.bodies().certificate();
    let mut course = mechanism.course(&start, &plan, from).map_err(failed)?;
    let mut told = Outcome { rows, sink, plan };
    let mut stopped = false;
    if let (Some(settle), false) = (plan.settle, course.stage().recording) {
        stopped = run_phase(observer, "settle", PhaseWork::AtMost(settle.most), |progress| {
            course.settle(&goal, &mut InPhase { told: &mut told, progress, settling: Some(settle.tolerance) })
        })
        .map_err(|e| e.in_file(&rest.file.file))?;
    }
    if !stopped {
        let left = PhaseWork::Steps(plan.cycles - course.stage().recorded.min(plan.cycles));
        stopped = run_phase(observer, "run", left, |progress| {
            course.record(&goal, &mut InPhase { told: &mut told, progress, settling: None })
        })
        .map_err(|e| e.in_file(&rest.file.file))?;
    }
    let stopped = stopped.then(|| course.cycle());
    let done = GearboxRun::of(course, &start).map_err(failed)?;
    let rows = told.rows;
    // The last row of a motion may be no whole row behind the one before.
    let even = plan.cycles.saturating_mul(plan.steps_per_cycle) / plan.steps_per_row.max(1);
    let even = rows.len().min(even as usize + 1);
    let result = GearboxMotionResult {
        orders: orders(&rows, asked.waterfall_cycles)?,
        waterfall: match asked.to_speed_rpm {
            Some(_) => waterfall((&rows, even), asked.waterfall_cycles)?,
            None => None,
        },
        spectrum: match asked.to_speed_rpm {
            Some(_) => None,
            None => {
                let fastest = frequencies.iter().fold(0.0, |m: f64, hz| m.max(*hz));
                let steps = (even.max(1) - 1) as f64 * plan.steps_per_row as f64;
                let found = done.periodicity.filter(|_| plan.settle.is_some());
                let window = window(found, plan.periodic_tolerance(), plan.cycles);
                spectrum((&rows, even), (steps / plan.steps_per_cycle as f64, fastest), window)?
            }
        },
        common_period: done.common_period,
        reached: ReachedByRows::of(&rows, &frequencies)?,
        rows: Arc::new(rows),
        mesh_frequencies: frequencies,
        stiffness,
        damping,
        step: rest.step(asked),
        steps: [done.steps, done.divided],
        energy: done.energy,
        separations: done.separations,
        reach: done.reach,
        gear_modes: gear_frequencies(rest.file.gears.len(), rest.modes),
        reduction,
        warm_up_cycles: done.warm_up,
        periodicity: done.periodicity.filter(|_| plan.settle.is_some()),
        run_up,
        map_remarks,
    };
    Ok((result, stopped))
}

/// Who is told of a motion, and its rows so far.
struct Outcome<'a> {
    rows: RowStore<GearboxInstant>,
    sink: &'a mut dyn GearboxSink,
    plan: MotionPlan,
}

/// The same in one phase of the analysis.
struct InPhase<'a, 'b> {
    told: &'a mut Outcome<'b>,
    progress: &'a dyn Progress,
    /// Tolerance to which the motion settles in this phase.
    settling: Option<f64>,
}

impl Follower<&mut GearboxMechanism> for InPhase<'_, '_> {
    type Error = AnalysisError;

    fn row(&mut self, row: Row<'_, &mut GearboxMechanism>) -> Result<(), AnalysisError> {
        let instant = row.system.instant(row.state)?;
        self.told.sink.row(&instant).map_err(AnalysisError::Sink)?;
        Ok(self.told.rows.push(instant)?)
    }

    fn cycle(&mut self, stage: &Stage) -> Result<(), AnalysisError> {
        self.progress.tick();
        unless_cancelled(self.progress)?;
        if let (Some(tolerance), Some(found)) = (self.settling, stage.periodicity) {
            self.progress.say(format!("repeats itself to {:.1e}, asked {tolerance:.0e}", found.residual));
        }
        Ok(())
    }

    fn seeks(&self, _: &&mut GearboxMechanism, found: Periodicity) -> bool {
        self.told.plan.seeks(found)
    }

    fn nearer(&mut self, system: &mut &mut GearboxMechanism, period: &Ahead) -> Result<Option<State>, AnalysisError> {
        Ok(system.nearer(period, self.told.plan.periodic_tolerance())?)
    }

    fn checkpoint(&mut self, state: GearboxCheckpoint) -> Result<(), AnalysisError> {
        self.told.sink.checkpoint(state).map_err(AnalysisError::Sink)
    }
}
