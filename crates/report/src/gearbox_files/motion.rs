//! A gearbox in motion as numbers of the summary and as a part of its page.

use std::f64::consts::TAU;

use analysis::{
    gearbox::{GearboxMotionResult, GearboxResult, ReachedByMesh, RunUpTorque},
    in_motion::FlankCertificate,
    motion::{ElasticHeadline, RunUp, RunUpHeadline},
};
use answer::Answer;
use described::Key;
use gearbox::motion::ReductionCertificate;
use scene::gearbox::Gearbox;
use serde::Serialize;

use super::motion_charts::{is_run_up, motion_charts};
use crate::{
    ReportError,
    page::{Cell, Grid, Line, Part},
};

described::described! {
    /// A gearbox in motion, as `summary.json` has it.
    #[derive(Serialize)]
    pub(super) struct MotionSummary<'a> {
        /// rows of `motion.csv`
        rows: usize,
        /// length of a step; of the longest one with an `error_tolerance`
        step_s: f64,
        /// steps that were taken
        steps: u64,
        /// steps that were divided: no solution as a whole, or too large an error
        divided_steps: u64,
        /// cycles of the fastest mesh before the rows
        warm_up_cycles: u64,
        /// cycles of the fastest mesh after which a steady motion comes back; else `null`
        period_cycles: Option<usize>,
        /// largest difference of a coordinate or velocity after that period, over its peak to peak
        periodicity: Option<f64>,
        /// cycles of the fastest mesh after which all meshes are where they began; `null` beyond 100,000
        common_period_cycles: Option<u64>,
        /// meshes, in the order of the file
        meshes: Vec<MeshMotion<'a>>,
        /// bearings, in the order of the file
        bearings: Vec<BearingMotion<'a>>,
        /// gears that keep elastic modes, in the order of the file
        gears: Vec<GearMotion<'a>>,
        /// energy since the start, in common axes
        energy: EnergySummary,
        /// shafts in motion
        reduction: ShaftReductionSummary,
    }

    /// A mesh in motion.
    #[derive(Serialize)]
    struct MeshMotion<'a> {
        /// name of the mesh
        name: &'a str,
        /// mesh frequency
        mesh_hz: f64,
        /// mean stiffness along the normal
        mean_mesh_stiffness_n_per_um: f64,
        /// damping along the normal
        mesh_damping_n_s_per_mm: f64,
        /// largest minus smallest dynamic transmission error of a mesh cycle, averaged over the cycles; with `to_speed_rpm` the largest of a cycle
        peak_to_peak_dte_um: f64,
        /// smallest dynamic transmission error over all rows
        min_dte_um: f64,
        /// largest dynamic transmission error over all rows
        max_dte_um: f64,
        /// smallest sum of the normal forces on the driving flanks over all rows, damping included
        min_normal_force_n: f64,
        /// largest sum of the normal forces on the driving flanks over all rows, damping included
        max_normal_force_n: f64,
        /// largest sum of the normal forces on the coast flanks over all rows, damping included
        max_coast_normal_force_n: f64,
        /// natural frequency of both gears turning against each other on the mean stiffness; 0 where neither can
        mesh_resonance_hz: f64,
        /// about how much of itself steps change the peak to peak of the DTE by: an estimate from its mesh orders beside the mesh resonance, where steps follow an error for their mean length ([theory](theory.md), equation 66a); `null` of a run-up, where an explicit method follows an error, and of rows too few to tell orders
        step_error_percent: Option<f64>,
        /// elastic frequencies of the gears beside the mesh harmonics
        elasticity: &'a ElasticHeadline,
        /// what the flanks do
        #[serde(flatten)]
        flanks: &'a FlankCertificate,
        /// largest values of a run-up and where they are; `null` without one
        ramp: Option<RunUpHeadline>,
        /// root mean square error of the map's approach at random places over the mean approach; `null` without a map
        map_error: Option<f64>,
        /// largest share of the map's forces and tilts, or of the half by which a tilt may change a spring; beyond 1 the rows are not valid
        map_excess: f64,
    }

    /// A bearing in motion.
    #[derive(Serialize)]
    struct BearingMotion<'a> {
        /// name of the bearing
        name: &'a str,
        /// smallest radial force over all rows
        min_radial_force_n: f64,
        /// largest radial force over all rows
        max_radial_force_n: f64,
    }

    /// A gear with elastic modes in motion.
    #[derive(Serialize)]
    struct GearMotion<'a> {
        /// name of the gear
        name: &'a str,
        /// elastic modes that move
        elastic_modes: usize,
        /// frequency of the highest of them, bore held and flanks free
        highest_elastic_mode_hz: f64,
    }

    /// Energy since the start.
    #[derive(Serialize)]
    struct EnergySummary {
        /// work of the input
        input_work_mj: f64,
        /// work of the outputs, below 0 of loads
        output_work_mj: f64,
        /// kinetic energy at the end
        kinetic_mj: f64,
        /// elastic energy of the shafts at the end
        shafts_mj: f64,
        /// elastic energy of bearings and housing at the end
        supports_mj: f64,
        /// elastic energy of the meshes at the end, modes of gears among it
        meshes_mj: f64,
        /// gain of kinetic and elastic energy
        gained_mj: f64,
        /// energy dissipated
        dissipated_mj: f64,
        /// energy that does not close over the sum of all
        relative_residual: f64,
        /// energy that does not close, as the integrator has it, over the work that goes through the gearbox
        ledger_residual_over_work: f64,
        /// energy that the steps add or take by themselves over the kinetic and elastic energy that comes and goes in them; the bound is 1e-2
        open_over_vibration: f64,
    }

    /// Reduction of the shafts.
    #[derive(Serialize)]
    pub(super) struct ShaftReductionSummary {
        /// degrees of freedom of all nodes
        dof: usize,
        /// degrees of freedom that are kept
        dof_kept: usize,
        /// modes that are kept
        kept_modes: usize,
        /// highest frequency that was asked for
        highest_frequency_hz: f64,
        /// natural frequencies up to there that were compared with those of all nodes
        frequencies_compared: usize,
        /// largest relative error of these frequencies
        frequency_error: f64,
    }
}

