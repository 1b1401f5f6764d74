//! Changes of the tooth window, and their effect on the solution.

use ltca::{StaticHistory, ToothChangeRecord};
use serde::Serialize;

described::described! {
    /// The first tooth change of a run, and the largest jump that any of them makes.
    #[derive(Debug, Clone, Copy, PartialEq, Serialize)]
    pub struct ToothChangeHeadline {
        /// mesh cycles from the start to the first tooth change
        pub mesh_cycles: f64,
        /// angle of the pinion at the first tooth change
        pub pinion_angle_deg: f64,
        /// tooth of the pinion that leaves the window
        pub outgoing_pinion_tooth: u32,
        /// tooth of the wheel that leaves the window
        pub outgoing_wheel_tooth: u32,
        /// tooth of the pinion that enters the window
        pub oncoming_pinion_tooth: u32,
        /// tooth of the wheel that enters the window
        pub oncoming_wheel_tooth: u32,
        /// largest difference of the STE between the two windows at the same place, of all tooth changes
        pub max_ste_jump_um: f64,
        /// largest difference of the sum of normal forces between the two windows, of all tooth changes
        pub max_normal_force_jump_n: f64,
    }
}

impl ToothChangeHeadline {
    /// Tooth changes of a static history; `None` if no tooth changes.
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

    /// Text for tables and reports.
    pub fn words(&self) -> String {
        let Self { mesh_cycles, pinion_angle_deg, max_ste_jump_um, .. } = self;
        format!("first at {mesh_cycles:.3} cycles, {pinion_angle_deg:.2} deg; STE jumps by {max_ste_jump_um:.1e} um")
    }
}
