//! Errors of tooth changes.

/// A tooth change that is not permitted, or a window that cannot exist.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum AleError {
    /// The outgoing tooth still carries load.
    #[error(
        "pair {pair} still carries {force_n:.3} N and cannot leave the window (pinion tooth {pinion_tooth}, wheel tooth {wheel_tooth})"
    )]
    LoadedTooth {
        /// Running number of the pair.
        pair: i64,
        /// Pinion tooth.
        pinion_tooth: u32,
        /// Wheel tooth.
        wheel_tooth: u32,
        /// Normal force of the pair, N.
        force_n: f64,
    },
    /// The window has more teeth than the gear.
    #[error("a window of {window} teeth does not fit a gear of {teeth} teeth")]
    TooWide {
        /// Number of teeth of the window.
        window: usize,
        /// Number of teeth of the gear.
        teeth: u32,
    },
    /// The number of forces differs from the number of pairs.
    #[error("{given} pair forces for a window of {window} pairs")]
    WrongCount {
        /// Number of forces given.
        given: usize,
        /// Number of pairs of the window.
        window: usize,
    },
    /// A pair outside the window would be in contact.
    #[error(
        "at mesh phase {phase:.6} of cycle {cycle}: pair {pair} outside the window of {window} teeth overlaps by {overlap_um:.3} um under {torque_nm} N m"
    )]
    Starved {
        /// Mesh cycle.
        cycle: i64,
        /// Phase of the mesh cycle, 0 .. 1.
        phase: f64,
        /// Running number of the pair.
        pair: i64,
        /// Number of teeth of the window.
        window: usize,
        /// Overlap of the undeformed flanks at the loaded pose, um.
        overlap_um: f64,
        /// Torque, N m.
        torque_nm: f64,
    },
    /// Tooth changes cause force jumps: a pair is already in contact when it enters the window.
    #[error(
        "tooth changes of the window of {window} teeth drop forces of up to {jump_n:.3} N, the flanks press with up to {largest_n:.3} N"
    )]
    Dropped {
        /// Number of teeth of the window.
        window: usize,
        /// Largest jump of the normal force at a tooth change, N.
        jump_n: f64,
        /// Largest normal force, N.
        largest_n: f64,
    },
    /// The gears rotate farther in one step than the window can follow.
    #[error(
        "at mesh phase {phase:.6} of cycle {cycle}: the gears have turned by {teeth:.3e} teeth in one step, the window has {window}"
    )]
    Leapt {
        /// Mesh cycle at the end of the step.
        cycle: i64,
        /// Phase of the mesh cycle, 0 .. 1.
        phase: f64,
        /// Number of teeth by which the window lags.
        teeth: f64,
        /// Number of teeth of the window.
        window: usize,
    },
}

impl AleError {
    /// What the user can do next.
    pub fn hint(&self) -> Option<String> {
        match self {
            Self::LoadedTooth { .. } => Some("use a wider window (analysis.window_teeth) or less torque".into()),
            Self::TooWide { teeth, .. } => Some(format!(
                "the window is as wide as the contact ratio asks for, or as `analysis.window_teeth` says, {teeth} teeth at most; \
                 is `face_width_mm` in mm, and the helix angle right?"
            )),
            Self::WrongCount { .. } => None,
            Self::Starved { window, .. } | Self::Dropped { window, .. } => Some(format!(
                "set analysis.window_teeth of the pair to {} (the meshes must have that many teeth), or lower the torque",
                window + 1
            )),
            Self::Leapt { .. } => Some(
                "take smaller steps (`steps_per_mesh_cycle`, `steps_per_resonance`; of a gearbox `steps_per_cycle`), or let an `error_tolerance` choose them; \
                 is every torque in N m, and the inertia in kg m^2?"
                    .into(),
            ),
        }
    }
}
