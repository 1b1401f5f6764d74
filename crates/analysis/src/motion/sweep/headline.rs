//! Headline values of a sweep.

use scene::{MotionScene, Run, SweepScene, SweepWay};
use serde::Serialize;

use super::{SweepRow, SweepStatus};
use crate::motion::{
    orders::CriticalSpeed,
    setup::{ElasticHeadline, InertiaHeadline, PreparedMotion, Vibration},
};

described::described! {
    /// A speed without a motion.
    #[derive(Debug, Clone, PartialEq, Serialize)]
    pub struct FailedSpeed {
        /// direction from which the speed was reached
        pub way: SweepWay,
        /// speed of the driver
        pub speed_rpm: f64,
        /// reason why there is no motion
        pub reason: String,
    }
}

described::described! {
    /// The few numbers that a sweep is made for.
    #[derive(Debug, Clone, PartialEq, Serialize)]
    pub struct SweepHeadline {
        /// `sweep`
        pub run: Run,
        /// mesh resonance, as of one motion
        pub mesh_resonance_hz: f64,
        /// speed of the driver at which the mesh frequency is the mesh resonance
        pub mesh_resonance_rpm: f64,
        /// inertia of the gears, and the mesh resonance with either choice of it
        pub inertia: InertiaHeadline,
        /// elastic frequencies of the gears beside the mesh harmonics
        pub elasticity: ElasticHeadline,
        /// mean static transmission error under the same load
        pub mean_ste_um: f64,
        /// peak to peak of the static transmission error under the same load
        pub peak_to_peak_ste_um: f64,
        /// mean tangent mesh stiffness of the quasi-static cycle
        pub mean_mesh_stiffness_n_per_um: f64,
        /// mean sum of the normal forces of the quasi-static cycle
        pub mean_static_normal_force_n: f64,
        /// of each direction the row with the largest peak to peak of the DTE
        pub largest: Vec<SweepRow>,
        /// speeds at which no periodic motion was found
        pub not_periodic_rpm: Vec<f64>,
        /// speeds without a solution
        pub failed: Vec<FailedSpeed>,
        /// speeds, up to the highest of the run, at which a mesh order meets a natural frequency
        pub critical_speeds: Vec<CriticalSpeed>,
    }
}

/// What a sweep is made for: the largest answer of each way, and where no periodic state was found.
pub(super) fn headline(
    (motion, sweep): (&MotionScene, &SweepScene),
    prepared: &PreparedMotion,
    (rows, vibration): (&[SweepRow], &Vibration),
    critical_speeds: Vec<CriticalSpeed>,
    teeth: u32,
) -> SweepHeadline {
    let has_motion = |r: &&SweepRow| r.status != SweepStatus::Failed;
    let largest = sweep.ways.iter().filter_map(|way| {
        let of_way = rows.iter().filter(|r| r.way == *way).filter(has_motion);
        of_way.max_by(|a, b| a.peak_to_peak_dte_um.total_cmp(&b.peak_to_peak_dte_um)).cloned()
    });
    let ste = prepared.quasi_static.transmission_error.iter().map(|e| 1e3 * e);
    let [low, high] = ste.fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], e| [l.min(e), h.max(e)]);
    let resonance = prepared.system.mesh_resonance_hz();
    let of_status = |status: SweepStatus| rows.iter().filter(move |r| r.status == status);
    SweepHeadline {
        run: motion.run,
        mesh_resonance_hz: resonance,
        mesh_resonance_rpm: 60.0 * resonance / f64::from(teeth),
        inertia: InertiaHeadline::of(&prepared.system),
        elasticity: prepared.elasticity.headline(vibration),
        mean_ste_um: 1e3 * prepared.quasi_static.mean_error(),
        peak_to_peak_ste_um: high - low,
        mean_mesh_stiffness_n_per_um: 1e-3 * prepared.quasi_static.stiffness,
        mean_static_normal_force_n: prepared.quasi_static.normal_force,
        largest: largest.collect(),
        not_periodic_rpm: of_status(SweepStatus::NotPeriodic).map(|r| r.speed_rpm).collect(),
        failed: of_status(SweepStatus::Failed)
            .map(|r| FailedSpeed { way: r.way, speed_rpm: r.speed_rpm, reason: r.reason.clone() })
            .collect(),
        critical_speeds,
    }
}
