//! Results of a quasi-static analysis at its positions.

use ale::{Station, ToothWindow};
use contact::{Site, SliceResult, Wrench};
use geometry::Side;
use serde::Serialize;

use crate::{FilletField, FilletStress, RootPattern};

/// One tooth pair of the window at one position.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PairResult {
    /// Running number of the pair. It increases by one from pair to pair in the sense of rotation and never wraps.
    pub pair: i64,
    /// Pinion tooth number, 0 .. z1-1.
    pub pinion_tooth: u32,
    /// Wheel tooth number, 0 .. z2-1.
    pub wheel_tooth: u32,
    /// Sum of the normal forces, N.
    pub normal_force: f64,
    /// Largest contact pressure, MPa.
    pub max_pressure: f64,
    /// Length of this pair's contact line, mm; NaN if not requested ([`crate::StaticOptions::line_lengths`]).
    pub contact_line_length: f64,
    /// Analytic length of the unloaded contact line, mm; 0 outside the path of contact.
    pub geometric_line_length: f64,
    /// Number of slices or quadrature points that carry load.
    pub points_in_contact: usize,
    /// The loaded slices, ascending in z; empty for contact of points.
    pub slices: Vec<SliceResult>,
    /// Derivative of the transmission error by the gap of each of these slices; empty if not requested
    /// ([`crate::StaticOptions::gap_rates`]), and where there is none.
    pub gap_rates: Vec<f64>,
}

/// Residuals of a solved position.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct Certificate {
    /// |contact torque - applied torque| / applied torque.
    pub torque_residual: f64,
    /// Largest violation of g >= 0, p >= 0, p g = 0, relative to the largest approach and pressure.
    pub complementarity_residual: f64,
    /// Largest component of (force on pinion + force on wheel) / largest force.
    pub action_reaction_residual: f64,
    /// Round-off of positions divided by the approach of the flanks under load: the share of the load's work that is
    /// lost to round-off.
    pub round_off_share: f64,
    /// Error of the pose at the last step, relative to the approach of the flanks; above round-off if the force jumps
    /// as the gear rotates.
    pub pose_residual: f64,
    /// Number of Newton (active-set) iterations.
    pub iterations: usize,
    /// Largest error of the interpolated bulk compliance between two slices, relative to the largest self-compliance; 0
    /// if it is exact.
    pub bulk_compliance_error: f64,
    /// Force on the teeth at the ends of the window relative to the total force. It shows how close the window is to
    /// being too small.
    pub window_edge_load: f64,
}

/// All results at one position.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StaticPosition {
    /// Pinion angle, rad, in the sense of rotation, measured from the middle position of pair 0.
    pub pinion_angle: f64,
    /// Mesh phase, 0 .. 1.
    pub mesh_phase: f64,
    /// Transmission error, mm on the transverse line of action; positive if the driven gear lags.
    pub transmission_error: f64,
    /// Transmission error without load, mm, caused only by micro-geometry and misalignment. Like the transmission error
    /// it is counted from the position at which the unmodified flanks would touch with parallel axes through the gears'
    /// centres.
    pub kinematic_transmission_error: f64,
    /// F_bt / (te - kinematic te), N/mm; NaN without load.
    pub secant_stiffness: f64,
    /// d F_bt / d te, N/mm.
    pub tangent_stiffness: f64,
    /// Total length of the contact lines of all pairs, mm; NaN if not requested.
    pub contact_line_length: f64,
    /// Analytic length of the contact lines of the unloaded pair, mm.
    pub geometric_line_length: f64,
    /// Pairs of the window, ascending.
    pub pairs: Vec<PairResult>,
    /// Mesh force and moment on pinion and wheel.
    pub wrench: [Wrench; 2],
    /// Largest contact pressure, MPa.
    pub max_pressure: f64,
    /// Stress in the root fillets of the window's teeth on pinion and wheel, tooth by tooth counter-clockwise; empty if
    /// not requested.
    pub root_stress: [Vec<FilletStress>; 2],
    /// The same fillets with the stress at all their points; a history keeps the largest alone ([`StaticHistory::roots`]).
    #[serde(skip)]
    pub root_fields: [Vec<FilletField>; 2],
    /// Friction work per radian of pinion rotation, N mm, >= 0. Multiplied by the pinion's speed it is the power loss.
    pub friction_work: f64,
    /// Normal force times sliding per radian of pinion rotation, summed over the contact, N mm: the friction work of
    /// these forces for a coefficient of friction of 1. It is computed without friction as well.
    pub sliding_work: f64,
    /// Elastic energy of both gears and the contact, N mm.
    pub strain_energy: f64,
    /// Number of tooth changes since the start of the run.
    pub tooth_changes: u64,
    /// Residuals of the solution.
    pub certificate: Certificate,
}

