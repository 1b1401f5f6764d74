//! Errors of a quasi-static analysis.

/// A quasi-static analysis cannot continue.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StaticError {
    /// Contact cannot be set up: a gear cannot be reduced, mesh and geometry do not match, or an offset is out of
    /// range.
    #[error(transparent)]
    SetUp(#[from] contact::ContactError),
    /// Contact cannot be solved at a station.
    #[error("at mesh phase {phase:.6} of cycle {cycle}: {source}")]
    Contact {
        /// Mesh cycle.
        cycle: i64,
        /// Phase of the mesh cycle, 0 .. 1.
        phase: f64,
        /// Error of the contact solution.
        source: contact::ContactError,
    },
    /// The pose did not converge.
    #[error(
        "at mesh phase {phase:.6} of cycle {cycle}: no equilibrium after {iterations} steps, the last one {step_mm:.3e} mm"
    )]
    NoEquilibrium {
        /// Mesh cycle.
        cycle: i64,
        /// Phase of the mesh cycle, 0 .. 1.
        phase: f64,
        /// Number of steps.
        iterations: usize,
        /// Last step on the base circle, mm.
        step_mm: f64,
    },
    /// The deflection of the teeth would be as large as their height.
    #[error(
        "at mesh phase {phase:.6} of cycle {cycle}: {torque_nm} N m would bend the teeth by {deflection_mm:.3} mm, at a module of {module_mm} mm"
    )]
    Overloaded {
        /// Mesh cycle.
        cycle: i64,
        /// Phase of the mesh cycle, 0 .. 1.
        phase: f64,
        /// Torque, N m.
        torque_nm: f64,
        /// Deflection of the driven gear on the base circle at which its flanks lost contact, mm.
        deflection_mm: f64,
        /// Normal module, mm.
        module_mm: f64,
    },
    /// Teeth have passed through each other.
    #[error(
        "at mesh phase {phase:.6} of cycle {cycle}: teeth have passed through each other: along the line of action flanks are {distance_mm:.3e} mm beyond touching (negative: apart), teeth are {thickness_mm:.3} mm thick there"
    )]
    PassedThrough {
        /// Mesh cycle.
        cycle: i64,
        /// Phase of the mesh cycle, 0 .. 1.
        phase: f64,
        /// Distance by which the gears have come closer along the transverse line of action than flanks that touch, mm;
        /// negative: they are farther apart.
        distance_mm: f64,
        /// Half a base pitch, mm.
        thickness_mm: f64,
    },
    /// No flanks face each other at this station.
    #[error(
        "at mesh phase {phase:.6} of cycle {cycle}: without load no flanks touch, wherever the driven gear is turned"
    )]
    Apart {
        /// Mesh cycle.
        cycle: i64,
        /// Phase of the mesh cycle, 0 .. 1.
        phase: f64,
    },
    /// Error of the tooth window.
    #[error(transparent)]
    Window(#[from] ale::AleError),
    /// Contact of points was combined with corner contact switched off.
    #[error("corner contact cannot be switched off in nodal contact: points cannot tell an edge from a flank")]
    NodalCornerContact,
    /// Derivatives were requested at a position where they do not exist.
    #[error("at mesh phase {phase:.6} there are no derivatives {what}")]
    NoDerivative {
        /// Phase, 0 .. 1; NaN if it holds at every phase.
        phase: f64,
        /// Quantity or place without a derivative, as named in the message.
        what: &'static str,
    },
    /// A value outside its range.
    #[error("{name} = {value} is out of range: {expected}")]
    OutOfRange {
        /// Name of the quantity.
        name: &'static str,
        /// Value of the quantity.
        value: f64,
        /// The permitted range.
        expected: &'static str,
    },
}

const SMALLER_STEPS: &str = "take smaller steps (`steps_per_mesh_cycle`, `steps_per_resonance`; of a gearbox `steps_per_cycle`), or let an `error_tolerance` choose them";

impl From<std::convert::Infallible> for StaticError {
    fn from(never: std::convert::Infallible) -> Self {
        match never {}
    }
}

impl From<reduction::ReductionError> for StaticError {
    fn from(source: reduction::ReductionError) -> Self {
        Self::SetUp(contact::ContactError::Reduction { gear: "gear", source })
    }
}

impl StaticError {
    /// Whether the window has too few teeth, so that a wider one may succeed.
    pub fn is_starved(&self) -> bool {
        matches!(self, Self::Window(ale::AleError::Starved { .. } | ale::AleError::Dropped { .. }))
    }

    /// What the user can do next.
    pub fn hint(&self) -> Option<String> {
        match self {
            Self::SetUp(source) | Self::Contact { source, .. } => source.hint(),
            Self::NoEquilibrium { .. } => {
                Some("lower the torque, or try other `slices` (method nodal: `points_per_face_edge`)".into())
            },
            Self::Overloaded { .. } => Some(
                "elasticity here is linear and holds for small deflections: is the torque in N m, the face width in mm, Young's modulus in MPa, a penalty in MPa per mm? Do springs under a bore hold the gear?".into(),
            ),
            Self::PassedThrough { distance_mm, .. } if *distance_mm < 0.0 => Some(format!("{SMALLER_STEPS}; where the torque may turn round, `flanks = \"both\"` lets the coast flanks hold")),
            Self::PassedThrough { .. } => Some(format!("{SMALLER_STEPS}; is every torque in N m?")),
            Self::Apart { .. } => Some("are offsets, tilts and modifications in their units (um, mm)?".into()),
            Self::Window(e) => e.hint(),
            Self::NodalCornerContact => Some("leave corner contact on, or take `contact.method = \"slice\"`".into()),
            Self::NoDerivative { .. } => Some("derivatives want slices, gears reduced by one sector, and a load".into()),
            Self::OutOfRange { name, expected, .. } => Some(format!("give {name} {expected}")),
        }
    }
}
