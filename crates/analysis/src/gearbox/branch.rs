//! The branch of periodic motions of a gearbox over the speed of its input: continuation, results, comparison with
//! motions in time.

use std::ops::ControlFlow;

use answer::{Check, Checks, Remark};
use dynamics::Speed;
use gearbox::{
    GearboxError,
    motion::{Drive, GearboxBranch as Followed, GearboxInstant, GearboxMechanism, ReductionCertificate},
};
use periodic::{FourierSeries, PeriodicError, PeriodicMotion};
use scene::gearbox::{GearboxBranch, GearboxMotion};
use study::extent;

use super::{
    at_rest::AtRest,
    motion::{Ready, ready},
    motion_checks::{self, Contact},
};
use crate::{
    AnalysisError, Observer, PhaseWork, Progress,
    branch::{BranchFigures, BranchPoint, BranchTurn, BranchWords, ROWS, ReadOff, TimePoint, checks, stable_ones},
    motion::RPM,
    remark, run_phase, unless_cancelled,
};

/// Difference that modes above twice `highest_frequency_hz` may make to the size of the largest multiplier.
const MULTIPLIER: f64 = 0.02;

/// The branch of a gearbox over the speed of its input, with a point for each mesh of every motion.
#[derive(Debug, Clone)]
pub struct GearboxBranchResult {
    /// Headline values of the branch; parameter values are speeds of the input, 1/min.
    pub figures: BranchFigures,
    /// Motions in the order of the branch, per mesh.
    pub points: Vec<Vec<BranchPoint>>,
    /// Points at which the branch turns or another branch leaves it, per mesh.
    pub turns: Vec<Vec<BranchTurn>>,
    /// Stable motions integrated in time, per mesh.
    pub in_time: Vec<Vec<TimePoint>>,
    /// Number of cycles of each mesh in a period.
    pub mesh_cycles: Vec<u64>,
    /// Mean stiffness of each mesh along its normal, N/mm, near its equilibrium.
    pub stiffness: Vec<f64>,
    /// Damping of each mesh along its normal, N s/mm.
    pub damping: Vec<f64>,
    /// Largest used share of each mesh's map; 0 for other meshes.
    pub reach: Vec<f64>,
    /// Number of coordinates on which the meshes depend: unknowns per harmonic.
    pub seen: usize,
    /// Accuracy of the reduction of the shafts.
    pub reduction: ReductionCertificate,
    /// What must hold of the branch.
    pub(super) checks: Checks,
    /// What the user should hear.
    pub(super) remarks: Vec<Remark>,
}

impl GearboxBranchResult {
    /// Motion with the largest peak to peak of a mesh's transmission error.
    pub fn largest(&self, mesh: usize) -> Option<&BranchPoint> {
        self.points.iter().map(|p| &p[mesh]).max_by(|a, b| a.peak_to_peak_dte_um.total_cmp(&b.peak_to_peak_dte_um))
    }
}