impl StaticPosition {
    /// With stress in its fillets.
    pub(crate) fn with_roots(self, root_fields: [Vec<FilletField>; 2]) -> Self {
        let peaks = |all: &Vec<FilletField>| all.iter().map(|own| own.peaks).collect();
        Self { root_stress: root_fields.each_ref().map(peaks), root_fields, ..self }
    }

    /// Largest contact pressure of slices at end faces and tip edges, MPa; 0 if there are none, and for contact of
    /// points.
    pub fn max_edge_pressure(&self) -> f64 {
        let slices = self.pairs.iter().flat_map(|pair| &pair.slices);
        slices.filter(|s| s.site != Site::Flank).map(|s| s.pressure).fold(0.0, f64::max)
    }
}

/// Results of a whole quasi-static run.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct StaticHistory {
    /// Positions in the order of the rotation.
    pub positions: Vec<StaticPosition>,
    /// Tooth changes during the run, in order.
    pub tooth_changes: Vec<ToothChangeRecord>,
    /// Remarks for the user: neglected effects, doubtful results, adjusted inputs.
    pub remarks: Vec<answer::Remark>,
    /// Largest tensions at the points of the loaded fillets of pinion and wheel, if root stress is requested.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub roots: Option<[RootPattern; 2]>,
    /// The same mesh cycles under other torques, if requested for a load spectrum.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub under_loads: Vec<LoadCycle>,
}

/// Mesh cycles under a torque that differs from that of their history.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LoadCycle {
    /// Torque on the driven gear, N mm, above 0.
    pub torque: f64,
    /// Positions in the order of the rotation.
    pub positions: Vec<StaticPosition>,
    /// Largest tensions as in [`StaticHistory::roots`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub roots: Option<[RootPattern; 2]>,
}

impl StaticHistory {
    /// Adds a position, whose fillets loaded on `side` of the teeth go into [`StaticHistory::roots`].
    pub(crate) fn push(&mut self, mut position: StaticPosition, side: Side) {
        let fields = std::mem::take(&mut position.root_fields);
        if fields.iter().any(|own| !own.is_empty()) {
            let roots = self.roots.get_or_insert_default();
            roots.iter_mut().zip(&fields).for_each(|(own, fields)| own.take(fields, side));
        }
        self.positions.push(position);
    }
}

/// A tooth change: the same station solved with the windows before and after it.
#[derive(Debug, Clone)]
pub struct ToothChange {
    /// Result with the old window.
    pub before: StaticPosition,
    /// Result with the new window.
    pub after: StaticPosition,
    /// The new window.
    pub window: ToothWindow,
}

/// Station of a tooth change and the resulting change of the solution there. This change is only round-off, because the
/// outgoing teeth are unloaded.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ToothChangeRecord {
    /// Mesh cycles since the start.
    pub mesh_cycles: f64,
    /// Pinion angle, rad, defined as that of a position.
    pub pinion_angle: f64,
    /// Outgoing teeth of pinion and wheel.
    pub outgoing: [u32; 2],
    /// Oncoming teeth of pinion and wheel.
    pub oncoming: [u32; 2],
    /// |transmission error after - before|, mm.
    pub error_jump: f64,
    /// |sum of normal forces after - before|, N.
    pub force_jump: f64,
}

impl ToothChange {
    /// Record of the change at a station, with the resulting change of the solution.
    pub fn record(&self, station: Station) -> ToothChangeRecord {
        let Self { before, after, .. } = self;
        let only_in = |these: &StaticPosition, those: &StaticPosition| {
            let own = these.pairs.iter().find(|p| those.pairs.iter().all(|q| q.pair != p.pair));
            own.map_or([0; 2], |p| [p.pinion_tooth, p.wheel_tooth])
        };
        let force = |p: &StaticPosition| p.pairs.iter().map(|pair| pair.normal_force).sum::<f64>();
        ToothChangeRecord {
            mesh_cycles: station.cycle as f64 + station.phase,
            pinion_angle: after.pinion_angle,
            outgoing: only_in(before, after),
            oncoming: only_in(after, before),
            error_jump: (after.transmission_error - before.transmission_error).abs(),
            force_jump: (force(after) - force(before)).abs(),
        }
    }
}