/// Objects of the summary with their keys.
pub(super) fn objects() -> Vec<(&'static str, Vec<Key>)> {
    vec![
        ("motion", MotionSummary::KEYS.to_vec()),
        ("meshes, motion", [MeshMotion::KEYS, FlankCertificate::KEYS].concat()),
        ("bearings, motion", BearingMotion::KEYS.to_vec()),
        ("gears, motion", GearMotion::KEYS.to_vec()),
        ("energy, motion", EnergySummary::KEYS.to_vec()),
        ("reduction, motion", ShaftReductionSummary::KEYS.to_vec()),
    ]
}

/// Summary of a motion; `None` at rest alone.
pub(super) fn summary<'a>(file: &'a Gearbox, result: &'a GearboxResult) -> Option<MotionSummary<'a>> {
    let motion = result.motion.as_ref()?;
    let mesh = |i: usize| {
        let ReachedByMesh { dte_um, peak_to_peak_dte_um, normal_force, .. } = motion.reached.meshes[i];
        MeshMotion {
            name: &result.meshes[i].name,
            mesh_hz: motion.mesh_frequencies[i],
            mean_mesh_stiffness_n_per_um: 1e-3 * motion.stiffness[i],
            mesh_damping_n_s_per_mm: motion.damping[i],
            peak_to_peak_dte_um,
            min_dte_um: dte_um.least,
            max_dte_um: dte_um.largest,
            min_normal_force_n: normal_force.least,
            max_normal_force_n: normal_force.largest,
            max_coast_normal_force_n: motion.reached.meshes[i].coast_normal_force,
            mesh_resonance_hz: motion.resonances[i].hz,
            step_error_percent: motion.step_errors_percent[i],
            elasticity: &motion.elasticity[i],
            flanks: &motion.flanks[i],
            ramp: motion.run_ups.get(i).and_then(RunUp::headline),
            map_error: motion.map_errors[i].map(|[error, _]| error),
            map_excess: motion.reach[i],
        }
    };
    let bearings = file.bearings.iter().enumerate().map(|(i, b)| {
        let force = motion.reached.radial_force[i];
        BearingMotion { name: &b.name, min_radial_force_n: force.least, max_radial_force_n: force.largest }
    });
    let gears = file.gears.iter().zip(&motion.gear_modes).filter_map(|(gear, modes)| {
        let all = &modes.as_ref()?.frequencies_hz;
        Some(GearMotion { name: &gear.name, elastic_modes: all.len(), highest_elastic_mode_hz: *all.last()? })
    });
    let energy = &motion.energy;
    Some(MotionSummary {
        rows: motion.rows.len(),
        step_s: motion.step,
        steps: motion.steps[0],
        divided_steps: motion.steps[1],
        warm_up_cycles: motion.warm_up_cycles,
        period_cycles: motion.periodicity.map(|p| p.period),
        periodicity: motion.periodicity.map(|p| p.residual),
        common_period_cycles: motion.common_period,
        meshes: (0..file.meshes.len()).map(mesh).collect(),
        bearings: bearings.collect(),
        gears: gears.collect(),
        energy: EnergySummary {
            input_work_mj: energy.input_work,
            output_work_mj: energy.output_work,
            kinetic_mj: energy.kinetic,
            shafts_mj: energy.shafts,
            supports_mj: energy.supports,
            meshes_mj: energy.meshes,
            gained_mj: energy.gained,
            dissipated_mj: energy.dissipated,
            relative_residual: energy.relative_residual,
            ledger_residual_over_work: motion.ledger_residual_over_work,
            open_over_vibration: energy.open_over_vibration,
        },
        reduction: reduction_summary(&motion.reduction),
    })
}

