//! Headline values of a run.

use ltca::{StaticHistory, StaticPosition};
use scene::Scene;
use serde::Serialize;
use study::{Harmonic, StudyError, cycle_statistics, mesh_harmonics};

use super::{
    PressurePlace, RootStressHeadline, ToothChangeHeadline, face_load_factor, load_sharing_ratio, root_stress_headline,
    transverse_load_factor,
};
use crate::{pair_rating::RatingHeadline, worse};

/// Mesh harmonics of the transmission error that are listed.
const ORDERS: usize = 8;

described::described! {
    /// The few numbers that a run is made for; units are in the names.
    #[derive(Debug, Clone, PartialEq, Serialize)]
    pub struct StaticHeadline {
        /// mean static transmission error (STE) over all positions
        pub mean_ste_um: f64,
        /// largest minus smallest sampled STE of a mesh cycle, averaged over the cycles; it belongs to `samples_per_cycle`
        pub peak_to_peak_ste_um: f64,
        /// smallest STE of all positions
        pub min_ste_um: f64,
        /// largest STE of all positions
        pub max_ste_um: f64,
        /// positions per mesh cycle
        pub samples_per_cycle: usize,
        /// mesh cycles that were solved
        pub cycles: usize,
        /// single-sided amplitudes of the mesh harmonics 1 .. 8 of the STE (a sine of amplitude 1 reads 1), without a window function, since the history is whole cycles
        pub ste_harmonics_um: Vec<f64>,
        /// mean secant mesh stiffness
        pub mean_mesh_stiffness_n_per_um: f64,
        /// mean tangent mesh stiffness
        pub mean_mesh_stiffness_tangent_n_per_um: f64,
        /// mean total contact-line length under load
        pub mean_contact_line_length_mm: f64,
        /// mean total contact-line length of the unloaded pair, analytic
        pub mean_geometric_line_length_mm: f64,
        /// mean sum of the normal forces of all tooth pairs
        pub mean_normal_force_n: f64,
        /// mean mesh force on the wheel: x, y, z in fixed axes
        pub mean_wheel_force_n: [f64; 3],
        /// mean mesh moment on the pinion about y through its centre
        pub mean_pinion_tilting_moment_nmm: f64,
        /// mean mesh moment on the wheel about y through its centre
        pub mean_wheel_tilting_moment_nmm: f64,
        /// mean power lost to friction at the scene's speed
        pub mean_friction_power_loss_w: f64,
        /// mean output power over mean input power
        pub efficiency: f64,
        /// H_VL: sum of the solved normal forces times the sliding of the flanks, over the work of the driver. A coefficient of friction mu loses mu H_VL of the power (to first order: the forces are those of the run). Known without friction; missing without torque
        #[serde(skip_serializing_if = "Option::is_none")]
        pub tooth_loss_factor: Option<f64>,
        /// largest normal force of one tooth pair
        pub max_pair_force_n: f64,
        /// K_Hbeta as ISO 6336-1 defines it, from the solved distribution of the load: of the largest line loads that each height of the face sees over the mesh, the largest over their mean. Models with slices
        #[serde(skip_serializing_if = "Option::is_none")]
        pub face_load_factor: Option<f64>,
        /// K_Halpha of ISO 6336-1 from the solved distribution of the load: `load_sharing_ratio`, or 1 where that is below 1 ([theory](theory.md), equation 34a); missing without load
        #[serde(skip_serializing_if = "Option::is_none")]
        pub transverse_load_factor: Option<f64>,
        /// largest normal force of a tooth pair over the largest that it would have if the pairs in mesh shared the load as the analytic lengths of their contact lines. 1 for a spur pair of which one pair carries all for a while, below 1 where load spreads over more pairs; missing without load
        #[serde(skip_serializing_if = "Option::is_none")]
        pub load_sharing_ratio: Option<f64>,
        /// largest contact pressure of all positions
        pub max_pressure_mpa: f64,
        /// place of the largest pressure; `null` without slices
        pub max_pressure_at: Option<PressurePlace>,
        /// largest root stresses; `null` where they are not asked for
        pub root_stress: Option<RootStressHeadline>,
        /// ratings of the pair; missing without `[rating]`
        #[serde(skip_serializing_if = "Option::is_none")]
        pub rating: Option<RatingHeadline>,
        /// tooth changes of the window in the mesh cycles, one that closes the last of them included
        pub tooth_changes: usize,
        /// first tooth change, and the largest jumps at any of them; `null` without one
        pub tooth_change: Option<ToothChangeHeadline>,
        /// largest relative difference between the torque of the contact and the applied one
        pub worst_torque_residual: f64,
        /// largest relative violation of gap >= 0, pressure >= 0, one of them zero
        pub worst_complementarity_residual: f64,
        /// largest relative difference between the forces on pinion and wheel
        pub worst_action_reaction_residual: f64,
        /// largest share of the load on an end pair of the window
        pub worst_window_edge_load: f64,
        /// largest error of the interpolated bulk compliance of slices, over the largest self-compliance ([theory](theory.md), equation 36)
        pub bulk_compliance_error: f64,
        /// iterations of the contact solver, sum over all positions
        pub iterations: usize,
    }
}

