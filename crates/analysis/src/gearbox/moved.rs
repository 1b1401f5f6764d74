//! Results of a gearbox motion.

use std::sync::Arc;

use answer::{Checks, Remark, RowStore};
use dynamics::MeshResonance;
use gearbox::motion::{GearboxEnergy, GearboxInstant, ReductionCertificate};
use integrate::Periodicity;

use super::{
    orders::MotionOrder,
    reached::ReachedByRows,
    swings::{GearFrequencies, GearboxCampbell},
};
use crate::{
    in_motion::FlankCertificate,
    motion::{ElasticHeadline, EnergyRow, MotionSpectrum, RunUp, Waterfall},
    run_up::RunUpTorque,
};

/// Rows of a gearbox motion, with the energy balance so far row by row.
pub type GearboxRows = (RowStore<GearboxInstant>, RowStore<EnergyRow>);

/// Results of a gearbox motion that was run.
#[derive(Debug, Clone)]
pub struct GearboxMotionResult {
    /// Rows, including the initial state.
    pub rows: Arc<RowStore<GearboxInstant>>,
    /// Energy balance so far, row by row.
    pub ledger: Arc<RowStore<EnergyRow>>,
    /// Extremes of the rows.
    pub reached: ReachedByRows,
    /// Frequency of each mesh at the initial speed, Hz.
    pub mesh_frequencies: Vec<f64>,
    /// Mean stiffness of each mesh along its normal, N/mm, near its equilibrium.
    pub stiffness: Vec<f64>,
    /// Damping of each mesh along its normal, N s/mm.
    pub damping: Vec<f64>,
    /// Length of a step, s.
    pub step: f64,
    /// Number of steps taken, and of those that were divided.
    pub steps: [u64; 2],
    /// Average number of steps per cycle of the fastest mesh, over the cycles with rows.
    pub steps_per_cycle: Option<f64>,
    /// Energy balance.
    pub energy: GearboxEnergy,
    /// Residual of the ledger, divided by the energy transmitted by the gearbox.
    pub ledger_residual_over_work: f64,
    /// Events and extremes of the flanks of each mesh.
    pub flanks: Vec<FlankCertificate>,
    /// Largest used share of each mesh's map; 0 for other meshes.
    pub reach: Vec<f64>,
    /// Error of each mesh's map relative to its mean approach, and the largest permitted error; `None` without a map.
    pub map_errors: Vec<Option<[f64; 2]>>,
    /// Resonance of both gears of each mesh vibrating against each other on its mean stiffness.
    pub resonances: Vec<MeshResonance>,
    /// Estimated change of the peak to peak of each mesh by the steps, %; empty for a motion that was stopped.
    pub step_errors_percent: Vec<Option<f64>>,
    /// Elastic frequencies of the gears of each mesh compared with its harmonics; empty for a motion that was stopped.
    pub elasticity: Vec<ElasticHeadline>,
    /// Whether the meshes compute the pressure on their flanks, which those with exact contact do.
    pub knows_pressure: bool,
    /// Number of evenly spaced rows, including the initial state.
    pub even_rows: usize,
    /// Whether the motion after the rows repeats from their beginning.
    pub comes_back: bool,
    /// Orders of every mesh, section by section.
    pub orders: Vec<MotionOrder>,
    /// Spectra of a motion with a speed ramp: transmission error (um) and normal force (N) of each mesh, then the force
    /// of each bearing (N).
    pub waterfall: Option<Waterfall>,
    /// Spectra of a motion without a speed ramp: the quantities of the waterfall, over all rows.
    pub spectrum: Option<MotionSpectrum>,
    /// Number of cycles of the fastest mesh after which all meshes are in their initial positions; `None` if that takes
    /// more than 100,000.
    pub common_period: Option<u64>,
    /// Elastic modes of the gears, in order; `None` for gears that are rigid apart from their teeth.
    pub gear_modes: Vec<Option<GearFrequencies>>,
    /// Accuracy of the reduction of the shafts.
    pub reduction: ReductionCertificate,
    /// Cycles of the fastest mesh before the rows.
    pub warm_up_cycles: u64,
    /// Final periodicity of the motion, its period in cycles of the fastest mesh; `None` if it need not be periodic.
    pub periodicity: Option<Periodicity>,
    /// Each mesh over the speed of the input, for a speed ramp; otherwise empty.
    pub run_ups: Vec<RunUp>,
    /// Natural frequencies over the speed of the input, for a run-up; `None` if those of a vibration are given.
    pub campbell: Option<GearboxCampbell>,
    /// Torque at the input that accelerates all parts driven by the meshes in a run-up, and that of the loads.
    pub run_up: Option<RunUpTorque>,
    /// What must hold of it.
    pub(super) checks: Checks,
    /// What a user should hear of it.
    pub(super) remarks: Vec<Remark>,
}