/// Follows the branch that a file asks for.
pub(super) fn branch(
    rest: &AtRest<'_>,
    asked: &GearboxBranch,
    observer: &mut dyn Observer,
) -> Result<GearboxBranchResult, AnalysisError> {
    let failed = |source: GearboxError| AnalysisError::from(source).in_file(&rest.file.file);
    let range = [asked.motion.speed_rpm, asked.to_speed_rpm];
    let [begin, fastest] = [range[0], range[0].max(range[1])].map(|speed| speed * RPM);
    let drive = Drive::Speed(Speed::Constant(begin));
    let Ready { mut mechanism, start, stiffness, damping, map_errors, map_remarks, .. } =
        ready(rest, &asked.motion, (drive, fastest), observer)?;
    let plan = BranchWords {
        range,
        harmonics: [asked.harmonics, asked.most_harmonics],
        tail: asked.tail,
        phases: asked.phases,
        longest_step: asked.longest_step,
        motions: asked.motions,
    }
    .plan();
    let mut found = run_phase(observer, "branch", PhaseWork::Unknown, |progress| {
        let of = mechanism.branch(&start, (&plan, u64::from(asked.periods)), |motion| {
            progress.say(format!("{:.3} rpm", motion.parameter));
            if progress.is_cancelled() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        of.map_err(failed)
    })?;
    let (points, turns) = run_phase(observer, "read", PhaseWork::Steps(found.motions.len() as u64), |progress| {
        read(&mut mechanism, &mut found, progress).map_err(|e| e.in_file(&rest.file.file))
    })?;
    let reach = mechanism.reach().to_vec();
    let reduction = *mechanism.bodies().certificate();
    let chosen = stable_ones(points.iter().filter_map(|p| p.first()), asked.time_points as usize);
    let in_time = run_phase(observer, "in time", PhaseWork::Steps(chosen.len() as u64), |progress| {
        let one = |&i: &usize| {
            progress.tick();
            unless_cancelled(progress)?;
            let (motion, whole) = (&found.branch.motions[i], &found.motions[i]);
            integrated(rest, &mut mechanism, (&asked.motion, found.period_cycles), (motion, whole, &points[i]))
                .map_err(failed)
        };
        chosen.iter().map(one).collect::<Result<Vec<_>, AnalysisError>>()
    })?;
    let read = ReadOff { points: &points, turns: &turns, in_time: &in_time };
    let [coordinates, seen] = found.coordinates;
    let of = (&found.branch, &plan, "the speed, 1/min,");
    let figures = BranchFigures::new(of, read, (coordinates, found.period_cycles as u32));
    let rolls = rest.structure.bearings.iter().any(|b| b.law.is_some());
    let springs = rolls.then(remark::branch_linear_bearings);
    let of_branch = figures.remarks(("periods", 2 * asked.periods));
    let contacts = map_errors.iter().zip(&reach).map(|(&map_error, &reach)| Contact {
        model: asked.motion.mesh,
        map_error,
        reach,
        on_branch: true,
    });
    let of_machine = motion_checks::of_branch(contacts, &reduction);
    Ok(GearboxBranchResult {
        remarks: map_remarks
            .into_iter()
            .chain(springs)
            .chain([remark::inertia_not_judged()])
            .chain(of_branch)
            .collect(),
        checks: of_machine.and(checks(&found.branch, &plan)).and(Checks::new([modes_left_out(&found)])),
        figures,
        turns,
        in_time,
        mesh_cycles: found.mesh_cycles,
        stiffness,
        damping,
        reach,
        seen,
        reduction,
        points,
    })
}

/// What modes do to the stability of motions that are judged without them.
fn modes_left_out(found: &Followed) -> Check {
    let of = |[known, all]: &[f64; 2]| (known - all).abs() / all.max(1.0);
    let off = found.with_all_modes.iter().map(of).fold(0.0, crate::worse);
    Check::new(
        "multiplier_error",
        off,
        MULTIPLIER,
        "state a higher `highest_frequency_hz`: modes up to twice that are judged",
    )
}

/// Points of every motion and of every bifurcation, mesh by mesh.
type ReadBranch = (Vec<Vec<BranchPoint>>, Vec<Vec<BranchTurn>>);

/// Of each mesh a point of every motion, up to one that a mesh has no forces for, and of every bifurcation.
fn read(
    mechanism: &mut GearboxMechanism,
    found: &mut Followed,
    progress: &dyn Progress,
) -> Result<ReadBranch, AnalysisError> {
    let (cycles, count) = (found.mesh_cycles.clone(), ROWS * found.period_cycles as usize);
    let mut read = |motion: &PeriodicMotion, whole: &FourierSeries| {
        let rows = mechanism.instants((motion.parameter * RPM, motion.period), whole, count)?;
        let point = |(mesh, &own): (usize, &u64)| {
            let list = |of: fn(&GearboxInstant, usize) -> f64| rows.iter().map(|r| of(r, mesh)).collect::<Vec<_>>();
            let [errors, forces] =
                [list(|r, i| 1e3 * r.meshes[i].transmission_error), list(|r, i| r.meshes[i].normal_force)];
            BranchPoint::new(motion, &errors, &forces, own as usize)
        };
        Ok::<Vec<BranchPoint>, GearboxError>(cycles.iter().enumerate().map(point).collect())
    };
    let mut points = Vec::new();
    for (motion, whole) in found.branch.motions.iter().zip(&found.motions) {
        progress.tick();
        unless_cancelled(progress)?;
        match read(motion, whole) {
            Ok(own) => points.push(own),
            // Flanks that no map has would touch: the branch holds up to there.
            Err(source) if source.is_without_result() && !points.is_empty() => {
                let parameter = motion.parameter;
                found.branch.broken = Some(PeriodicError::Mechanism { parameter, phase: 0.0, source });
                break;
            }
            Err(source) => return Err(source.into()),
        }
    }
    found.branch.motions.truncate(points.len());
    let passed = found.branch.bifurcations.iter().zip(&found.bifurcations);
    let turns = passed.filter(|(own, _)| own.after + 1 < points.len()).map(|(own, whole)| {
        Ok(read(&own.motion, whole)?.into_iter().map(|point| BranchTurn::new(own, point)).collect())
    });
    let turns = turns.collect::<Result<Vec<Vec<BranchTurn>>, AnalysisError>>()?;
    Ok((points, turns))
}

/// Runs a motion of the branch on in time, until it repeats itself or for as long as the file waits for that.
fn integrated(
    rest: &AtRest<'_>,
    mechanism: &mut GearboxMechanism,
    (asked, cycles): (&GearboxMotion, u64),
    (motion, whole, points): (&PeriodicMotion, &FourierSeries, &[BranchPoint]),
) -> Result<Vec<TimePoint>, GearboxError> {
    mechanism.set_speed(motion.parameter * RPM);
    let start = GearboxMechanism::state_of(whole, motion.period, 0.0);
    let here = GearboxMotion { speed_rpm: motion.parameter, cycles: cycles as u32, ..*asked };
    let mut errors = vec![Vec::new(); points.len()];
    mechanism.run(&start, &rest.plan(&here), |instant| {
        errors.iter_mut().zip(&instant.meshes).for_each(|(list, mesh)| list.push(1e3 * mesh.transmission_error));
    })?;
    let one = |(errors, point): (&Vec<f64>, &BranchPoint)| {
        let [low, high] = extent(errors);
        TimePoint {
            value: motion.parameter,
            peak_to_peak_dte_um: high - low,
            branch_peak_to_peak_dte_um: point.peak_to_peak_dte_um,
        }
    };
    Ok(errors.iter().zip(points).map(one).collect())
}