/// Headline values of a history over the scene's whole mesh cycles.
///
/// # Errors
/// [`StudyError`] if the history does not match the scene, or if a transmission error is not a finite number.
pub fn static_headline(scene: &Scene, history: &StaticHistory) -> Result<StaticHeadline, StudyError> {
    let positions = &history.positions;
    let cycles = scene.analysis.cycles as usize;
    let ste: Vec<f64> = positions.iter().map(|p| p.transmission_error * 1e3).collect();
    let statistics = cycle_statistics(&ste, cycles)?;
    let harmonics = mesh_harmonics(&ste, cycles, ORDERS)?;
    let mean = |f: &dyn Fn(&StaticPosition) -> f64| positions.iter().map(f).sum::<f64>() / positions.len() as f64;
    let worst = |f: &dyn Fn(&StaticPosition) -> f64| positions.iter().map(f).fold(0.0_f64, worse);
    // The gear that drives, and its turns a turn of the pinion.
    let driver = scene.operation.driver.opposite().driven();
    let driver = (driver, [1.0, f64::from(scene.pinion.teeth) / f64::from(scene.wheel.teeth)][driver]);
    Ok(StaticHeadline {
        mean_ste_um: statistics.mean,
        peak_to_peak_ste_um: statistics.peak_to_peak,
        min_ste_um: statistics.min,
        max_ste_um: statistics.max,
        samples_per_cycle: statistics.samples_per_cycle,
        cycles,
        ste_harmonics_um: harmonics.iter().map(|h: &Harmonic| h.amplitude).collect(),
        mean_mesh_stiffness_n_per_um: mean(&|p| p.secant_stiffness * 1e-3),
        mean_mesh_stiffness_tangent_n_per_um: mean(&|p| p.tangent_stiffness * 1e-3),
        mean_contact_line_length_mm: mean(&|p| p.contact_line_length),
        mean_geometric_line_length_mm: mean(&|p| p.geometric_line_length),
        mean_normal_force_n: mean(&|p| p.pairs.iter().map(|pair| pair.normal_force).sum()),
        mean_wheel_force_n: [0, 1, 2].map(|k| mean(&|p| p.wrench[1].force[k])),
        mean_pinion_tilting_moment_nmm: mean(&|p| p.wrench[0].moment[1]),
        mean_wheel_tilting_moment_nmm: mean(&|p| p.wrench[1].moment[1]),
        mean_friction_power_loss_w: mean(&|p| 1e-3 * p.friction_work * scene.pinion_speed()),
        efficiency: 1.0 - share_lost(driver, positions, |p| p.friction_work).unwrap_or(0.0),
        tooth_loss_factor: share_lost(driver, positions, |p| p.sliding_work),
        max_pair_force_n: worst(&|p| p.pairs.iter().map(|pair| pair.normal_force).fold(0.0, worse)),
        face_load_factor: face_load_factor(scene.contact.slices.unwrap_or(1) as usize, positions),
        transverse_load_factor: transverse_load_factor(history),
        load_sharing_ratio: load_sharing_ratio(history),
        max_pressure_mpa: worst(&|p| p.max_pressure),
        max_pressure_at: PressurePlace::of(scene, history),
        root_stress: root_stress_headline(history),
        rating: RatingHeadline::of(scene, history),
        tooth_changes: history.tooth_changes.len(),
        tooth_change: ToothChangeHeadline::of(history),
        worst_torque_residual: worst(&|p| p.certificate.torque_residual),
        worst_complementarity_residual: worst(&|p| p.certificate.complementarity_residual),
        worst_action_reaction_residual: worst(&|p| p.certificate.action_reaction_residual),
        worst_window_edge_load: worst(&|p| p.certificate.window_edge_load),
        bulk_compliance_error: worst(&|p| p.certificate.bulk_compliance_error),
        iterations: positions.iter().map(|p| p.certificate.iterations).sum(),
    })
}

/// Work per radian of the pinion (N mm) over that of the driver, which is given with its turns a turn of the pinion, over the mesh cycles; `None` without torque.
/// Theory (34b).
fn share_lost(
    (driver, ratio): (usize, f64),
    positions: &[StaticPosition],
    lost: impl Fn(&StaticPosition) -> f64,
) -> Option<f64> {
    let put_in: f64 = positions.iter().map(|p| ratio * p.wrench[driver].moment[2].abs()).sum();
    (put_in > 0.0).then(|| positions.iter().map(lost).sum::<f64>() / put_in)
}
