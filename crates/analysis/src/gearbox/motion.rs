//! A gearbox in motion, from its equilibrium on, row by row.

use std::{f64::consts::TAU, sync::Arc};

use answer::{Checks, Remark};
use dynamics::MeshResonance;
use gearbox::{
    GearboxError,
    motion::{
        ContactSpring, Drive, FlankCourse, GearboxCheckpoint, GearboxMechanism, GearboxRun, MotionOptions, MotionPlan,
    },
};
use integrate::{Ahead, Follower, Periodicity, Row, Stage, State};
use scene::gearbox::{GearboxDrive, GearboxMotion, MeshModel};
use study::Window;

use super::{
    at_rest::AtRest,
    inertia,
    motion_remarks::Judged,
    moved::{GearboxMotionResult, GearboxRows},
    orders::{cuts, orders, spectrum, waterfall},
    parts::{input_over_time, over_time},
    reached::ReachedByRows,
    sink::GearboxSink,
    swings::gear_frequencies,
};
use crate::{
    AnalysisError, Observer, PhaseWork, Progress,
    in_motion::{FlankCertificate, stretched},
    motion::{Elasticity, EnergyRow, QuasiStatic, RunUp, RunUpCycle, window},
    run_phase,
    run_up::RunUpTorque,
    unless_cancelled,
    unstable_steps::{Steps, UnstableSteps},
};

/// Highest frequency of the shafts over that of the fastest mesh, where none is stated.
const BEYOND: f64 = 4.0;

/// Where a motion begins, and where it is to stop.
#[derive(Debug, Default)]
pub(super) struct Span {
    /// State to go on from, with the rows before it.
    pub from: Option<(GearboxCheckpoint, GearboxRows)>,
    /// Stop when so many cycles of the fastest mesh are done.
    pub stop_after: Option<u64>,
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
    /// Each mesh through its own cycle at rest.
    pub cycles: Vec<QuasiStatic>,
    /// Both gears of each mesh turning against each other.
    pub resonances: Vec<MeshResonance>,
    /// Error of the map of each mesh, beside the most with which it is taken.
    pub map_errors: Vec<Option<[f64; 2]>>,
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
    let resonance = |(i, own): (usize, &QuasiStatic)| rest.resonance(i, &bodies, (own, damping[i]), asked);
    let resonances = cycles.iter().enumerate().map(resonance).collect();
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
    let (elements, map_errors): (Vec<_>, Vec<_>) = elements.into_iter().unzip();
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
    Ok(Ready { mechanism, start, stiffness, damping, cycles, resonances, map_errors, map_remarks })
}

