//! What a motion of a gearbox comes to.

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

/// Rows of a gearbox's motion, with the energy so far row for row.
pub type GearboxRows = (RowStore<GearboxInstant>, RowStore<EnergyRow>);

/// A gearbox in motion, run.
#[derive(Debug, Clone)]
pub struct GearboxMotionResult {
    /// Rows, the start among them.
    pub rows: Arc<RowStore<GearboxInstant>>,
    /// Energy so far, row for row.
    pub ledger: Arc<RowStore<EnergyRow>>,
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
    /// Steps in a cycle of the fastest mesh with rows, on average.
    pub steps_per_cycle: Option<f64>,
    /// Where the energy went.
    pub energy: GearboxEnergy,
    /// Energy of the ledger that does not close, over the work that goes through the gearbox.
    pub ledger_residual_over_work: f64,
    /// What the flanks of each mesh do.
    pub flanks: Vec<FlankCertificate>,
    /// How much of its map each mesh has used at most; 0 for others.
    pub reach: Vec<f64>,
    /// Error of the map of each mesh over its mean approach, beside the most with which it is taken; `None` without a map.
    pub map_errors: Vec<Option<[f64; 2]>>,
    /// Both gears of each mesh turning against each other on its mean stiffness.
    pub resonances: Vec<MeshResonance>,
    /// About how much of itself steps change the peak to peak of each mesh by, %: an estimate; none of a motion that was stopped.
    pub step_errors_percent: Vec<Option<f64>>,
    /// Elastic frequencies of the gears of each mesh beside its harmonics; none of a motion that was stopped.
    pub elasticity: Vec<ElasticHeadline>,
    /// Whether the meshes know the pressure of their flanks: those of the exact contact.
    pub knows_pressure: bool,
    /// Rows, the start among them, that are evenly spaced.
    pub even_rows: usize,
    /// Whether what comes after the rows is what they began with.
    pub comes_back: bool,
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
    /// Each mesh over the speed of the input, where that is led from one to another; else none.
    pub run_ups: Vec<RunUp>,
    /// Natural frequencies over the speed of the input, of a run-up; `None` where those of a vibration are told.
    pub campbell: Option<GearboxCampbell>,
    /// What the acceleration of a run-up takes at the input: of all that the meshes drive, beside their loads.
    pub run_up: Option<RunUpTorque>,
    /// What must hold of it.
    pub(super) checks: Checks,
    /// What a user should hear of it.
    pub(super) remarks: Vec<Remark>,
}