/// How well the shafts were reduced.
pub(super) fn reduction_summary(reduction: &ReductionCertificate) -> ShaftReductionSummary {
    ShaftReductionSummary {
        dof: reduction.coordinates[0],
        dof_kept: reduction.coordinates[1],
        kept_modes: reduction.modes,
        highest_frequency_hz: reduction.limit / TAU,
        frequencies_compared: reduction.compared,
        frequency_error: reduction.error,
    }
}

/// Meshes and bearings in motion, charts over time, and over speed of a run-up.
///
/// # Errors
/// [`ReportError`] where rows cannot be read back.
pub(super) fn parts(file: &Gearbox, result: &GearboxResult, answer: &Answer) -> Result<Vec<Part>, ReportError> {
    let Some(motion) = &result.motion else { return Ok(Vec::new()) };
    let words = "Least and largest values are those of all rows; a peak to peak is the mean over the cycles of the mesh, of a \
                 run-up the largest of a cycle.";
    let words = if is_run_up(motion) {
        format!("Orders over the speed and spectra are those of stretches of some cycles of the slowest mesh. {words}")
    } else {
        words.to_owned()
    };
    let head = ["in motion", "mesh Hz", "DTE p-p um", "least N", "largest N", "coast flanks N", "contact lost"];
    let meshes = (0..file.meshes.len()).map(|i| {
        let ReachedByMesh { peak_to_peak_dte_um, normal_force, coast_normal_force, .. } = motion.reached.meshes[i];
        vec![
            Cell::text(&result.meshes[i].name),
            Cell::number(motion.mesh_frequencies[i], 1),
            Cell::number(peak_to_peak_dte_um, 3),
            Cell::number(normal_force.least, 0),
            Cell::number(normal_force.largest, 0),
            Cell::number(coast_normal_force, 0),
            Cell::count(motion.flanks[i].contact_losses),
        ]
    });
    let bearings = file.bearings.iter().enumerate().map(|(i, b)| {
        let force = motion.reached.radial_force[i];
        vec![Cell::text(&b.name), Cell::number(force.least, 1), Cell::number(force.largest, 1)]
    });
    let reduction = &motion.reduction;
    let note = format!(
        "{} steps; {} of {} coordinates of the shafts, frequencies up to {:.0} Hz. {}",
        motion.steps[0],
        reduction.coordinates[1],
        reduction.coordinates[0],
        reduction.limit / TAU,
        together(motion)
    );
    let radial = Grid::new(["bearing", "least radial N", "largest N"]).rows(bearings);
    Ok(vec![
        Part::new("In motion").closing().words(words).grid(Grid::new(head).rows(meshes)).note(note),
        run_up(result, motion),
        Part::more().grid(radial).figures(motion_charts(file, motion, answer)?),
    ])
}

/// How long a run-up takes, what its acceleration asks for, and where each mesh is worst.
fn run_up(result: &GearboxResult, motion: &GearboxMotionResult) -> Part {
    let Some(RunUpTorque { duration, inertia, load }) = motion.run_up else { return Part::more() };
    let share = format!("N m at the input, {} % of the load", crate::tables::fixed(100.0 * inertia / load, 1));
    let lines = [
        Line::number("run-up lasts", duration, 3, "s"),
        Line::number("largest torque that accelerates", 1e-3 * inertia, 2, share),
        Line::number("torque of the loads", 1e-3 * load, 2, "N m at the input"),
    ];
    let rows = result.meshes.iter().zip(&motion.run_ups).filter_map(|(mesh, own)| {
        let RunUpHeadline { peak_to_peak_dte_um: swing, normal_force_n: force, .. } = own.headline()?;
        Some(vec![
            Cell::text(&mesh.name),
            Cell::number(swing.value, 3),
            Cell::number(swing.driver_speed_rpm, 0),
            Cell::number(force.value, 0),
            Cell::number(force.driver_speed_rpm, 0),
        ])
    });
    let head = ["mesh", "largest p-p DTE um", "at input 1/min", "largest force N", "at input 1/min"];
    Part::new("Run-up").closing().lines(lines).grid(Grid::new(head).rows(rows))
}

/// After how long all meshes come back together.
fn together(motion: &GearboxMotionResult) -> String {
    let Some(period) = motion.common_period else {
        return "The meshes do not come back together within 100,000 cycles of the fastest.".to_owned();
    };
    let gone = motion.reached.cycles.last().copied().unwrap_or(0.0).floor();
    let few = if gone < period as f64 { "; a section needs as many rows" } else { "" };
    format!("All meshes come back together after {period} cycles of the fastest, of {gone} here{few}.")
}
