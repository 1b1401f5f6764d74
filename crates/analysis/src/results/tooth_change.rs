//! Where the window of teeth moves on, and what that changes of the solution.

use ltca::{StaticHistory, ToothChangeRecord};
use serde::Serialize;

/// The first tooth change of a run, and the largest jump that any of them makes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[allow(missing_docs)] // the names say what they are, `docs/outputs.md` how they are formed
pub struct ToothChangeHeadline {
    pub mesh_cycles: f64,
    pub pinion_angle_deg: f64,
    pub outgoing_pinion_tooth: u32,
    pub outgoing_wheel_tooth: u32,
    pub oncoming_pinion_tooth: u32,
    pub oncoming_wheel_tooth: u32,
    pub max_ste_jump_um: f64,
    pub max_normal_force_jump_n: f64,
}

impl ToothChangeHeadline {
    /// Of a history at rest; `None` where no tooth changes.
    pub fn of(history: &StaticHistory) -> Option<Self> {
        let all = &history.tooth_changes;
        let first = all.first()?;
        let largest = |jump: fn(&ToothChangeRecord) -> f64| all.iter().map(jump).fold(0.0, crate::worse);
        Some(Self {
            mesh_cycles: first.mesh_cycles,
            pinion_angle_deg: first.pinion_angle.to_degrees(),
            outgoing_pinion_tooth: first.outgoing[0],
            outgoing_wheel_tooth: first.outgoing[1],
            oncoming_pinion_tooth: first.oncoming[0],
            oncoming_wheel_tooth: first.oncoming[1],
            max_ste_jump_um: 1e3 * largest(|c| c.error_jump),
            max_normal_force_jump_n: largest(|c| c.force_jump),
        })
    }

    /// In words, for tables and reports.
    pub fn words(&self) -> String {
        let Self { mesh_cycles, pinion_angle_deg, max_ste_jump_um, .. } = self;
        format!("first at {mesh_cycles:.3} cycles, {pinion_angle_deg:.2} deg; STE jumps by {max_ste_jump_um:.1e} um")
    }
}