/// Refuses steps of given length that are too long for an explicit method; `mechanism` has modal damping by its start.
///
/// # Errors
/// [`AnalysisError::Refused`] with the limit, the step, and the number of steps that would do.
pub(super) fn refuse_unstable(
    rest: &AtRest<'_>,
    asked: &GearboxMotion,
    mechanism: &mut GearboxMechanism,
) -> Result<(), AnalysisError> {
    if asked.error_tolerance.is_some() || !asked.scheme.is_explicit() {
        return Ok(());
    }
    let limit = mechanism.stable_step(asked.scheme).map_err(AnalysisError::from);
    let Some(limit) = limit.map_err(|e| e.in_file(&rest.file.file))? else { return Ok(()) };
    let step = rest.step(asked);
    let steps = Steps::of_gearbox(step, 1.0 / (step * f64::from(asked.steps_per_cycle)));
    match UnstableSteps::of(steps, limit) {
        Some(unstable) => Err(AnalysisError::from(unstable.refusal()).in_file(&rest.file.file)),
        None => Ok(()),
    }
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
    let Ready { mut mechanism, start, stiffness, damping, cycles, resonances, map_errors, map_remarks } =
        ready(rest, asked, (drive, fastest), observer)?;
    refuse_unstable(rest, asked, &mut mechanism)?;
    let run_up = match drive {
        Drive::Speed(speed) | Drive::Balanced(speed) => {
            RunUpTorque::new(speed, (mechanism.driven_inertia(), 1.0), rest.load_at_input())
        }
        Drive::Torque { .. } => None,
    };
    let plan = rest.plan(asked);
    let longer = stretched(asked.duration, plan.cycles, mechanism.time_of_cycles(plan.cycles as f64));
    let (from, rows) = span.from.map_or_else(Default::default, |(from, rows)| (Some(from), rows));
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
    let (rows, ledger) = told.rows;
    // The last row of a motion may be no whole row behind the one before.
    let even = plan.cycles.saturating_mul(plan.steps_per_cycle) / plan.steps_per_row.max(1);
    let even = rows.len().min(even as usize + 1);
    let found = done.periodicity.filter(|_| plan.settle.is_some());
    let window = window(found, plan.periodic_tolerance(), plan.cycles);
    let at_rest: Vec<f64> = cycles.iter().map(|own| own.normal_force).collect();
    let reached = ReachedByRows::of(&rows, &frequencies, asked.to_speed_rpm.map(|_| &at_rest[..]))?;
    let orders = orders(&rows, asked.waterfall_cycles)?;
    let over_speed = |(mesh, all): (usize, &Vec<RunUpCycle>)| RunUp { cycles: all.clone(), cuts: cuts(&orders, mesh) };
    let is_led = asked.to_speed_rpm.is_some();
    let run_ups = reached.cycles_of_meshes.iter().enumerate().filter(|_| is_led).map(over_speed).collect();
    let on_flanks = |(i, own): (usize, &FlankCourse)| {
        let both = reached.meshes.get(i).map_or_else(Default::default, |mesh| mesh.both);
        FlankCertificate::new(own, both, stiffness[i])
    };
    let mut result = GearboxMotionResult {
        ledger_residual_over_work: done.ledger.residual() / done.throughput.max(f64::MIN_POSITIVE),
        flanks: done.flanks.iter().enumerate().map(on_flanks).collect(),
        reach: done.flanks.iter().map(|own| own.reach).collect(),
        map_errors,
        resonances,
        step_errors_percent: Vec::new(),
        elasticity: Vec::new(),
        knows_pressure: asked.mesh == MeshModel::Exact,
        even_rows: even,
        comes_back: window == Window::Rectangular,
        orders,
        run_ups,
        campbell: None,
        waterfall: match asked.to_speed_rpm {
            Some(_) => waterfall((&rows, even), asked.waterfall_cycles)?,
            None => None,
        },
        spectrum: match asked.to_speed_rpm {
            Some(_) => None,
            None => {
                let fastest = frequencies.iter().fold(0.0, |m: f64, hz| m.max(*hz));
                let steps = (even.max(1) - 1) as f64 * plan.steps_per_row as f64;
                spectrum((&rows, even), (steps / plan.steps_per_cycle as f64, fastest), window)?
            }
        },
        common_period: done.common_period,
        reached,
        rows: Arc::new(rows),
        ledger: Arc::new(ledger),
        mesh_frequencies: frequencies,
        stiffness,
        damping,
        step: rest.step(asked),
        steps: [done.steps, done.divided],
        steps_per_cycle: done.steps_per_cycle,
        energy: done.energy,
        gear_modes: gear_frequencies(rest.file.gears.len(), rest.modes),
        reduction,
        warm_up_cycles: done.warm_up,
        periodicity: found,
        run_up,
        checks: Checks::default(),
        remarks: map_remarks.into_iter().chain(longer).collect(),
    };
    // What was stopped on the way is gone on with before it is judged.
    if stopped.is_none() {
        let each = cycles.iter().enumerate().map(|(i, own)| rest.elasticity(i, own));
        let elasticity = each.collect::<Result<Vec<_>, AnalysisError>>()?;
        let judged = Judged { rest, asked, elasticity: &elasticity, moved: &result };
        let of_mesh = |(i, own): (usize, &Elasticity)| own.headline(&judged.vibration(i));
        let resolved = (0..rest.meshes.len()).map(|i| judged.resolved(i)).collect::<Result<Vec<_>, _>>()?;
        let (headlines, checks, remarks) =
            (elasticity.iter().enumerate().map(of_mesh).collect(), judged.checks(), judged.remarks(&resolved));
        result.step_errors_percent = resolved.iter().map(|own| own.step_error_percent).collect();
        (result.elasticity, result.checks) = (headlines, checks);
        result.remarks.extend(remarks);
    }
    Ok((result, stopped))
}

/// Who is told of a motion, and its rows so far.
struct Outcome<'a> {
    rows: GearboxRows,
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
        let Row { system, state, ledger } = row;
        let (instant, energy) = (system.instant(state)?, EnergyRow::of(state.time, ledger));
        self.told.sink.row(&instant, &energy).map_err(AnalysisError::Sink)?;
        self.told.rows.0.push(instant)?;
        Ok(self.told.rows.1.push(energy)?)
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
